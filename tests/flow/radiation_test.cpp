// Optically thin radiation: the workshop's polynomials at temperatures where they can be added up by hand.
#include "flow/models/radiation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flame/streams.hpp"

namespace lampblack::test {
namespace {

const Mechanism& methane() {
  static const auto m = shippedMechanism("methane_drm19_21.yaml");
  return m;
}

double ofPure(const char* species, double T, double p = constants::oneAtmosphere) {
  std::vector<double> X(methane().numSpecies(), 0.0);
  X[methane().speciesIndex(species)] = 1;
  return ThinRadiation(methane(), 300).absorption(T, p, X);
}

// At 1000 K every term of H2O and CO2 is its coefficient, those of CO and CH4 a coefficient times a power of ten; at
// 2000 K and 500 K powers of two come in. Digits are those of the sum.
TEST(ThinRadiation, HasThePublishedAbsorptionCoefficients) {
  EXPECT_NEAR(ofPure("H2O", 1000), 5.575471316, 1e-9);
  EXPECT_NEAR(ofPure("CO2", 1000), 27.3741, 1e-10);
  EXPECT_NEAR(ofPure("CO", 1000), 10.09 - 11.83 + 4.7753 - 0.587209 - 0.025334, 1e-10);
  EXPECT_NEAR(ofPure("CH4", 1000), 6.6334 - 3.5686 + 0.016682 + 0.25611 - 0.026558, 1e-10);
  EXPECT_NEAR(ofPure("H2O", 2000), 1.218208166125, 1e-10);
  EXPECT_NEAR(ofPure("CO2", 2000), 5.542346875, 1e-10);
  EXPECT_NEAR(ofPure("H2O", 500), 19.412592112, 1e-10);
  EXPECT_NEAR(ofPure("CO", 500), 4.7869 - 34.765 + 73.94375 - 53.2165 + 12.680875, 1e-10);
}

TEST(ThinRadiation, AddsSpeciesByPartialPressure) {
  std::vector<double> X(methane().numSpecies(), 0.0);
  X[methane().speciesIndex("H2O")] = 0.2;
  X[methane().speciesIndex("CO2")] = 0.1;
  X[methane().speciesIndex("N2")] = 0.7;
  const double p = 3 * constants::oneAtmosphere;
  EXPECT_NEAR(ThinRadiation(methane(), 300).absorption(1000, p, X), 3 * (0.2 * 5.575471316 + 0.1 * 27.3741), 1e-9);
}

TEST(ThinRadiation, AbsorbsBeyondItsFitAsAtTheEndsAndAlmostContinuouslyWithin) {
  for (const char* species : {"H2O", "CO2", "CO", "CH4"}) {
    EXPECT_EQ(ofPure(species, 3000), ofPure(species, 2500)) << species;
    EXPECT_EQ(ofPure(species, 250), ofPure(species, 300)) << species;
    for (double T = 300; T < 2500; T += 10) EXPECT_GT(ofPure(species, T), 0) << species << " " << T;
  }
  EXPECT_NEAR(ofPure("CO", 750.001) / ofPure("CO", 750), 3.647861617 / 3.604079688, 1e-5);
}

TEST(ThinRadiation, IsLostToTheSurroundingsAloneAndAtTheirTemperatureNotAtAll) {
  const ThinRadiation radiation(methane(), 600);
  EXPECT_EQ(radiation.loss(2.0, 600), 0.0);
  EXPECT_LT(radiation.loss(2.0, 500), 0.0);
  // 4 sigma 1/m (1e12 - 0.1296e12) K4 = 197.4 kW/m3 by hand.
  EXPECT_NEAR(radiation.loss(1.0, 1000), 4 * 5.670374419e-8 * 0.8704e12, 1e-4);
  // A central difference of a quartic over 1 K errs by (1/T)^2 of the slope.
  const double slope = 0.5 * (radiation.loss(1.0, 1501) - radiation.loss(1.0, 1499));
  EXPECT_NEAR(radiation.lossSlope(1.0, 1500), slope, slope * 1e-6);
}

TEST(ThinRadiation, SpeciesThatAreNotThereDoNotRadiateAndTheSurroundingsAreChecked) {
  const auto hydrogen = shippedMechanism("hydrogen_h2o2_10.yaml");
  std::vector<double> X(hydrogen.numSpecies(), 0.0);
  X[hydrogen.speciesIndex("N2")] = 0.5;
  X[hydrogen.speciesIndex("H2O")] = 0.5;
  EXPECT_NEAR(ThinRadiation(hydrogen, 300).absorption(1000, constants::oneAtmosphere, X), 0.5 * 5.575471316, 1e-9);
  EXPECT_THROW(ThinRadiation(hydrogen, -1), InputError);
  EXPECT_THROW(ThinRadiation(hydrogen, std::nan("")), InputError);
}

// As in the mechanisms of Lawrence Livermore: h2o.
TEST(ThinRadiation, NamesMayBeInAnyCase) {
  const auto text = readTextFile(sourcePath("cases/mechanisms/hydrogen_h2o2_10.yaml"), "a mechanism");
  const auto lower = readFileText(std::regex_replace(text, std::regex("\\bH2O\\b"), "h2o"));
  std::vector<double> X(lower.numSpecies(), 0.0);
  X[lower.speciesIndex("h2o")] = 1;
  EXPECT_EQ(lower.speciesName(lower.speciesIndex("H2O")), "h2o");
  EXPECT_NEAR(ThinRadiation(lower, 300).absorption(1000, constants::oneAtmosphere, X), 5.575471316, 1e-9);
}

TEST(ThinRadiation, WhatWouldRadiateButDoesNotIsSaid) {
  EXPECT_THAT(radiationWarnings(shippedMechanism("hydrogen_h2o2_10.yaml")), ::testing::IsEmpty());
  EXPECT_THAT(radiationWarnings(shippedMechanism("methane_gri30_53.yaml")),
              ::testing::ElementsAre(::testing::HasSubstr("NH3, N2O, NO of the mechanism would too")));
}

}  // namespace
}  // namespace lampblack::test
