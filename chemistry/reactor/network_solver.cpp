#include "chemistry/reactor/network_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "chemistry/reactor/burning_branch.hpp"
#include "chemistry/reactor/steady_state.hpp"
#include "chemistry/thermo/equilibrium.hpp"

namespace lampblack::chemistry {

namespace {

constexpr std::size_t kUnseen = static_cast<std::size_t>(-1);
constexpr double kSameTemperature = 0.1;  // K, of two steady states

// The part of a network in a group, with what comes from reactors that are solved already as streams from outside.
ReactorNetwork partOf(const ReactorNetwork& network, const std::vector<std::size_t>& group,
                      const std::vector<ReactorSteadyState>& solved) {
  ReactorNetwork part;
  part.pressure = network.pressure;
  std::vector<std::size_t> inPart(network.reactors.size(), kUnseen);
  for (const std::size_t r : group) {
    inPart[r] = part.reactors.size();
    part.reactors.push_back(network.reactors[r]);
  }
  for (const InflowStream& stream : network.inflows)
    if (inPart[stream.to] != kUnseen)
      part.inflows.push_back({inPart[stream.to], stream.massFlow, stream.temperature, stream.Y, stream.carried});
  for (const InnerStream& stream : network.streams) {
    const std::size_t to = inPart[stream.to], from = inPart[stream.from];
    if (to == kUnseen) continue;
    if (from != kUnseen)
      part.streams.push_back({from, to, stream.massFlow});
    else
      part.inflows.push_back({to, stream.massFlow, solved[stream.from].state.temperature, solved[stream.from].state.Y,
                              solved[stream.from].state.carried});
  }
  return part;
}

struct ColdReactor {
  bool out = false;
  std::optional<double> lastBurningTime;
};

// A state in which reactors are cold that could burn becomes a burning one where there is such: one without cold
// reactors, or else one with fewer. What is said of those that stay cold is returned.
std::vector<ColdReactor> relight(const Mechanism& mechanism, NetworkSystem& system, SteadyState& steady) {
  const std::size_t reactors = system.network().reactors.size(), carried = system.numCarried();
  std::vector<ColdReactor> result(reactors);
  const BurningBranch branch(mechanism, system.network());
  const std::size_t cold = branch.cold(steady.y, carried);
  if (cold == 0) return result;
  BurningBranch::Result found = branch.follow(0);
  const bool whole = !found.y.empty();
  if (!whole && cold == reactors && reactors > 1) found.y = branch.follow(cold - 1).y;
  if (!found.y.empty()) {
    std::vector<double> y;
    bool other = false;  // not where the transient has arrived anyway
    const std::size_t own = mechanism.numSpecies() + 1;
    for (std::size_t r = 0; r < reactors; ++r) {
      y.insert(y.end(), &found.y[r * own], &found.y[r * own] + own);
      other = other || std::abs(y.back() - steady.y[y.size() - 1]) > kSameTemperature;
      y.resize(y.size() + carried);
    }
    if (other) steady = networkAtRest(system, y);
  }
  for (std::size_t r = 0; r < reactors; ++r) {
    result[r].out = !whole && branch.isCold(steady.y, r, carried);
    if (result[r].out && !found.lastResidenceTimes.empty()) result[r].lastBurningTime = found.lastResidenceTimes[r];
  }
  return result;
}

}  // namespace

std::vector<std::vector<std::size_t>> solutionOrder(const ReactorNetwork& network) {
  const std::size_t count = network.reactors.size();
  std::vector<std::size_t> index(count, kUnseen), low(count), stack;
  std::vector<bool> onStack(count, false);
  std::vector<std::vector<std::size_t>> groups;
  std::size_t next = 0;
  // Against the streams, so that a group is finished after all that it is fed by.
  const std::function<void(std::size_t)> visit = [&](std::size_t r) {
    index[r] = low[r] = next++;
    stack.push_back(r);
    onStack[r] = true;
    for (const InnerStream& stream : network.streams) {
      if (stream.to != r) continue;
      if (index[stream.from] == kUnseen) {
        visit(stream.from);
        low[r] = std::min(low[r], low[stream.from]);
      } else if (onStack[stream.from]) {
        low[r] = std::min(low[r], index[stream.from]);
      }
    }
    if (low[r] != index[r]) return;
    groups.emplace_back();
    std::size_t member = kUnseen;
    do {
      member = stack.back();
      stack.pop_back();
      onStack[member] = false;
      groups.back().push_back(member);
    } while (member != r);
    std::sort(groups.back().begin(), groups.back().end());
  };
  for (std::size_t r = 0; r < count; ++r)
    if (index[r] == kUnseen) visit(r);
  return groups;
}

GasState startOf(const Mechanism& mechanism, const ReactorNetwork& network, const NetworkStart& start) {
  if (start.given) return *start.given;
  const Thermo thermo(mechanism);
  GasState state{0, network.pressure, std::vector<double>(mechanism.numSpecies(), 0.0)};
  double total = 0, enthalpy = 0, temperature = 0;
  for (const InflowStream& stream : network.inflows) total += stream.massFlow;
  for (const InflowStream& stream : network.inflows) {
    const double share = stream.massFlow / total;
    for (std::size_t k = 0; k < state.Y.size(); ++k) state.Y[k] += share * stream.Y[k];
    enthalpy += share * thermo.enthalpyMass(stream.temperature, stream.Y);
    temperature += share * stream.temperature;
  }
  state.temperature = start.burnt ? Equilibrium(mechanism).atEnthalpyAndPressure(enthalpy, network.pressure, state.Y)
                                  : thermo.temperatureFromEnthalpy(enthalpy, state.Y, temperature);
  return state;
}

std::vector<double> startUnknowns(const Mechanism& mechanism, const ReactorNetwork& network, const NetworkStart& start,
                                  std::size_t carried) {
  GasState begin = startOf(mechanism, network, start);
  const double temperature = begin.temperature;
  std::vector<double> y;
  for (const StirredReactor& reactor : network.reactors) {
    begin.temperature = reactor.temperature.value_or(temperature);
    const std::vector<double> block = unknownsOf(begin, carried);
    y.insert(y.end(), block.begin(), block.end());
  }
  return y;
}

std::vector<ReactorSteadyState> solveNetwork(const Mechanism& mechanism, const ReactorNetwork& network,
                                             const NetworkStart& start, CarriedPhase* carried) {
  std::vector<ReactorSteadyState> solved(network.reactors.size());
  for (const auto& group : solutionOrder(network)) {
    NetworkSystem system(mechanism, partOf(network, group, solved), carried);
    const ReactorNetwork& part = system.network();
    SteadyState steady = networkAtRest(system, startUnknowns(mechanism, part, start, system.numCarried()));
    std::vector<ColdReactor> coldOnes(group.size());
    if (start.burnt && !start.given) coldOnes = relight(mechanism, system, steady);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const double* block = system.block(steady.y.data(), i);
      ReactorSteadyState& result = solved[group[i]];
      const double* amounts = block + mechanism.numSpecies() + 1;
      result.state = {block[mechanism.numSpecies()],
                      network.pressure,
                      {block, block + mechanism.numSpecies()},
                      {amounts, amounts + system.numCarried()}};
      result.massFlow = part.throughflow(i);
      result.density = system.density(block);
      result.residenceTime = system.residenceTime(steady.y.data(), i);
      result.volume = result.residenceTime * result.massFlow / result.density;
      result.heatRelease = system.heatRelease(steady.y.data(), i);
      result.residual = steady.residual;
      result.steps = steady.steps;
      result.out = coldOnes[i].out;
      result.lastBurningTime = coldOnes[i].lastBurningTime;
    }
  }
  return solved;
}

}  // namespace lampblack::chemistry
