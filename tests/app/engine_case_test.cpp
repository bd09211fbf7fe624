// What decks of an engine become, and what is refused.
#include "app/problems/engine/engine_case.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "app/problems/engine/engine_output.hpp"
#include "app/problems/engine/engine_repeat.hpp"
#include "core/errors.hpp"
#include "tests/messages.hpp"

namespace lampblack::app {
namespace {

using testing::HasSubstr;

const std::string engineSection =
    "engine: {bore: 0.1 m, stroke: 0.1 m, rod: 0.2 m, compression_ratio: 12, speed: 1200 rpm, start: -90 deg, end: "
    "90 deg}\n";
const std::string engineStart = "problem: engine\nmechanism: hydrogen_h2o2_10.yaml\n" + engineSection;
const std::string engineCharge1 =
    "charge: {temperature: 400 K, pressure: 1 bar, fuel: 'H2: 1', oxidizer: 'O2: 1, N2: 3.76', equivalence_ratio: 0.3";

EngineCase readEngine(const std::string& more, const std::vector<std::string>& set = {}) {
  return readEngineCase(
      Deck::parse(engineStart + more, LAMPBLACK_SOURCE_DIR "/cases/mechanisms/deck.yaml", set, engineSchema()));
}

std::string refusedEngine(const std::string& more, const std::vector<std::string>& set = {}) {
  return test::messageOf<InputError>([&] { (void)readEngine(more, set); });
}

TEST(EngineCase, TimesAnglesAndVolumes) {
  const EngineCase made = readEngine(engineCharge1 + "}\noutput: {every: 50 deg}\n");
  EXPECT_EQ(made.angles(), (std::vector<double>{-90, -40, 10, 60, 90}));
  EXPECT_NEAR(made.timeOf(90), 0.025, 1e-15);
  EXPECT_NEAR(made.options.step * 360 * 20, 0.5, 1e-12);
  EXPECT_NEAR(made.options.pistonSpeed, 4, 1e-12);
  EXPECT_NEAR(made.options.volume(made.timeOf(0)), made.crank.displacement() / 11, 1e-15);
  EXPECT_EQ(made.options.mixing, EngineMixingModel::none);
  EXPECT_EQ(made.options.heat.model, EngineHeatLaw::Model::none);
}

// The engine of the lecture: cm3 at 30, 60, 90, 120, 150 deg from the upper dead centre.
TEST(SliderCrank, VolumesOfTheGeely) {
  const SliderCrank crank{73.4e-3, 78.6e-3, 136e-3, 9.6};
  EXPECT_NEAR(1e6 * crank.displacement(), 332.586, 1e-3);
  EXPECT_NEAR(1e6 * crank.clearance(), 38.6728, 1e-4);
  const double volumes[] = {66.9903, 140.1310, 229.5167, 306.4242, 355.0186};
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(1e6 * crank.volume((k + 1) * std::numbers::pi / 6), volumes[k], 1e-4) << k;
  EXPECT_NEAR(crank.volume(std::numbers::pi), crank.clearance() + crank.displacement(), 1e-12);
}

TEST(EngineCase, ChargesFillTheCylinder) {
  const EngineCase made = readEngine(engineCharge1 +
                                     ", exhaust: 0.2, exhaust_by: mole, temperature_deviation: 20 K, ratio_deviation: "
                                     "0.05}\ncycles: {residual: 0.1}\nsample: {particles: 400}\n");
  const Thermo thermo(*made.mechanism);
  const EngineGas gas = engineCharge(made, 0, {});
  EXPECT_NEAR(volumeOf(thermo, gas), made.options.volume(0), 1e-15);
  double mean = 0, square = 0, ratio = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    mean += gas.temperature[i] / 400;
    square += std::pow(gas.temperature[i] - 400, 2) / 400;
    ratio += equivalenceRatioOf(*made.mechanism, gas.Y(i)) / 400;
  }
  EXPECT_NEAR(mean, 400, 4);
  EXPECT_NEAR(std::sqrt(square), 20, 3);
  EXPECT_NEAR(ratio, 0.3, 0.01);  // exhaust has that of the fresh gas
  // A fifth of the moles: the steam in it, of 0.3 H2 to 1.0 + 3.76 + 0.15.
  const EngineCase even = readEngine(engineCharge1 + ", exhaust: 0.2, exhaust_by: mole}\n");
  const EngineGas same = engineCharge(even, 0, {});
  std::vector<double> X(same.species);
  thermo.massToMole(same.Y(0), X);
  EXPECT_NEAR(X[made.mechanism->speciesIndex("H2O")], 0.2 * 0.6 / (0.3 + 0.4 + 0.3 + 4.76 - 0.3 - 0.0), 2e-3);
  // Residual gas, hotter: what it brings in temperature.
  const EngineResidual left{1200, 4e5, std::vector<double>(same.Y(0).begin(), same.Y(0).end())};
  const EngineCase cycled = readEngine(engineCharge1 + ", exhaust: 0.2, exhaust_by: mole}\ncycles: {residual: 0.1}\n");
  const double hot = engineCharge(cycled, 0, left).temperature[0];
  EXPECT_GT(hot, 400 + 0.1 * (1200 * std::pow(0.25, 0.3) - 400) * 0.9);
  EXPECT_LT(hot, 400 + 0.1 * 800);
}

TEST(EngineCase, RepeatsHaveMeansAndIntervals) {
  const std::vector<double> repeats{1, 10, 3, 30};
  const std::vector<double> means = engineMeans(repeats, 2, 2);
  ASSERT_EQ(means.size(), 8U);
  EXPECT_EQ(means[0], 2);
  EXPECT_EQ(means[1], 1);
  EXPECT_EQ(means[4], 20);
  EXPECT_EQ(engineMeans(std::span(repeats).first(2), 2, 1), (std::vector<double>{1, 10}));
}

TEST(EngineCase, SootOfAnyKindFollowsTheMeanGas) {
  const std::vector<std::string> ethylene{"mechanism=ethylene_abf2000_101.yaml"};
  const std::string soot = "charge: {temperature: 400 K, pressure: 1 bar, composition: N2}\nparticles: {description: ";
  for (const char* kind : {"ensemble", "trees", "molecules"})
    EXPECT_TRUE(readEngine(soot + kind + "}\n", ethylene).population.has_value()) << kind;
  EXPECT_THAT(refusedEngine(soot + "ensemble}\noutput: {species: [OH]}\n", ethylene), HasSubstr("all species"));
  EXPECT_THAT(refusedEngine(soot + "ensemble, bins: 40}\n", ethylene), HasSubstr("no size distributions"));
}

TEST(EngineCase, SaysWhatIsWrong) {
  const std::string whole = engineCharge1 + "}\n";
  EXPECT_THAT(refusedEngine(whole, {"engine.rod=4 cm"}), HasSubstr("longer than half of the stroke"));
  EXPECT_THAT(refusedEngine(whole, {"engine.end=-100 deg"}), HasSubstr("that rise"));
  EXPECT_THAT(refusedEngine(whole + "mixing: {time: [1 ms, 2 ms]}\n"), HasSubstr("2 values for 0 angles"));
  EXPECT_THAT(refusedEngine(whole + "mixing: {time: [1 ms, 2 ms], angles: [10 deg, 0 deg]}\n"),
              HasSubstr("angles that rise"));
  EXPECT_THAT(refusedEngine(whole + "walls: {jumps: 0.5}\n"), HasSubstr("more than 1, or 0"));
  EXPECT_THAT(refusedEngine(whole + "walls: {model: constant}\n"), HasSubstr("'factor'"));
  EXPECT_THAT(refusedEngine(whole + "output: {particles_at: [100 deg]}\n"), HasSubstr("between engine.start"));
  EXPECT_THAT(refusedEngine(whole + "injection: {fuel: 'H2: 1', angles: [0 deg, 1 deg], rates: [1 g/s, 0 g/s]}\n"),
              HasSubstr("begin and end with zero"));
  EXPECT_THAT(
      refusedEngine("charge: {temperature: 400 K, pressure: 1 bar, composition: 'H2: 1', ratio_deviation: 0.1}\n"),
      HasSubstr("by fuel, oxidizer"));
  EXPECT_THAT(refusedEngine(whole + "particles: {description: moss_brookes}\n"), HasSubstr("carbon and hydrogen"));
}

}  // namespace
}  // namespace lampblack::app
