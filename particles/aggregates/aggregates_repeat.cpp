#include "particles/aggregates/aggregates_repeat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/spheres/ballistic_joining.hpp"
#include "particles/spheres/sphere_geometry.hpp"
#include "particles/spheres/sphere_growth.hpp"
#include "particles/spheres/sphere_measures.hpp"
#include "particles/spheres/sphere_sintering.hpp"
#include "particles/trees/tree_population.hpp"

namespace lampblack::particles {
namespace {

// The run is asked to stop in the middle of a repeat.
struct Cut {};
void requireGoingOn() {
  if (stopRequest() != 0) throw Cut{};
}

// What random numbers are for: RandomStream.
constexpr std::uint32_t buildPurpose = 0x61676772, shadowPurpose = 0x73686164, radiusPurpose = 0x72616469,
                        drawPurpose = 0x64726177;

std::vector<double> drawRadii(const AggregatesCase& made, std::uint64_t repeat, std::size_t count) {
  RandomStream random(made.seed, repeat, radiusPurpose);
  std::vector<double> radii(count, made.radius);
  if (made.deviation > 1)
    for (double& radius : radii) radius *= std::exp(std::log(made.deviation) * normalQuantile(random.uniform()));
  return radii;
}

class Rows {
 public:
  Rows(const AggregatesCase& made, std::uint64_t repeat, std::span<double> rows)
      : made_(made), random_(made.seed, repeat, shadowPurpose), rows_(rows) {}
  // The law of a fractal goes through the aggregates of a row; of those that are being built, of all sizes so far.
  void add(const std::vector<const SphereAggregate*>& all, const AggregatePopulation& population,
           bool isBuilt = false) {
    const std::size_t width = aggregateQuantities().size();
    if (!isBuilt) law_ = {};
    if (!all.empty())
      describeAggregates(all, {made_.fitFrom, made_.directions}, population, law_, random_,
                         rows_.subspan(next_ * width, width));
    ++next_;
  }

