// The problems as a table: what holds for the decks of all of them.
#include "app/shell/problem.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "tests/app/app_fixture.hpp"

namespace lampblack::app {
namespace {

using testing::HasSubstr;

std::vector<std::filesystem::path> shippedDecks() {
  std::vector<std::filesystem::path> decks;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::sourceFolder / "cases"))
    if (entry.path().filename() == "deck.yaml") decks.push_back(entry.path());
  return decks;
}

// With every result stands the deck it was made from, defaults included. Read again it is the same deck: no default
// stands in it that another choice of the deck refuses.
TEST(Problems, TheDeckOfARunCanBeReadAgain) {
  const auto decks = shippedDecks();
  EXPECT_GT(decks.size(), 5U);
  for (const auto& path : decks) {
    SCOPED_TRACE(path.string());
    const std::string resolved = Deck::load(path, {}, deckKinds(), MPI_COMM_SELF).resolved();
    EXPECT_EQ(Deck::parse(resolved, path, {}, deckKinds()).resolved(), resolved);
  }
}

// What a run starts from is made before there is a folder, and what is wrong with it stands at its place in the deck.
TEST(Problems, AFlameThatCannotBurnIsRefusedWhereItIsPrepared) {
  const auto path = test::sourceFolder / "cases/flame1d/free_hydrogen/deck.yaml";
  const auto prepare = [&](const std::vector<std::string>& overrides) {
    const Deck deck = Deck::load(path, overrides, deckKinds(), MPI_COMM_SELF);
    return problemOf(deck).prepare(MPI_COMM_SELF, deck)->summary();
  };
  EXPECT_THAT(prepare({}), HasSubstr("free flame, 10 species"));
  try {
    (void)prepare({"inlet={temperature: 300 K, composition: \"O2: 1, N2: 4\"}"});
    FAIL() << "a flame without fuel was prepared";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("inlet: "));
    EXPECT_THAT(error.what(), HasSubstr("fuel"));
  }
}

// On one rank there is a cell for it; on two the deck says so, at its place, before there is a mesh.
TEST(Problems, AFlowNeedsACellForEveryRank) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const Deck deck = Deck::load(
      test::sourceFolder / "tests/app/flame.yaml",
      {"mechanism=" + (test::sourceFolder / "cases/mechanisms/hydrogen_h2o2_10.yaml").string(),
       "mesh={r: [{to: 14 mm, cells: 1}], z: [{to: 8 mm, cells: 1}]}",
       "boundaries={fuel: {type: inlet, side: z-min, velocity: 1, temperature: 300, composition: \"H2: 1\"}, "
       "oxidiser: {type: inlet, side: z-max, velocity: 1, temperature: 300, composition: \"O2: 1\"}, "
       "axis: {type: symmetry, side: r-min}, "
       "outflow: {type: outlet, side: r-max, temperature: 300, composition: \"N2: 1\"}}",
       "particles.description=none"},
      deckKinds(), MPI_COMM_WORLD);
  if (ranks == 1) {
    EXPECT_THAT(problemOf(deck).prepare(MPI_COMM_WORLD, deck)->summary(), HasSubstr("1 cells"));
    return;
  }
  try {
    (void)problemOf(deck).prepare(MPI_COMM_WORLD, deck);
    FAIL() << "one cell was spread over " << ranks << " ranks";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("mesh: 1 cells cannot be spread over"));
  }
}

TEST(FlowCase, AnEdgeInsideAFaceIsTold) {
  const auto notes = [](const std::string& to) {
    return readFlowCase(test::flameDeck({"boundaries.fuel.to=" + to, "boundaries.fuel_flange.from=" + to})).notes;
  };
  EXPECT_TRUE(notes("10 mm").empty());
  const auto told = notes("9.5 mm");
  ASSERT_EQ(told.size(), 2U);
  EXPECT_THAT(told[0], HasSubstr("the boundary fuel has its edge at 0.0095 m inside a face"));
  EXPECT_THAT(told[0], HasSubstr("the nearest edge of a face is at 0.01 m"));
}

// Just below and above Mach 0.3 of ethylene at 299 K (331.5 m/s).
TEST(FlowCase, InletsAreSlowerThanMachThreeTenths) {
  EXPECT_NO_THROW((void)readFlowCase(test::flameDeck({"boundaries.fuel.velocity=99 m/s"})));
  EXPECT_THROW((void)readFlowCase(test::flameDeck({"boundaries.fuel.velocity=100 m/s"})), InputError);
}

}  // namespace
}  // namespace lampblack::app
