#include "chemistry/reactor/reactor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::hydrogen;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::Table;
using Options = ConstantPressureReactor::Options;

constexpr double kAtm = constants::oneAtmosphere;

struct State {
  double T;
  std::vector<double> Y;
};

State flameState(std::size_t row) {
  static const Table table("counterflow_c2h4_states.csv");
  State state{table.number(row, "T"), std::vector<double>(ethylene().numSpecies())};
  Thermo(ethylene()).moleToMass(table.moleFractions(row, ethylene()), state.Y);
  return state;
}

constexpr std::size_t kFlameStates = 30;

std::vector<double> chemicalRates(const State& state) {
  ReactorSystem system(ethylene());
  system.setConditions(kAtm, {});
  auto y = state.Y;
  y.push_back(state.T);
  std::vector<double> f(y.size());
  system.chemicalRates(y.data(), f.data());
  f.pop_back();
  return f;
}

ConstantPressureReactor::Result advance(ConstantPressureReactor& reactor, State& state, double dt,
                                        std::span<const double> source = {}, double initialStep = 0) {
  ConstantPressureReactor::Cell cell{state.T, kAtm, state.Y, source, initialStep};
  const auto result = reactor.advance(cell, dt);
  state.T = cell.temperature;
  return result;
}

Options tight() {
  return {1e-11, 1e-18, 100000, 0.0, 0};
}

// A hot mixture whose radicals transport has left below zero: by mass action through zero, chain branching would let
// them grow downwards as fast as upwards. They count as next to none, and the mixture ignites as it does without any.
TEST(Reactor, RadicalsBelowZeroDoNotBranch) {
  State without{1400, std::vector<double>(hydrogen().numSpecies())};
  Thermo(hydrogen()).moleToMass(parseComposition(hydrogen(), "H2: 2, O2: 1, N2: 3.76"), without.Y);
  const std::size_t H = hydrogen().speciesIndex("H");
  State below = without;
  for (const char* name : {"H", "O", "OH"}) {
    below.Y[hydrogen().speciesIndex(name)] -= 1e-6;
    below.Y[hydrogen().speciesIndex("N2")] += 1e-6;
  }
  for (const int rosenbrockSteps : {0, 200}) {
    ConstantPressureReactor reactor(hydrogen(), {1e-9, 1e-15, 20000, 0.0, rosenbrockSteps});
    State early = below, late = below, reference = without;
    advance(reactor, early, 5e-6);
    for (const double Y : early.Y) EXPECT_GT(Y, -1e-6 - 1e-9) << rosenbrockSteps;
    advance(reactor, late, 1e-3);
    advance(reactor, reference, 1e-3);
    EXPECT_GT(late.T, 2500) << rosenbrockSteps;
    // 1e-6 of the mass is 2e8 J/kg short, the enthalpy of H.
    EXPECT_NEAR(late.T, reference.T, 1.0) << rosenbrockSteps;
    EXPECT_GT(late.Y[H], 0) << rosenbrockSteps;
  }
}

// Default tolerances against rtol 1e-11. Local errors of 1e-6 add up over about a hundred steps, with some of them
// correlated: within 1e-4 of a mass fraction, and 1e-8 where there is nearly nothing.
TEST(Reactor, DefaultTolerancesFollowATightRun) {
  ConstantPressureReactor coarse(ethylene()), fine(ethylene(), tight());
  double worstT = 0, worstY = 0, worstMajor = 0;
  for (std::size_t row = 0; row < kFlameStates; row += 3) {
    for (const double dt : {1e-6, 1e-4}) {
      auto a = flameState(row), b = a;
      advance(coarse, a, dt);
      advance(fine, b, dt);
      raise(worstT, a.T / b.T - 1);
      EXPECT_NEAR(a.T, b.T, 2e-5 * b.T) << row << " " << dt;
      for (std::size_t k = 0; k < a.Y.size(); ++k) {
        raise(worstY, a.Y[k] - b.Y[k]);
        if (b.Y[k] > 1e-6) raise(worstMajor, a.Y[k] / b.Y[k] - 1);
        EXPECT_NEAR(a.Y[k], b.Y[k], 1e-4 * std::abs(b.Y[k]) + 1e-8) << ethylene().speciesName(k) << " " << row;
      }
    }
  }
  measured("temperature, relative", worstT);
  measured("mass fractions", worstY);
  measured("mass fractions above 1e-6, relative", worstMajor);
}

