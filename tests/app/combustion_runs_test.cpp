// Runs of flames in turbulence: the same on any number of ranks and after a restart, without mixing those without a
// model to the last bit, with closed budgets, and where a model cannot be its message.
#include "app/problems/flame/flame_case.hpp"
#include "app/problems/reactor/reactor_case.hpp"
#include "tests/app/turbulent_run.hpp"

namespace lampblack::app {
namespace {

using testing::HasSubstr;

// Hydrogen in nitrogen beside hot air, some ten steps.
Deck mixingDeck(const std::string& combustion, std::vector<std::string> more = {}) {
  more.emplace_back("checkpoint.steps=3");
  return test::flowDeck("hydrogen_h2o2_10.yaml",
                        fmt::format(R"(
turbulence: {{model: sst, walls: automatic, eddy_viscosity_ratio: 20, energy: 200 m^2/s^2, wall_distance: infinite}}
combustion: {{{}}}
mesh: {{geometry: planar, x: [{{to: 8 mm, cells: 8}}], y: [{{to: 8 mm, cells: 6}}]}}
boundaries:
  fuel: {{type: inlet, side: y-min, to: 4 mm, velocity: 40 m/s, temperature: 500 K, composition: "H2: 0.5, N2: 0.5", turbulence_intensity: 0.1, turbulence_length: 1 mm}}
  air: {{type: inlet, side: y-min, from: 4 mm, velocity: 20 m/s, temperature: 1400 K, composition: "O2: 0.21, N2: 0.79", turbulence_intensity: 0.1, turbulence_length: 1 mm}}
  out: {{type: outlet, side: y-max, temperature: 1400 K, composition: "O2: 0.21, N2: 0.79"}}
  middle: {{type: symmetry, side: x-min}}
  side: {{type: symmetry, side: x-max}}
initial: {{layer: none, composition: "O2: 0.1, H2: 0.2, N2: 0.7", temperature: 1400 K, formula: {{velocity_y: "30"}}}}
time: {{end: 70 us, first_step: 10 us, maximum_step: 10 us}}
output: {{boundaries: [out]}}
)",
                                    combustion),
                        more);
}

// Of the last step.
const std::vector<double>& lastOf(const test::Ran& ran, const std::string& field) {
  const std::string& name = ran.fields.rbegin()->first;
  return ran.fields.at(name.substr(0, name.find('/') + 1) + field);
}

TEST(CombustionRuns, GoOnAndDoNotDependOnRanks) {
  const std::string map =
      "chemistry.reference_map={fuel: fuel, oxidizer: air, mixture_fraction: 0.05, temperature: 60 K, log_density: "
      "0.1, "
      "checked: 0.3}";
  for (const std::string model : {"pasr", "edc", "pasr with a map"}) {
    SCOPED_TRACE(model);
    const bool isMapped = model.ends_with("map");
    const test::SharedScratchFolder scratch;
    const Deck deck = mixingDeck("model: " + model.substr(0, model.find(' ')),
                                 isMapped ? std::vector<std::string>{map} : std::vector<std::string>{});
    const auto whole = scratch.path() / "whole";
    const test::Ran all = resultsOf({deck, whole});
    const std::vector<double>& share = lastOf(all, "reacting_share");
    EXPECT_GT(*std::ranges::max_element(share), 1.2 * *std::ranges::min_element(share));
    EXPECT_GT(*std::ranges::min_element(share), 0.0);
    EXPECT_LT(all.history.at("reacting_share_mean").back(), 0.9);
    EXPECT_GT(all.history.at("heat_release").back(), 0.0);
    EXPECT_EQ(all.history.contains("mapped_cells"), isMapped);
    if (isMapped) {
      EXPECT_GT(all.history.at("mapped_cells").back(), 5.0);
      EXPECT_GT(all.history.at("map_checked_cells").back(), 0.0);
    }
    expectSameBits(resultsOf({deck, scratch.path() / "rest", whole}), all);
    if (test::worldSize() == 1) continue;
    MPI_Comm one = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, test::worldRank() == 0 ? 0 : MPI_UNDEFINED, 0, &one);
    // Fine structures ignite by reactors of their own, to the tolerance of the chemistry.
    expectSameFields(resultsOf({deck, scratch.path() / "one", {}, false, one}), all, model == "edc" ? 1e-5 : 1e-7);
    if (one != MPI_COMM_NULL) MPI_Comm_free(&one);
  }
}

