// A type of particles of one's own - here an aggregate with a tree of its primary particles and contacts, on the heap -
// goes through the methods by the public headers alone.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "../../statistics.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/monte_carlo/equal_weight_solver.hpp"
#include "particles/population/monte_carlo/hybrid_solver.hpp"
#include "particles/population/monte_carlo/weighted_solver.hpp"

namespace lampblack::particles {
namespace {

using test::Sample;
using test::summarise;
using test::zLimit;

class TreeAggregate {
 public:
  struct Primary {
    double volume = 0;          // m3
    std::uint32_t contact = 0;  // an earlier primary; itself for the root
  };
  struct Particle {
    std::vector<Primary> primaries;
    // How many real primary particles this one stands for, as its tree is one of several where particles were averaged.
    double count = 0;
  };

  // What the tests want to know of particles nobody hands out.
  struct Seen {
    std::uint64_t made = 0, joined = 0, averaged = 0, broken = 0, largest = 0;
  };
  explicit TreeAggregate(Seen& seen) : seen_(&seen) {}

  [[nodiscard]] double volume(const Particle& p) const {
    double sum = 0;
    for (const Primary& primary : p.primaries) sum += primary.volume;
    return sum;
  }
  [[nodiscard]] double mass(const Particle& p) const { return 1800 * volume(p); }
  [[nodiscard]] double surface(const Particle& p) const {
    double sum = 0;
    for (const Primary& primary : p.primaries) sum += std::cbrt(36 * constants::pi) * std::pow(primary.volume, 2.0 / 3);
    return sum;
  }
  // Of a fractal aggregate of dimension 1.8.
  [[nodiscard]] double collisionDiameter(const Particle& p) const {
    const double n = static_cast<double>(p.primaries.size());
    return std::cbrt(6 / constants::pi * volume(p) / n) * std::pow(n, 1 / 1.8);
  }

  [[nodiscard]] Particle make(double volume) const {
    ++seen_->made;
    return {{{volume, 0}}, 1};
  }
  // The root of one touches the last primary of the other.
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q) const {
    ++seen_->joined;
    Particle joined = p;
    const auto offset = static_cast<std::uint32_t>(p.primaries.size());
    for (const Primary& primary : q.primaries) {
      const bool root = joined.primaries.size() == offset;
      joined.primaries.push_back({primary.volume, root ? offset - 1 : primary.contact + offset});
    }
    joined.count += q.count;
    if (!isTree(joined)) throw std::logic_error("not a tree");
    seen_->largest = std::max<std::uint64_t>(seen_->largest, joined.primaries.size());
    return joined;
  }
  // The tree of the heavier one, swollen or shrunk to the mean volume.
  [[nodiscard]] Particle mean(const Particle& p, double wp, const Particle& q, double wq) const {
    ++seen_->averaged;
    Particle mean = wp >= wq ? p : q;
    const double target = (wp * volume(p) + wq * volume(q)) / (wp + wq), factor = target / volume(mean);
    for (Primary& primary : mean.primaries) primary.volume *= factor;
    mean.count = (wp * p.count + wq * q.count) / (wp + wq);
    return mean;
  }
  [[nodiscard]] Particle fragment(const Particle& p, double fraction) const {
    ++seen_->broken;
    Particle piece = p;
    for (Primary& primary : piece.primaries) primary.volume *= fraction;
    piece.count *= fraction;
    return piece;
  }
  [[nodiscard]] Particle grown(const Particle& p, double condensation, double, double dt) const {
    Particle grown = p;
    for (Primary& primary : grown.primaries) primary.volume *= std::exp(condensation * dt);
    return grown;
  }

  [[nodiscard]] static bool isTree(const Particle& p) {
    for (std::size_t k = 0; k < p.primaries.size(); ++k) {
      if (p.primaries[k].contact > k || (p.primaries[k].contact == k) != (k == 0)) return false;
    }
    return !p.primaries.empty();
  }