TEST(Reactor, ConservesEnthalpyMassAndElements) {
  ConstantPressureReactor reactor(ethylene());
  const Thermo thermo(ethylene());
  double worstH = 0, worstSum = 0, worstElement = 0;
  for (std::size_t row = 0; row < kFlameStates; ++row) {
    auto state = flameState(row);
    const auto start = state;
    advance(reactor, state, 1e-4);
    const double cp = thermo.cpMass(state.T, state.Y);
    const double heat = thermo.enthalpyMass(state.T, state.Y) - thermo.enthalpyMass(start.T, start.Y);
    const double mass =
        std::accumulate(state.Y.begin(), state.Y.end(), 0.0) - std::accumulate(start.Y.begin(), start.Y.end(), 0.0);
    raise(worstH, heat / (cp * state.T));
    raise(worstSum, mass);
    EXPECT_NEAR(heat, 0, 1e-9 * cp * state.T);
    EXPECT_NEAR(mass, 0, 5e-15);
    for (std::size_t i = 0; i < ethylene().numElements(); ++i) {
      double change = 0;
      for (std::size_t k = 0; k < state.Y.size(); ++k)
        change += (state.Y[k] - start.Y[k]) / ethylene().molecularWeights()[k] * ethylene().atoms(k, i) *
                  ethylene().atomicWeight(i);
      raise(worstElement, change);
      EXPECT_NEAR(change, 0, 1e-12) << ethylene().elementName(i) << " " << row;
    }
  }
  measured("enthalpy, of cp T", worstH);
  measured("sum of mass fractions", worstSum);
  measured("element mass fractions", worstElement);
}

// Cantera 3.2.0, rtol 1e-10, atol 1e-18: H2/air, phi = 1, 1200 K, 1 atm; time of the steepest rise of T 45.33140 us,
// end temperature 2763.3197 K. Here the rise is between the middles of steps of 0.05 us, refined by a parabola.
TEST(Reactor, HydrogenIgnitesWhenCanteraSays) {
  const auto& mechanism = hydrogen();
  ConstantPressureReactor reactor(mechanism, {1e-10, 1e-18, 100000, 0.0, 0});
  State state{1200.0, std::vector<double>(mechanism.numSpecies())};
  Thermo(mechanism).moleToMass(parseComposition(mechanism, "H2: 2, O2: 1, N2: 3.76"), state.Y);
  const double dt = 5e-8;
  std::vector<double> T{state.T};
  for (int i = 0; i < 1200; ++i) {
    advance(reactor, state, dt);
    T.push_back(state.T);
  }
  std::size_t steepest = 1;
  for (std::size_t i = 1; i + 1 < T.size(); ++i)
    if (T[i + 1] - T[i] > T[steepest + 1] - T[steepest]) steepest = i;
  const double a = T[steepest] - T[steepest - 1], b = T[steepest + 1] - T[steepest],
               c = T[steepest + 2] - T[steepest + 1];
  const double delay = dt * (static_cast<double>(steepest) + 0.5 + 0.5 * (a - c) / (a - 2 * b + c));
  measured("ignition delay, relative", delay / 4.533140e-5 - 1);
  EXPECT_NEAR(delay / 4.533140e-5, 1, 1e-4);
  advance(reactor, state, 2.07e-3);
  measured("end temperature, K", state.T - 2763.319735);
  EXPECT_NEAR(state.T, 2763.319735, 1e-3);
}

TEST(Reactor, ASourceThatBalancesTheChemistryKeepsTheState) {
  ConstantPressureReactor reactor(ethylene());
  for (std::size_t row = 0; row < kFlameStates; ++row) {
    auto state = flameState(row);
    const auto start = state;
    auto source = chemicalRates(state);
    for (double& s : source) s = -s;
    const auto result = advance(reactor, state, 1e-4, source);
    EXPECT_LE(result.steps, 1);
    EXPECT_NEAR(state.T, start.T, 1e-8);
    for (std::size_t k = 0; k < state.Y.size(); ++k)
      EXPECT_NEAR(state.Y[k], start.Y[k], 1e-12) << ethylene().speciesName(k);
  }
}

