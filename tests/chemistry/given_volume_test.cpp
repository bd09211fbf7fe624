// Closed reactors of given volume: the laws of the volume, isentropes, the balance of energy, the Jacobian.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/stiff_integrator.hpp"
#include "chemistry/reactor/volume_law.hpp"
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
using Held = ReactorSystem::Held;

constexpr double kDegree = std::numbers::pi / 180;
const SliderCrank geely{0.0734, 0.0786, 0.136, 9.6};

// At 1000 rpm from bottom to top and back.
constexpr double kSpeed = 6000 * kDegree, kHalfTurn = 0.03;

GasState hydrogenGas(const std::string& moles, double temperature, double pressure) {
  GasState state{temperature, pressure, std::vector<double>(hydrogen().numSpecies())};
  Thermo(hydrogen()).moleToMass(parseComposition(hydrogen(), moles), state.Y);
  return state;
}

std::vector<double> advance(ClosedReactor& reactor, double end, double tolerance = 1e-11) {
  StiffIntegrator integrator(reactor, {tolerance, 1e-15});
  integrator.start(0.0, reactor.initialState(), end);
  while (integrator.time() < end) {
    double stop = end;
    for (const double kink : reactor.volume()->kinks())
      if (kink > integrator.time()) stop = std::min(stop, kink);
    integrator.stopAt(stop);
    integrator.step();
  }
  return {integrator.state().begin(), integrator.state().end()};
}

TEST(GivenVolume, OfACrank) {
  EXPECT_NEAR(geely.displacement(), 332.586e-6, 1e-9);
  EXPECT_NEAR(geely.clearance(), 38.6728e-6, 1e-10);
  const double volumes[] = {66.9903, 140.1310, 229.5167, 306.4242, 355.0186};  // cm3 at 30, 60, ... degrees
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(geely.volume(30 * (i + 1) * kDegree) * 1e6, volumes[i], 1e-4);
  EXPECT_NEAR(geely.volume(180 * kDegree) / geely.volume(0), 9.6, 1e-12);
  const VolumeLaw law = VolumeLaw::piston(geely, -180 * kDegree, kSpeed);
  EXPECT_NEAR(law.ratio(kHalfTurn), 1 / 9.6, 1e-14);
  EXPECT_NEAR(law.smallestAt(2 * kHalfTurn), kHalfTurn, 1e-12);
}

// The slopes of all laws against differences of fourth order.
TEST(GivenVolume, SlopesAreThoseOfTheVolume) {
  const GasState air = hydrogenGas("O2: 1, N2: 3.76", 900, 2e5);
  const double end = 0.02;
  const VolumeLaw laws[] = {VolumeLaw::piston(geely, -150 * kDegree, kSpeed),
                            VolumeLaw::table({0, 0.004, 0.011, 0.02}, {3, 2.5, 1, 1.1}),
                            VolumeLaw::formula([](double t) { return 2 + std::cos(200 * t); }, end),
                            VolumeLaw::pressureRise(hydrogen(), air.temperature, air.Y, 40, end),
                            VolumeLaw::pressureRise(hydrogen(), air.temperature, air.Y, -30, end)};
  double worst = 0;
  for (const VolumeLaw& law : laws) {
    EXPECT_DOUBLE_EQ(law.ratio(0), 1);
    for (const double t : {0.001, 0.0071, 0.0153}) {
      const double h = 2e-5;
      const auto central = [&](double step) { return (law.ratio(t + step) - law.ratio(t - step)) / (2 * step); };
      const double slope = (4 * central(h) - central(2 * h)) / 3;
      raise(worst, law.expansion(t) * law.ratio(t) / slope - 1);
    }
  }
  measured("slope, relative", worst);
  EXPECT_LT(worst, 1e-7);
}

// A table meets its points, rises and falls with them, and stays as it is beyond them.
TEST(GivenVolume, OfATable) {
  const VolumeLaw law = VolumeLaw::table({0, 1, 2, 4}, {8, 2, 1, 1});
  EXPECT_DOUBLE_EQ(law.ratio(1), 0.25);
  EXPECT_DOUBLE_EQ(law.ratio(9), 0.125);
  EXPECT_EQ(law.expansion(9), 0);
  EXPECT_EQ(law.smallestAt(5), 2);
  for (double t = 0.05; t < 4; t += 0.05) EXPECT_LE(law.ratio(t), law.ratio(t - 0.05)) << t;
  EXPECT_THROW(VolumeLaw::table({0, 1}, {1, 0}), InputError);
  EXPECT_THROW(VolumeLaw::table({0, 0}, {1, 1}), InputError);
}

