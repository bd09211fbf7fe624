// Site counting beside the lattice: what events do to numbers of sites, the closure, and the law of the growth.
#include "particles/pah/site_counting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/errors.hpp"
#include "tests/effort.hpp"
#include "tests/particles/pah/pah_fixtures.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {
namespace {

using particles::test::manyEvents;
using particles::test::named;
using particles::test::referenceRates;

// What events of the lattice do to numbers of sites, with the neighbours that they had.
TEST(SiteCounts, ChangeAsThoseOfTheLattice) {
  std::array<int, pahProcessCount> seen{};
  for (std::uint64_t run = 0; run < 40; ++run) {
    Molecule molecule = named("pyrene");
    RandomStream random(5, run, 0);
    PahRates rates;
    rates.fill(1);  // so that all happen
    rates[static_cast<std::size_t>(PahProcess::G6R_FE)] = rates[static_cast<std::size_t>(PahProcess::G6R_AC)] = 2;
    for (int event = 0; event < 400; ++event) {
      const auto process = static_cast<PahProcess>(random.below(pahProcessCount));
      const SiteGroup group = rowOf(process).site;
      if (molecule.count(group) == 0 || molecule.rings() > 200) continue;
      const auto site = molecule.member(group, random.below(molecule.count(group)));
      // Of two sides one is drawn.
      if (group == SiteGroup::AC_FE3 && molecule.isMiddle(molecule.next(molecule.next(site))) &&
          molecule.isMiddle(molecule.previous(molecule.previous(site))))
        continue;
      if ((group == SiteGroup::RFE || group == SiteGroup::RAC) && molecule.type(molecule.next(site)) == SiteType::R5 &&
          molecule.type(molecule.previous(site)) == SiteType::R5)
        continue;
      SiteCounts counts(molecule);
      const SitesBeside beside = sitesBeside(molecule, group, site);
      std::array<SiteType, 2> neighbours{};
      const auto changed = static_cast<std::size_t>(neighbourChange(process).count);
      ASSERT_EQ(beside.count >= changed, true);
      for (std::size_t k = 0; k < changed; ++k) neighbours[k] = countedType(molecule.type(beside.site[k]));
      if (!molecule.apply(process, site, random)) continue;
      ASSERT_TRUE(counts.apply(process, std::span(neighbours).first(changed))) << rowOf(process).name;
      counts.requireConsistent();
      const SiteCounts after(molecule);
      EXPECT_EQ(counts.sites(), after.sites()) << rowOf(process).name;
      EXPECT_EQ(counts.rings(), after.rings()) << rowOf(process).name;
      EXPECT_EQ(counts.carbon(), static_cast<int>(molecule.carbon()));
      EXPECT_EQ(counts.hydrogen(), static_cast<int>(molecule.hydrogen()));
      ++seen[static_cast<std::size_t>(process)];
    }
  }
  for (std::size_t p = 0; p < pahProcessCount; ++p) EXPECT_GT(seen[p], 0) << pahProcesses[p].name;
}

TEST(SiteCounts, LackWhatIsNotThere) {
  SiteCounts pyrene(named("pyrene"));
  const SiteCounts::Numbers before = pyrene.sites();
  const auto apply = [&](PahProcess process, std::vector<SiteType> neighbours) {
    return pyrene.apply(process, neighbours);
  };
  EXPECT_FALSE(apply(PahProcess::G6R_AC, {SiteType::FE, SiteType::FE}));     // no armchair
  EXPECT_FALSE(apply(PahProcess::G6R_FE, {SiteType::AC, SiteType::FE}));     // no such neighbour
  EXPECT_FALSE(apply(PahProcess::D6R_FE_AC, {SiteType::FE, SiteType::ZZ}));  // a free edge has no ring to lose
  EXPECT_FALSE(apply(PahProcess::G6R_FE, {SiteType::R5, SiteType::ZZ}));
  EXPECT_EQ(pyrene.sites(), before);
  EXPECT_TRUE(apply(PahProcess::G6R_FE, {SiteType::FE, SiteType::ZZ}));
  EXPECT_THROW(SiteCounts({5, 4, 0, 0, 0, 0}, 4), std::logic_error);
}

// Of lattice molecules along their growth, in one gas.
SiteClosure closureOf(const PahRates& rates, double duration, std::uint64_t runs, int samples) {
  SiteClosure closure;
  for (std::uint64_t run = 0; run < runs; ++run) {
    MoleculeGrowth growth(named("pyrene"), RandomStream(77, run, 1));
    for (int s = 0; s < samples; ++s) {
      closure.add(growth.molecule());
      growth.advance(rates, duration / samples, manyEvents);
    }
    closure.add(growth.molecule());
  }
  return closure;
}

TEST(SiteClosure, KnowsWhatItSaw) {
  SiteClosure closure;
  closure.add(named("pyrene"));
  closure.prepare();
  const SiteCounts pyrene(named("pyrene"));
  const std::size_t at = SiteClosure::classOf(16, 10);
  EXPECT_EQ(closure.seen()[at].molecules, 1u);
  // 6 FE, 4 ZZ; two rings with three free edges and four free edges beside others.
  EXPECT_DOUBLE_EQ(closure.expected(at, SiteGroup::FE, pyrene), 6);
  EXPECT_DOUBLE_EQ(closure.expected(at, SiteGroup::FE3, pyrene),
                   static_cast<double>(named("pyrene").count(SiteGroup::FE3)));
  EXPECT_DOUBLE_EQ(closure.expected(at, SiteGroup::FE_HACA, pyrene),
                   static_cast<double>(named("pyrene").count(SiteGroup::FE_HACA)));
  EXPECT_DOUBLE_EQ(closure.expected(at, SiteGroup::AC, pyrene), 0);
  // Neighbours of free edges are free edges or zigzags, as often as they are there.
  const auto& beside = closure.seen()[at].beside[static_cast<std::size_t>(SiteGroup::FE)];
  EXPECT_EQ(beside[0] + beside[1], 12u);
  RandomStream random(1, 0, 0);
  SiteType neighbour{};
  double free = 0;
  constexpr int draws = 10000;
  for (int i = 0; i < draws; ++i) {
    ASSERT_TRUE(closure.drawNeighbour(at, SiteGroup::FE, pyrene.sites(), random, neighbour));
    free += neighbour == SiteType::FE ? 1 : 0;
  }
  const double p = static_cast<double>(beside[0]) / 12;
  EXPECT_NEAR(free / draws, p, 3.3 * std::sqrt(p * (1 - p) / draws));
  // None but what is left.
  ASSERT_TRUE(closure.drawNeighbour(at, SiteGroup::FE, {0, 1, 0, 0, 0, 0}, random, neighbour));
  EXPECT_EQ(neighbour, SiteType::ZZ);
  EXPECT_FALSE(closure.drawNeighbour(at, SiteGroup::FE, {0, 0, 3, 0, 0, 0}, random, neighbour));
  EXPECT_THROW(SiteClosure().prepare(), InputError);
}

TEST(SiteClosure, IsReadAsItWasWritten) {
  const SiteClosure closure = closureOf(referenceRates(1500), 2e-5, 20, 10);
  const std::string text = closure.write("1500 K");
  const SiteClosure back = SiteClosure::read(text);
  EXPECT_EQ(back.write("1500 K"), text);
  EXPECT_THROW(SiteClosure::read("head\n1,2,3\n"), InputError);
  EXPECT_THROW(SiteClosure::read("head\n1,-2,3\n"), InputError);
  EXPECT_THROW(SiteClosure::read("head\n100000,2,3\n"), InputError);
}

// What has no room is not counted, as nothing happens there.
TEST(SiteClosure, CountsSitesThatHaveRoom) {
  std::array<std::size_t, 2> seen{};
  for (std::uint64_t run = 0; run < 30; ++run) {
    MoleculeGrowth growth(named("pyrene"), RandomStream(9, run, 1));
    growth.advance(referenceRates(1500), 1e-4, manyEvents);
    const Molecule& molecule = growth.molecule();
    for (std::size_t p = 0; p < pahProcessCount; ++p) {
      const SiteGroup group = pahProcesses[p].site;
      for (std::size_t i = 0; i < molecule.count(group); ++i) {
        Molecule changed = molecule;
        RandomStream random(1, 0, 0);
        const bool hasRoom = molecule.hasRoom(group, molecule.member(group, i));
        EXPECT_EQ(changed.apply(static_cast<PahProcess>(p), molecule.member(group, i), random), hasRoom)
            << pahProcesses[p].name;
        ++seen[hasRoom ? 1 : 0];
      }
    }
  }
  EXPECT_GT(seen[0], 20u);
  EXPECT_GT(seen[1], 1000u);
}

struct Growth {
  std::vector<double> carbon, hydrogen, five;
};

template <class Make>
Growth grown(const Make& make, const PahRates& rates, double duration, std::uint64_t runs) {
  Growth all;
  for (std::uint64_t run = 0; run < runs; ++run) make(run, all, rates, duration);
  return all;
}

// Mean C, H and rings of five at the end, of the lattice and of the counts with its closure.
void compareGrowth(double temperature, double duration, std::uint64_t runs, double within) {
  const PahRates rates = referenceRates(temperature);
  SiteClosure closure = closureOf(rates, duration, 400, 100);
  closure.prepare();
  const auto add = [](Growth& all, auto carbon, auto hydrogen, auto five) {
    all.carbon.push_back(static_cast<double>(carbon));
    all.hydrogen.push_back(static_cast<double>(hydrogen));
    all.five.push_back(static_cast<double>(five));
  };
  const Growth lattice = grown(
      [&](std::uint64_t run, Growth& all, const PahRates& k, double t) {
        MoleculeGrowth growth(named("pyrene"), RandomStream(1, run, 2));
        growth.advance(k, t, manyEvents);
        add(all, growth.molecule().carbon(), growth.molecule().hydrogen(), growth.molecule().fiveRings());
      },
      rates, duration, runs);
  const Growth counts = grown(
      [&](std::uint64_t run, Growth& all, const PahRates& k, double t) {
        SiteCounting growth(SiteCounts(named("pyrene")), closure, RandomStream(1, run, 3));
        growth.advance(k, t, manyEvents);
        add(all, growth.counts().carbon(), growth.counts().hydrogen(), growth.counts().count(SiteType::R5));
      },
      rates, duration, runs);
  for (const auto what : {&Growth::carbon, &Growth::hydrogen}) {
    const Sample a = summarise(lattice.*what), b = summarise(counts.*what);
    EXPECT_NEAR(b.mean / a.mean, 1, within + zLimit * std::hypot(a.standardError, b.standardError) / a.mean);
    if (std::getenv("LAMPBLACK_LONG_TESTS") != nullptr)
      std::cout << temperature << " K, " << duration << " s: " << a.mean << " +- " << a.standardError << ", counted "
                << b.mean << " +- " << b.standardError << '\n';
  }
}

TEST(SiteCounting, GrowsAsTheLattice) {
  compareGrowth(1500, 1e-4, fewOrMany(300, 3000), 0.05);
  compareGrowth(2000, 1e-4, fewOrMany(300, 3000), 0.05);
}

// The master equation of all eleven processes and molecules of seven rings or fewer, but for what the closure leaves
// out and its own noise.
TEST(SiteCounting, IsNearTheMasterEquation) {
  const PahRates rates = referenceRates(1500);
  SiteClosure closure = closureOf(rates, 5e-6, 1000, 20);
  closure.prepare();
  std::vector<double> carbon, hydrogen;
  for (std::uint64_t run = 0; run < 10000; ++run) {
    SiteCounting growth(SiteCounts(named("pyrene")), closure, RandomStream(2, run, 5), 7);
    growth.advance(rates, 5e-6, manyEvents);
    if (growth.hasLeft()) continue;
    carbon.push_back(growth.counts().carbon());
    hydrogen.push_back(growth.counts().hydrogen());
  }
  const Sample c = summarise(carbon), h = summarise(hydrogen);
  EXPECT_NEAR(c.mean, 18.329997, 0.05 + zLimit * c.standardError);
  EXPECT_NEAR(h.mean, 10.938212, 0.05 + zLimit * h.standardError);
}

// Of one site of a type there is one: it is not drawn as a neighbour twice.
TEST(SiteCounting, DrawsEachNeighbourOnce) {
  const PahRates rates = particles::test::only(referenceRates(1500), {PahProcess::G6R_FE});
  SiteClosure closure;
  closure.add(named("phenanthrene"));
  closure.prepare();
  for (std::uint64_t run = 0; run < 300; ++run) {
    SiteCounting growth(SiteCounts({7, 1, 1, 0, 0, 0}, 3), closure, RandomStream(4, run, 6));
    growth.advance(rates, 1, 1);
    EXPECT_EQ(growth.events()[static_cast<std::size_t>(PahProcess::G6R_FE)], 1u);
    EXPECT_EQ(growth.voids()[static_cast<std::size_t>(PahProcess::G6R_FE)], 0u);
  }
}

// Coronene whose rings leave and grow: 24 - 2 (6 z + 18 z^2 + 6 z^3)/(1 + 6 z + 9 z^2 + 2 z^3) carbon atoms, z = 1.
TEST(SiteCounting, IsNearTheStationaryCoronene) {
  PahRates rates{};
  particles::test::rateOf(rates, PahProcess::G6R_AC) = particles::test::rateOf(rates, PahProcess::D6R_FE_AC) = 1;
  SiteClosure closure;
  MoleculeGrowth lattice(named("coronene"), RandomStream(6, 0, 1));
  for (int sample = 0; sample < 3000; ++sample) {
    lattice.advance(rates, 1, manyEvents);
    closure.add(lattice.molecule());
  }
  closure.prepare();
  SiteCounting counts(SiteCounts(named("coronene")), closure, RandomStream(6, 1, 1));
  double carbon = 0;
  constexpr int samples = 5000;
  for (int sample = 0; sample < samples; ++sample) {
    counts.advance(rates, 1, manyEvents);
    carbon += static_cast<double>(counts.counts().carbon()) / samples;
  }
  EXPECT_NEAR(carbon, 24 - 60.0 / 18, 0.5);
}

// One process has no closure: rings of five on pyrene's zigzags.
TEST(SiteCounting, OfProcessesWithoutNeighboursIsExact) {
  PahRates rates = particles::test::only(referenceRates(1500), {PahProcess::G5R_ZZ, PahProcess::D5R_R5});
  SiteClosure closure;
  closure.add(named("pyrene"));
  closure.prepare();
  const double a = particles::test::rateOf(rates, PahProcess::G5R_ZZ),
               b = particles::test::rateOf(rates, PahProcess::D5R_R5);
  std::vector<double> five;
  const double t = 2e-5;
  for (std::uint64_t run = 0; run < 4000; ++run) {
    SiteCounting growth(SiteCounts(named("pyrene")), closure, RandomStream(3, run, 4));
    growth.advance(rates, t, manyEvents);
    five.push_back(growth.counts().count(SiteType::R5));
  }
  EXPECT_LT(std::abs(summarise(five).z(4 * a / (a + b) * (1 - std::exp(-(a + b) * t)))), zLimit);
}

}  // namespace
}  // namespace lampblack::test