// A gas that reacts faster than a few steps can follow goes to CVODE, and comes back from it when it has calmed down:
// the first step that is kept for the next interval tells.
TEST(Reactor, CellsGoToCvodeWhileFewStepsDoNotDo) {
  Options options;
  options.rosenbrockSteps = 4;
  ConstantPressureReactor reactor(hydrogen(), options), alone(hydrogen(), {1e-6, 1e-12, 20000, 0.0, 0});
  State state{1200, std::vector<double>(hydrogen().numSpecies())};
  Thermo(hydrogen()).moleToMass(parseComposition(hydrogen(), "H2: 2, O2: 1, N2: 3.76"), state.Y);
  State byCvode = state;
  const double dt = 5e-6;
  double step = 0;
  int handedOver = 0, triedFirst = 0, last = 0;
  for (int i = 0; i < 100; ++i) {
    ConstantPressureReactor::Cell cell{state.T, kAtm, state.Y, {}, step};
    int attempts = 0;
    const bool isTried = step <= 0 || step * options.rosenbrockSteps >= dt;
    const auto result = reactor.advance(cell, dt, [&](const ConstantPressureReactor::Event& event) {
      attempts += event.kind == ConstantPressureReactor::Event::Kind::Attempt ? 1 : 0;
    });
    EXPECT_EQ(attempts, (isTried ? 1 : 0) + (result.handedOver ? 1 : 0)) << i;
    EXPECT_EQ(result.retries, 0);
    if (!isTried) {
      EXPECT_EQ(cell.initialStep, 2 * step);
    }
    handedOver += result.handedOver ? 1 : 0;
    triedFirst += isTried ? 1 : 0;
    if (result.handedOver) last = i;
    state.T = cell.temperature;
    step = cell.initialStep;
    EXPECT_TRUE(advance(alone, byCvode, dt).handedOver);
  }
  EXPECT_GT(handedOver, 5);
  EXPECT_LT(triedFirst, 100);
  EXPECT_LT(last, 95);
  EXPECT_GT(state.T, 2500);
  EXPECT_NEAR(state.T, byCvode.T, 1e-2);
}

// Cold fuel with a source of oxygen: Y grows linearly and nothing burns.
TEST(Reactor, ASourceAloneAddsUp) {
  ConstantPressureReactor reactor(ethylene());
  State state{300.0, std::vector<double>(ethylene().numSpecies(), 0.0)};
  const auto N2 = ethylene().speciesIndex("N2"), O2 = ethylene().speciesIndex("O2");
  state.Y[N2] = 1;
  std::vector<double> source(state.Y.size(), 0.0);
  source[O2] = 40;
  source[N2] = -40;
  const auto result = advance(reactor, state, 1e-3, source);
  EXPECT_TRUE(result.skipped);
  EXPECT_NEAR(state.Y[O2], 0.04, 1e-12);
  EXPECT_NEAR(state.Y[N2], 0.96, 1e-12);
}

// Mass fractions that add up to less than one by round-off do so again after a source that brings what is missing: a
// cell's mass is not the reactions' to change.
TEST(Reactor, TheSumOfMassFractionsIsThatOfTheStartAndTheSource) {
  ConstantPressureReactor reactor(ethylene());
  const double missing = 1e-11, dt = 2e-5;
  for (std::size_t row = 0; row < kFlameStates; row += 4) {
    auto state = flameState(row);
    double sum = 0;
    for (const double Y : state.Y) sum += Y;
    for (double& Y : state.Y) Y *= (1 - missing) / sum;
    std::vector<double> source = state.Y;
    for (double& s : source) s *= missing / dt;
    advance(reactor, state, dt, source);
    double end = 0;
    for (const double Y : state.Y) end += Y;
    EXPECT_NEAR(end, 1, 1e-15) << row;
  }
}

