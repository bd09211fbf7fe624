#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/particles/pah/pah_fixtures.hpp"

namespace lampblack::particles {
namespace {

using test::named;
using Cells = std::vector<LatticeCell>;

Molecule::SiteNumber onlySite(const Molecule& molecule, SiteGroup group) {
  EXPECT_GE(molecule.count(group), 1U);
  return molecule.member(group, 0);
}

bool applyFirst(Molecule& molecule, PahProcess process) {
  static RandomStream random(11, 0, 0);
  return molecule.apply(process, onlySite(molecule, rowOf(process).site), random);
}

// Events drawn evenly over processes that can happen, but losses half as often so that molecules grow into their own
// way: each changes the atoms by its row, keeps the sites those of the cells, or is void and changes nothing.
TEST(MoleculeEvents, EachChangesTheMoleculeAsItsRowSays) {
  RandomStream random(5, 1, 0);
  std::array<int, pahProcessCount> happened{}, voids{};
  Molecule molecule = named("pyrene");
  for (int event = 0; event < 6000; ++event) {
    // Started anew from time to time, so that each kind of neighbourhood is met.
    if (molecule.rings() > 60) molecule = named(event % 2 == 0 ? "naphthalene" : "triphenylene");
    const auto p = random.below(pahProcessCount);
    const PahProcessRow& row = pahProcesses[p];
    if (molecule.count(row.site) == 0 || (row.carbon < 0 && random.below(2) == 0)) continue;
    const Cells six = molecule.cells(false), five = molecule.cells(true);
    const std::size_t carbon = molecule.carbon(), hydrogen = molecule.hydrogen();
    const auto site = molecule.member(row.site, random.below(molecule.count(row.site)));
    if (molecule.apply(static_cast<PahProcess>(p), site, random)) {
      ++happened[p];
      ASSERT_EQ(static_cast<int>(molecule.carbon() - carbon), row.carbon) << row.name;
      ASSERT_EQ(static_cast<int>(molecule.hydrogen() - hydrogen), row.hydrogen) << row.name;
    } else {
      ++voids[p];
      ASSERT_EQ(molecule.cells(false), six) << row.name;
      ASSERT_EQ(molecule.cells(true), five) << row.name;
    }
    ASSERT_NO_THROW(molecule.requireConsistent()) << row.name << ", event " << event;
  }
  for (std::size_t p = 0; p < pahProcessCount; ++p) EXPECT_GT(happened[p], 10) << pahProcesses[p].name;
  // What leaves without a new place is never in the way, but for a ring that joins two parts.
  for (const PahProcess p : {PahProcess::D6R_FE3, PahProcess::O6R_FE3, PahProcess::D5R_R5})
    EXPECT_EQ(voids[static_cast<std::size_t>(p)], 0) << rowOf(p).name;
  for (const PahProcess p : {PahProcess::G6R_FE, PahProcess::G6R_AC, PahProcess::G5R_ZZ, PahProcess::D6R_FE_AC})
    EXPECT_GT(voids[static_cast<std::size_t>(p)], 0) << rowOf(p).name;
}

TEST(MoleculeEvents, AReverseRestoresTheCells) {
  struct Pair {
    const char* start;
    PahProcess there, back;
  };
  for (const Pair& pair : {Pair{"phenanthrene", PahProcess::G6R_AC, PahProcess::D6R_FE_AC},
                           {"benzene", PahProcess::G6R_FE, PahProcess::D6R_FE3},
                           {"naphthalene", PahProcess::G5R_ZZ, PahProcess::D5R_R5}}) {
    bool isRestored = false;
    Molecule molecule = named(pair.start);
    const Cells six = molecule.cells(false);
    RandomStream random(1, 0, 0);
    ASSERT_TRUE(applyFirst(molecule, pair.there));
    EXPECT_NE(molecule.cells(pair.there == PahProcess::G5R_ZZ).size(),
              pair.there == PahProcess::G5R_ZZ ? 0U : six.size());
    const SiteGroup group = rowOf(pair.back).site;
    for (std::size_t i = 0; i < molecule.count(group); ++i) {
      Molecule back = molecule;
      if (!back.apply(pair.back, back.member(group, i), random)) continue;
      isRestored = isRestored || (back.cells(false) == six && back.fiveRings() == 0);
    }
    EXPECT_TRUE(isRestored) << rowOf(pair.there).name;
  }
}

// Naphthalene with a ring of five on one of its zigzags: acenaphthylene. The ring grows on a free edge beside it,
// and phenanthrene, whose armchair has the two last rings, is left; from there it goes back.
TEST(MoleculeEvents, ARingOfFiveBecomesOneOfSixAndBack) {
  Molecule molecule(namedMolecule("naphthalene"), Cells{{0, 1}});
  EXPECT_EQ(molecule.carbon(), 12U);
  EXPECT_EQ(molecule.hydrogen(), 8U);
  EXPECT_EQ(molecule.count(SiteType::R5), 1U);
  EXPECT_EQ(molecule.count(SiteType::RFE), 2U);
  EXPECT_EQ(molecule.count(SiteGroup::FE3), 0U);  // a free edge beside an R5 is none of the three
  ASSERT_TRUE(applyFirst(molecule, PahProcess::C5R_RFE));
  EXPECT_EQ(molecule.carbon(), 14U);
  EXPECT_EQ(molecule.fiveRings(), 0U);
  EXPECT_EQ(molecule.count(SiteType::AC), 1U);
  molecule.requireConsistent();
  ASSERT_TRUE(applyFirst(molecule, PahProcess::C6R_AC_FE3));
  EXPECT_EQ(molecule.carbon(), 12U);
  EXPECT_EQ(molecule.count(SiteType::R5), 1U);
  molecule.requireConsistent();
}

// Phenanthrene's armchair may give its last ring or its first: each in half of the cases.
TEST(MoleculeEvents, TheSideOfAnArmchairIsDrawn) {
  RandomStream random(2, 0, 0);
  const Cells ends[] = {{{0, 0}, latticeDirections[0]}, {{0, 0}, latticeDirections[2]}};
  std::array<int, 2> left{};
  constexpr int tries = 1000;
  for (int i = 0; i < tries; ++i) {
    Molecule molecule = named("phenanthrene");
    ASSERT_TRUE(molecule.apply(PahProcess::C6R_AC_FE3, onlySite(molecule, SiteGroup::AC_FE3), random));
    for (std::size_t k = 0; k < 2; ++k) {
      Cells cells = ends[k];
      std::ranges::sort(cells, {}, [](const LatticeCell& c) { return std::pair(c.r, c.q); });
      left[k] += molecule.cells(false) == cells ? 1 : 0;
    }
  }
  EXPECT_EQ(left[0] + left[1], tries);
  EXPECT_NEAR(left[0], tries / 2, 3.3 * std::sqrt(tries / 4.0));
}

TEST(MoleculeEvents, ARingOfFiveMovesAlongTheEdge) {
  Molecule molecule(Cells{{0, 0}, {1, 0}, {2, 0}}, Cells{{0, 1}});  // anthracene, a zigzag beside the bridged one
  EXPECT_EQ(molecule.count(SiteType::RZZ), 1U);
  const std::size_t carbon = molecule.carbon();
  ASSERT_TRUE(applyFirst(molecule, PahProcess::M5R_RZZ));
  EXPECT_EQ(molecule.cells(true), (Cells{{1, 1}}));
  EXPECT_EQ(molecule.carbon(), carbon);
  molecule.requireConsistent();
}

// A ring of five beside an armchair: a ring of six in the armchair, and the zigzag is free.
TEST(MoleculeEvents, ARingOfFiveFillsTheArmchairBesideIt) {
  const Cells six{{0, 0}, {1, 0}, {2, 0}, {2, 1}};
  Molecule molecule(six, Cells{{0, 1}});
  ASSERT_EQ(molecule.count(SiteType::RAC), 1U);
  const std::size_t carbon = molecule.carbon(), hydrogen = molecule.hydrogen();
  ASSERT_TRUE(applyFirst(molecule, PahProcess::C5R_RAC));
  EXPECT_EQ(molecule.fiveRings(), 0U);
  EXPECT_EQ(molecule.sixRings(), 5U);
  EXPECT_EQ(molecule.carbon(), carbon);
  EXPECT_EQ(molecule.hydrogen(), hydrogen);
  molecule.requireConsistent();
}

// Five rings around an empty cell are an open benzo[ghi]perylene, which loses two H as it closes.
TEST(MoleculeEvents, ABayCloses) {
  Cells open(latticeDirections.begin(), latticeDirections.end() - 1);
  Molecule molecule(open);
  ASSERT_EQ(molecule.count(SiteGroup::BY6), 1U);
  EXPECT_EQ(molecule.hydrogen(), 14U);
  ASSERT_TRUE(applyFirst(molecule, PahProcess::L6_BY6));
  EXPECT_EQ(molecule.carbon(), 22U);
  EXPECT_EQ(molecule.hydrogen(), 12U);
  molecule.requireConsistent();
}

// A ring may not touch others than those of its own run.
TEST(MoleculeEvents, WhatIsInTheWayMakesAnEventVoid) {
  // Seven of the eight rings around two empty cells: in the place of the eighth, two free edges share a cell.
  const Cells cells{{-1, 1}, {0, 1}, {1, 1}, {2, 0}, {2, -1}, {1, -1}, {0, -1}};
  Molecule molecule(cells);
  RandomStream random(4, 0, 0);
  std::size_t hindered = 0, free = 0;
  for (std::size_t i = 0; i < molecule.count(SiteGroup::FE); ++i) {
    Molecule grown = molecule;
    const bool happens = grown.apply(PahProcess::G6R_FE, grown.member(SiteGroup::FE, i), random);
    EXPECT_EQ(happens, grown.sixRings() == molecule.sixRings() + 1);
    EXPECT_NO_THROW(grown.requireConsistent());
    ++(happens ? free : hindered);
  }
  EXPECT_EQ(hindered, 2U);
  EXPECT_GT(free, 0U);
}

}  // namespace
}  // namespace lampblack::particles
