// A given gas as the equations that particles are coupled with: what is held, what particles deplete, against closed
// solutions; and the splitting of both against the stiff solver alone.
#include "coupling/gas_along.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "coupling/split_gas.hpp"
#include "tests/coupling/toy_particles.hpp"

namespace lampblack::coupling {
namespace {

const Mechanism& mechanism() {
  return test::ethylene();
}
std::size_t acetylene() {
  return mechanism().speciesIndex("C2H2");
}

// Rows of one temperature and pressure, of acetylene in nitrogen.
GasHistory historyOf(const std::vector<double>& times, const std::vector<double>& fractions) {
  GasHistory history;
  const std::size_t n = mechanism().numSpecies();
  for (std::size_t i = 0; i < times.size(); ++i) {
    history.time.push_back(times[i]);
    history.temperature.push_back(1500);
    history.pressure.push_back(101325);
    history.fractions.resize((i + 1) * n, 0.0);
    history.fractions[i * n + acetylene()] = fractions[i];
    history.fractions[i * n + mechanism().speciesIndex("N2")] = 1 - fractions[i];
  }
  return history;
}

std::vector<double> advanced(GasAlong& gas, double end) {
  std::vector<double> y = gas.initialState();
  StiffIntegrator integrator(gas, {1e-9, 1e-16, 0, 1000000});
  double t = 0;
  while (t < end) {
    const double stop = std::min(end, gas.nextRow(t));
    integrator.start(t, y, stop);
    while (integrator.time() < stop) integrator.step();
    y.assign(integrator.state().begin(), integrator.state().end());
    t = stop;
  }
  return y;
}

// Mass fraction that a mole fraction of acetylene in nitrogen is.
double massFraction(double x) {
  const auto W = mechanism().molecularWeights();
  const double a = x * W[acetylene()];
  return a / (a + (1 - x) * W[mechanism().speciesIndex("N2")]);
}

TEST(GasAlong, IsTheHistoryWhereNothingIsTaken) {
  GasHistory history = historyOf({0, 1e-3, 3e-3, 4e-3}, {1e-4, 5e-4, 0, 2e-4});
  history.temperature = {1400, 1600, 1500, 1700};
  history.pressure = {1e5, 1.2e5, 1.2e5, 0.9e5};
  const test::Toy none(mechanism(), 0, 0, 0);
  test::ToyPhase phase(none);
  GasAlong gas(mechanism(), history, {acetylene()}, &phase);
  const std::size_t n = mechanism().numSpecies();
  const double x[] = {5e-4, 0, 2e-4}, T[] = {1600, 1500, 1700}, p[] = {1.2e5, 1.2e5, 0.9e5};
  const double t[] = {1e-3, 3e-3, 4e-3};
  for (int i = 0; i < 3; ++i) {
    const std::vector<double> y = advanced(gas, t[i]);
    EXPECT_NEAR(y[acetylene()], massFraction(x[i]), 2e-6 * massFraction(5e-4)) << i;
    EXPECT_NEAR(y[mechanism().speciesIndex("N2")], 1 - massFraction(x[i]), 1e-12) << i;
    EXPECT_NEAR(y[n], T[i], 1e-9);
    EXPECT_EQ(gas.pressure(t[i]), p[i]);
    const double W = 1 / (massFraction(x[i]) / mechanism().molecularWeights()[acetylene()] +
                          (1 - massFraction(x[i])) / mechanism().molecularWeights()[mechanism().speciesIndex("N2")]);
    EXPECT_NEAR(gas.density(t[i], y.data()) * constants::gasConstant * T[i] / (p[i] * W), 1, 1e-8);
  }
  // Half way, concentrations are straight lines.
  const std::vector<double> y = advanced(gas, 0.5e-3);
  const double R = constants::gasConstant, c0 = 1e5 / (R * 1400), c1 = 1.2e5 / (R * 1600);
  const double middle = (1e-4 * c0 + 5e-4 * c1) / (c0 + c1);
  EXPECT_NEAR(y[acetylene()] / massFraction(middle), 1, 1e-7);
  EXPECT_NEAR(y[n], 1500, 1e-9);
}

// dY/dt = S - k Y where the gas makes it, and the part exp(-k t) of what is given where it loses it or keeps it.
TEST(GasAlong, WhatParticlesTakeIsMissingLater) {
  const double k = 700, end = 2e-3;
  const test::Toy toy(mechanism(), k, 0, 0);
  const auto left = [&](double first, double last) {
    test::ToyPhase phase(toy);
    const GasHistory history = historyOf({0, end}, {first, last});
    GasAlong gas(mechanism(), history, {acetylene()}, &phase);
    const std::vector<double> y = advanced(gas, end);
    // What is missing is in the particles.
    const double carbon = y[mechanism().numSpecies() + 1] * test::ToyPhase::unit;
    EXPECT_GT(carbon, 0);
    if (first == last) {
      const double perMass = 2 * toy.carbonWeight / mechanism().molecularWeights()[acetylene()];
      EXPECT_NEAR(carbon / (perMass * (massFraction(first) - y[acetylene()])), 1, 1e-6);
    }
    return y[acetylene()];
  };
  const double fade = std::exp(-k * end);
  EXPECT_NEAR(left(2e-4, 2e-4) / (massFraction(2e-4) * fade), 1, 1e-6);
  EXPECT_NEAR(left(2e-4, 5e-5) / (massFraction(5e-5) * fade), 1, 1e-6);
  const double made = (massFraction(3e-4) - massFraction(1e-4)) / end;
  EXPECT_NEAR(left(1e-4, 3e-4) / (massFraction(1e-4) * fade + made * (1 - fade) / k), 1, 1e-4);
}

TEST(GasAlong, SpeciesThatAreHeldAreNotTaken) {
  const test::Toy toy(mechanism(), 700, 0, 0);
  test::ToyPhase phase(toy);
  const GasHistory history = historyOf({0, 2e-3}, {2e-4, 1e-4});
  GasAlong gas(mechanism(), history, {}, &phase);
  const std::vector<double> y = advanced(gas, 2e-3);
  EXPECT_NEAR(y[acetylene()] / massFraction(1e-4), 1, 1e-12);
  EXPECT_GT(y[mechanism().numSpecies() + 1], 0);
}

TEST(GasAlong, DerivativesAreThoseOfTheRates) {
  const test::Toy toy(mechanism(), 700, 2000, 1e4);
  test::ToyPhase phase(toy);
  GasHistory history = historyOf({0, 1e-3, 2e-3}, {1e-4, 3e-4, 1e-4});
  history.numberLossRate = {30, -20};
  history.temperature = {1500, 1600, 1400};
  GasAlong gas(mechanism(), history, {acetylene()}, &phase);
  const std::size_t size = gas.size(), n = mechanism().numSpecies();
  for (const double t : {0.3e-3, 1.6e-3}) {
    std::vector<double> y = advanced(gas, t), f(size), g(size), J(size * size);
    y[n + 1] += 0.02;
    ASSERT_TRUE(gas.jacobian(t, y.data(), f.data(), J.data(), size));
    ASSERT_TRUE(gas.rates(t, y.data(), g.data()));
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(f[i], g[i], 1e-12 * std::abs(f[i])) << i;
    EXPECT_NEAR(f[n], t < 1e-3 ? 1e5 : -2e5, 1e-6);
    for (std::size_t j = 0; j < size; ++j) {
      std::vector<double> moved = y;
      const double step = j == n ? 1e-3 : 1e-6 * std::max(std::abs(y[j]), 1e-3);
      moved[j] += step;
      ASSERT_TRUE(gas.rates(t, moved.data(), g.data()));
      for (std::size_t i = 0; i < size; ++i)
        EXPECT_NEAR((g[i] - f[i]) / step, J[i + size * j], 1e-5 * (std::abs(J[i + size * j]) + std::abs(f[i]) + 1))
            << i << ", " << j << " at " << t;
    }
  }
}

// Splitting and the predictor come to what the stiff solver says of gas and particles together, to second order.
TEST(GasAlong, SplittingComesToTheWhole) {
  const test::Toy toy(mechanism(), 2000, 0, 2e4);
  GasHistory history = historyOf({0, 1e-3, 2e-3}, {1e-4, 4e-4, 2e-4});
  history.temperature = {1500, 1600, 1400};
  history.pressure = {1e5, 1.4e5, 0.8e5};
  history.numberLossRate = {40, 40};
  test::ToyPhase phase(toy);
  GasAlong whole(mechanism(), history, {acetylene()}, &phase);
  const std::vector<double> y = advanced(whole, 2e-3);
  const std::size_t n = mechanism().numSpecies();
  const double carbon = y[n + 1] * test::ToyPhase::unit * whole.density(2e-3, y.data());
  ASSERT_GT(carbon, 0.1 * toy.carbonWeight * 1e-4 * 8);  // a good part of what there was
  for (const bool predicted : {false, true}) {
    std::vector<double> errors;
    for (const int steps : {40, 80, 160}) {
      test::ToySplit particles(toy);
      ParticlesAtRest atRest;
      ExchangeInGas exchange(mechanism(), {"C", "H"}, {acetylene()});
      GasAlong gas(mechanism(), history, {acetylene()}, predicted ? &exchange : &atRest);
      SplitReactor::Gas own = splitGas(gas);
      if (predicted) own.expected = &exchange;
      SplitReactor::Options options;
      options.integrator = {1e-9, 1e-16, 0, 1000000};
      options.largestStep = 2e-3 / steps;
      options.fixedStep = true;
      SplitReactor split(mechanism(), own, particles, options);
      split.start(0, gas.initialState());
      split.advance(2e-3);
      errors.push_back(std::abs(split.state()[acetylene()] / y[acetylene()] - 1) +
                       std::abs(particles.carbon / carbon - 1));
    }
    EXPECT_LT(errors[2], predicted ? 1e-3 : 2e-2) << predicted;
    for (const std::size_t i : {0, 1}) {
      EXPECT_GT(errors[i] / errors[i + 1], 3.5) << predicted << ", " << errors[i + 1];
      EXPECT_LT(errors[i] / errors[i + 1], 5) << predicted << ", " << errors[i + 1];
    }
  }
}

// Species that are held stay what they are in both couplings, and what particles take of them, here a thousand times
// what there is, shortens no steps.
TEST(GasAlong, WhatIsTakenOfHeldSpeciesCostsNoSteps) {
  const double c = 2e-4 * 101325 / (constants::gasConstant * 1500), b = 25;  // mol/m3, m3/kg
  const test::Toy toy(mechanism(), 1e6, 0, b);
  const GasHistory history = historyOf({0, 1e-3}, {2e-4, 2e-4});
  for (const bool predicted : {false, true}) {
    test::ToySplit particles(toy);
    ParticlesAtRest atRest;
    ExchangeInGas exchange(mechanism(), {"C", "H"}, {acetylene()});
    GasAlong gas(mechanism(), history, {}, predicted ? &exchange : &atRest);
    SplitReactor::Gas own = splitGas(gas);
    if (predicted) own.expected = &exchange;
    SplitReactor split(mechanism(), own, particles, {});
    split.start(0, gas.initialState());
    split.advance(1e-3);
    EXPECT_NEAR(split.state()[acetylene()] / massFraction(2e-4), 1, 1e-12) << predicted;
    EXPECT_NEAR(particles.carbon * b / std::expm1(2 * toy.carbonWeight * 1e6 * c * b * 1e-3), 1, 1e-6) << predicted;
    EXPECT_LT(split.work().steps, 30) << predicted;
  }
}

// Held species leave inert particles to their expansion: the density of the gas, and what thins them besides.
TEST(GasAlong, InertParticlesStayAsManyPerMassOfGas) {
  GasHistory history = historyOf({1e-3, 2e-3, 4e-3}, {0.1, 0.3, 0.2});
  history.temperature = {600, 1500, 1100};
  history.pressure = {2e5, 1e5, 1e5};
  history.numberLossRate = {50, -100};
  test::ToySplit particles(test::Toy(mechanism(), 0, 0, 0));
  particles.carbon = 1e-6;
  ParticlesAtRest atRest;
  GasAlong gas(mechanism(), history, {}, &atRest);
  SplitReactor::Options options;
  options.integrator = {1e-10, 1e-16, 0, 1000000};
  SplitReactor split(mechanism(), splitGas(gas), particles, options);
  const std::vector<double> start = gas.initialState();
  const double first = gas.density(1e-3, start.data());
  split.start(1e-3, start);
  split.advance(2e-3);
  const double second = gas.density(2e-3, split.state().data());
  EXPECT_NEAR(particles.carbon / (1e-6 * second / first * std::exp(-50e-3)), 1, 1e-6);
  split.advance(4e-3);
  EXPECT_NEAR(particles.carbon / (1e-6 * gas.density(4e-3, split.state().data()) / first * std::exp(-50e-3 + 200e-3)),
              1, 1e-6);
}

TEST(GasAlong, AnImpossibleGasIsRefused) {
  GasHistory history = historyOf({0, 1e-3}, {1e-4, 1e-4});
  history.temperature[1] = -1;
  EXPECT_THROW(GasAlong(mechanism(), history, {}, nullptr), InputError);
}

}  // namespace
}  // namespace lampblack::coupling
