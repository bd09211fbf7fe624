// What reactor decks become: mixtures, flows in balance, the shipped cases.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <utility>
#include <vector>

#include "app/deck/gas_input.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/shell/problem.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "core/text_file.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/app/kind_of.hpp"
#include "tests/scratch.hpp"

namespace lampblack::app {
namespace {

ReactorCase shipped(const std::string& name) {
  return readReactorCase(Deck::load(test::sourceFolder / "cases" / name / "deck.yaml", {}, reactorSchema()));
}

TEST(ReactorCase, ShippedDecksAreValid) {
  for (const auto& entry : std::filesystem::directory_iterator(test::sourceFolder / "cases/reactor")) {
    const std::string name = "reactor/" + entry.path().filename().string();
    EXPECT_NO_THROW(shipped(name)) << name;
  }
}

TEST(ReactorCase, AnEquivalenceRatioIsThatOfTheAtoms) {
  const ReactorCase methane = shipped("reactor/ignition_methane");
  const Mechanism& mechanism = *methane.mechanism;
  std::vector<double> Y(mechanism.numSpecies());
  Thermo(mechanism).moleToMass(parseComposition(mechanism, "CH4: 1, O2: 2, N2: 7.52"), Y);
  for (std::size_t k = 0; k < Y.size(); ++k) EXPECT_NEAR(kindOf<ClosedKind>(methane).initial.Y[k], Y[k], 1e-15);
  // Oxygen in the fuel counts: CO + H2 + CH3OH need 1/2 + 1/2 + 3/2 O2.
  const auto X = mixByEquivalenceRatio(mechanism, parseComposition(mechanism, "CO: 1, H2: 1, CH3OH: 1"),
                                       parseComposition(mechanism, "O2: 1, N2: 3.76"), 2.0);
  EXPECT_NEAR((X[mechanism.speciesIndex("CO")] * 0.5 + X[mechanism.speciesIndex("H2")] * 0.5 +
               X[mechanism.speciesIndex("CH3OH")] * 1.5) /
                  X[mechanism.speciesIndex("O2")],
              2.0, 1e-12);
}

// 50 g/s come in and 30 % go round once more: F = 50 + 0.3 F.
TEST(ReactorCase, FlowsOfANetworkAreInBalance) {
  const ReactorNetwork network = kindOf<StirredKind>(shipped("reactor/network_combustor")).vessels;
  ASSERT_EQ(network.reactors.size(), 6U);
  EXPECT_NEAR(network.throughflow(0), 0.05 / 0.7, 1e-15);
  EXPECT_NEAR(network.throughflow(1), 0.3 * 0.05 / 0.7, 1e-15);
  EXPECT_NEAR(network.throughflow(5), 0.13, 1e-15);
}

// What a profile file becomes: its temperatures, or the message about it.
std::string profileOf(const std::string& text, std::optional<double> at = {}) {
  const test::ScratchFolder folder;
  std::string found;
  try {
    const auto deck = Deck::parse(
        "problem: reactor\nmechanism: mechanisms/hydrogen_h2o2_10.yaml\n"
        "reactor: {type: constant_pressure, energy: profile}\n"
        "initial: {temperature: 300 K, composition: \"H2: 1, O2: 1\"}\ntime: {end: 1 s}\n"
        "temperature_profile: {file: " +
            folder.file("profile.csv", text) + "}\n",
        test::sourceFolder / "cases/deck.yaml", {}, reactorSchema());
    const ReactorCase read = readReactorCase(deck);
    for (const double T : read.profile->temperatures()) found += fmt::format("{:g} ", T);
    if (at) found += fmt::format("at {:g}", read.profile->value(*at));
  } catch (const InputError& error) {
    found = error.what();
  }
  return found;
}

TEST(ReactorCase, AProfileFileLosesNoLine) {
  EXPECT_EQ(profileOf("0,300\n1,400\n"), "300 400 ");
  EXPECT_EQ(profileOf("\xef\xbb\xbf"
                      "0,300\r\n1,400\r\n"),
            "300 400 ")
      << "a byte-order mark";
  EXPECT_EQ(profileOf("# made by hand\n\"time, s\",\"T, K\"\n0,300\n1,+4e2"), "300 400 ");
  EXPECT_EQ(profileOf("time T\n 0 300\n\n# half way\n 1\t400\n"), "300 400 ");
  EXPECT_EQ(profileOf("time [s];T [degC]\n0;26.85\n1; 126.85\n", 1.0), "300 400 at 400");
  for (const char* text : {"0,0;300\n1,0;400\n", "0;300\n1;400,0\n", "0\t300,0\n1\t400,0\n", "0,0 300,0\n1 400\n",
                           "time [s];T [K];\n0,0;300\n1,0;400,0\n", "0,000 300\n0,500 400\n", "0;300,000\n1;400,000\n"})
    EXPECT_EQ(profileOf(text), "300 400 ") << "decimal commas: " << text;
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"0,nan\n1,400\n", "profile.csv:1: expected two numbers, found '0,nan'"},
           {"nan,nan\n1,400\n", ":1: expected two numbers, found 'nan,nan'"},
           {"0,0;300;1\n", ":1: expected two numbers, found '0,0;300;1'"},
           {"0,0 300\n1,200 400\n", ":2: the comma of '1,200' may be that of thousands; write a decimal point"},
           {"0\t300,000\n", ":1: the comma of '300,000' may be that of thousands"},
           {"0 12,345,678\n", ":1: expected two numbers, found '0 12,345,678'"},
           {"12,345,678;300\n", ":1: expected two numbers, found '12,345,678;300'"},
           {"0,0,300\n", ":1: expected two numbers, found '0,0,300'"},
           {"0,T\n1,400\n", ":1: expected two numbers, found '0,T'"},
           {"time,T\ntime,T\n1,400\n", ":2: expected two numbers"},
           {"time,T\n0,300,1\n", ":2: expected two numbers"},
           {"0,300\n0,400\n", ":2: the points have to rise; 0 follows 0"},
           {"0,300\n1,1e9\n", ":2: expected temperatures from"},
           {"time,T\n", "expected lines of two numbers, found none"},
           {"", "the file is empty"}})
    EXPECT_THAT(profileOf(text), testing::HasSubstr(message)) << text;
}

