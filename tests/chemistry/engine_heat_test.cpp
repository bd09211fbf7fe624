// Heat from an engine's particles to its walls.
#include "chemistry/reactor/engine/engine_heat.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/chemistry/engine_particles.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::engineGas;
using lampblack::test::hydrogen;

// Equal temperatures of argon, whose heat capacity is constant: mean and variance after a time of constant rate.
TEST(EngineHeat, JumpsHaveTheirMeanAndVariance) {
  const Thermo thermo(hydrogen());
  constexpr double T0 = 1400, wall = 400, times = 0.7;
  for (const double jump : {2.0, 15.0}) {
    EngineGas gas = engineGas(std::vector<std::pair<double, std::string>>(20000, {T0, "AR: 1"}), 1);
    const double cp = thermo.cpMass(T0, gas.Y(0)), before = enthalpyOf(thermo, gas);
    RandomStream random(3, 0, 0);
    const EngineHeatLoss loss(thermo, jump);
    double lost = 0;
    for (int k = 0; k < 2; ++k) lost += loss.advance(0.5, times * cp, wall, random, gas);
    double mean = 0, variance = 0;
    const auto n = static_cast<double>(gas.count());
    for (const double T : gas.temperature) mean += (T - wall) / n;
    for (const double T : gas.temperature) variance += (T - wall - mean) * (T - wall - mean) / n;
    const double exact = 1e6 * std::exp(-2 * times) * std::expm1(times / jump);
    EXPECT_NEAR(mean, 1000 * std::exp(-times), 3.3 * std::sqrt(exact / n));
    EXPECT_NEAR(variance / exact, 1, 0.04);
    EXPECT_NEAR(lost, before - enthalpyOf(thermo, gas), 1e-9 * lost);
  }
}

TEST(EngineHeat, WithoutJumpsTheMean) {
  const Thermo thermo(hydrogen());
  EngineGas gas = engineGas({{1400, "AR: 1"}, {900, "AR: 1"}}, 2);
  const double cp = thermo.cpMass(1400, gas.Y(0));
  RandomStream random(3, 0, 0);
  const double lost = EngineHeatLoss(thermo, 0).advance(1, 2 * cp * 0.7, 400, random, gas);
  EXPECT_NEAR(gas.temperature[0], 400 + 1000 * std::exp(-0.7), 1e-9);
  EXPECT_NEAR(gas.temperature[1], 400 + 500 * std::exp(-0.7), 1e-9);
  EXPECT_NEAR(lost, cp * 1500 * -std::expm1(-0.7), 1e-8 * lost);
}

EngineHeatState heatState() {
  EngineHeatState s;
  s.pressure = 4e6;
  s.temperature = 1000;
  s.volume = 1e-4;
  s.density = 14;
  s.capacity = 1150;
  s.bore = 0.1;
  s.pistonSpeed = 5;
  s.displacement = 5e-4;
  s.referencePressure = 1e5;
  s.referenceTemperature = 350;
  s.referenceVolume = 5.5e-4;
  s.motoredPressure = 3e6;
  return s;
}

// By hand from the printed formulas.
TEST(EngineHeat, CorrelationsAreAsPrinted) {
  EngineHeatState s = heatState();
  const double w = 2.28 * 5 + 3.24e-3 * (5e-4 * 350 / (1e5 * 5.5e-4)) * 1e6;
  EXPECT_NEAR(heatCoefficient(woschniLaw(), s),
              3.26 * std::pow(0.1, -0.2) * std::pow(4000, 0.8) * std::pow(1000, -0.55) * std::pow(w, 0.8), 1e-9);
  EXPECT_NEAR(heatCoefficient(hohenbergLaw(), s),
              129.8 * std::pow(1e-4, -0.06) * std::pow(40, 0.8) * std::pow(1000, -0.4) * std::pow(6.4, 0.8), 1e-9);
  EngineHeatLaw swirling = woschniLaw();
  swirling.swirl = 3;
  EngineHeatState motored = s;
  motored.motoredPressure = s.pressure;
  EXPECT_NEAR(heatCoefficient(swirling, motored) / heatCoefficient(woschniLaw(), motored),
              std::pow((2.28 + 0.308 * 3) / 2.28, 0.8), 1e-12);
  // Viscosity of air at 1000 K 4.15e-5 Pa s (Sutherland).
  const double mu = 1.716e-5 * std::pow(1000 / 273.15, 1.5) * 383.55 / 1110.4;
  EXPECT_NEAR(mu, 4.15e-5, 2e-7);
  EXPECT_NEAR(heatCoefficient(nusseltLaw(), motored),
              0.035 * std::pow(14 * 2.28 * 5 * 0.1 / mu, 0.71) * mu * 1150 / 0.71 / 0.1, 1e-9);
  EngineHeatLaw constant;
  constant.model = EngineHeatLaw::Model::constant;
  constant.factor = 321;
  EXPECT_EQ(heatCoefficient(constant, s), 321);
  EXPECT_EQ(heatCoefficient({}, s), 0);
}

}  // namespace
