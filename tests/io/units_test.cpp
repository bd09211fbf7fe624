#include "io/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "io/unit_symbols.hpp"

namespace lampblack::io {
namespace {

using testing::HasSubstr;

struct Written {
  const char* text;
  units::Dimension dimension;
  double si;
};

class Quantities : public testing::TestWithParam<Written> {};

TEST_P(Quantities, AreReadInSi) {
  const auto& [text, dimension, si] = GetParam();
  // One rounding in each of at most four products and quotients.
  EXPECT_NEAR(units::parseQuantity(text, dimension), si, 4e-16 * std::abs(si)) << text;
}

INSTANTIATE_TEST_SUITE_P(
    Units, Quantities,
    testing::Values(Written{"20 cm/s", units::velocity, 0.2}, Written{"1 atm", units::pressure, 101325.0},
                    Written{"50 um", units::length, 50e-6}, Written{"50 µm", units::length, 50e-6},
                    Written{"298 K", units::temperature, 298.0}, Written{"25 degC", units::temperature, 298.15},
                    Written{"8mm", units::length, 8e-3}, Written{"1e-5 s", units::time, 1e-5},
                    Written{"40 ms", units::time, 0.04}, Written{"2.3e19 1/m^2", units::perArea, 2.3e19},
                    Written{"1e15 cm^-3", units::perVolume, 1e21}, Written{"1e15 cm-3", units::perVolume, 1e21},
                    Written{"1.8 g/cm3", units::density, 1800.0}, Written{"5 %", units::dimensionless, 0.05},
                    Written{"3 ppm", units::dimensionless, 3e-6}, Written{"0.026 W/(m K)", units::conductivity, 0.026},
                    Written{"0.026 W/m/K", units::conductivity, 0.026},
                    Written{"1.8e-5 Pa s", units::viscosity, 1.8e-5}, Written{"1.8e-5 Pa*s", units::viscosity, 1.8e-5},
                    Written{"12 kcal/mol", units::molarEnergy, 50208.0}, Written{"3 L/min", units::volumeFlow, 5e-5},
                    Written{"90 deg", units::angle, 1.5707963267948966}, Written{"0", units::angle, 0.0},
                    Written{"-9.81", units::acceleration, -9.81}, Written{"+3 m", units::length, 3.0},
                    Written{"  7  m  ", units::length, 7.0}, Written{"2 min", units::time, 120.0},
                    Written{"10 kW/m^2", units::heatFlux, 1e4}, Written{"1 N/m^2", units::pressure, 1.0},
                    Written{"1 (kg/m)/s^2", units::pressure, 1.0},
                    Written{"750 Torr", units::pressure, 99991.776315789473}));

struct Refused {
  const char* text;
  units::Dimension dimension;
  const char* why;
};

class BadQuantities : public testing::TestWithParam<Refused> {};

TEST_P(BadQuantities, SayWhatIsWrong) {
  const auto& [text, dimension, why] = GetParam();
  try {
    const double value = units::parseQuantity(text, dimension);
    FAIL() << text << " was read as " << value;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(why)) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Units, BadQuantities,
    testing::Values(
        Refused{"20 cm", units::velocity, "expected a velocity (for instance '20 cm/s'), found '20 cm', a length"},
        Refused{"1500", units::angularVelocity,
                "expected a speed of revolution (for instance '1000 rpm'), found '1500' without a unit"},
        Refused{"-142", units::angle, "found '-142' without a unit"},
        Refused{"5 deg", units::dimensionless, "found '5 deg', an angle"},
        Refused{"fast", units::velocity, "expected a velocity (for instance '20 cm/s'), found 'fast'"},
        Refused{"20 parsec", units::length, "'parsec' is not a unit known here"},
        Refused{"60 torr", units::pressure, "'torr' is not a unit known here; did you mean Torr?"},
        Refused{"2 Atm", units::pressure, "did you mean atm?"}, Refused{"1 Kpa", units::pressure, "did you mean kPa?"},
        Refused{"5 UM", units::length, "; did you mean um?"},
        Refused{"2 MPA", units::pressure, "did you mean mPa or MPa?"},
        Refused{"25 C", units::temperature, "'C' is not a unit known here; write degC"},
        Refused{"300 °K", units::temperature, "; write K"}, Refused{"10 dyn/cm^2", units::pressure, "; one is 1e-5 N"},
        Refused{"-20 CAD", units::angle, "; write deg"}, Refused{"540 R", units::temperature, "Rankine is 5/9 K"},
        Refused{"10 sec", units::time, "; write s"}, Refused{"10 cm/Sec", units::velocity, "; write s"},
        Refused{"14.7 psi", units::pressure, "one is 6894.757 Pa"}, Refused{"5 cc", units::volume, "write cm^3"},
        Refused{"3 slpm", units::massFlow, "give the mass flow"}, Refused{"nan", units::length, "not a finite number"},
        Refused{"inf m", units::length, "not a finite"}, Refused{"-inf", units::length, "not a finite"},
        Refused{"1e999 m", units::length, "not a finite"}, Refused{"1e308 km", units::length, "not a finite"},
        Refused{"1 e", units::length, "'e' is not a unit known here"}, Refused{"1d", units::time, "found '1d'"},
        Refused{"1,5 ms", units::time, "; a number has a decimal point, 1.5"},
        Refused{"1.013.25 bar", units::pressure, "; the digits of a number stand together"},
        Refused{"101 325 Pa", units::pressure, "; the digits of a number stand together"},
        Refused{"101'325 Pa", units::pressure, "; the digits of a number stand together"},
        Refused{"1.0D-3 s", units::time, "; write 1e-3"}, Refused{"2d3 s", units::time, "; write 1e-3"},
        Refused{"1e\u22123 s", units::time, "; write the minus as '-'"},
        Refused{"1\u00a0ms", units::time, "; one of its blanks is a special character"},
        Refused{"", units::length, "expected a length"}, Refused{"3 m/", units::length, "it ends too early"},
        Refused{"3 m^", units::length, "needs an integer"}, Refused{"3 m^99", units::length, "-9 to 9"},
        Refused{"3 (m", units::length, "')' is missing"}, Refused{"3 m)", units::length, "not expected here"},
        Refused{"3 W/m K", units::conductivity, "ambiguous"},
        Refused{"3 degC/m", units::temperatureGradient, "degC cannot be part of a longer unit"},
        Refused{"3 degC^2", units::temperature, "degC cannot be part of a longer unit"},
        Refused{"3 kg m", units::length, "a quantity in kg m"}, Refused{"1 2 m", units::length, "cannot be read"},
        Refused{"+-3 m", units::length, "expected a length"}, Refused{"0x10 m", units::length, "not a unit"}));

// Units without prefixes get none by a guess.
TEST(Units, WhatIsGuessedIsAUnit) {
  for (const char* none : {"MATM", "mdeg", "kTORR"}) EXPECT_EQ(units::unitAsWrittenHere(none), "") << none;
  EXPECT_EQ(units::unitAsWrittenHere("kpa"), "; did you mean kPa?");
  EXPECT_EQ(units::unitAsWrittenHere("HZ"), "; did you mean Hz?");
  EXPECT_EQ(units::unitAsWrittenHere("ATM"), "; did you mean atm?");
}

TEST(Units, PrefixesArePowersOfTen) {
  const std::pair<const char*, double> known[] = {{"f", 1e-15},     {"p", 1e-12},     {"n", 1e-9}, {"u", 1e-6},
                                                  {"\u00b5", 1e-6}, {"\u03bc", 1e-6}, {"m", 1e-3}, {"c", 1e-2},
                                                  {"d", 1e-1},      {"da", 1e1},      {"h", 1e2},  {"k", 1e3},
                                                  {"M", 1e6},       {"G", 1e9},       {"T", 1e12}};
  for (const auto& [prefix, factor] : known)
    EXPECT_EQ(units::parseUnit(std::string(prefix) + "J").factor, factor) << prefix;
}

TEST(Units, EveryNamedDimensionReadsItsOwnExampleAndSiUnit) {
  for (const units::Dimension& dimension :
       {units::length,      units::time,          units::mass,           units::temperature,
        units::amount,      units::angle,         units::area,           units::volume,
        units::frequency,   units::velocity,      units::acceleration,   units::density,
        units::force,       units::pressure,      units::energy,         units::watt,
        units::massFlow,    units::massFlux,      units::volumeFlow,     units::viscosity,
        units::diffusivity, units::conductivity,  units::heatFlux,       units::molarEnergy,
        units::molarMass,   units::concentration, units::specificEnergy, units::temperatureGradient,
        units::absorption,  units::perArea,       units::perVolume,      units::dimensionless}) {
    EXPECT_NO_THROW((void)units::parseQuantity(units::example(dimension), dimension)) << units::describe(dimension);
    if (dimension == units::dimensionless) continue;
    const units::Unit unit = units::parseUnit(units::siUnit(dimension));
    EXPECT_EQ(unit.dimension, dimension) << units::siUnit(dimension);
    EXPECT_EQ(unit.factor, 1.0);
  }
}

TEST(Units, DimensionsWithoutANameStillHaveAReadableUnit) {
  const units::Dimension odd = units::mass * units::length / units::power(units::temperature, 2);
  EXPECT_EQ(units::siUnit(odd), "kg m K^-2");
  EXPECT_EQ(units::parseUnit(units::siUnit(odd)).dimension, odd);
}

}  // namespace
}  // namespace lampblack::io