 private:
  const AggregatesCase& made_;
  RandomStream random_;
  FractalPoints law_;
  std::span<double> rows_;
  std::size_t next_ = 0;
};

std::vector<const SphereAggregate*> placesOf(const std::vector<SphereAggregate>& all) {
  std::vector<const SphereAggregate*> places;
  for (const SphereAggregate& one : all) places.push_back(&one);
  return places;
}

// Relative change of the temperature over which a gas is as in the middle: of sintering with an activation of 1.2e5 K
// at 1500 K by 17 %, whose mean is 0.1 % off.
constexpr double slowlyHotter = 0.002;

// Between rows, cut where the table of the gas has one, and where it gets hotter or colder. f(time, length) of each
// part.
template <class F>
void throughTime(const AggregatesCase& made, std::size_t row, const F& f) {
  for (double now = made.times[row - 1]; now < made.times[row];) {
    const double next = std::min(made.times[row], made.gas.nextChange(now));
    const double change = std::abs(std::log(made.gas.at(next).temperature / made.gas.at(now).temperature));
    const double parts = std::max(1.0, std::ceil(change / slowlyHotter)), length = (next - now) / parts;
    for (double k = 0; k < parts; ++k) f(now + (k + 0.5) * length, length);
    now = next;
  }
}

// Aggregates that were built grow and sinter, half of the growth before and half behind.
void treat(const AggregatesCase& made, std::vector<SphereAggregate>& all, Rows& rows) {
  SphereSintering sintering(made.population.material.sintering, made.population.sphereTolerance);
  double merged = 0;
  for (std::size_t row = 1; row < made.times.size(); ++row) {
    throughTime(made, row, [&](double middle, double length) {
      const double layer = 0.5 * length * made.gas.growthAt(middle);
      for (SphereAggregate& one : all) {
        requireGoingOn();
        const auto before = static_cast<double>(one.count());
        growEverywhere(one, layer);
        sintering.advance(one, made.gas.at(middle).temperature, length);
        growEverywhere(one, layer);
        merged += before - static_cast<double>(one.count());
      }
    });
    rows.add(placesOf(all), {.merged = merged});
  }
}

void build(const AggregatesCase& made, std::uint64_t repeat, std::vector<SphereAggregate>& all, Rows& rows) {
  RandomStream random(made.seed, repeat, buildPurpose);
  BallisticJoining joining;
  const std::size_t count = made.aggregates;
  const bool byPairs = made.build == AggregatesCase::Build::equalPairs;
  const std::vector<std::size_t> sizes = made.sizes();
  const std::vector<double> radii = drawRadii(made, repeat, byPairs ? count : count * sizes.back());
  for (std::size_t k = 0; k < count; ++k) all.emplace_back(radii[k]);
  rows.add(placesOf(all), {}, true);
  for (std::size_t size = 1; size < sizes.back(); size = byPairs ? 2 * size : size + 1) {
    const std::uint64_t before = joining.tries();
    std::vector<SphereAggregate> next;
    for (std::size_t k = 0; k < count; ++k) {
      requireGoingOn();
      if (byPairs) {
        const std::size_t i = random.below(count), j = random.below(count - 1);
        next.push_back(joining.join(all[i], all[j < i ? j : j + 1], random));
      } else {
        next.push_back(joining.join(all[k], SphereAggregate(radii[size * count + k]), random));
      }
    }
    all = std::move(next);
    const double tries = static_cast<double>(joining.tries() - before) / static_cast<double>(count);
    if (std::ranges::binary_search(sizes, all.front().count())) rows.add(placesOf(all), {.tries = tries}, true);
  }
}

void collide(const AggregatesCase& made, std::uint64_t repeat, Rows& rows, std::vector<SphereAggregate>& last) {
  TreeOptions options = made.population;
  options.seed = made.seed;
  options.owner = repeat;
  TreePopulation population(options);
  population.setCallback(requireGoingOn);
  const double unit = options.material.volume({1});
  if (made.number > 0) {
    std::vector<TreeUnits> spheres;
    for (const double radius : drawRadii(made, repeat, options.particles))
      spheres.push_back({volumeOfRadius(radius) / unit});
    population.fill(spheres, made.number);
  }
  const auto addRow = [&] {
    population.applyDeferred();
    last.clear();
    const TreeTotals totals = population.totals();
    AggregatePopulation numbers{.number = totals.number,
                                .collisionDiameter = totals.collisionDiameter,
                                .merged = static_cast<double>(population.counters().fused)};
    population.forEachTree([&](const Tree& tree, double) { last.emplace_back().copy(tree.spheres()); });
    if (const auto collisions = population.counters().coagulations; collisions > 0)
      numbers.tries = static_cast<double>(population.tries()) / static_cast<double>(collisions);
    rows.add(placesOf(last), numbers);
  };
  addRow();
  for (std::size_t row = 1; row < made.times.size(); ++row) {
    throughTime(made, row, [&](double middle, double length) {
      const double d = made.birthDiameter;
      population.setSources(
          {made.gas.birthsAt(middle), d > 0 ? volumeOfRadius(0.5 * d) : 0, made.gas.growthAt(middle)});
      population.advance({made.gas.at(middle), {}}, length);
    });
    addRow();
  }
}

}  // namespace

void runAggregates(const AggregatesCase& made, std::uint64_t repeat, std::span<double> rows,
                   std::vector<SphereAggregate>* last) {
  std::ranges::fill(rows, nothingToSay);
  Rows to(made, repeat, rows);
  std::vector<SphereAggregate> all;
  try {
    if (made.build == AggregatesCase::Build::collisions) {
      collide(made, repeat, to, all);
    } else {
      build(made, repeat, all, to);
      treat(made, all, to);
    }
  } catch (const Cut&) {
    return;
  }
  if (last == nullptr) return;
  // Some at random: a population has its particles in an order that means something.
  RandomStream random(made.seed, repeat, drawPurpose);
  const std::size_t drawn = std::min(all.size(), made.drawn);
  for (std::size_t k = 0; k < drawn; ++k) std::swap(all[k], all[k + random.below(all.size() - k)]);
  all.resize(drawn);
  *last = std::move(all);
}

}  // namespace lampblack::particles
