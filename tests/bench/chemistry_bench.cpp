// Timings of the chemistry room on states along a counterflow ethylene flame (47 species, 224 reactions). Each number
// is the best of several rounds.
//
//   build/release/tests/bench/chemistry_bench      (configured with -DLAMPBLACK_BENCH=ON)
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

#include "chemistry/dense_lu.hpp"
#include "chemistry/kinetics.hpp"
#include "chemistry/reactor.hpp"
#include "chemistry/reactor_system.hpp"
#include "chemistry/thermo.hpp"
#include "chemistry/transport.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/table.hpp"

namespace {

using namespace lampblack;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Seconds a call of work(i), best of nine rounds of `calls`.
template <class Work>
double time(int calls, Work&& work) {
  double best = 1e30;
  for (int round = 0; round < 9; ++round) {
    const double start = now();
    for (int i = 0; i < calls; ++i) work(i);
    best = std::min(best, (now() - start) / calls);
  }
  return best;
}

struct State {
  double T = 0;
  std::vector<double> X, Y, c;
};

void report(const char* what, double seconds) {
  std::printf("%-60s %10.3f us\n", what, 1e6 * seconds);
}

void timeReactor(const Mechanism& mechanism, const std::vector<State>& states, double dt, double rtol, bool balanced) {
  ConstantPressureReactor::Options options;
  options.relativeTolerance = rtol;
  if (rtol < 1e-7) options.absoluteTolerance = 1e-15;
  ConstantPressureReactor reactor(mechanism, options);
  ReactorSystem system(mechanism);
  const std::size_t n = mechanism.numSpecies();
  double best = 1e30, worst = 0;
  long steps = 0, skipped = 0, jacobians = 0, calls = 0;
  for (int round = 0; round < 5; ++round) {
    double total = 0;
    steps = skipped = jacobians = calls = 0;
    worst = 0;
    for (const auto& state : states) {
      auto Y = state.Y;
      std::vector<double> source;
      if (balanced) {
        std::vector<double> y = Y, f(n + 1);
        y.push_back(state.T);
        system.setConditions(constants::oneAtmosphere, {});
        system.chemicalRates(y.data(), f.data());
        source.resize(n);
        for (std::size_t k = 0; k < n; ++k) source[k] = -f[k];
      }
      ConstantPressureReactor::Cell cell{state.T, constants::oneAtmosphere, Y, source, 0.0};
      const double start = now();
      const auto result = reactor.advance(cell, dt);
      const double seconds = now() - start;
      total += seconds;
      worst = std::max(worst, seconds);
      steps += result.steps;
      jacobians += result.jacobianEvaluations;
      calls += result.rhsEvaluations;
      skipped += result.skipped ? 1 : 0;
    }
    best = std::min(best, total / static_cast<double>(states.size()));
  }
  const auto count = static_cast<double>(states.size());
  std::printf(
      "reactor dt %.0e rtol %.0e %-9s mean %8.1f us, worst %8.1f us, %6.1f steps, %6.1f rates, %5.1f jacobians, "
      "%ld of %zu skipped\n",
      dt, rtol, balanced ? "balanced" : "", 1e6 * best, 1e6 * worst, static_cast<double>(steps) / count,
      static_cast<double>(calls) / count, static_cast<double>(jacobians) / count, skipped, states.size());
}

}  // namespace

int main() {
  const auto& mechanism = testing::ethylene();
  const std::size_t n = mechanism.numSpecies();
  const testing::Table table("counterflow_c2h4_states.csv");
  Thermo thermo(mechanism);
  std::vector<State> states;
  for (std::size_t i = 0; i < table.size(); ++i) {
    State s;
    s.T = table.number(i, "T");
    s.X = table.moleFractions(i, mechanism);
    s.Y.resize(n);
    thermo.moleToMass(s.X, s.Y);
    for (const double x : s.X) s.c.push_back(x * constants::oneAtmosphere / (constants::gasConstant * s.T));
    states.push_back(s);
  }
  const auto state = [&](int i) -> const State& { return states[static_cast<std::size_t>(i) % states.size()]; };
  std::printf("%s: %zu species, %zu reactions\n", mechanism.description().c_str(), n, mechanism.numReactions());

  Kinetics kinetics(mechanism);
  std::vector<double> wdot(n), byT(n), J(n * n), D(n);
  report("net production rates, new temperature",
         time(20000, [&](int i) { kinetics.netProductionRates(state(i).T, state(i).c, wdot); }));
  report("net production rates, same temperature",
         time(20000, [&](int i) { kinetics.netProductionRates(1500.0, state(i).c, wdot); }));
  report("net production rates and Jacobian",
         time(5000, [&](int i) { kinetics.netProductionRatesAndJacobian(state(i).T, state(i).c, wdot, J, byT); }));
  Transport transport(mechanism);
  double sink = 0;
  report("mixture transport", time(10000, [&](int i) {
           sink += transport.mixture(state(i).T, constants::oneAtmosphere, state(i).X, D).viscosity;
         }));
  report("enthalpy of the mixture", time(20000, [&](int i) { sink += thermo.enthalpyMass(state(i).T, state(i).Y); }));
  report("temperature from enthalpy, 50 K off", time(10000, [&](int i) {
           const auto& s = state(i);
           sink += thermo.temperatureFromEnthalpy(thermo.enthalpyMass(s.T, s.Y), s.Y, s.T + 50);
         }));
  ReactorSystem system(mechanism);
  system.setConditions(constants::oneAtmosphere, {});
  DenseLu lu(n + 1);
  const std::size_t ld = lu.leadingDimension();
  std::vector<double> y(n + 1), f(n + 1), jacobian(ld * (n + 1));
  const auto load = [&](int i) {
    std::copy(state(i).Y.begin(), state(i).Y.end(), y.begin());
    y[n] = state(i).T;
  };
  report("reactor right-hand side", time(20000, [&](int i) {
           load(i);
           system.rates(y.data(), f.data());
         }));
  report("reactor Jacobian", time(5000, [&](int i) {
           load(i);
           system.jacobian(y.data(), f.data(), jacobian.data(), ld);
         }));
  report("LU of I - 1e-6 s J", time(5000, [&](int) {
           for (std::size_t i = 0; i < jacobian.size(); ++i) lu.column(0)[i] = -1e-6 * jacobian[i];
           for (std::size_t i = 0; i <= n; ++i) lu.column(i)[i] += 1.0;
           lu.factorise();
         }));
  report("back substitution", time(20000, [&](int) {
           lu.solve(f.data());
           f[0] = 1.0;
         }));
  for (const double dt : {1e-6, 1e-5, 1e-4}) timeReactor(mechanism, states, dt, 1e-6, false);
  timeReactor(mechanism, states, 1e-5, 1e-9, false);
  timeReactor(mechanism, states, 1e-4, 1e-6, true);
  timeReactor(mechanism, states, 1e-5, 1e-6, true);
  return sink == 12345.0 ? 1 : 0;
}
