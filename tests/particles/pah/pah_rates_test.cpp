#include "particles/pah/pah_rates.hpp"

#include <gmock/gmock.h>

#include "core/errors.hpp"
#include "particles/pah/growth_path.hpp"
#include "tests/messages.hpp"
#include "tests/particles/pah/pah_fixtures.hpp"

namespace lampblack::particles {
namespace {

using test::rateOf;
using testing::HasSubstr;

// Numbers made by another program from the same constants (python, double precision), printed with nine digits: half
// of the last digit is 5e-9 of the smallest mantissa.
TEST(PahRates, AreThoseOfTheReference) {
  struct Row {
    double temperature;
    std::array<double, 11> rates;  // in the order of the processes
  };
  const Row rows[] = {
      {1200,
       {1.22429664e+04, 4.16066236e+03, 5.55703523e-04, 3.60555873e-01, 1.35973652e+04, 1.66183357e+03, 2.14327375e+03,
        1.67505608e+03, 7.13325344e+02, 7.13325344e+02, 3.60555873e-01}},
      {1500,
       {4.21212476e+04, 1.64276207e+04, 2.25944144e-01, 4.74177439e+02, 3.42844556e+04, 1.03937137e+04, 3.04276175e+04,
        3.17234640e+02, 1.66206449e+03, 1.66206449e+03, 4.74177439e+02}},
      {1800,
       {8.87392011e+04, 3.58992979e+04, 1.11066932e+01, 3.27658135e+04, 6.44225916e+04, 2.98412106e+04, 1.06234969e+05,
        8.07689369e+01, 2.59472098e+03, 2.59472098e+03, 3.27658135e+04}},
      {2100,
       {1.43895988e+05, 5.86334995e+04, 1.63748012e+02, 1.01970270e+05, 1.02290769e+05, 5.46333641e+04, 2.58999841e+05,
        2.73625926e+01, 3.44944423e+03, 3.44944423e+03, 1.01970270e+05}},
      {2400,
       {2.00429423e+05, 8.19101952e+04, 1.14602995e+03, 1.38844650e+05, 1.45988098e+05, 7.54768143e+04, 5.11795865e+05,
        1.12805205e+01, 4.11238859e+03, 4.11238859e+03, 1.38844650e+05}},
  };
  const PahProcess order[] = {PahProcess::G6R_AC,  PahProcess::G6R_FE,  PahProcess::D6R_FE_AC, PahProcess::D6R_FE3,
                              PahProcess::L6_BY6,  PahProcess::G5R_ZZ,  PahProcess::D5R_R5,    PahProcess::C5R_RFE,
                              PahProcess::C5R_RAC, PahProcess::M5R_RZZ, PahProcess::C6R_AC_FE3};
  for (const Row& row : rows) {
    PahRates rates = test::referenceRates(row.temperature);
    for (std::size_t i = 0; i < row.rates.size(); ++i)
      EXPECT_NEAR(rateOf(rates, order[i]), row.rates[i], 1e-8 * row.rates[i])
          << rowOf(order[i]).name << " at " << row.temperature;
    EXPECT_EQ(rateOf(rates, PahProcess::O6R_FE3), 0);
  }
  // With the gas constant of today the largest exponent, 36, moves the rates by no more than 2e-7.
  const PahRates now = pahRates({}, 1200, test::concentrationsAt(1200, 0.01, 0.1, 0.1));
  for (std::size_t p = 0; p < 11; ++p) {
    const double before = test::referenceRates(1200)[p];
    EXPECT_NEAR(now[p], before, 2e-7 * before) << pahProcesses[p].name;
  }
}

// A gas of OH, H2O and O2 besides, in which every term counts; written out from the table of set R1.
TEST(PahRates, WaterAndOxidisersCount) {
  const double T = 1700, RT = constants::gasConstant * T / (1e3 * constants::thermochemicalCalorie);
  const std::vector<double> c{0.03, 0.2, 0.05, 0.3, 0.1, 0.25};  // mol/m3
  const double H = 3e-8, H2 = 2e-7, OH = 5e-8, H2O = 3e-7, O2 = 1e-7, C2H2 = 2.5e-7;
  const auto k = [&](double A, double n, double E) { return A * std::pow(T, n) * std::exp(-E / RT); };
  PahRates rates = pahRates({}, T, c);
  const double u = k(4.2e13, 0, 13) * H + k(1e10, 0.734, 1.43) * OH;
  const double d = k(3.9e12, 0, 11) * H2 + k(3.68e8, 1.139, 17.1) * H2O + 2e13 * H;
  const auto g = [&](double a, double b) { return a / (a + b); };
  const double kc = k(8e7, 1.56, 3.8) * C2H2, ko = k(9.7e3, 2.42, 38.46338) * O2, oh = k(1.3e13, 0, 10.62) * OH;
  EXPECT_NEAR(rateOf(rates, PahProcess::G6R_AC), 2 * kc * g(u, d + kc), 1e-12 * rateOf(rates, PahProcess::G6R_AC));
  EXPECT_NEAR(rateOf(rates, PahProcess::O6R_FE3), ko * g(u, d + ko) + oh, 1e-12 * rateOf(rates, PahProcess::O6R_FE3));
  EXPECT_EQ(rateOf(rates, PahProcess::O6R_FE3), rateOf(rates, PahProcess::O6R_FE_HACA));
  const double k9 = k(1.11e11, 0.658, 23.99);
  const double bu = k(9.24e7, 1.5, 9.646) * H + k(2.1e13, 0, 4.56937799) * OH;
  const double bd = k(9.6e4, 1.96, 9.021) * H2 + k(3.68e8, 1.139, 17.1) * H2O + k(8.02e19, -2.011, 1.968) * H;
  EXPECT_NEAR(rateOf(rates, PahProcess::L6_BY6), 2 * k9 * g(bu, bd + k9), 1e-12 * rateOf(rates, PahProcess::L6_BY6));
}

TEST(PahRates, TheFactorsOfTheTableMultiply) {
  const std::vector<double> c = test::concentrationsAt(1500, 0.01, 0.1, 0.1);
  PahRates published = pahRates({}, 1500, c);
  PahRateConstants changed;
  changed.waysArmchair = 3;
  changed.waysLossArmchair = 1;
  changed.waysBay = 5;
  changed.waysZigzag = 1;
  PahRates rates = pahRates(changed, 1500, c);
  for (const auto& [process, factor] : {std::pair{PahProcess::G6R_AC, 1.5},
                                        {PahProcess::D6R_FE_AC, 2.0},
                                        {PahProcess::L6_BY6, 2.5},
                                        {PahProcess::G5R_ZZ, 2.0},
                                        {PahProcess::G6R_FE, 1.0}})
    EXPECT_NEAR(rateOf(rates, process), factor * rateOf(published, process), 1e-12 * rateOf(rates, process));
  PahRateConstants perBenzene;
  perBenzene.sitesPerZigzagRate = 6;
  PahRateConstants slower;
  slower.zigzagOpenByH[0].A /= 6;
  EXPECT_NEAR(pahRates(perBenzene, 1500, c)[5], pahRates(slower, 1500, c)[5], 1e-12 * pahRates(slower, 1500, c)[5]);
  EXPECT_LT(pahRates(perBenzene, 1500, c)[5], 0.5 * rateOf(published, PahProcess::G5R_ZZ));
}

TEST(PahRates, ANamedConstantIsOneOfTheTable) {
  for (const PahRateName& name : pahRateNames) {
    PahRateConstants without;
    ASSERT_FALSE((without.*name.value).empty()) << name.name;
    for (RateConstant& k : without.*name.value) k.A = 0;
    const std::vector<double> c{0.03, 0.2, 0.05, 0.3, 0.1, 0.25};
    EXPECT_NE(pahRates(without, 1600, c), pahRates({}, 1600, c)) << name.name;
  }
}

TEST(PahRates, WithoutHAndOHNothingHappens) {
  const PahRates rates = pahRates({}, 1500, std::vector<double>{0, 1, 0, 1, 1, 1});
  for (std::size_t p = 0; p < pahProcessCount; ++p) EXPECT_EQ(rates[p], 0) << pahProcesses[p].name;
}

TEST(PahRates, WhatIsNoGasIsRefused) {
  const std::vector<double> c(pahGasSpecies, 1.0), bad(pahGasSpecies, std::nan(""));
  EXPECT_THAT(lampblack::test::messageOf<NumericsError>([&] { (void)pahRates({}, -3, c); }), HasSubstr("-3 K"));
  EXPECT_THAT(lampblack::test::messageOf<NumericsError>([&] { (void)pahRates({}, 1000, bad); }),
              HasSubstr("no number"));
  PahRateConstants huge;
  huge.lossArmchair[0] = {1e308, 2, 0};
  EXPECT_THAT(lampblack::test::messageOf<NumericsError>([&] { (void)pahRates(huge, 1e6, c); }),
              HasSubstr("D6R_FE_AC at 1e+06 K is no rate"));
}

ParticlePath heating(double from, double to, double duration) {
  ParticlePath path;
  for (const double T : {from, to}) {
    GasSample sample;
    sample.time = path.points.empty() ? 0 : duration;
    sample.gas.temperature = T;
    sample.concentrations = test::concentrationsAt(T, 0.01, 0.1, 0.1);
    path.points.push_back(sample);
  }
  path.divergence.resize(1);
  return path;
}

std::array<bool, pahProcessCount> all() {
  std::array<bool, pahProcessCount> active{};
  active.fill(true);
  return active;
}

TEST(GrowthPath, IntervalsAreAsShortAsTheRatesChange) {
  const ParticlePath path = heating(1400, 1700, 1e-3);
  // The integral of each rate along the path: the middles of intervals have it to second order, so that a tenth of the
  // change has a hundredth of the error.
  const auto integral = [&](double change) {
    const GrowthPath growth = growthPath(path, {0, 1}, {}, all(), change);
    EXPECT_EQ(growth.records, (std::vector<std::size_t>{0, growth.intervals.size()}));
    double time = 0;
    std::array<double, pahProcessCount> sum{};
    for (const GrowthInterval& interval : growth.intervals) {
      time += interval.duration;
      for (std::size_t p = 0; p < pahProcessCount; ++p) sum[p] += interval.duration * interval.rates[p];
    }
    EXPECT_NEAR(time, 1e-3, 1e-15);
    return sum;
  };
  const auto exact = integral(0.001), coarse = integral(0.5), fine = integral(0.05);
  for (const PahProcess p : {PahProcess::D6R_FE3, PahProcess::G6R_AC, PahProcess::D5R_R5}) {
    const auto i = static_cast<std::size_t>(p);
    EXPECT_LT(std::abs(fine[i] / exact[i] - 1), 2e-4) << rowOf(p).name;
    EXPECT_LT(std::abs(fine[i] - exact[i]), 0.1 * std::abs(coarse[i] - exact[i])) << rowOf(p).name;
  }
}

TEST(GrowthPath, AGasThatStaysIsOneInterval) {
  auto active = all();
  active[0] = false;
  const GrowthPath growth = growthPath(heating(1500, 1500, 1e-3), {1}, {}, active, 0.05);
  ASSERT_EQ(growth.intervals.size(), 1U);
  EXPECT_EQ(growth.records, std::vector<std::size_t>{1});
  EXPECT_EQ(growth.intervals[0].rates[0], 0);
  EXPECT_GT(growth.intervals[0].rates[1], 0);
}

}  // namespace
}  // namespace lampblack::particles
