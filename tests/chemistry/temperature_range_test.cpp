// The temperatures an input may ask for, and the speed of sound.
#include "chemistry/thermo/temperature_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "chemistry/thermo/sound_speed.hpp"
#include "chemistry/transport/pure_gas.hpp"
#include "chemistry/transport/transport.hpp"
#include "chemistry/transport/transport_margin.hpp"
#include "core/modules.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"

namespace lampblack::chemistry {
namespace {

// Two species whose polynomials reach from low to high, and from 1000 K to 1500 K.
TemperatureRange rangeOf(const std::string& low, const std::string& high) {
  const auto species = [](const char* name, const std::string& from, const std::string& to) {
    return std::string("\n- {name: ") + name + ", composition: {N: 2}, thermo: {model: NASA7, temperature-ranges: [" +
           from + ", 1200, " + to + "], data: [[3.5, 0, 0, 0, 0, -900, 4], [3.5, 0, 0, 0, 0, -900, 4]]}}";
  };
  return temperatureRange(
      test::readText("species: [A, B]", species("A", low, high) + species("B", "1000", "1500"), "[]"));
}

TEST(TemperatureRange, IsThatOfAllSpeciesAndALittleBeyond) {
  const auto expect = [](const TemperatureRange& range, double low, double high) {
    EXPECT_DOUBLE_EQ(range.low, low);
    EXPECT_DOUBLE_EQ(range.high, high);
  };
  expect(rangeOf("300", "3000"), 200, 4000);    // 100 K down, 1000 K up
  expect(rangeOf("200", "3500"), 200, 4500);    // not below 200 K
  expect(rangeOf("500", "5800"), 400, 6000);    // not above 6000 K
  expect(rangeOf("100", "20000"), 100, 20000);  // unless the data go there
}

TEST(TemperatureRange, OfMechanismsThatAreShipped) {
  const TemperatureRange range = temperatureRange(test::hydrogen());
  EXPECT_EQ(range.low, 200);
  EXPECT_EQ(range.high, 6000);
  EXPECT_TRUE(range.contains(200));
  EXPECT_TRUE(range.contains(6000));
  EXPECT_FALSE(range.contains(199.999));
  EXPECT_FALSE(range.contains(std::nan("")));
  const TemperatureRange narrow = range.within({250, 9000});
  EXPECT_EQ(narrow.low, 250);
  EXPECT_EQ(narrow.high, 6000);
}

// Nitrogen at 300 K: cp = 29.12 J/mol/K (NIST), so 353.0 m/s; argon, without internal energy, sqrt(5/3 R T/W) = 322.6.
TEST(SoundSpeed, OfNitrogenAndArgon) {
  const auto& mechanism = test::hydrogen();
  const Thermo thermo(mechanism);
  const auto of = [&](const char* name) {
    std::vector<double> Y(mechanism.numSpecies(), 0.0);
    Y[mechanism.speciesIndex(name)] = 1;
    return soundSpeed(thermo, 300, Y);
  };
  EXPECT_NEAR(of("N2"), 353.0, 0.2);
  EXPECT_NEAR(of("AR"), 322.6, 0.1);
}

// Flames at 200 and 4000 K need room beyond the range of the fits. Eight and six terms that are good to 2e-4 inside
// grow by the Chebyshev polynomial T7 = 5 of the place 190 K, a twentieth beyond.
TEST(TransportMargin, PolynomialsAreGoodALittleBeyondTheirRange) {
  const auto& mechanism = test::hydrogen();
  const Transport transport(mechanism);
  const PureGas gas(mechanism, CollisionIntegrals::MonchickMason);
  double worst = 0;
  for (const double T : {transportmargin::coldest, transportmargin::hottest})
    for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) {
      worst = std::max(worst, std::abs(transport.speciesViscosity(T, k) / gas.viscosity(k, T) - 1));
      for (std::size_t j = 0; j < k; ++j)
        worst = std::max(
            worst,
            std::abs(T * std::sqrt(T) / (1e5 * transport.binaryDiffusion(T, 1e5, j, k)) / gas.resistance(j, k, T) - 1));
    }
  test::measured("transport polynomials 10 K below and 200 K above their range", worst);
  EXPECT_LT(worst, 1e-3);
}

}  // namespace
}  // namespace lampblack::chemistry
