#include "chemistry/thermo/species_thermo.hpp"

#include <algorithm>
#include <cmath>

#include "chemistry/mechanism/nasa_polynomials.hpp"

namespace lampblack::chemistry {

namespace {

// sum_n c_n a_n over the coefficients First..First+N-1 of each species, with the range chosen by temperature.
template <std::size_t First, std::size_t N>
void combine(double T, const std::vector<double>& mid, const std::array<std::vector<double>, 7>& low,
             const std::array<std::vector<double>, 7>& high, const std::array<double, N>& c, double* __restrict out) {
  const std::size_t size = mid.size();
  const double* __restrict m = mid.data();
  std::array<const double*, N> lo, hi;
  for (std::size_t n = 0; n < N; ++n) {
    lo[n] = low[First + n].data();
    hi[n] = high[First + n].data();
  }
  for (std::size_t k = 0; k < size; ++k) {
    double below = 0, above = 0;
    for (std::size_t n = 0; n < N; ++n) {
      below += c[n] * lo[n][k];
      above += c[n] * hi[n][k];
    }
    out[k] = T <= m[k] ? below : above;
  }
}

// Sum of weights times the coefficients that hold at T.
double dotOfChosen(double T, const double* __restrict mid, const double* __restrict low, const double* __restrict high,
                   const double* __restrict weights, std::size_t n) {
  constexpr std::size_t width = 8;
  double sums[width] = {};
  std::size_t k = 0;
  for (; k + width <= n; k += width)
    for (std::size_t l = 0; l < width; ++l) sums[l] += weights[k + l] * (T <= mid[k + l] ? low[k + l] : high[k + l]);
  for (std::size_t l = 0; k < n; ++k, ++l) sums[l] += weights[k] * (T <= mid[k] ? low[k] : high[k]);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

const std::array<double, 7>& range(const Nasa7& data, double T) {
  return T <= data.midTemperature ? data.low : data.high;
}

// A range holds from its lower bound on; the first and the last beyond their ends, too.
const std::array<double, 9>& range(const Nasa9& data, double T) {
  const auto inner = std::span(data.temperatures).subspan(1, data.ranges.size() - 1);
  return data.ranges[static_cast<std::size_t>(std::upper_bound(inner.begin(), inner.end(), T) - inner.begin())];
}

double cpSlopeOverR(const std::array<double, 9>& a, double T) {
  return (-2 * a[0] / T - a[1]) / (T * T) + a[3] + T * (2 * a[4] + T * (3 * a[5] + T * 4 * a[6]));
}

}  // namespace

double cpOverR(const Species& species, double T) {
  return species.nasa9 ? cpOverR(range(*species.nasa9, T), T) : cpOverR(range(species.thermo, T), T);
}

double enthalpyOverRT(const Species& species, double T) {
  return species.nasa9 ? enthalpyOverRT(range(*species.nasa9, T), T, std::log(T))
                       : enthalpyOverRT(range(species.thermo, T), T);
}

double entropyOverR(const Species& species, double T) {
  const double lnT = std::log(T);
  return species.nasa9 ? entropyOverR(range(*species.nasa9, T), T, lnT)
                       : entropyOverR(range(species.thermo, T), T, lnT);
}

SpeciesThermo::SpeciesThermo(std::span<const Species> species) {
  for (std::size_t k = 0; k < species.size(); ++k) {
    const auto& s = species[k];
    mid_.push_back(s.thermo.midTemperature);
    for (std::size_t n = 0; n < 7; ++n) {
      low_[n].push_back(s.thermo.low[n]);
      high_[n].push_back(s.thermo.high[n]);
    }
    if (s.nasa9) nasa9_.push_back({k, *s.nasa9});
  }
}

void SpeciesThermo::cpOverR(double T, double* cp) const {
  combine<0, 5>(T, mid_, low_, high_, {1.0, T, T * T, T * T * T, T * T * T * T}, cp);
  for (const auto& s : nasa9_) cp[s.index] = chemistry::cpOverR(range(s.data, T), T);
}

void SpeciesThermo::cpSlopeOverR(double T, double* slope) const {
  combine<1, 4>(T, mid_, low_, high_, {1.0, 2 * T, 3 * T * T, 4 * T * T * T}, slope);
  for (const auto& s : nasa9_) slope[s.index] = chemistry::cpSlopeOverR(range(s.data, T), T);
}

void SpeciesThermo::enthalpyOverRT(double T, double* h) const {
  combine<0, 6>(T, mid_, low_, high_, {1.0, T / 2, T * T / 3, T * T * T / 4, T * T * T * T / 5, 1 / T}, h);
  if (nasa9_.empty()) return;
  const double lnT = std::log(T);
  for (const auto& s : nasa9_) h[s.index] = chemistry::enthalpyOverRT(range(s.data, T), T, lnT);
}

void SpeciesThermo::entropyOverR(double T, double lnT, double* s) const {
  combine<0, 7>(T, mid_, low_, high_, {lnT, T, T * T / 2, T * T * T / 3, T * T * T * T / 4, 0.0, 1.0}, s);
  for (const auto& one : nasa9_) s[one.index] = chemistry::entropyOverR(range(one.data, T), T, lnT);
}

void SpeciesThermo::gibbsOverRT(double T, double lnT, double* g) const {
  combine<0, 7>(T, mid_, low_, high_,
                {1.0 - lnT, -T / 2, -T * T / 6, -T * T * T / 12, -T * T * T * T / 20, 1 / T, -1.0}, g);
  for (const auto& s : nasa9_) {
    const auto& a = range(s.data, T);
    g[s.index] = chemistry::enthalpyOverRT(a, T, lnT) - chemistry::entropyOverR(a, T, lnT);
  }
}

MixturePolynomial SpeciesThermo::mixture(double T, const double* weights) const {
  MixturePolynomial result;
  result.above = -HUGE_VAL;
  result.upTo = HUGE_VAL;
  for (const double mid : mid_) {
    if (mid < T) result.above = std::max(result.above, mid);
    if (!(mid < T)) result.upTo = std::min(result.upTo, mid);
  }
  for (std::size_t n = 0; n < result.c.size(); ++n)
    result.c[n] = dotOfChosen(T, mid_.data(), low_[n].data(), high_[n].data(), weights, mid_.size());
  return result;
}

}  // namespace lampblack::chemistry
