// What benchmarks of the gas share: states along two flames, and cases that report the time of a state, its least value
// over repetitions included.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/bench/reactor_states.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace lampblack::bench {

// One state of a flame in all the measures that models take.
struct FlameState {
  double T = 0;                 // K
  double p = 0;                 // Pa
  std::vector<double> Y, X, c;  // mass fractions, mole fractions, mol/m3
};

struct FlameGas {
  Mechanism mechanism;
  std::vector<FlameState> states;
};

inline FlameState flameState(const Thermo& thermo, double T, double p, std::vector<double> Y) {
  FlameState state{T, p, std::move(Y), {}, {}};
  state.X.resize(state.Y.size());
  thermo.massToMole(state.Y, state.X);
  for (const double x : state.X) state.c.push_back(x * p / (constants::gasConstant * T));
  return state;
}

// Every tenth of a thousand states along a premixed flame of methane and air, GRI-Mech 3.0, 1 atm.
inline const FlameGas& methaneFlame() {
  static const FlameGas gas = [] {
    auto mechanism = shippedMechanism("methane_gri30_53");
    const Thermo thermo(mechanism);
    std::vector<FlameState> states;
    for (const auto& s : methaneFlameStates(mechanism)) states.push_back(flameState(thermo, s.T, s.p, s.Y));
    return FlameGas{std::move(mechanism), std::move(states)};
  }();
  return gas;
}

// 30 states along a counterflow flame of ethylene, 1 atm (Bisetti et al. 2012).
inline const FlameGas& ethyleneFlame() {
  static const FlameGas gas = [] {
    auto mechanism = shippedMechanism("ethylene_bisetti2012_47");
    const Thermo thermo(mechanism);
    const test::Table table("counterflow_c2h4_states.csv");
    std::vector<FlameState> states;
    for (std::size_t i = 0; i < table.size(); ++i) {
      std::vector<double> Y(mechanism.numSpecies());
      thermo.moleToMass(table.moleFractions(i, mechanism), Y);
      states.push_back(flameState(thermo, table.number(i, "T"), constants::oneAtmosphere, Y));
    }
    return FlameGas{std::move(mechanism), std::move(states)};
  }();
  return gas;
}

// Call after the timed loop: an iteration took this many states.
inline void countStates(benchmark::State& timer, std::size_t states) {
  const auto count = static_cast<double>(states);
  timer.SetItemsProcessed(static_cast<std::int64_t>(timer.iterations() * states));
  timer.counters["per_state"] =
      benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// work(state) for every state of the gas, once an iteration.
template <class Work>
void timeStates(benchmark::State& timer, const FlameGas& gas, Work&& work) {
  for (auto _ : timer)
    for (const auto& state : gas.states) work(state);
  countStates(timer, gas.states.size());
}

template <class Work>
void registerCase(const std::string& name, Work&& work) {
  benchmark::RegisterBenchmark(name.c_str(), std::forward<Work>(work))
      ->Unit(benchmark::kMicrosecond)
      ->ComputeStatistics("min", [](const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); });
}

inline int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace lampblack::bench
