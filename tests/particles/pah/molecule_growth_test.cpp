#include "particles/pah/molecule_growth.hpp"

#include <gtest/gtest.h>

#include "tests/particles/pah/pah_fixtures.hpp"

namespace lampblack::particles {
namespace {

using test::manyEvents, test::named, test::rateOf;

// The mean of a waiting time that nothing else ends: a benzene that grows once.
TEST(MoleculeGrowth, WaitingTimesAreThoseOfAllSites) {
  PahRates rates{};
  rateOf(rates, PahProcess::G6R_FE) = 2.0;  // of each of six sites
  constexpr int repeats = 4000;
  int unchanged = 0;
  for (int r = 0; r < repeats; ++r) {
    MoleculeGrowth growth(named("benzene"), RandomStream(9, static_cast<std::uint64_t>(r), 0));
    (void)growth.advance(rates, 0.05, manyEvents);
    unchanged += growth.molecule().rings() == 1 ? 1 : 0;
  }
  const double expected = std::exp(-6 * 2.0 * 0.05);
  EXPECT_NEAR(unchanged, repeats * expected, 3.3 * std::sqrt(repeats * expected * (1 - expected)));
}

// The same random numbers in two portions of events are not the same events (the waiting time is drawn anew), but
// counts add up, and what is left over is said.
TEST(MoleculeGrowth, StopsAfterTheMostEvents) {
  const PahRates rates = test::referenceRates(1800);
  MoleculeGrowth growth(named("pyrene"), RandomStream(1, 2, 0));
  const double left = growth.advance(rates, 1e-4, 5);
  EXPECT_GT(left, 0);
  EXPECT_LT(left, 1e-4);
  std::uint64_t count = 0;
  for (std::size_t p = 0; p < pahProcessCount; ++p) count += growth.events()[p] + growth.voids()[p];
  EXPECT_EQ(count, 5U);
  EXPECT_EQ(growth.advance(rates, left, manyEvents), 0);
}

TEST(MoleculeGrowth, AtomsAreThoseOfTheEvents) {
  const PahRates rates = test::referenceRates(1700);
  MoleculeGrowth growth(named("pyrene"), RandomStream(5, 0, 0));
  (void)growth.advance(rates, 2e-4, 20000);
  int carbon = 16, hydrogen = 10;
  for (std::size_t p = 0; p < pahProcessCount; ++p) {
    carbon += static_cast<int>(growth.events()[p]) * pahProcesses[p].carbon;
    hydrogen += static_cast<int>(growth.events()[p]) * pahProcesses[p].hydrogen;
  }
  EXPECT_EQ(static_cast<int>(growth.molecule().carbon()), carbon);
  EXPECT_EQ(static_cast<int>(growth.molecule().hydrogen()), hydrogen);
  growth.molecule().requireConsistent();
}

TEST(MoleculeGrowth, AStreamGivesTheSameMoleculeAgain) {
  const PahRates rates = test::referenceRates(1600);
  const auto cells = [&](std::uint64_t owner) {
    MoleculeGrowth growth(named("pyrene"), RandomStream(5, owner, 0));
    (void)growth.advance(rates, 1e-4, manyEvents);
    return growth.molecule().cells(false);
  };
  EXPECT_EQ(cells(3), cells(3));
  EXPECT_NE(cells(3), cells(4));
}

TEST(MoleculeGrowth, AMoleculeThatHasLeftStays) {
  const PahRates rates = test::referenceRates(1500);
  MoleculeGrowth growth(named("pyrene"), RandomStream(5, 0, 0), 6);
  (void)growth.advance(rates, 1, manyEvents);
  ASSERT_TRUE(growth.hasLeft());
  EXPECT_EQ(growth.molecule().rings(), 7U);
  const auto events = growth.events();
  EXPECT_EQ(growth.advance(rates, 1, manyEvents), 0);
  EXPECT_EQ(growth.events(), events);
}

TEST(MoleculeGrowth, OxidationAloneBurnsDownToBenzene) {
  PahRates rates{};
  rateOf(rates, PahProcess::O6R_FE3) = rateOf(rates, PahProcess::O6R_FE_HACA) = 1;
  for (std::uint64_t r = 0; r < 20; ++r) {
    MoleculeGrowth growth(named("phenanthrene"), RandomStream(2, r, 0));
    (void)growth.advance(rates, 1e6, manyEvents);
    EXPECT_EQ(growth.molecule().rings(), 1U);
    EXPECT_EQ(growth.events()[static_cast<std::size_t>(PahProcess::O6R_FE3)], 2U);
  }
}

}  // namespace
}  // namespace lampblack::particles