TEST(CombustionRuns, WithoutMixingAreLaminarToTheLastBit) {
  const test::SharedScratchFolder scratch;
  const test::Ran laminar = resultsOf({mixingDeck("model: laminar"), scratch.path() / "laminar"});
  for (const std::string model : {"pasr", "edc"}) {
    const test::Ran all = resultsOf({mixingDeck("laminar_below: 1e9, model: " + model), scratch.path() / model});
    for (const auto& [name, values] : laminar.fields) EXPECT_EQ(all.fields.at(name), values) << name;
    for (const double share : lastOf(all, "reacting_share")) EXPECT_EQ(share, 1.0);
    EXPECT_EQ(all.history.at("heat_release_laminar").back(), 0.0);
  }
}

// Particles react at the gas's share, or do not; atoms are kept in either.
TEST(CombustionRuns, ParticlesHaveTheShareThatTheDeckSays) {
  const test::SharedScratchFolder scratch;
  const auto sooting = [&](const std::string& factor) {
    const std::string gas = "\"C2H4: 0.2, C2H2: 0.05, A2: 1e-3, O2: 0.1, H: 1e-3, OH: 1e-3, N2: 0.647\"";
    const Deck deck =
        mixingDeck("model: pasr, soot_factor: " + factor,
                   {"mechanism=" + test::sourcePath("cases/mechanisms/ethylene_bisetti2012_47.yaml"),
                    "mesh.x=[{to: 8 mm, cells: 4}]", "mesh.y=[{to: 8 mm, cells: 3}]",
                    "boundaries.fuel.composition=" + gas, "particles={description: two_equation_dimer, pah: [A2]}",
                    "initial.composition=" + gas, "initial.temperature=1600 K",
                    "time={end: 0.2 us, first_step: 0.1 us, maximum_step: 0.1 us}", "output.interval=0.1 us"});
    return resultsOf({deck, scratch.path() / factor});
  };
  const test::Ran one = sooting("one"), kappa = sooting("kappa");
  // What the second step makes goes by the share at its start.
  const auto after = [](const test::Ran& ran, int step, const std::string& field) -> const std::vector<double>& {
    return ran.fields.at(fmt::format("{:06}/{}", step, field));
  };
  const std::vector<double>& share = after(kappa, 1, "reacting_share");
  const auto made = [&](const test::Ran& ran, std::size_t c) {
    return after(ran, 2, "soot_volume_fraction")[c] - after(ran, 1, "soot_volume_fraction")[c];
  };
  for (std::size_t c = 0; c < share.size(); ++c) {
    EXPECT_LT(share[c], 0.9);
    EXPECT_GT(made(one, c), 0.0);
    EXPECT_NEAR(made(kappa, c), share[c] * made(one, c), 0.02 * made(one, c));
  }
  for (const test::Ran* ran : {&one, &kappa})
    for (const std::string atom : {"C", "H"})
      EXPECT_LT(std::abs(ran->history.at(atom + "_budget_error").back()), 1e-12);
}

