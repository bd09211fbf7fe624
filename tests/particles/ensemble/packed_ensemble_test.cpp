// The complete state of a stochastic population as it travels and is saved: who unpacks it goes on to the same bits.
#include "particles/ensemble/packed_ensemble.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/monte_carlo/weighted_deviation.hpp"
#include "particles/stochastic/particle_rows.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

const test::FlameGas& flame() {
  static const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {2e-5, 3e-6, 2e-6});
  return gas;
}

struct Choice {
  EnsembleMethod method;
  SootShape shape;
  bool coagulation, events = false;
};

class PackedSoot : public testing::TestWithParam<Choice> {
 protected:
  [[nodiscard]] EnsembleOptions options(std::uint64_t owner) const {
    EnsembleOptions o;
    o.method = GetParam().method;
    o.shape = GetParam().shape;
    o.particles = 300;
    o.seed = 42;
    o.owner = owner;
    o.soot = test::threePah();
    o.soot.coagulation = GetParam().coagulation;
    o.growthByEvents = GetParam().events;
    o.splitTolerance = 0.05;
    return o;
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, PackedSoot,
                         testing::Values(Choice{EnsembleMethod::dsmc, SootShape::spheres, true},
                                         Choice{EnsembleMethod::dsmc, SootShape::aggregates, true},
                                         Choice{EnsembleMethod::dsmc, SootShape::spheres, false},
                                         Choice{EnsembleMethod::sammc, SootShape::spheres, true},
                                         Choice{EnsembleMethod::sammc, SootShape::aggregates, true},
                                         Choice{EnsembleMethod::sammc, SootShape::spheres, false},
                                         Choice{EnsembleMethod::swa, SootShape::spheres, true},
                                         Choice{EnsembleMethod::swa, SootShape::aggregates, true},
                                         Choice{EnsembleMethod::dsmc, SootShape::spheres, true, true},
                                         Choice{EnsembleMethod::dsmc, SootShape::aggregates, true, true},
                                         Choice{EnsembleMethod::dsmc, SootShape::spheres, false, true},
                                         Choice{EnsembleMethod::sammc, SootShape::spheres, true, true},
                                         Choice{EnsembleMethod::pairs, SootShape::spheres, true},
                                         Choice{EnsembleMethod::pairs, SootShape::surfaceVolume, false, true},
                                         Choice{EnsembleMethod::dsmc, SootShape::surfaceVolume, true, true},
                                         Choice{EnsembleMethod::sammc, SootShape::surfaceVolume, true}));

TEST_P(PackedSoot, GoesOnToTheSameBits) {
  const auto one = makeEnsemble(options(7));
  for (int k = 0; k < 3; ++k) one->advance(flame().state, 0, 3e-4);  // fills up and is full
  const std::vector<double> state = one->pack();
  const auto other = makeEnsemble(options(7));
  other->unpack(state);
  EXPECT_EQ(other->pack(), state);
  for (int k = 0; k < 3; ++k) {
    one->advance(flame().state, 2, 3e-4);
    other->advance(flame().state, 2, 3e-4);
    // One of them travels once more.
    if (k == 1) {
      const std::vector<double> again = other->pack();
      other->unpack(again);
    }
  }
  if (GetParam().coagulation) {
    EXPECT_GT(one->counters().coagulations, 100U);
  }
  EXPECT_EQ(one->pack(), other->pack());
  EXPECT_EQ(one->takeExchange().carbon, other->takeExchange().carbon);
}

// What particles that burn away leave room for depends on whether the sample was full once.
TEST_P(PackedSoot, GoesOnToTheSameBitsWhileItBurnsAway) {
  const test::FlameGas burning(1800, 0, 0, 5e-3, 0.1, 0, 0, {0, 0, 0});
  for (std::uint64_t owner = 0; owner < 4; ++owner) {
    const auto one = makeEnsemble(options(owner)), other = makeEnsemble(options(owner));
    one->advance(flame().state, 0, 1e-3);
    other->unpack(one->pack());
    for (const auto* soot : {&one, &other}) (*soot)->advance(burning.state, 0, 1e-4);
    EXPECT_GT(one->counters().vanished, 2U);
    EXPECT_GT(one->size(), 20U);
    EXPECT_EQ(one->pack(), other->pack());
  }
}

TEST_P(PackedSoot, DependsOnOwnerAndSeedOnlyNotOnTheOrderOfProcessing) {
  std::vector<std::vector<double>> alone;
  for (std::uint64_t owner = 0; owner < 3; ++owner) {
    const auto soot = makeEnsemble(options(owner));
    for (int k = 0; k < 3; ++k) soot->advance(flame().state, 5, 2e-4);
    alone.push_back(soot->pack());
  }
  std::vector<std::unique_ptr<Ensemble>> mixed;
  for (const std::uint64_t owner : {2U, 0U, 1U}) mixed.push_back(makeEnsemble(options(owner)));
  for (int k = 0; k < 3; ++k) {
    for (const auto& soot : mixed) soot->advance(flame().state, 5, 2e-4);
  }
  EXPECT_EQ(mixed[0]->pack(), alone[2]);
  EXPECT_EQ(mixed[1]->pack(), alone[0]);
  EXPECT_EQ(mixed[2]->pack(), alone[1]);
  EXPECT_NE(alone[0], alone[1]);
}

TEST_P(PackedSoot, RefusesTheStateOfAnother) {
  const auto soot = makeEnsemble(options(7));
  soot->advance(flame().state, 0, 3e-4);
  std::vector<double> state = soot->pack();
  EnsembleOptions smaller = options(7);
  smaller.particles = 100;
  EXPECT_THROW(makeEnsemble(smaller)->unpack(state), InputError);
  EXPECT_THROW(makeEnsemble(options(7))->unpack({}), InputError);
  std::vector<double> cut(state.begin(), state.end() - 1), longer = state;
  longer.push_back(1);
  EXPECT_THROW(makeEnsemble(options(7))->unpack(cut), InputError);
  EXPECT_THROW(makeEnsemble(options(7))->unpack(longer), InputError);
  // A particle of nothing, and one that stands for another number than its head says.
  std::vector<double> empty = state, other = state;
  empty[packedHead] = 0;
  EXPECT_THROW(makeEnsemble(options(7))->unpack(empty), InputError);
  other[packedHead + packedParticle - 1] *= 2;
  if (GetParam().method == EnsembleMethod::dsmc) {
    EXPECT_THROW(makeEnsemble(options(7))->unpack(other), InputError);
  }
}

// What a step of oxidation took too much of the hydrogen comes along.
TEST_P(PackedSoot, TakesATraceOfHydrogenBelowZero) {
  const auto soot = makeEnsemble(options(7));
  soot->advance(flame().state, 0, 3e-4);
  std::vector<double> state = soot->pack();
  state[packedHead + 1] = -1e-6 * state[packedHead];
  const auto other = makeEnsemble(options(7));
  other->unpack(state);
  EXPECT_EQ(other->pack(), state);
  other->advance(flame().state, 0, 3e-4);
  state[packedHead + 1] = -state[packedHead];
  EXPECT_THROW(other->unpack(state), InputError);
}

TEST_P(PackedSoot, HasItsParticlesBehindTheHead) {
  const auto soot = makeEnsemble(options(7));
  EXPECT_EQ(soot->pack().size(), packedHead);
  soot->advance(flame().state, 0, 3e-4);
  std::vector<GivenParticle> packed = packedParticles(soot->pack());
  ASSERT_EQ(packed.size(), soot->size());
  double carbon = 0;
  for (const GivenParticle& p : packed) carbon += p.number * p.carbon;
  EXPECT_NEAR(carbon, soot->totals().carbon, 1e-12 * carbon);
}

TEST(WeightedDeviation, IsOneForParticlesThatAreAllTheSame) {
  for (int k = 1; k < 500; ++k) {
    WeightedDeviation one;
    one.add(std::log(1e-9 + 1e-12 * k), 1e9 / k);
    EXPECT_NEAR(one.geometric(), 1.0, 1e-6);
  }
}

TEST(WeightedDeviation, OfManyAtATimeIsThatOfOneByOne) {
  RandomStream random(3, 0, 1);
  std::vector<double> x, weights;
  for (int k = 0; k < 301; ++k) {
    x.push_back(-20 + 0.1 * random.uniform());
    weights.push_back(1e15 * random.uniform());
  }
  WeightedDeviation each, some;
  for (std::size_t k = 0; k < x.size(); ++k) each.add(x[k], weights[k]);
  some.add(x.data(), weights.data(), 0);
  for (const auto& [first, n] : {std::pair{0, 128}, {128, 1}, {129, 172}}) some.add(&x[first], &weights[first], n);
  EXPECT_NEAR(std::log(some.geometric()), std::log(each.geometric()), 1e-12 * std::log(each.geometric()));
  EXPECT_GT(each.geometric(), 1.02);
}

// Particles put behind those of a packed population of different weights are its own, in any order; too many merge.
TEST(PackedEnsemble, TakesParticlesThatWerePutIn) {
  EnsembleOptions o;
  o.method = EnsembleMethod::sammc;
  o.particles = 100;
  o.soot = test::threePah();
  const auto soot = makeEnsemble(o);
  std::vector<double> state = soot->pack();
  for (int k = 0; k < 250; ++k) packDoubles(state, GivenParticle{1e-23 * (1 + (k * 37) % 250), 1e-25, 1, 1e9});
  soot->unpack(state);
  EXPECT_EQ(soot->size(), 100U);
  EXPECT_EQ(soot->counters().merges, 150U);
  EXPECT_NEAR(soot->totals().number, 250e9, 1);
  EXPECT_NEAR(soot->totals().carbon, 1e-23 * 1e9 * 250 * 251 / 2, 1e-26);
}

// A population is its head and a row a particle: a head alone has none.
TEST(ParticleRows, OfAHeadAloneThereAreNone) {
  const ParticleRows rows{3, false};
  const std::vector<double> head(3, 1.0), one(3 + packedParticle, 1.0);
  EXPECT_TRUE(rows.isEmpty({}));
  EXPECT_TRUE(rows.isEmpty(head));
  EXPECT_FALSE(rows.isEmpty(one));
  EXPECT_TRUE(rows.of(head).empty());
  EXPECT_EQ(rows.count(rows.of(one)), 1u);
}

}  // namespace
}  // namespace lampblack::particles
