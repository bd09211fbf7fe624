// NASA-9 polynomials, reference pressures, and how the table of all species treats both formats.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "chemistry/thermo/species_thermo.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::readText;

// Nitrogen of McBride, Zehe, Gordon (2002), NASA/TP-2002-211556.
const char* const kNitrogen = R"(
- name: N2
  composition: {N: 2}
  thermo:
    model: NASA9
    temperature-ranges: [200.00, 1000.00, 6000.0, 20000]
    reference-pressure: 1 bar
    data:
    - [2.210371497E+04, -3.818461820E+02, 6.082738360E+00, -8.530914410E-03, 1.384646189E-05, -9.625793620E-09,
       2.519705809E-12, 7.108460860E+02, -1.076003744E+01]
    - [5.877124060E+05, -2.239249073E+03, 6.066949220E+00, -6.139685500E-04, 1.491806679E-07, -1.923105485E-11,
       1.061954386E-15, 1.283210415E+04, -1.586640027E+01]
    - [8.310139160E+08, -6.420733540E+05, 2.020264635E+02, -3.065092046E-02, 2.486903333E-06, -9.705954110E-11,
       1.437538881E-15, 4.938707040E+06, -1.672099740E+03])";

// At 298.15 K: h = 0, by definition; s = 191.609(4) J/mol/K at 1 bar (CODATA: Cox, Wagman, Medvedev 1989); cp = 29.124
// J/mol/K (Gurvich, Veyts, Alcock 1989).
TEST(Nasa9, GivesThePublishedValuesOfNitrogen) {
  const auto mechanism = readText("species: [N2]", kNitrogen, "[]");
  const Thermo thermo(mechanism);
  const std::vector<double> Y{1.0};
  const double W = mechanism.molecularWeights()[0], T = 298.15;
  EXPECT_NEAR(thermo.cpMass(T, Y) * W, 29.124, 5e-4);
  EXPECT_NEAR(thermo.enthalpyMass(T, Y) * W, 0, 1e-4);
  EXPECT_NEAR(thermo.entropyMass(T, 1e5, Y) * W, 191.609, 4e-3);
  EXPECT_NEAR(thermo.entropyMass(T, 101325, Y) * W, 191.609 - constants::gasConstant * std::log(1.01325), 4e-3);
  EXPECT_EQ(mechanism.species(0).thermo.minTemperature, 200);
  EXPECT_EQ(mechanism.species(0).thermo.maxTemperature, 20000);
}

// dh/dT = cp, ds/dT = cp/T and the slope of cp, in each of the three ranges and beyond both ends.
TEST(Nasa9, DerivativesAreConsistentInEveryRange) {
  const auto mechanism = readText("species: [N2]", kNitrogen, "[]");
  const SpeciesThermo table(mechanism.allSpecies());
  const auto& species = mechanism.species(0);
  for (const double T : {150.0, 300.0, 990.0, 2500.0, 7000.0, 21000.0}) {
    double cp = 0, slope = 0, g = 0, h = 0, s = 0;
    table.cpOverR(T, &cp);
    table.cpSlopeOverR(T, &slope);
    EXPECT_EQ(cp, cpOverR(species, T));
    // Central differences are off by d^2/6 of the third derivative: (d/T)^2 of each term, times up to four. At 21000 K
    // terms of up to 300 cp cancel.
    const double d = 1e-4 * T;
    const auto difference = [&](auto&& f) { return (f(T + d) - f(T - d)) / (2 * d); };
    EXPECT_NEAR(difference([&](double t) { return t * enthalpyOverRT(species, t); }), cp, 1e-5 * cp) << T;
    EXPECT_NEAR(difference([&](double t) { return entropyOverR(species, t); }), cp / T, 1e-5 * cp / T) << T;
    EXPECT_NEAR(difference([&](double t) { return cpOverR(species, t); }), slope, 1e-5 * cp / T) << T;
    table.gibbsOverRT(T, std::log(T), &g);
    table.enthalpyOverRT(T, &h);
    table.entropyOverR(T, std::log(T), &s);
    EXPECT_NEAR(g, h - s, 1e-13 * s);
    EXPECT_EQ(h, enthalpyOverRT(species, T));
    EXPECT_EQ(s, entropyOverR(species, T));
  }
}

// The same polynomials in both formats, next to each other, at temperatures in and beyond both ranges.
TEST(Nasa9, WithoutInversePowersIsNasa7) {
  const auto mechanism = readText("species: [N2, O2, NO]", R"(
- name: N2
  composition: {N: 2}
  thermo: &a
    model: NASA7
    temperature-ranges: [200, 900, 3000]
    data: [[3.5, 2e-4, -3e-8, 4e-12, -5e-16, -900, 4], [3.6, 1e-4, -2e-8, 3e-12, -4e-16, -930, 3.4]]
- name: O2
  composition: {O: 2}
  thermo:
    model: NASA9
    temperature-ranges: [200, 900, 3000]
    data: [[0, 0, 3.5, 2e-4, -3e-8, 4e-12, -5e-16, -900, 4], [0, 0, 3.6, 1e-4, -2e-8, 3e-12, -4e-16, -930, 3.4]]
- {name: NO, composition: {N: 1, O: 1}, thermo: *a})",
                                  "[]");
  const SpeciesThermo table(mechanism.allSpecies());
  std::array<double, 3> out{};
  for (const double T : {150.0, 300.0, 899.9, 900.1, 2000.0, 4000.0}) {
    const double lnT = std::log(T);
    const auto expectSame = [&](auto&& evaluate) {
      evaluate(out.data());
      EXPECT_EQ(out[0], out[2]);
      EXPECT_NEAR(out[1], out[0], 1e-14 * (1 + lnT + std::abs(out[0]))) << T;
    };
    expectSame([&](double* o) { table.cpOverR(T, o); });
    expectSame([&](double* o) { table.cpSlopeOverR(T, o); });
    expectSame([&](double* o) { table.enthalpyOverRT(T, o); });
    expectSame([&](double* o) { table.gibbsOverRT(T, lnT, o); });
    expectSame([&](double* o) { table.entropyOverR(T, lnT, o); });
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(entropyOverR(mechanism.species(k), T), out[k], 1e-13 * out[k]);
  }
}

// Data for 2 atm say s(2 atm); at 1 atm it is larger by R ln 2.
TEST(Nasa9, ReferencePressureShiftsTheEntropy) {
  const std::string seven = "model: NASA7, temperature-ranges: [200, 3000], data: [[3.5, 0, 0, 0, 0, 0, 1]]}}";
  const std::string nine = "model: NASA9, temperature-ranges: [200, 3000], data: [[0, 0, 3.5, 0, 0, 0, 0, 0, 1]]}}";
  for (const auto& data : {seven, nine})
    for (const std::string pressure :
         {"reference-pressure: 2 atm, ", "units: {pressure: atm}, reference-pressure: 2, "}) {
      const auto mechanism =
          readText("species: [N2]", "\n- {name: N2, composition: {N: 2}, thermo: {" + pressure + data, "[]");
      EXPECT_DOUBLE_EQ(entropyOverR(mechanism.species(0), 1.0), 1 + std::log(2.0)) << data;
    }
}

}  // namespace
