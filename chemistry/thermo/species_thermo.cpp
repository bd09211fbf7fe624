#include "chemistry/thermo/species_thermo.hpp"

#include <algorithm>
#include <cmath>

#include "chemistry/mechanism/nasa_polynomials.hpp"
#include "numerics/block.hpp"

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
    for (std::size_t n = 0; n < kBlockWidth; ++n) {
      lowBlock_.push_back(n < 7 ? s.thermo.low[n] : 0.0);
      highBlock_.push_back(n < 7 ? s.thermo.high[n] : 0.0);
    }
    if (s.nasa9) nasa9_.push_back({k, *s.nasa9});
  }
  changes_ = mid_;
  std::ranges::sort(changes_);
  changes_.erase(std::unique(changes_.begin(), changes_.end()), changes_.end());
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
  const auto next = std::ranges::lower_bound(changes_, T);
  result.above = next == changes_.begin() ? -HUGE_VAL : *(next - 1);
  result.upTo = next == changes_.end() ? HUGE_VAL : *next;
  const auto coefficients = [&](std::size_t k) {
    return (T <= mid_[k] ? lowBlock_ : highBlock_).data() + k * kBlockWidth;
  };
  // In two sums, as one would wait for itself.
  Block even{}, odd{};
  const std::size_t n = mid_.size();
  for (std::size_t k = 0; k + 1 < n; k += 2) {
    even += weights[k] * blockAt(coefficients(k));
    odd += weights[k + 1] * blockAt(coefficients(k + 1));
  }
  if (n % 2 == 1) even += weights[n - 1] * blockAt(coefficients(n - 1));
  const Block sum = even + odd;
  for (std::size_t i = 0; i < result.c.size(); ++i) result.c[i] = sum[i];
  return result;
}

}  // namespace lampblack::chemistry
