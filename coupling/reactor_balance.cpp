#include "coupling/reactor_balance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lampblack::coupling {

ReactorBalance::ReactorBalance(const Mechanism& mechanism, CarriedPhase& phase,
                               std::vector<std::vector<double>> unitElements)
    : mechanism_(mechanism),
      phase_(phase),
      unitElements_(std::move(unitElements)),
      thermo_(mechanism),
      h_(phase.size()),
      slope_(phase.size()) {}

std::vector<double> ReactorBalance::elements(std::span<const double> Y, std::span<const double> amounts) const {
  std::vector<double> sums(mechanism_.numElements(), 0.0);
  const auto W = mechanism_.molecularWeights();
  for (std::size_t s = 0; s < amounts.size(); ++s)
    for (std::size_t e = 0; e < sums.size(); ++e) sums[e] += amounts[s] * unitElements_[s][e];
  for (std::size_t e = 0; e < sums.size(); ++e)
    for (std::size_t k = 0; k < Y.size(); ++k)
      sums[e] += Y[k] / W[k] * mechanism_.atoms(k, e) * mechanism_.atomicWeight(e);
  return sums;
}

double ReactorBalance::carriedEnthalpy(double T, std::span<const double> amounts) {
  phase_.enthalpies(T, h_, slope_);
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
  constexpr double roundOff = 1e-15;
  const double least = roundOff * std::accumulate(first.begin(), first.end(), 0.0);
  double largest = 0;
  for (std::size_t e = 0; e < first.size(); ++e)
    if (first[e] > least) largest = std::max(largest, std::abs(second[e] / first[e] - 1));
  return largest;
}

std::vector<SteadyBalance> steadyBalances(const Mechanism& mechanism, ReactorParticles& particles,
                                          const ReactorNetwork& network,
                                          const std::vector<ReactorSteadyState>& states) {
  ReactorBalance balance(mechanism, particles, particles.unitElements());
  std::vector<SteadyBalance> results;
  for (std::size_t r = 0; r < states.size(); ++r) {
    std::vector<double> in(mechanism.numElements(), 0.0);
    double energyIn = 0;
    const auto add = [&](double massFlow, double T, std::span<const double> Y, std::span<const double> carried) {
      const std::vector<double> elements = balance.elements(Y, carried);
      for (std::size_t e = 0; e < in.size(); ++e) in[e] += massFlow * elements[e];
      energyIn += massFlow * balance.enthalpy(T, Y, carried);
    };
    for (const InflowStream& stream : network.inflows)
      if (stream.to == r) add(stream.massFlow, stream.temperature, stream.Y, stream.carried);
    for (const InnerStream& stream : network.streams) {
      const GasState& from = states[stream.from].state;
      if (stream.to == r) add(stream.massFlow, from.temperature, from.Y, from.carried);
    }
    const GasState& state = states[r].state;
    const StirredReactor& vessel = network.reactors[r];
    std::vector<double> out = balance.elements(state.Y, state.carried);
    for (double& value : out) value *= states[r].massFlow;
    const double energyOut = states[r].massFlow * balance.enthalpy(state.temperature, state.Y, state.carried) +
                             vessel.conductance * (state.temperature - vessel.surroundings);
    const double scale = states[r].massFlow * Thermo(mechanism).cpMass(state.temperature, state.Y) * state.temperature;
    results.push_back({largestImbalance(in, out), vessel.temperature ? 0.0 : (energyIn - energyOut) / scale});
  }
  return results;
}

}  // namespace lampblack::coupling
