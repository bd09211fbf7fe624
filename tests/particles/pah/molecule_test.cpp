#include "particles/pah/molecule.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "tests/messages.hpp"
#include "tests/particles/pah/pah_fixtures.hpp"

namespace lampblack::particles {
namespace {

using testing::HasSubstr;

// The smallest of the twelve images of a set of cells, moved to the corner of the lattice.
std::vector<LatticeCell> upToSymmetry(const std::vector<LatticeCell>& cells) {
  std::vector<LatticeCell> best;
  for (const bool mirrored : {false, true}) {
    std::vector<LatticeCell> image = cells;
    if (mirrored)
      for (LatticeCell& c : image) std::swap(c.q, c.r);
    for (int turn = 0; turn < 6; ++turn) {
      for (LatticeCell& c : image) c = {-c.r, c.q + c.r};
      LatticeCell low = image[0];
      for (const LatticeCell& c : image) low = {std::min(low.q, c.q), std::min(low.r, c.r)};
      std::vector<LatticeCell> moved = image;
      for (LatticeCell& c : moved) c = {c.q - low.q, c.r - low.r};
      std::ranges::sort(moved);
      if (best.empty() || moved < best) best = moved;
    }
  }
  return best;
}

// Molecules of so many rings that grow ring by ring at any site are the planar simply connected polyhexes.
std::vector<std::size_t> polyhexesUpTo(int rings) {
  std::set<std::vector<LatticeCell>> level{upToSymmetry(namedMolecule("benzene"))};
  std::vector<std::size_t> numbers{level.size()};
  for (int h = 2; h <= rings; ++h) {
    std::set<std::vector<LatticeCell>> larger;
    for (const std::vector<LatticeCell>& cells : level) {
      const Molecule start(cells);
      Molecule::SiteNumber site = start.firstSite();
      for (std::size_t i = 0; i < start.hydrogen(); ++i, site = start.next(site)) {
        Molecule grown = start;
        if (grown.addRing(site)) larger.insert(upToSymmetry(grown.cells(false)));
      }
    }
    level.swap(larger);
    numbers.push_back(level.size());
  }
  return numbers;
}

TEST(MoleculeLattice, GrowthRingByRingMakesEveryPolyhex) {
  EXPECT_EQ(polyhexesUpTo(8), (std::vector<std::size_t>{1, 1, 3, 7, 22, 81, 331, 1435}));
}

struct KnownMolecule {
  const char* name;
  std::size_t carbon, hydrogen, rings;
  std::array<std::size_t, 5> sites;  // FE, ZZ, AC, BY5, BY6
};

TEST(MoleculeLattice, NamedMoleculesHaveTheirAtomsAndSites) {
  const KnownMolecule known[] = {{"benzene", 6, 6, 1, {6, 0, 0, 0, 0}},
                                 {"naphthalene", 10, 8, 2, {6, 2, 0, 0, 0}},
                                 {"anthracene", 14, 10, 3, {6, 4, 0, 0, 0}},
                                 {"phenanthrene", 14, 10, 3, {7, 2, 1, 0, 0}},
                                 {"pyrene", 16, 10, 4, {6, 4, 0, 0, 0}},
                                 {"triphenylene", 18, 12, 4, {9, 0, 3, 0, 0}},
                                 {"benzo[ghi]perylene", 22, 12, 6, {7, 4, 1, 0, 0}},
                                 {"coronene", 24, 12, 7, {6, 6, 0, 0, 0}},
                                 {"ovalene", 32, 14, 10, {6, 8, 0, 0, 0}},
                                 {"circumcoronene", 54, 18, 19, {6, 12, 0, 0, 0}}};
  EXPECT_EQ(std::size(known), moleculeNames().size());
  for (const KnownMolecule& k : known) {
    const Molecule molecule = test::named(k.name);
    EXPECT_EQ(molecule.carbon(), k.carbon) << k.name;
    EXPECT_EQ(molecule.hydrogen(), k.hydrogen) << k.name;
    EXPECT_EQ(molecule.sixRings(), k.rings) << k.name;
    for (std::size_t t = 0; t < 5; ++t)
      EXPECT_EQ(molecule.count(static_cast<SiteType>(t)), k.sites[t]) << k.name << " " << siteTypeNames[t];
    EXPECT_NO_THROW(molecule.requireConsistent()) << k.name;
  }
  EXPECT_THAT(lampblack::test::messageOf<InputError>([] { (void)namedMolecule("pyren"); }), HasSubstr("pyrene"));
}

TEST(MoleculeLattice, SitesThatDependOnWhatIsNearAreFound) {
  struct Known {
    const char* name;
    std::size_t FE3, FE_HACA, AC_FE3;
  };
  // Naphthalene and anthracene end in two rings with four H; phenanthrene too, to both sides of its armchair; its
  // middle ring has one free edge. Pyrene has two rings with three H, two with two. Benzene's ring must not leave.
  for (const Known& k : {Known{"benzene", 0, 0, 0},
                         {"naphthalene", 2, 0, 0},
                         {"anthracene", 2, 0, 0},
                         {"phenanthrene", 2, 1, 1},
                         {"pyrene", 0, 2, 0},
                         {"triphenylene", 3, 0, 3},
                         {"benzo[ghi]perylene", 0, 3, 0},
                         {"coronene", 0, 6, 0}}) {
    const Molecule molecule = test::named(k.name);
    EXPECT_EQ(molecule.count(SiteGroup::FE3), k.FE3) << k.name;
    EXPECT_EQ(molecule.count(SiteGroup::FE_HACA), k.FE_HACA) << k.name;
    EXPECT_EQ(molecule.count(SiteGroup::AC_FE3), k.AC_FE3) << k.name;
  }
}

// Benz[a]anthracene and its mirror image: the ring with four H is to one side of the armchair alone.
TEST(MoleculeLattice, AnArmchairSeesARingWithFourHToEitherSide) {
  for (const LatticeCell& fourth : {LatticeCell{2, 0}, LatticeCell{-2, 2}}) {
    const Molecule molecule(std::vector<LatticeCell>{{0, 0}, {1, 0}, {-1, 1}, fourth});
    EXPECT_EQ(molecule.count(SiteGroup::FE3), 2U);
    EXPECT_EQ(molecule.count(SiteGroup::AC_FE3), 1U);
  }
}

TEST(MoleculeLattice, CellsThatAreNoMoleculeAreRefused) {
  const auto refused = [](std::vector<LatticeCell> six, std::vector<LatticeCell> five = {}) {
    return lampblack::test::messageOf<InputError>([&] { Molecule(six, five); });
  };
  EXPECT_THAT(refused({}), HasSubstr("one ring at least"));
  EXPECT_THAT(refused({{0, 0}, {1, 0}, {0, 0}}), HasSubstr("(0, 0) is there twice"));
  EXPECT_THAT(refused({{0, 0}, {2, 0}}), HasSubstr("one piece without a hole"));
  EXPECT_THAT(refused({{0, 0}, {300000, 0}}), HasSubstr("cells wide"));
  const std::vector<LatticeCell> ring(latticeDirections.begin(), latticeDirections.end());
  EXPECT_THAT(refused(ring), HasSubstr("one piece without a hole"));
  const std::vector<LatticeCell> naphthalene = namedMolecule("naphthalene");
  EXPECT_EQ(refused(naphthalene, {{0, 1}}), "");
  EXPECT_THAT(refused(naphthalene, {{2, 0}}), HasSubstr("(2, 0) is not on a zigzag"));
  EXPECT_THAT(refused(naphthalene, {{0, 1}, {0, 1}}), HasSubstr("twice"));
  // Anthracene's zigzags of one side are beside each other.
  EXPECT_EQ(refused({{0, 0}, {1, 0}, {2, 0}}, {{0, 1}, {2, -1}}), "");
  EXPECT_THAT(refused({{0, 0}, {1, 0}, {2, 0}}, {{0, 1}, {1, 1}}), HasSubstr("touches another ring"));
}

TEST(MoleculeLattice, TheLatticeGrowsWithTheMolecule) {
  RandomStream random(3, 0, 0);
  Molecule molecule = test::named("benzene");
  // Rings on free edges alone make long arms, over any first lattice.
  while (molecule.sixRings() < 120) {
    const std::size_t i = random.below(molecule.count(SiteGroup::FE));
    (void)molecule.apply(PahProcess::G6R_FE, molecule.member(SiteGroup::FE, i), random);
  }
  molecule.requireConsistent();
  // Cells keep their names.
  EXPECT_THAT(molecule.cells(false), testing::Contains(LatticeCell{0, 0}));
  // An acene of 200 rings: each ring on the far end.
  std::vector<LatticeCell> acene;
  for (int q = 0; q < 200; ++q) acene.push_back({q, -3});
  Molecule line(acene);
  EXPECT_EQ(line.carbon(), 4U * 200 + 2);
  EXPECT_EQ(line.count(SiteType::ZZ), 2U * 199);
  line.requireConsistent();
  EXPECT_LT(test::named("circumcoronene").bytes(), 3000U);
}

}  // namespace
}  // namespace lampblack::particles