// p V^(5/3) of a gas of constant heat capacities, from bottom to top and back.
TEST(GivenVolume, ArgonFollowsItsIsentrope) {
  const Mechanism argon = lampblack::test::readFileText(
      "phases:\n- {name: gas, thermo: ideal-gas, species: [AR]}\nspecies:\n- {name: AR, composition: {Ar: 1}, thermo: "
      "{model: NASA7, temperature-ranges: [200, 6000], data: [[2.5, 0, 0, 0, 0, -745.375, 4.366]]}}\n");
  for (const double end : {kHalfTurn, 2 * kHalfTurn}) {
    ClosedReactor reactor(argon, {300, 1e5, {1}}, Held::Density, std::nullopt, nullptr,
                          VolumeLaw::piston(geely, -180 * kDegree, kSpeed));
    const auto y = advance(reactor, end);
    const double invariant = reactor.pressure(end, y.data()) / 1e5 * std::pow(reactor.volume()->ratio(end), 5.0 / 3);
    measured("p V^gamma", invariant - 1);
    EXPECT_NEAR(invariant, 1, 1e-8);
    if (end > kHalfTurn) continue;
    EXPECT_NEAR(reactor.pressure(end, y.data()) / 1e5, 43.3629, 1e-4);
    EXPECT_NEAR(y[1] / 300, 4.51697, 1e-5);
  }
}

// Air over a motored piston keeps its entropy.
TEST(GivenVolume, MotoredAirKeepsItsEntropy) {
  const GasState air = hydrogenGas("O2: 1, N2: 3.76", 330, 1e5);
  ClosedReactor reactor(hydrogen(), air, Held::Density, std::nullopt, nullptr,
                        VolumeLaw::piston(geely, -180 * kDegree, kSpeed));
  const auto y = advance(reactor, kHalfTurn);
  const std::size_t n = air.Y.size();
  const Thermo thermo(hydrogen());
  const double before = thermo.entropyMass(air.temperature, air.pressure, air.Y);
  const double after = thermo.entropyMass(y[n], reactor.pressure(kHalfTurn, y.data()), {y.data(), n});
  measured("entropy, relative", after / before - 1);
  EXPECT_GT(y[n], 750);
  EXPECT_NEAR(after / before, 1, 1e-9);
}

// What does not react has the pressure that is asked for; without a rise the reactor is one of constant volume.
TEST(GivenVolume, PressureRisesAsAskedFor) {
  const GasState air = hydrogenGas("O2: 1, N2: 3.76", 900, 2e5);
  for (const double rate : {30.0, -20.0}) {
    ClosedReactor reactor(hydrogen(), air, Held::Density, std::nullopt, nullptr,
                          VolumeLaw::pressureRise(hydrogen(), air.temperature, air.Y, rate, 0.01));
    const auto y = advance(reactor, 0.01);
    measured("pressure, relative", reactor.pressure(0.01, y.data()) / (2e5 * (1 + rate * 0.01)) - 1);
    EXPECT_NEAR(reactor.pressure(0.01, y.data()), 2e5 * (1 + rate * 0.01), 2e5 * 1e-7);
  }
  EXPECT_THROW(VolumeLaw::pressureRise(hydrogen(), 900, air.Y, -101, 0.01), InputError);
  const GasState fuel = hydrogenGas("H2: 2, O2: 1, N2: 3.76", 1100, 2e5);
  ClosedReactor still(hydrogen(), fuel, Held::Density, std::nullopt, nullptr,
                      VolumeLaw::pressureRise(hydrogen(), fuel.temperature, fuel.Y, 0, 1e-4));
  ClosedReactor constant(hydrogen(), fuel, Held::Density);
  const auto y = still.initialState();
  std::vector<double> f(y.size()), g(y.size());
  ASSERT_TRUE(still.rates(5e-5, y.data(), f.data()));
  ASSERT_TRUE(constant.rates(5e-5, y.data(), g.data()));
  EXPECT_EQ(f, g);
}