TEST(ReactorCase, AProfileFileSaysItsUnits) {
  for (const std::string header :
       {"time [ms],T [degC]", "time[ms],T[degC]", "time (ms),T (degC)", "time [ms] T [degC]",
        "\"time [ms]\",\"gas, measured [degC]\"", "\"time; shifted [ms]\",T [degC]", "time (ms), T [degC]"}) {
    const bool commas = header.find(',') != std::string::npos;
    EXPECT_EQ(profileOf(header + (commas ? "\n0,26.85\n2000,126.85\n" : "\n0 26.85\n2000 126.85\n"), 1.0),
              "300 400 at 350")
        << header;
  }
  for (const std::string header :
       {"# time [ms], T [degC]", "# from a figure\n# time [ms]  T [degC]", "#time (ms)\tT (degC)"})
    EXPECT_EQ(profileOf(header + "\n0 26.85\n2000 126.85\n", 1.0), "300 400 at 350") << header;
  EXPECT_EQ(profileOf("# after Smith, Fig. 3 (run 7)\n0,300\n2,400\n", 1.0), "300 400 at 350");
  EXPECT_EQ(profileOf("time (from the valve),T (corrected)\n0,300\n2,400\n", 1.0), "300 400 at 350");
  EXPECT_EQ(profileOf("time since the start T\n0 300\n2 400\n", 1.0), "300 400 at 350");
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"z [cm],T [K]\n0,300\n", "profile.csv:1: the column 'z' is in cm; expected a time"},
           {"time [s],T [ms]\n0,300\n", ":1: the column 'T' is in ms; expected a temperature"},
           {"time [sec],T [K]\n0,300\n", "'sec' is not a unit known here"},
           {"the time [ms] T [K]\n0 300\n", ":1: expected the names of two columns"},
           {"# z [cm], T [K]\n0,300\n", ":1: the column 'z' is in cm; expected a time"},
           {"time [ms],T [degC]\n0,1e9\n", ":2: expected temperatures from"}})
    EXPECT_THAT(profileOf(text), testing::HasSubstr(message)) << text;
}

