// Timings of rates, properties and thermodynamics on states along two flames: premixed methane (GRI-Mech 3.0, 53
// species, 325 reactions) and counterflow ethylene (47 species, 224 reactions). Transport and the reactor have files of
// their own.
//
//   build/release/tests/bench/chemistry_bench --benchmark_repetitions=20 --benchmark_report_aggregates_only=true
//       --benchmark_enable_random_interleaving=true                 (configured with -DLAMPBLACK_BENCH=ON)
//
// An iteration takes every state once; `per_state` of the row `min` is what is to be read on a machine that does other
// things too. Interleaving lets all cases see the same minutes, so that their ratios hold.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "chemistry/kinetics/batch_kinetics.hpp"
#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/reactor/reactor.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/bench/timing.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;
using bench::FlameGas;
using bench::FlameState;

void scalarRates(benchmark::State& timer, const FlameGas& gas) {
  Kinetics kinetics(gas.mechanism);
  std::vector<double> wdot(gas.mechanism.numSpecies());
  bench::timeStates(timer, gas, [&](const FlameState& state) {
    kinetics.netProductionRates(state.T, state.c, wdot);
    benchmark::DoNotOptimize(wdot.data());
  });
}

void scalarRatesOfOneTemperature(benchmark::State& timer, const FlameGas& gas) {
  Kinetics kinetics(gas.mechanism);
  std::vector<double> wdot(gas.mechanism.numSpecies());
  bench::timeStates(timer, gas, [&](const FlameState& state) {
    kinetics.netProductionRates(1500.0, state.c, wdot);
    benchmark::DoNotOptimize(wdot.data());
  });
}

void denseJacobian(benchmark::State& timer, const FlameGas& gas) {
  Kinetics kinetics(gas.mechanism);
  const std::size_t n = gas.mechanism.numSpecies();
  std::vector<double> wdot(n), jacobian(n * n), byT(n);
  bench::timeStates(timer, gas, [&](const FlameState& state) {
    kinetics.netProductionRatesAndJacobian(state.T, state.c, wdot, jacobian, byT);
    benchmark::DoNotOptimize(jacobian.data());
  });
}

void sparseJacobian(benchmark::State& timer, const FlameGas& gas) {
  Kinetics kinetics(gas.mechanism);
  const std::size_t n = gas.mechanism.numSpecies();
  std::vector<double> wdot(n), values(kinetics.jacobianPattern().numEntries()), common(n), byT(n);
  bench::timeStates(timer, gas, [&](const FlameState& state) {
    kinetics.netProductionRatesAndSparseJacobian(state.T, state.c, wdot, values, common, byT);
    benchmark::DoNotOptimize(values.data());
  });
}

// The flame's states over and over until there are `size`.
void batchRates(benchmark::State& timer, const FlameGas& gas, BatchKinetics::Instructions instructions,
                std::size_t size) {
  if (!BatchKinetics::available(instructions)) return timer.SkipWithError("this processor has no such instructions");
  BatchKinetics kinetics(gas.mechanism, instructions);
  const std::size_t n = gas.mechanism.numSpecies();
  std::vector<double> T(size), c(n * size), wdot(n * size);
  for (std::size_t i = 0; i < size; ++i) {
    const auto& state = gas.states[i % gas.states.size()];
    T[i] = state.T;
    for (std::size_t k = 0; k < n; ++k) c[k * size + i] = state.c[k];
  }
  for (auto _ : timer) {
    kinetics.netProductionRates(T, c, wdot);
    benchmark::DoNotOptimize(wdot.data());
    benchmark::ClobberMemory();
  }
  bench::countStates(timer, size);
}

void enthalpy(benchmark::State& timer, const FlameGas& gas) {
  const Thermo thermo(gas.mechanism);
  bench::timeStates(timer, gas,
                    [&](const FlameState& state) { benchmark::DoNotOptimize(thermo.enthalpyMass(state.T, state.Y)); });
}

// From a guess 50 K off.
void temperatureFromEnthalpy(benchmark::State& timer, const FlameGas& gas) {
  const Thermo thermo(gas.mechanism);
  std::vector<double> enthalpies;
  for (const auto& state : gas.states) enthalpies.push_back(thermo.enthalpyMass(state.T, state.Y));
  bench::timeStates(timer, gas, [&](const FlameState& state) {
    const auto i = static_cast<std::size_t>(&state - gas.states.data());
    benchmark::DoNotOptimize(thermo.temperatureFromEnthalpy(enthalpies[i], state.Y, state.T + 50));
  });
}

// A cell of a steady flame: the transport's source balances the reactions.
void reactorInBalance(benchmark::State& timer, const FlameGas& gas, double dt) {
  const std::size_t n = gas.mechanism.numSpecies();
  ConstantPressureReactor reactor(gas.mechanism);
  ReactorSystem system(gas.mechanism);
  std::vector<std::vector<double>> sources;
  for (const auto& state : gas.states) {
    auto y = state.Y;
    y.push_back(state.T);
    std::vector<double> f(n + 1);
    system.setConditions(constants::oneAtmosphere, {});
    system.chemicalRates(y.data(), f.data());
    for (double& value : f) value = -value;
    f.resize(n);
    sources.push_back(f);
  }
  std::vector<double> Y(n);
  bench::timeStates(timer, gas, [&](const FlameState& state) {
    Y = state.Y;
    const auto i = static_cast<std::size_t>(&state - gas.states.data());
    ConstantPressureReactor::Cell cell{state.T, constants::oneAtmosphere, Y, sources[i], 0.0};
    benchmark::DoNotOptimize(reactor.advance(cell, dt));
  });
}

void registerGas(const std::string& name, const FlameGas& (*gas)()) {
  const auto add = [&](const std::string& what, auto work) {
    bench::registerCase(name + "/" + what, [gas, work](benchmark::State& timer) { work(timer, gas()); });
  };
  add("rates/one_by_one/new_temperature", scalarRates);
  add("rates/one_by_one/same_temperature", scalarRatesOfOneTemperature);
  for (const auto instructions :
       {BatchKinetics::Instructions::Generic, BatchKinetics::Instructions::Avx2, BatchKinetics::Instructions::Avx512})
    for (const std::size_t size : {8, 101, 1000})
      add("rates/batch_of_" + std::to_string(size) + "/" + BatchKinetics::name(instructions),
          [=](benchmark::State& timer, const FlameGas& states) { batchRates(timer, states, instructions, size); });
  add("rates_and_jacobian/dense", denseJacobian);
  add("rates_and_jacobian/sparse", sparseJacobian);
  add("enthalpy", enthalpy);
  add("temperature_from_enthalpy", temperatureFromEnthalpy);
  add("reactor_in_balance/1e-05_s", [](auto& timer, const auto& states) { reactorInBalance(timer, states, 1e-5); });
}

}  // namespace

int main(int argc, char** argv) {
  registerGas("methane", bench::methaneFlame);
  registerGas("ethylene", bench::ethyleneFlame);
  return bench::run(argc, argv);
}