TEST(CombustionCase, RefusesWhatCannotBe) {
  struct Wrong {
    std::string combustion;
    std::vector<std::string> overrides;
    std::vector<std::string> words;
  };
  const std::string sa = "turbulence={model: sa, wall_distance: infinite}";
  const Wrong decks[] = {
      {"model: pasr", {sa}, {"combustion.model", "'sa' does not know", "'combustion.dissipation: shear'"}},
      {"model: edc", {"turbulence={model: wang, wall_distance: infinite}"}, {"'wang' does not know"}},
      {"model: flamelet", {}, {"combustion.model", "flamelet", "pasr"}},
      {"model: laminar, mixing_constant: 1", {}, {"combustion.mixing_constant"}},
      {"model: edc, chemical_time: slowest_species", {}, {"combustion.chemical_time"}},
      {"model: pasr, version: 1996", {}, {"combustion.version"}},
      {"model: pasr, mixing_constant: 0", {}, {"combustion.mixing_constant"}},
      {"model: pasr, laminar_below: -1", {}, {"combustion.laminar_below"}},
      {"model: pasr, soot_factor: kappa", {}, {"combustion.soot_factor", "the particles of a model"}},
      {"model: edc, soot_factor: kappa", {}, {"combustion.soot_factor"}},
      {"model: edc",
       {"chemistry.reference_map={fuel: fuel, oxidizer: air}"},
       {"chemistry.reference_map", "fine structures of 'edc'"}},
  };
  for (const Wrong& deck : decks) {
    SCOPED_TRACE(deck.combustion);
    const std::string message =
        test::messageOf<InputError>([&] { (void)readFlowCase(mixingDeck(deck.combustion, deck.overrides)); });
    for (const std::string& word : deck.words) EXPECT_THAT(message, HasSubstr(word));
  }
  for (const std::string model : {"pasr", "edc"}) {
    const std::string laminar = test::messageOf<InputError>(
        [&] { (void)readFlowCase(test::flameDeck({"combustion={model: " + model + "}"})); });
    EXPECT_THAT(laminar, HasSubstr("combustion.model"));
    EXPECT_THAT(laminar, HasSubstr("'" + model + "' goes by the turbulence, and the flow has none; expected laminar"));
  }
  // Where nothing is turbulent there is no such section.
  const auto elsewhere = [](const std::string& problem, const DeckSchema& schema) {
    const std::string text = fmt::format("problem: {}\nmechanism: gas.yaml\ncombustion: {{model: pasr}}\n", problem);
    return test::messageOf<InputError>([&] { (void)Deck::parse(text, "deck.yaml", {}, schema); });
  };
  EXPECT_THAT(elsewhere("reactor", reactorSchema()), HasSubstr("unknown key 'combustion'"));
  EXPECT_THAT(elsewhere("flame1d", flameSchema()), HasSubstr("unknown key 'combustion'"));
  EXPECT_TRUE(readFlowCase(mixingDeck("model: pasr, dissipation: shear", {sa})).combustion->dissipationOfShear);
  EXPECT_FALSE(readFlowCase(mixingDeck("model: laminar")).combustion);
}

TEST(CombustionCase, TakesWhatTheDeckSays) {
  const auto optionsOf = [](const std::string& keys) { return *readFlowCase(mixingDeck(keys)).combustion; };
  const auto usual = optionsOf("model: pasr");
  EXPECT_EQ(usual.chemicalTime, ChemicalTime::Kind::WeightedReactions);
  EXPECT_EQ(usual.mixingTime, MixingTime::Effective);
  EXPECT_EQ(usual.mixingConstant, 0.3);
  EXPECT_EQ(usual.laminarBelow, 0.1);
  EXPECT_EQ(optionsOf("model: pasr, chemical_time: reactions_of6").chemicalTime, ChemicalTime::Kind::ReactionsOf6);
  EXPECT_EQ(optionsOf("model: pasr, chemical_time: slowest_species").chemicalTime, ChemicalTime::Kind::SlowestSpecies);
  EXPECT_EQ(optionsOf("model: pasr, mixing_time: kolmogorov").mixingTime, MixingTime::Kolmogorov);
  EXPECT_EQ(optionsOf("model: pasr, mixing_time: geometric").mixingTime, MixingTime::Geometric);
  EXPECT_EQ(optionsOf("model: pasr, mixing_time: integral").mixingTime, MixingTime::Integral);
  const auto powers = [&](const std::string& version) {
    const FineStructures fine = optionsOf("model: edc, version: " + version).fine;
    return std::pair(fine.powerAbove, fine.powerBelow);
  };
  EXPECT_EQ(powers("2005"), std::pair(2.0, 2.0));
  EXPECT_EQ(powers("1996"), std::pair(2.0, 3.0));
  EXPECT_EQ(powers("1981"), std::pair(3.0, 3.0));
}

}  // namespace
}  // namespace lampblack::app
