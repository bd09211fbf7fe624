// Timings and accuracy of the constant-pressure reactor: states of a methane flame (GRI-Mech 3.0) and igniting methane
// with six mechanisms, against the same reactor with difference quotients for a Jacobian.
//
//   build/release/tests/bench/reactor_bench                           (configured with -DLAMPBLACK_BENCH=ON)
//   build/release/tests/bench/reactor_bench --no_errors               (without the table of errors at its beginning)
//
// An iteration advances every state once; `per_state` is what is to be read.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/bench/difference_quotient_reactor.hpp"
#include "tests/bench/reactor_states.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;
using bench::GasState;

constexpr double kRelativeTolerance = 1e-6, kAbsoluteTolerance = 1e-12;

struct Gas {
  Mechanism mechanism;
  std::vector<GasState> states;
};

const Gas& methaneFlame() {
  static const Gas gas = [] {
    auto mechanism = bench::shippedMechanism("methane_gri30_53");
    auto states = bench::methaneFlameStates(mechanism);
    return Gas{std::move(mechanism), std::move(states)};
  }();
  return gas;
}

Gas ignitingMethane(const std::string& name) {
  auto mechanism = bench::shippedMechanism(name);
  auto states = bench::methaneIgnitionStates(mechanism);
  return {std::move(mechanism), std::move(states)};
}

ConstantPressureReactor reactorOf(const Mechanism& mechanism, double relative, double absolute) {
  return {mechanism, {relative, absolute, 1000000, 0.0}};
}

int advance(ConstantPressureReactor& reactor, GasState& state, double dt) {
  ConstantPressureReactor::Cell cell{state.T, state.p, state.Y, {}, 0.0};
  const auto result = reactor.advance(cell, dt);
  state.T = cell.temperature;
  return result.steps;
}

template <class Advance>
void timeStates(benchmark::State& timer, const std::vector<GasState>& states, Advance&& advanceState) {
  long steps = 0;
  auto work = states;
  for (auto _ : timer) {
    steps = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      work[i] = states[i];
      steps += advanceState(work[i]);
    }
  }
  const auto count = static_cast<double>(states.size());
  timer.counters["per_state"] =
      benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  timer.counters["steps"] = static_cast<double>(steps) / count;
}

void analytic(benchmark::State& timer, const Gas& gas, double dt, double relative, double absolute) {
  auto reactor = reactorOf(gas.mechanism, relative, absolute);
  timeStates(timer, gas.states, [&](GasState& state) { return advance(reactor, state, dt); });
}

void differenceQuotients(benchmark::State& timer, const Gas& gas, double dt) {
  bench::DifferenceQuotientReactor reactor(gas.mechanism, kRelativeTolerance, kAbsoluteTolerance);
  timeStates(timer, gas.states, [&](GasState& state) { return reactor.advance(state, dt); });
}

// Largest and root-mean-square errors: of T in K, and of mass fractions (absolute, over all states and species).
struct Errors {
  double largestT = 0, meanT = 0, largestY = 0, meanY = 0;
};

Errors errorsOf(const std::vector<GasState>& states, const std::vector<GasState>& exact) {
  Errors e;
  std::size_t values = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double byT = states[i].T - exact[i].T;
    e.largestT = std::max(e.largestT, std::abs(byT));
    e.meanT += byT * byT;
    for (std::size_t k = 0; k < exact[i].Y.size(); ++k) {
      const double byY = states[i].Y[k] - exact[i].Y[k];
      e.largestY = std::max(e.largestY, std::abs(byY));
      e.meanY += byY * byY;
      ++values;
    }
  }
  e.meanT = std::sqrt(e.meanT / static_cast<double>(states.size()));
  e.meanY = std::sqrt(e.meanY / static_cast<double>(values));
  return e;
}

void printErrors(const Gas& gas, const char* name) {
  bench::DifferenceQuotientReactor quotients(gas.mechanism, kRelativeTolerance, kAbsoluteTolerance);
  auto ours = reactorOf(gas.mechanism, kRelativeTolerance, kAbsoluteTolerance);
  auto exact = reactorOf(gas.mechanism, 1e-11, 1e-18);
  std::printf("errors against rtol 1e-11: %s\n%-8s %-22s %10s %10s %10s %10s\n", name, "dt, s", "Jacobian", "T max, K",
              "T rms, K", "Y max", "Y rms");
  for (const double dt : {1e-6, 1e-5, 1e-4}) {
    auto a = gas.states, b = gas.states, c = gas.states;
    for (std::size_t i = 0; i < a.size(); ++i) {
      advance(ours, a[i], dt);
      quotients.advance(b[i], dt);
      advance(exact, c[i], dt);
    }
    for (const auto& [what, states] : {std::pair{"analytic", &a}, std::pair{"difference quotients", &b}}) {
      const auto e = errorsOf(*states, c);
      std::printf("%-8.0e %-22s %10.2e %10.2e %10.2e %10.2e\n", dt, what, e.largestT, e.meanT, e.largestY, e.meanY);
    }
  }
}

void registerMethaneFlame() {
  for (const double dt : {1e-6, 1e-5, 1e-4}) {
    char name[64];
    std::snprintf(name, sizeof name, "methane_flame/analytic/%.0e_s", dt);
    benchmark::RegisterBenchmark(name, [dt](benchmark::State& timer) {
      analytic(timer, methaneFlame(), dt, kRelativeTolerance, kAbsoluteTolerance);
    })->Unit(benchmark::kMillisecond);
    std::snprintf(name, sizeof name, "methane_flame/difference_quotients/%.0e_s", dt);
    benchmark::RegisterBenchmark(name, [dt](benchmark::State& timer) {
      differenceQuotients(timer, methaneFlame(), dt);
    })->Unit(benchmark::kMillisecond);
  }
  benchmark::RegisterBenchmark("methane_flame/analytic/1e-05_s/rtol_1e-09", [](benchmark::State& timer) {
    analytic(timer, methaneFlame(), 1e-5, 1e-9, 1e-15);
  })->Unit(benchmark::kMillisecond);
}

void registerScaling() {
  for (const char* name : {"methane_drm19_21", "ethylene_bisetti2012_47", "methane_gri30_53", "ethylene_abf2000_101",
                           "ethylene_narayanaswamy2010_158", "ethylene_km2_202"}) {
    benchmark::RegisterBenchmark((std::string("igniting_methane/") + name).c_str(), [name](benchmark::State& timer) {
      const auto gas = ignitingMethane(name);
      analytic(timer, gas, 1e-5, kRelativeTolerance, kAbsoluteTolerance);
      timer.counters["species"] = static_cast<double>(gas.mechanism.numSpecies());
    })->Unit(benchmark::kMillisecond);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool wantsErrors = argc < 2 || std::string(argv[1]) != "--no_errors";
  if (!wantsErrors) std::rotate(argv + 1, argv + 2, argv + argc--);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  if (wantsErrors) printErrors(methaneFlame(), "methane flame, GRI-Mech 3.0, 101 states");
  registerMethaneFlame();
  registerScaling();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