 private:
  Seen* seen_;
};
static_assert(ParticleType<TreeAggregate>);
static_assert(!std::is_trivially_copyable_v<TreeAggregate::Particle>);

constexpr InitialPopulation monodisperse{InitialPopulation::Distribution::monodisperse, 1.0, 1.0, 1};

PopulationModel constantKernel() {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->rate = 1;
  return model;
}

MonteCarloOptions optionsOf(MonteCarloMethod method, int repeat) {
  MonteCarloOptions options;
  options.method = method;
  options.particles = 300;
  options.threshold = 2;
  options.repeat = static_cast<std::uint64_t>(repeat);
  return options;
}

// Primaries in an aggregate are the sizes of the constant kernel, N_k = (t/2)^(k-1) / (1+t/2)^(k+1).
TEST(OwnParticleType, AggregatesHaveTheExactNumbersOfPrimaries) {
  const PopulationModel model = constantKernel();
  const double end = 3;
  const std::vector<double> edges = {0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5};
  for (const EventRates rates : {EventRates::majorant, EventRates::exact}) {
    std::vector<std::vector<double>> sizes(edges.size() - 1);
    TreeAggregate::Seen seen;
    for (int repeat = 0; repeat < 60; ++repeat) {
      MonteCarloOptions options = optionsOf(MonteCarloMethod::dsmc, repeat);
      options.rates = rates;
      const auto solver = makeEqualWeight(TreeAggregate(seen), model, monodisperse, options);
      solver->advance(end);
      EXPECT_NEAR(solver->moments()[1], 1, 1e-12);  // each primary has the volume 1: none is lost
      const auto bins = solver->numberInBins(edges);
      EXPECT_GT(solver->counters().doublings, 0u);
      for (std::size_t k = 0; k < bins.size(); ++k) sizes[k].push_back(bins[k]);
    }
    EXPECT_GT(seen.largest, 10u);
    EXPECT_GT(seen.joined, 60u * 150u);
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      const double size = static_cast<double>(k);
      const double exact = std::pow(end / 2, size) / std::pow(1 + end / 2, size + 2);
      EXPECT_LT(std::abs(summarise(sizes[k]).z(exact)), zLimit) << "of " << k + 1 << " primaries";
    }
  }
}

// The particles themselves, from the store: every one is a tree of as many primaries as its volume says.
TEST(OwnParticleType, TreesStayWhole) {
  using Method = EqualWeightMethod<TreeAggregate, ClassStore<EqualRates<TreeAggregate>>>;
  TreeAggregate::Seen seen;
  RandomStream random(1, 2, 3);
  const TreeAggregate type(seen);
  Method method(type, constantKernel(), monodisperse, optionsOf(MonteCarloMethod::dsmc, 0), random);
  for (int event = 0; event < 1000; ++event) method.coagulate(random);
  double primaries = 0;
  method.store().forEach([&](const auto& entry) {
    EXPECT_TRUE(TreeAggregate::isTree(entry.particle));
    EXPECT_EQ(static_cast<double>(entry.particle.primaries.size()), entry.particle.count);
    EXPECT_EQ(entry.particle.count, type.volume(entry.particle));
    primaries += method.weight() * entry.particle.count;
  });
  EXPECT_NEAR(primaries, 1, 1e-12);
}

// In SAMMC neighbours in volume become their mean, of which the number of primaries is conserved as volume is.
TEST(OwnParticleType, MergingConservesPrimariesAndVolume) {
  using Rates = WeightedRates<TreeAggregate>;
  using Method = WeightedMethod<TreeAggregate, SortedStore<Rates>>;
  PopulationModel model = constantKernel();
  model.breakage = BreakageOptions{0.3, 0, 2, BreakageOptions::Daughters::uniform};
  TreeAggregate::Seen seen;
  RandomStream random(1, 2, 3);
  const TreeAggregate type(seen);
  Method method(type, model, monodisperse, optionsOf(MonteCarloMethod::sammc, 0), random);
  for (int event = 0; event < 3000; ++event) {
    if (event % 3 == 0)
      method.breakUp(random);
    else
      method.coagulate(random);
  }
  EXPECT_GT(seen.averaged, 500u);
  double primaries = 0, volume = 0, number = 0;
  method.store().forEach([&](const auto& entry) {
    EXPECT_TRUE(TreeAggregate::isTree(entry.particle));
    primaries += entry.weight * entry.particle.count;
    volume += entry.weight * type.volume(entry.particle);
    number += entry.weight;
  });
  EXPECT_NEAR(primaries, 1, 1e-11);
  EXPECT_NEAR(volume, 1, 1e-11);
  EXPECT_NEAR(number, method.moments()[0], 1e-12);
}

