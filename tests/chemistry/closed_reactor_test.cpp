// Closed reactors against exact solutions and conservation laws.
#include "chemistry/reactor/closed_reactor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/reactor/stiff_integrator.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::hydrogen;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::readText;
using Held = ReactorSystem::Held;

// A => B of first order, k = 1000/s exp(-2000 K/T) with the activation energy in cal/mol.
Mechanism firstOrder() {
  return readText("species: [A, B]",
                  "\n- {name: A, composition: {N: 2}, thermo: *t}\n- {name: B, composition: {N: 2}, thermo: *t}",
                  "- {equation: A => B, rate-constant: {A: 1000, b: 0, Ea: 3974.4}}");
}

double rateConstant(double T) {
  return 1000 * std::exp(-3974.4 * 4.184 / (constants::gasConstant * T));
}

std::vector<double> run(ClosedReactor& reactor, double end) {
  StiffIntegrator integrator(reactor, {});
  integrator.start(0.0, reactor.initialState(), end);
  while (integrator.time() < end) {
    if (reactor.profile()) integrator.stopAt(reactor.profile()->nextKink(integrator.time()).value_or(end));
    integrator.step();
  }
  return {integrator.state().begin(), integrator.state().end()};
}

TEST(ClosedReactor, FirstOrderDecayIsExponential) {
  const Mechanism mechanism = firstOrder();
  for (const Held held : {Held::Pressure, Held::Density}) {
    ClosedReactor reactor(mechanism, {900, constants::oneAtmosphere, {1, 0}}, held, TemperatureProfile(900));
    const auto y = run(reactor, 0.02);
    const double exact = std::exp(-rateConstant(900) * 0.02);
    measured("relative error", y[0] / exact - 1);
    EXPECT_NEAR(y[0] / exact, 1, 1e-7);
    EXPECT_EQ(y[2], 900);
  }
}

// A ramp of temperature: ln Y = -int k(T(t)) dt, by Simpson's rule on 2000 intervals a line (error below 1e-12).
TEST(ClosedReactor, FollowsAGivenTemperature) {
  const Mechanism mechanism = firstOrder();
  const TemperatureProfile profile({0.0, 0.004, 0.010, 0.012}, {700, 1300, 800, 1500});
  ClosedReactor reactor(mechanism, {500, constants::oneAtmosphere, {1, 0}}, Held::Pressure, profile);
  const double end = 0.014;
  const auto y = run(reactor, end);
  double integral = 0;
  const double kinks[] = {0.0, 0.004, 0.010, 0.012, end};
  for (int line = 0; line < 4; ++line) {
    const int intervals = 2000;
    const double h = (kinks[line + 1] - kinks[line]) / intervals;
    for (int i = 0; i < intervals; ++i) {
      const double t = kinks[line] + i * h;
      integral += h / 6 *
                  (rateConstant(profile.value(t)) + 4 * rateConstant(profile.value(t + h / 2)) +
                   rateConstant(profile.value(t + h)));
    }
  }
  measured("relative error", y[0] * std::exp(integral) - 1);
  EXPECT_NEAR(y[0] * std::exp(integral), 1, 2e-7);
  EXPECT_EQ(y[2], 1500);
}

// Energy and elements of igniting hydrogen; the integrator's relative tolerance is 1e-9 a step over a thousand steps.
TEST(ClosedReactor, ConservesEnergyAndElements) {
  const Mechanism& mechanism = hydrogen();
  const Thermo thermo(mechanism);
  GasState state{1200, 2e5, std::vector<double>(mechanism.numSpecies())};
  thermo.moleToMass(parseComposition(mechanism, "H2: 2, O2: 1, N2: 3.76"), state.Y);
  for (const Held held : {Held::Pressure, Held::Density}) {
    ClosedReactor reactor(mechanism, state, held);
    const auto start = reactor.initialState();
    const auto end = run(reactor, 1e-3);
    const std::size_t n = mechanism.numSpecies();
    // h - p/rho is the internal energy.
    const auto energy = [&](const std::vector<double>& y) {
      const double h = thermo.enthalpyMass(y[n], {y.data(), n});
      return held == Held::Pressure ? h : h - reactor.pressure(0, y.data()) / reactor.density(0, y.data());
    };
    measured("energy, of cp T", (energy(end) - energy(start)) / (thermo.cpMass(end[n], {end.data(), n}) * end[n]));
    EXPECT_GT(end[n], 2500);
    EXPECT_NEAR(energy(end), energy(start), 1e-7 * thermo.cpMass(end[n], {end.data(), n}) * end[n]);
    if (held == Held::Density) {
      EXPECT_GT(reactor.pressure(0, end.data()), 3.5e5);
      EXPECT_DOUBLE_EQ(reactor.density(0, end.data()), thermo.density(1200, 2e5, state.Y));
    }
    double worst = 0;
    for (std::size_t i = 0; i < mechanism.numElements(); ++i) {
      double change = 0;
      for (std::size_t k = 0; k < n; ++k)
        change +=
            (end[k] - start[k]) / mechanism.molecularWeights()[k] * mechanism.atoms(k, i) * mechanism.atomicWeight(i);
      raise(worst, change);
    }
    measured("elements, mass fraction", worst);
    EXPECT_LT(worst, 1e-12);
  }
}

TEST(ClosedReactor, SaysWhereItCannotGoOn) {
  const Mechanism mechanism = firstOrder();
  ClosedReactor reactor(mechanism, {900, constants::oneAtmosphere, {1, 0}}, Held::Pressure);
  StiffIntegrator integrator(reactor, {1e-9, 1e-15, 0, 3});
  integrator.start(0.0, reactor.initialState(), 1.0);
  try {
    for (int i = 0; i < 100000 && integrator.time() < 1.0; ++i) integrator.step();
    ADD_FAILURE() << "no limit of steps";
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("t = "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("mass fractions {A: "), std::string::npos) << error.what();
  }
}

TEST(TemperatureProfile, RefusesWhatIsNone) {
  EXPECT_THROW(TemperatureProfile({}, {}), InputError);
  EXPECT_THROW(TemperatureProfile({0, 1}, {300}), InputError);
  EXPECT_THROW(TemperatureProfile({0, 0}, {300, 400}), InputError);
  EXPECT_THROW(TemperatureProfile({0, 1}, {300, 30000}), InputError);
}

}  // namespace
