#include "particles/population/exact_solutions/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.hpp"

namespace lampblack::particles::exact {

double scaledBesselI1(double z) {
  if (z <= 30) {
    const double square = 0.25 * z * z;
    double term = 0.5 * z, sum = term;
    for (int k = 1; term > 1e-17 * sum; ++k) sum += term *= square / (k * (k + 1.0));
    return std::exp(-z) * sum;
  }
  // Asymptotic: the smallest term is about exp(-2 z).
  double term = 1, sum = 1;
  for (int k = 1; k < 60 && std::abs(term) > 1e-17; ++k) {
    const double odd = 2 * k - 1;
    sum += term *= (odd * odd - 4) / (8 * k * z);
  }
  return sum / std::sqrt(2 * constants::pi * z);
}

double logarithmicExcess(double e) {
  if (e > 0.25) return -std::log1p(-e) - e;
  double power = e, sum = 0;
  for (int k = 2; power > 0; ++k) {
    power *= e;
    sum += power / k;
    if (power < 1e-18 * sum) break;
  }
  return sum;
}

double stirlingRest(double k) {
  if (k < 16) return std::lgamma(k + 1) - 0.5 * std::log(2 * constants::pi * k) - k * std::log(k) + k;
  const double x = 1 / (k * k);
  return (1 / 12.0 - x * (1 / 360.0 - x * (1 / 1260.0 - x * (1 / 1680.0 - x / 1188.0)))) / k;
}

double multiplicativeDensity(double tau, double x) {
  const double decay = -(1 + tau) * x;
  const double argument = tau * x * x * x;
  if (!(argument > 0)) return std::exp(decay);
  // From the largest term outwards.
  const double peak = std::floor(std::cbrt(argument / 4));
  const double largest = decay + peak * std::log(argument) - std::lgamma(peak + 2) - std::lgamma(2 * peak + 2);
  double sum = 1, term = 1;
  for (double k = peak + 1; term > 1e-18 * sum; ++k) sum += term *= argument / ((k + 1) * 2 * k * (2 * k + 1));
  term = 1;
  for (double k = peak; k > 0 && term > 1e-18 * sum; --k) sum += term *= (k + 1) * 2 * k * (2 * k + 1) / argument;
  return std::exp(largest) * sum;
}

}  // namespace lampblack::particles::exact