// As above for the sizes; M_0 = 2/(2+t) and, from the trees, M_2 = 1 + t.
TEST(OwnParticleType, HasTheExactMomentsInWeightedMethods) {
  const double end = 3;
  for (const MonteCarloMethod method : {MonteCarloMethod::sammc, MonteCarloMethod::samwfmc, MonteCarloMethod::swa}) {
    std::vector<double> numbers, squares;
    TreeAggregate::Seen seen;
    for (int repeat = 0; repeat < 40; ++repeat) {
      const auto solver = makeWeighted(TreeAggregate(seen), constantKernel(), monodisperse, optionsOf(method, repeat));
      solver->advance(end);
      EXPECT_NEAR(solver->moments()[1], 1, 1e-11);
      numbers.push_back(solver->moments()[0]);
      squares.push_back(solver->moments()[2]);
    }
    EXPECT_LT(std::abs(summarise(numbers).z(2 / (2 + end))), zLimit) << static_cast<int>(method);
    EXPECT_LT(std::abs(summarise(squares).z(1 + end)), zLimit) << static_cast<int>(method);
    EXPECT_GT(seen.largest, 10u);
  }
}

TEST(OwnParticleType, GoesThroughEveryMethodAndProcess) {
  PopulationModel model = constantKernel();
  model.breakage = BreakageOptions{0.3, 0, 2, BreakageOptions::Daughters::uniform};
  const double end = 2;
  // dM0/dt = 0.3 M0 - M0^2/2.
  const double exact = 0.6 / (1 + (0.6 - 1) * std::exp(-0.3 * end));
  for (const MonteCarloMethod method : {MonteCarloMethod::dsmc, MonteCarloMethod::constantVolume,
                                        MonteCarloMethod::constantNumberByNumber, MonteCarloMethod::hybrid}) {
    std::vector<double> numbers;
    TreeAggregate::Seen seen;
    for (int repeat = 0; repeat < 40; ++repeat) {
      const TreeAggregate type(seen);
      const MonteCarloOptions options = optionsOf(method, repeat);
      const bool hybrid = method == MonteCarloMethod::hybrid;
      const bool weighted = method == MonteCarloMethod::swa || method == MonteCarloMethod::sammc;
      const auto solver = hybrid     ? makeHybrid(type, model, monodisperse, options)
                          : weighted ? makeWeighted(type, model, monodisperse, options)
                                     : makeEqualWeight(type, model, monodisperse, options);
      solver->advance(end);
      numbers.push_back(solver->moments()[0]);
    }
    EXPECT_LT(std::abs(summarise(numbers).z(exact)), zLimit) << static_cast<int>(method);
    EXPECT_GT(seen.broken, 0u);
  }
}

TEST(OwnParticleType, GrowthOfItsTreesCanBeDeferred) {
  PopulationModel model = constantKernel();
  model.growth.condensation = 0.5;
  model.growth.treatment = GrowthOptions::Treatment::deferred;
  TreeAggregate::Seen seen;
  const auto solver = makeEqualWeight(TreeAggregate(seen), model, monodisperse, optionsOf(MonteCarloMethod::dsmc, 0));
  solver->advance(2);
  EXPECT_NEAR(solver->moments()[1], std::exp(1.0), 1e-11);
}

}  // namespace
}  // namespace lampblack::particles
