// Decks of reactors of given volume: what is read, and what the messages say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/app/kind_of.hpp"
#include "tests/every_module.hpp"
#include "tests/scratch.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;

ClosedKind volumeCase(const std::string& volume, const std::string& more = "",
                      const std::string& type = "given_volume") {
  const ReactorCase read = readReactorCase(
      Deck::parse("problem: reactor\nmechanism: mechanisms/hydrogen_h2o2_10.yaml\nreactor: {type: " + type +
                      "}\ninitial: {temperature: 900 K, composition: \"H2: 2, O2: 1, AR: 10\"}\ntime: {end: 20 ms}\n" +
                      (volume.empty() ? "" : "volume: {" + volume + "}\n") + more,
                  test::sourceFolder / "cases/deck.yaml", {}, reactorSchema()));
  return kindOf<ClosedKind>(read);
}

std::string volumeMessage(const std::string& volume, const std::string& more = "",
                          const std::string& type = "given_volume") {
  try {
    volumeCase(volume, more, type);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::string crank =
    "law: slider_crank, bore: 73.4 mm, stroke: 78.6 mm, rod: 136 mm, compression_ratio: 9.6, speed: 1500 rpm";

TEST(VolumeCase, EveryLawIsRead) {
  const ClosedKind piston = volumeCase(crank + ", start_angle: -90 deg");
  EXPECT_NEAR(*piston.angularSpeed, 50 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(piston.ignitionFrom, 0.01, 1e-12);
  EXPECT_NEAR(piston.volume->ratio(0.01), 38.6728 / 229.5167, 1e-6);
  const ClosedKind table = volumeCase("law: table, time: [0 ms, 10 ms, 20 ms], volume: [500 cm^3, 50 cm^3, 55 cm^3]");
  EXPECT_NEAR(table.volume->ratio(0.02), 0.11, 1e-12);
  EXPECT_EQ(table.ignitionFrom, 0.01);
  const ClosedKind formula = volumeCase("law: formula, formula: '1 + 100*t'");
  EXPECT_NEAR(formula.volume->ratio(0.02), 3, 1e-12);
  EXPECT_EQ(formula.ignitionFrom, 0);
  const ClosedKind shock = volumeCase("law: pressure_rise, pressure_rise: 5 %/ms");
  EXPECT_LT(shock.volume->ratio(0.02), 0.7);
  EXPECT_GT(shock.volume->ratio(0.02), 0.5);
  EXPECT_EQ(shock.ignitionFrom, 0);
  EXPECT_EQ(volumeCase(crank, "ignition: {from: start}\n").ignitionFrom, 0);
}

TEST(VolumeCase, AFileSaysItsUnits) {
  const test::ScratchFolder folder;
  const auto file = [&](const std::string& text) { return "law: table, file: " + folder.file("v.csv", text); };
  EXPECT_NEAR(volumeCase(file("time [ms],volume [cm3]\n0,500\n10,50\n")).volume->ratio(0.01), 0.1, 1e-12);
  EXPECT_NEAR(volumeCase(file("\"t / ms\",\"V / cm3\"\n0,500\n10,50\n")).volume->ratio(0.01), 0.1, 1e-12);
  EXPECT_NEAR(volumeCase(file("t/ms, V/l\n0,5\n10,0.5\n")).volume->ratio(0.01), 0.1, 1e-12);
  EXPECT_NEAR(volumeCase(file("# trace\n0 500\n0.01 50\n")).volume->ratio(0.01), 0.1, 1e-12);
  EXPECT_THAT(volumeMessage(file("0,500\n0.01,-50\n")), testing::HasSubstr("v.csv:2: expected volumes above zero"));
  EXPECT_THAT(volumeMessage(file("0,500\n0,50\n")), testing::HasSubstr("the points have to rise"));
}

TEST(VolumeCase, RefusalsNameTheKeyAndTheCause) {
  for (const auto& [volume, message] : std::vector<std::pair<std::string, std::string>>{
           {"", "'given_volume' needs the section 'volume'"},
           {"law: table", "expected either 'time' and 'volume' or 'file'"},
           {"law: table, time: [0 s, 1 s]", "'time' and 'volume' belong together"},
           {"law: table, time: [0 s, 1 s], volume: [1 l]", "found 2 points and 1 values"},
           {"law: formula", "the law 'formula' needs the key 'formula'"},
           {"law: formula, formula: '1 - 100*t'", "has to be above zero until time.end"},
           {"law: formula, formula: '1 - x'", "x"},
           {"law: slider_crank", "bore"},
           {"law: slider_crank, bore: 1 cm, stroke: 8 cm, rod: 3 cm, compression_ratio: 9, speed: 1000 rpm",
            "longer than half the stroke"},
           {"law: pressure_rise", "pressure_rise"},
           {"law: pressure_rise, pressure_rise: -20 %/ms", "the pressure falls to zero"}})
    EXPECT_THAT(volumeMessage(volume), testing::HasSubstr(message)) << volume;
  EXPECT_THAT(volumeMessage(crank, "", "constant_pressure"), testing::HasSubstr("given_volume"));
  EXPECT_THAT(
      volumeMessage("law: table, time: [0 ms, 20 ms], volume: [5 l, 1 l]", "ignition: {from: end_of_compression}\n"),
      testing::HasSubstr("smallest at the end of the run"));
}

}  // namespace
