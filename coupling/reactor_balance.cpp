#include "coupling/reactor_balance.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack {

ReactorBalance::ReactorBalance(const Mechanism& mechanism, ReactorParticles& particles)
    : mechanism_(mechanism),
      particles_(particles),
      thermo_(mechanism),
      h_(particles.size()),
      slope_(particles.size()) {}

std::vector<double> ReactorBalance::elements(std::span<const double> Y, std::span<const double> amounts) const {
  std::vector<double> sums = particles_.elements(amounts);
  sums.resize(mechanism_.numElements(), 0.0);
  const auto W = mechanism_.molecularWeights();
  for (std::size_t e = 0; e < sums.size(); ++e)
    for (std::size_t k = 0; k < Y.size(); ++k)
      sums[e] += Y[k] / W[k] * mechanism_.atoms(k, e) * mechanism_.atomicWeight(e);
  return sums;
}

double ReactorBalance::carriedEnthalpy(double T, std::span<const double> amounts) {
  particles_.enthalpies(T, h_, slope_);
  double sum = 0;
  for (std::size_t s = 0; s < amounts.size(); ++s) sum += amounts[s] * h_[s];
  return sum;
}

double ReactorBalance::enthalpy(double T, std::span<const double> Y, std::span<const double> amounts) {
  return thermo_.enthalpyMass(T, Y) + carriedEnthalpy(T, amounts);
}

double ReactorBalance::internalEnergy(double T, std::span<const double> Y, std::span<const double> amounts) {
  return thermo_.internalEnergyMass(T, Y) + carriedEnthalpy(T, amounts);
}

double largestImbalance(std::span<const double> first, std::span<const double> second) {
  double largest = 0;
  for (std::size_t e = 0; e < first.size(); ++e)
    if (first[e] > 0) largest = std::max(largest, std::abs(second[e] / first[e] - 1));
  return largest;
}

}  // namespace lampblack