TEST(ReactorCase, LinesMayEndWithACarriageReturnAlone) {
  EXPECT_EQ(profileOf("z,T\r0,300\r1,400\r2,500\r"), "300 400 500 ");
  EXPECT_EQ(profileOf("z,T\n0,300\r1,400\r"), "300 400 ") << "a header put in front";
  EXPECT_EQ(profileOf("z,T\r\r\n0,300\r\r\n1,400\r\r\n"), "300 400 ") << "converted twice";
  for (const std::string end : {"\r", "\r\n", "\n"})
    EXPECT_THAT(profileOf("z,T" + end + "0,300" + end + "0,400" + end),
                testing::HasSubstr("profile.csv:3: the points have to rise"));
}

TEST(ReactorCase, ReactionsAreNamedByNumberOrEquation) {
  const auto path = test::sourceFolder / "cases/reactor/ignition_hydrogen/deck.yaml";
  const auto read = [&](const std::string& reactions) {
    return kindOf<ClosedKind>(
               readReactorCase(Deck::load(path, {"sensitivity.reactions=" + reactions}, reactorSchema())))
        .sensitivities;
  };
  EXPECT_EQ(read("['11', 'O+H2<=>H + OH']"), (std::vector<std::size_t>{10, 2}));
  EXPECT_EQ(read("[all]").size(), 29U);
  EXPECT_THROW(read("['0']"), InputError);
}

// The delay by OH without being asked for, where the mechanism calls it oh.
TEST(ReactorCase, TheRadicalOfADelayInAnyCase) {
  const test::ScratchFolder folder;
  const auto text =
      readTextFile((test::sourceFolder / "cases/mechanisms/hydrogen_h2o2_10.yaml").string(), "a mechanism");
  static_cast<void>(folder.file("low.yaml", std::regex_replace(text, std::regex("\\bOH\\b"), "oh")));
  const std::string deck = folder.file("deck.yaml",
                                       "problem: reactor\nmechanism: low.yaml\nreactor: {type: constant_pressure}\n"
                                       "initial: {temperature: 1100 K, composition: 'h2: 2, o2: 1, N2: 3.76'}\n"
                                       "time: {end: 1 ms}\n");
  const ReactorCase low = readReactorCase(Deck::load(deck, {}, reactorSchema()));
  std::vector<std::string> names;
  for (const IgnitionCriterion& criterion : kindOf<ClosedKind>(low).ignition) names.push_back(criterion.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"max_X_oh", "max_Y_oh"}));
}

TEST(Problems, ADeckChoosesItsProblem) {
  const auto deck = test::sourceFolder / "cases/reactor/ignition_hydrogen/deck.yaml";
  EXPECT_EQ(problemOf(Deck::load(deck, {}, deckKinds(), MPI_COMM_SELF)).name, "reactor");
  const auto flow = test::sourceFolder / "cases/flow/counterflow_ethylene/deck.yaml";
  EXPECT_EQ(problemOf(Deck::load(flow, {}, deckKinds(), MPI_COMM_SELF)).name, "flow");
  EXPECT_THROW(Deck::load(flow, {"problem=fluid"}, deckKinds(), MPI_COMM_SELF), InputError);
}

}  // namespace
}  // namespace lampblack::app