// Energy of igniting hydrogen that is compressed: du = -p dV/m, with the work by Simpson's rule along the way.
TEST(GivenVolume, EnergyIsWhatTheWallsGive) {
  const GasState fuel = hydrogenGas("H2: 2, O2: 1, N2: 3.76", 1100, 2e5);
  const double end = 2e-4;
  ClosedReactor reactor(hydrogen(), fuel, Held::Density, std::nullopt, nullptr,
                        VolumeLaw::formula([](double t) { return 1 - 2000 * t; }, end));
  const std::size_t n = fuel.Y.size();
  const Thermo thermo(hydrogen());
  StiffIntegrator integrator(reactor, {1e-10, 1e-15});
  integrator.start(0.0, reactor.initialState(), end);
  std::vector<double> y = reactor.initialState(), middle(y.size());
  const auto power = [&](double t, const double* state) {
    return -reactor.pressure(t, state) / reactor.density(t, state) * reactor.volume()->expansion(t);
  };
  double work = 0, last = 0;
  while (integrator.time() < end) {
    integrator.stopAt(end);
    const double before = power(last, y.data());
    integrator.step();
    const double now = integrator.time();
    integrator.interpolate(0.5 * (last + now), middle);
    y.assign(integrator.state().begin(), integrator.state().end());
    work += (now - last) / 6 * (before + 4 * power(0.5 * (last + now), middle.data()) + power(now, y.data()));
    last = now;
  }
  const double change =
      thermo.internalEnergyMass(y[n], {y.data(), n}) - thermo.internalEnergyMass(fuel.temperature, fuel.Y);
  measured("energy, of the work", change / work - 1);
  EXPECT_GT(y[n], 2500);
  EXPECT_NEAR(change / work, 1, 1e-6);
}

// Reactions are those of the density of the moment.
TEST(GivenVolume, ReactionsSeeTheDensityOfTheMoment) {
  const GasState gas = hydrogenGas("H2: 2, O2: 1, N2: 3.76, H: 0.02, OH: 0.03", 1500, 2e5);
  GasState compressed = gas;
  compressed.pressure *= 2;
  ClosedReactor reactor(hydrogen(), gas, Held::Density, std::nullopt, nullptr, VolumeLaw::table({0, 1e-6}, {2, 1}));
  ClosedReactor constant(hydrogen(), compressed, Held::Density);
  const auto y = reactor.initialState();
  std::vector<double> f(y.size()), g(y.size());
  ASSERT_TRUE(reactor.rates(2e-6, y.data(), f.data()));
  ASSERT_TRUE(constant.rates(0, y.data(), g.data()));
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], g[i], 1e-9 * std::abs(g[i])) << i;
  EXPECT_NEAR(reactor.density(2e-6, y.data()), constant.density(0, y.data()), 1e-12);
}

// The row of the temperature, through the work of the gas, by central differences.
TEST(GivenVolume, JacobianAgreesWithDifferencesOfTheRates) {
  const GasState gas = hydrogenGas("H2: 2, O2: 1, N2: 3.76, H: 0.02, OH: 0.03, H2O: 0.3", 1500, 2e5);
  ClosedReactor reactor(hydrogen(), gas, Held::Density, std::nullopt, nullptr,
                        VolumeLaw::formula([](double t) { return std::exp(-3e6 * t); }, 1e-6));
  const double t = 2e-7;
  const auto y = reactor.initialState();
  const std::size_t size = y.size(), n = size - 1;
  std::vector<double> f(size), J(size * size), up(size), down(size);
  ASSERT_TRUE(reactor.jacobian(t, y.data(), f.data(), J.data(), size));
  for (std::size_t j = 0; j < size; ++j) {
    auto changed = y;
    const double step = j == n ? 0.01 : 1e-5;
    changed[j] = y[j] + step;
    ASSERT_TRUE(reactor.rates(t, changed.data(), up.data()));
    changed[j] = y[j] - step;
    ASSERT_TRUE(reactor.rates(t, changed.data(), down.data()));
    const double slope = (up[n] - down[n]) / (2 * step);
    EXPECT_NEAR(J[j * size + n] / slope, 1, 1e-5) << j;
  }
}

}  // namespace