// Whatever a reactor did before, the same cell gives the same bits.
TEST(Reactor, TheResultDoesNotDependOnHistory) {
  ConstantPressureReactor used(ethylene());
  for (std::size_t row = 0; row < kFlameStates; row += 4) {
    auto warmUp = flameState((row + 17) % kFlameStates);
    advance(used, warmUp, 3e-5, {}, 1e-7);
    for (const double hint : {0.0, 1e-6}) {
      ConstantPressureReactor fresh(ethylene());
      auto a = flameState(row), b = a;
      const auto first = advance(used, a, 2e-5, {}, hint);
      const auto second = advance(fresh, b, 2e-5, {}, hint);
      EXPECT_EQ(a.T, b.T) << row;
      EXPECT_EQ(a.Y, b.Y) << row;
      EXPECT_EQ(first.steps, second.steps);
    }
  }
}

TEST(Reactor, ColdCellsAreSkippedAtTheCostOfTwoEvaluations) {
  ConstantPressureReactor reactor(ethylene());
  State air{300.0, std::vector<double>(ethylene().numSpecies(), 0.0)};
  air.Y[ethylene().speciesIndex("O2")] = 0.233;
  air.Y[ethylene().speciesIndex("N2")] = 0.767;
  const auto result = advance(reactor, air, 1e-3);
  EXPECT_TRUE(result.skipped);
  EXPECT_LE(result.rhsEvaluations, 2);
  EXPECT_EQ(result.steps, 0);
  EXPECT_NEAR(air.T, 300.0, 1e-9);
}

// Time (s) at which the gas is 300 K hotter, from a walk in intervals of dt; INFINITY if it does not get there.
struct Ignition {
  double delay = INFINITY;
  int skipped = 0;
};

Ignition ignite(const Mechanism& mechanism, const Options& options, const char* mixture, double T, double dt,
                int steps) {
  ConstantPressureReactor reactor(mechanism, options);
  State state{T, std::vector<double>(mechanism.numSpecies())};
  Thermo(mechanism).moleToMass(parseComposition(mechanism, mixture), state.Y);
  Ignition result;
  for (int i = 0; i < steps; ++i) {
    const double before = state.T;
    result.skipped += advance(reactor, state, dt).skipped ? 1 : 0;
    if (state.T <= T + 300) continue;
    result.delay = dt * (i + (T + 300 - before) / (state.T - before));
    break;
  }
  return result;
}

// Skipping must not hide chemistry: on the way to ignition, in intervals so short that the first ones change next to
// nothing, skipping moves the delay by less than a thousandth. Ethylene needs a few radicals to begin with: no
// reaction of this mechanism starts from C2H4 and O2 alone.
TEST(Reactor, SkippingDoesNotDelayIgnition) {
  const struct {
    const Mechanism& mechanism;
    const char* mixture;
    double T, dt;
    int steps;
  } cases[] = {{hydrogen(), "H2: 2, O2: 1, N2: 3.76", 1000, 2e-7, 2000},
               {ethylene(), "C2H4: 1, O2: 3, N2: 11.28, H: 1e-11", 1400, 1e-6, 300}};
  double bySkipping = 0, byTolerances = 0;
  for (const auto& c : cases) {
    const auto skipping = ignite(c.mechanism, {}, c.mixture, c.T, c.dt, c.steps);
    const auto always = ignite(c.mechanism, {1e-6, 1e-12, 20000, 0.0}, c.mixture, c.T, c.dt, c.steps);
    const auto exact = ignite(c.mechanism, {1e-10, 1e-20, 100000, 0.0, 0}, c.mixture, c.T, c.dt, c.steps);
    ASSERT_TRUE(std::isfinite(exact.delay)) << c.mixture;
    EXPECT_GT(skipping.skipped, 10) << c.mixture;
    EXPECT_NEAR(skipping.delay / always.delay, 1, 1e-3) << c.mixture;
    EXPECT_NEAR(always.delay / exact.delay, 1, 1e-3) << c.mixture;
    raise(bySkipping, skipping.delay / always.delay - 1);
    raise(byTolerances, always.delay / exact.delay - 1);
  }
  measured("ignition delay by skipping, relative", bySkipping);
  measured("ignition delay by the tolerances, relative", byTolerances);
}

}  // namespace
