// Particles of one pressure that a piston compresses.
#include "chemistry/reactor/engine/engine_gas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "chemistry/thermo/equilibrium.hpp"
#include "tests/chemistry/engine_particles.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::engineGas;
using lampblack::test::hydrogen;

TEST(EngineGas, ArgonKeepsPressureTimesVolumeToTheGamma) {
  const Thermo thermo(hydrogen());
  EngineGas gas = engineGas({{300, "AR: 1"}});
  const double volume = volumeOf(thermo, gas), pressure = gas.pressure, energy = energyOf(thermo, gas);
  EngineCompression compression(thermo);
  double work = 0;
  for (const double ratio : {1.0, 2.0, 5.0, 9.6, 3.0, 9.6}) {
    work += compression.moveTo(volume / ratio, gas);
    EXPECT_NEAR(gas.pressure * std::pow(volumeOf(thermo, gas), 5.0 / 3) / (pressure * std::pow(volume, 5.0 / 3)), 1,
                1e-8);
    EXPECT_NEAR(volumeOf(thermo, gas) * ratio / volume, 1, 1e-14);
  }
  EXPECT_NEAR(gas.pressure / pressure, 43.3629, 1e-4);
  EXPECT_NEAR(gas.temperature[0] / 300, 4.51697, 1e-5);
  EXPECT_NEAR(work + energyOf(thermo, gas) - energy, 0, 1e-13 * std::abs(work));
}

TEST(EngineGas, ParticlesStayOnTheirIsentropes) {
  const Thermo thermo(hydrogen());
  EngineGas gas = engineGas({{450, "H2: 1, O2: 3, N2: 4"}, {900, "N2: 1, H2O: 1"}, {1400, "AR: 1"}});
  std::vector<double> entropies;
  for (std::size_t i = 0; i < 3; ++i)
    entropies.push_back(thermo.entropyMass(gas.temperature[i], gas.pressure, gas.Y(i)));
  const double volume = volumeOf(thermo, gas);
  EngineCompression(thermo).moveTo(volume / 7, gas);
  EXPECT_NEAR(volumeOf(thermo, gas) * 7 / volume, 1, 1e-14);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(thermo.entropyMass(gas.temperature[i], gas.pressure, gas.Y(i)) / entropies[i], 1, 1e-9);
}

TEST(EngineGas, WorkIsThatOfThePressure) {
  const Thermo thermo(hydrogen());
  EngineGas gas = engineGas({{500, "N2: 1"}, {700, "H2O: 1, O2: 1"}});
  const double volume = volumeOf(thermo, gas);
  EngineCompression compression(thermo);
  double work = 0, integral = 0;
  constexpr int steps = 200;
  for (int k = 1; k <= steps; ++k) {
    const double before = gas.pressure;
    work += compression.moveTo(volume * (1 - 0.5 * k / steps), gas);
    integral -= 0.5 * (before + gas.pressure) * volume * 0.5 / steps;
  }
  EXPECT_NEAR(work / integral, 1, 1e-5);
  EXPECT_LT(work, 0);
}

TEST(EngineGas, RefusesTemperaturesOutsideOfThermodynamics) {
  const Thermo thermo(hydrogen());
  EngineGas gas = engineGas({{3000, "AR: 1"}});
  EXPECT_THROW(EngineCompression(thermo).moveTo(volumeOf(thermo, gas) / 20, gas), NumericsError);
}

TEST(EngineGas, ParticlesComeAndGo) {
  EngineGas gas = engineGas({{300, "AR: 1"}, {400, "N2: 1"}, {500, "O2: 1"}});
  gas.mass = {1, 2, 3};
  gas.remove(0);
  ASSERT_EQ(gas.count(), 2U);
  EXPECT_EQ(gas.mass[0], 3);
  EXPECT_EQ(gas.temperature[0], 500);
  EXPECT_EQ(gas.Y(0)[hydrogen().speciesIndex("O2")], 1);
  EXPECT_EQ(gas.Y(1)[hydrogen().speciesIndex("N2")], 1);
}

}  // namespace
