#include "chemistry/nasa7.hpp"

namespace lampblack {

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

}  // namespace

Nasa7Table::Nasa7Table(std::span<const Species> species) {
  for (const auto& s : species) {
    mid_.push_back(s.thermo.midTemperature);
    for (std::size_t n = 0; n < 7; ++n) {
      low_[n].push_back(s.thermo.low[n]);
      high_[n].push_back(s.thermo.high[n]);
    }
  }
}

void Nasa7Table::cpOverR(double T, double* cp) const {
  combine<0, 5>(T, mid_, low_, high_, {1.0, T, T * T, T * T * T, T * T * T * T}, cp);
}

void Nasa7Table::cpSlopeOverR(double T, double* slope) const {
  combine<1, 4>(T, mid_, low_, high_, {1.0, 2 * T, 3 * T * T, 4 * T * T * T}, slope);
}

void Nasa7Table::enthalpyOverRT(double T, double* h) const {
  combine<0, 6>(T, mid_, low_, high_, {1.0, T / 2, T * T / 3, T * T * T / 4, T * T * T * T / 5, 1 / T}, h);
}

void Nasa7Table::entropyOverR(double T, double lnT, double* s) const {
  combine<0, 7>(T, mid_, low_, high_, {lnT, T, T * T / 2, T * T * T / 3, T * T * T * T / 4, 0.0, 1.0}, s);
}

void Nasa7Table::gibbsOverRT(double T, double lnT, double* g) const {
  combine<0, 7>(T, mid_, low_, high_,
                {1.0 - lnT, -T / 2, -T * T / 6, -T * T * T / 12, -T * T * T * T / 20, 1 / T, -1.0}, g);
}

}  // namespace lampblack
