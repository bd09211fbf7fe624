// Particles of molecules: how they join and sinter, what they share, what sticks, and what events do to the gas.
#include <gtest/gtest.h>

#include <algorithm>

#include "particles/molecules/packed_molecules.hpp"
#include "tests/particles/molecules/molecules_fixtures.hpp"

namespace lampblack::test {
namespace {

HeldMolecule held(const char* name) {
  return std::make_shared<const Molecule>(namedMolecule(name));
}

MoleculeParticles primariesOfMolecules() {
  return MoleculeParticles(singlePyrene().material(), {}, false);
}

// Of so many primaries of different molecules, joined in any order.
MoleculeParticle someAggregate(const MoleculeParticles& type, std::size_t primaries, RandomStream& random) {
  const char* names[] = {"naphthalene", "pyrene", "coronene", "benzene"};
  std::vector<MoleculeParticle> all;
  for (std::size_t i = 0; i < primaries; ++i)
    all.push_back(type.made(MoleculesOfPrimary(2 + i % 3, held(names[i % 4]))));
  while (all.size() > 1) {
    std::swap(all[random.below(all.size())], all.back());
    MoleculeParticle one = std::move(all.back());
    all.pop_back();
    MoleculeParticle& other = all[random.below(all.size())];
    other = type.coagulated(std::move(other), std::move(one), random);
  }
  return all.front();
}

TEST(MoleculeParticles, JoinedOnesHoldTheMoleculesOfBoth) {
  const MoleculeParticles type = primariesOfMolecules();
  RandomStream random(1, 0, 0);
  const MoleculeParticle p = someAggregate(type, 12, random);
  EXPECT_EQ(p.tree.count(), 12u);
  expectParticle(type, p);
  EXPECT_EQ(p.mostCarbon, 24u);
  EXPECT_EQ(p.mostRings, 7u);
}

TEST(MoleculeParticles, SpheresHoldAllInOnePrimary) {
  const MoleculeParticles type(singlePyrene().material(), {}, true);
  RandomStream random(1, 0, 0);
  const MoleculeParticle p = someAggregate(type, 12, random);
  EXPECT_EQ(p.tree.count(), 1u);
  expectParticle(type, p);
}

// Molecules go with their primaries, whichever become one, and when.
TEST(MoleculeParticles, PrimariesThatFuseHoldTheMoleculesOfBoth) {
  TreeMaterial material = singlePyrene().material();
  material.sintering = {SinteringMechanism::grainBoundary, 1e31, 0, 0};
  const MoleculeParticles type(material, {}, false);
  std::vector<FusedPrimaries> fusions;
  TreeSintering sintering(type.trees(), 1e-3);
  sintering.tell(&fusions);
  sintering.setTemperature(1500);
  RandomStream random(7, 0, 0);
  std::size_t partly = 0;
  for (int trial = 0; trial < 20; ++trial) {
    MoleculeParticle p = someAggregate(type, 15, random);
    const double carbon = p.carbon();
    for (double time = 1e-6; time < 1; time *= 3) {
      fusions.clear();
      TreeSintering::Changes changes;
      sintering.advance(p.tree, time, changes);
      EXPECT_EQ(fusions.size(), changes.fused);
      type.fuse(p, fusions);
      expectParticle(type, p);
      partly += p.tree.count() > 1 && p.tree.count() < 15 ? 1 : 0;
    }
    EXPECT_DOUBLE_EQ(p.carbon(), carbon);
  }
  EXPECT_GT(partly, 20u);
}

TEST(MoleculeParticles, OfOneMoleculeCollideAsLargeAsIt) {
  const MoleculeParticles type = primariesOfMolecules();
  const MoleculeParticle one = type.made({held("pyrene")}), many = type.made(MoleculesOfPrimary(100, held("pyrene")));
  // 1.395 sqrt(3) sqrt(2 n / 3) Angstrom.
  EXPECT_NEAR(one.collision, 7.8913e-10, 1e-14);
  EXPECT_DOUBLE_EQ(many.collision, treeDiameter(many.tree.head().volume));
  EXPECT_GT(many.collision, 1.5 * one.collision);
}

TEST(MoleculeParticles, ChangesAreSeenByTheChangedOneAlone) {
  const MoleculeParticles type = primariesOfMolecules();
  MoleculeParticle p = type.made(MoleculesOfPrimary(3, held("pyrene")));
  const MoleculeParticle copy = p;
  EXPECT_EQ(copy.inside, p.inside);
  MoleculesOfParticle inside = *p.inside;
  inside[0][1] = held("coronene");
  type.set(p, std::move(inside));
  expectParticle(type, p);
  expectParticle(type, copy);
  EXPECT_EQ(copy.carbon(), 48);
  EXPECT_EQ(p.carbon(), 56);
  EXPECT_EQ((*copy.inside)[0][0], (*p.inside)[0][0]);
}

TEST(MoleculeParticles, StickByTheirRings) {
  using Rule = MoleculeSticking::Rule;
  const MoleculeSticking::Partner pyrene{4, 16}, coronene{7, 24};
  const auto sticks = [&](Rule rule, double rings) {
    return MoleculeSticking{.rule = rule, .rings = rings}.probability(coronene, pyrene);
  };
  EXPECT_EQ(sticks(Rule::always, 100), 1);
  EXPECT_EQ(sticks(Rule::smaller, 4), 1);
  EXPECT_EQ(sticks(Rule::smaller, 5), 0);
  EXPECT_EQ(sticks(Rule::larger, 7), 1);
  EXPECT_EQ(sticks(Rule::larger, 8), 0);
  EXPECT_EQ(sticks(Rule::together, 11), 1);
  EXPECT_EQ(sticks(Rule::together, 12), 0);
  EXPECT_EQ(sticks(Rule::reduced, 28.0 / 11), 1);
  EXPECT_EQ(sticks(Rule::reduced, 2.6), 0);
  const MoleculeSticking bySize{.rule = Rule::bySize, .A = 2, .B = 192, .C = 3};
  EXPECT_NEAR(bySize.probability(coronene, pyrene),
              1 / (1 + std::exp(-2 * (std::pow(1.395 * std::sqrt(32.0), 3) / 192 + 1 - 3))), 1e-12);
}

TEST(MoleculeParticles, OfSeveralMoleculesAlwaysStick) {
  const MoleculeParticles type(singlePyrene().material(), {.rule = MoleculeSticking::Rule::larger, .rings = 7}, false);
  const MoleculeParticle one = type.made({held("pyrene")}), two = type.made(MoleculesOfPrimary(2, held("pyrene"))),
                         large = type.made({held("coronene")});
  EXPECT_EQ(type.sticking(one, one), 0);
  EXPECT_EQ(type.sticking(one, two), 0);
  EXPECT_EQ(type.sticking(two, two), 1);
  EXPECT_EQ(type.sticking(one, large), 1);
}

// Atoms of the gas and of the molecule, process by process.
TEST(GasOfMolecules, KeepsTheAtomsOfEachEvent) {
  struct Atoms {
    double C, H, O;
  };
  const Atoms ofSpecies[] = {{0, 1, 0}, {0, 2, 0}, {0, 1, 1}, {0, 2, 1}, {0, 0, 2}, {2, 2, 0}, {1, 0, 1}, {16, 10, 0}};
  for (std::size_t p = 0; p < pahProcessCount; ++p)
    for (const double byOH : {0.0, 0.3, 1.0}) {
      std::array<double, pahProcessCount> events{};
      events[p] = 2;
      std::array<double, SootSpecies::fixed + 1> gas{};
      addGasOfEvents(events, byOH, gas);
      Atoms sum{2.0 * pahProcesses[p].carbon, 2.0 * pahProcesses[p].hydrogen, 0};
      for (std::size_t k = 0; k < gas.size(); ++k) {
        sum.C += gas[k] * ofSpecies[k].C;
        sum.H += gas[k] * ofSpecies[k].H;
        sum.O += gas[k] * ofSpecies[k].O;
      }
      EXPECT_NEAR(sum.C, 0, 1e-14) << pahProcesses[p].name;
      EXPECT_NEAR(sum.H, 0, 1e-14) << pahProcesses[p].name;
      EXPECT_NEAR(sum.O, 0, 1e-14) << pahProcesses[p].name;
      if (pahProcesses[p].name[0] != 'O') continue;
      // No O2 where OH does it all.
      EXPECT_EQ(gas[SootSpecies::O2] == 0, byOH == 1);
      EXPECT_EQ(gas[SootSpecies::OH] == 0, byOH == 0);
    }
}

TEST(PackedMolecules, ComeBackAsTheyWere) {
  const MoleculeParticles type = primariesOfMolecules();
  RandomStream random(3, 0, 0);
  MoleculeParticle p = someAggregate(type, 6, random);
  MoleculesOfParticle inside = *p.inside;
  Molecule bridged(namedMolecule("pyrene"));
  for (auto site = bridged.firstSite(); bridged.fiveRings() == 0; site = bridged.next(site))
    if (bridged.type(site) == SiteType::ZZ) bridged.apply(PahProcess::G5R_ZZ, site, random);
  inside[2][0] = std::make_shared<const Molecule>(bridged);
  type.set(p, std::move(inside));
  std::vector<double> row, fixed;
  packParticle(p, 5, type, row);
  packFixedPart(p, 5, type, fixed);
  EXPECT_EQ(moleculeRows.lengthOf(row.data()), row.size());
  EXPECT_EQ(row[packedNumberAt], 5);
  const MoleculeParticle back = unpackParticle(row, type, held("pyrene"));
  expectParticle(type, back);
  for (std::size_t i = 0; i < p.inside->size(); ++i)
    for (std::size_t k = 0; k < (*p.inside)[i].size(); ++k)
      for (const bool five : {false, true})
        EXPECT_EQ((*back.inside)[i][k]->cells(five), (*p.inside)[i][k]->cells(five));
  EXPECT_EQ(back.tree.head().surface, p.tree.head().surface);
  EXPECT_EQ(back.collision, p.collision);
  const MoleculeRow of = MoleculeRow::of(fixed.data());
  EXPECT_EQ(of.molecules, p.molecules);
  EXPECT_EQ(MoleculeRow::treeOf(fixed.data()).count, 6u);
  EXPECT_NEAR(of.particle.carbon + of.particle.hydrogen, type.mass(p), 1e-12 * type.mass(p));
}

}  // namespace
}  // namespace lampblack::test
