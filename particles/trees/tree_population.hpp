// A stochastic population of trees of primaries in a given gas: inception, coagulation, sintering, and what the
// material asks for: reactions of sites (TreeSites), or condensation, growth and oxidation of soot (TreeSoot). Equal
// weights with doubling and contraction (EqualWeightMethod). The gas is not changed, but what is taken from it and
// given to it is reported: the same atoms that the particles gain, to round-off.
//
// Splitting (Strang 1968): collisions and inception by jumps for half a step, growth for all of it, jumps for half a
// step (runEvents, EvenBirths), of a length over which the population changes by `splitTolerance`. Sintering is not
// split off: each tree has the time up to which it has sintered, and is brought up to date where it is looked at,
// before a collision, before it grows, and as soon as it has changed (TreeSintering). docs/theory/primary_trees.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/population/population_solver.hpp"
#include "particles/stochastic/particle_rows.hpp"
#include "particles/trees/tree_shape.hpp"

namespace lampblack::particles {

struct TreeOptions {
  TreeMaterial material;
  std::size_t particles = 8192;  // most numerical ones, at least 8
  std::uint64_t seed = 1, owner = 0;
  // Of coagulation and inception; the gas gives its gas.
  CollisionKernelOptions kernel{.type = CollisionKernelType::transition, .enhancement = 2.2, .slip = SlipLaw::air};
  CollisionSize size = CollisionSize::primaries;
  // By volume and surface: of materials with sites. The diameter of collision is of 6V/S, and so is the law of
  // sintering, dS/dt = -(S - S_sphere)/tau(6V/S) (Koch, Friedlander 1990).
  TreeShape shape = TreeShape::primaries;
  bool coagulation = true;
  double splitTolerance = 0.05;      // relative change of the population in a splitting step
  double sinteringTolerance = 1e-3;  // TreeSintering
  double fullAt = 1e18;              // 1/m3, number density at which the sample is full first
};

// Events and transferred amounts since the previous takeExchange(), per m3 of the gas at the time of each event.
struct TreeExchange {
  SootSpeciesArray gas{};  // mol/m3, of the material's species
  TreeUnits units{};       // of the particles, by all processes, 1/m3
  // Events, 1/m3.
  double inceptions = 0, coagulations = 0;
  // Of materials with sites; of sintering and of reactions within particles, pairs of sites.
  double reactions = 0, condensations = 0, sinteredPairs = 0;
  // Of soot: dimers that condensed, additions of C2H2, attacks by O2 and by OH; primaries and whole particles that
  // burnt away, and particles that broke as one of their primaries did.
  double dimers = 0, grown = 0, oxidisedO2 = 0, oxidisedOH = 0, burntPrimaries = 0, burnt = 0, broken = 0;
  double fragmentations = 0;  // necks that oxidation broke
};

struct TreeCounters {
  std::uint64_t inceptions = 0, coagulations = 0, fictitious = 0, fused = 0, doublings = 0, removals = 0;
  std::uint64_t splitSteps = 0;
  std::uint64_t reactions = 0, condensations = 0;  // at surfaces; within particles, of pairs of sites
  std::uint64_t limited = 0;                       // reactions within particles bounded at zero or without two sites
  std::uint64_t withoutSites = 0;                  // necks that sintered by more sites than a primary had
  std::uint64_t burnt = 0, broken = 0;  // particles that burnt away, and that broke as one of their primaries did
  std::uint64_t fragmentations = 0;     // necks that oxidation broke
};

// Rates of events in a gas, 1/m3/s, counted as in TreeExchange. Of soot: inception, coagulation and fragmentation only.
struct TreeRates {
  double inceptions = 0, coagulations = 0, reactions = 0, condensations = 0, fragmentations = 0;
};

// One kind of event of a material, as results list it. `plural` and `description` name the number of events per m3.
// `singular` names the rate; null where a material has no rate of this event. `count`: number in the sample; may be
// null.
struct TreeEvent {
  double TreeExchange::*number;
  const char *plural, *description;
  const char* singular = nullptr;
  double TreeRates::*rate = nullptr;
  std::uint64_t TreeCounters::*count = nullptr;
};
[[nodiscard]] std::vector<TreeEvent> treeEvents(const TreeMaterial& material);

// Sums per m3, means by number (SI).
struct TreeTotals {
  double number = 0, volume = 0, mass = 0, surface = 0, primaries = 0, sinteringRate = 0;
  TreeUnits units{};
  double sphereDiameter = 0, collisionDiameter = 0, primaryDiameter = 0,
         sinteringLevel = 1;                            // means; level 1: one primary
  double massSquared = 0;                               // kg2/m3
  double collisionDeviation = 1, primaryDeviation = 1;  // geometric, by number
  std::size_t largest = 0;                              // primaries
};

// How trees stand in a packed population (packed_tree.hpp).
inline constexpr ParticleRows treeRows{21 + sizeof(TreeExchange) / sizeof(double) + std::size(populationCounters),
                                       true};

// Spheres that a population begins with: `number` of them (1/m3), each of these units; or with a distribution of
// volumes of their own, which has the number, in the proportions of the units.
struct TreeStart {
  TreeUnits units{};
  double number = 0;
  InitialPopulation sizes = {};
};

class TreePopulation {
 public:
  virtual ~TreePopulation() = default;

  // Replaces the population by such spheres, divided between numerical particles of equal weight. InputError for what
  // is not a particle.
  virtual void fill(std::span<const TreeStart> starts) = 0;
  void fill(const TreeUnits& units, double number) { fill(std::vector<TreeStart>{{units, number}}); }
  // Over dt (s); the gas has the concentrations of the material's species, in their order. NumericsError.
  virtual void advance(const ParticleGas& gas, double dt) = 0;
  virtual void dilute(double factor) = 0;  // all numbers per volume
  [[nodiscard]] virtual TreeExchange takeExchange() = 0;
  // Applies deferred sintering to all trees, up to the present time.
  virtual void applyDeferred() = 0;

  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual double weight() const = 0;  // 1/m3 for a numerical particle
  // Whether the sample was full once (three quarters), so that it is kept so: it is not doubled before.
  [[nodiscard]] virtual bool wasFull() const = 0;
  [[nodiscard]] virtual TreeTotals totals() const = 0;
  // Of the population as it is. Coagulation is that of so many pairs drawn at random, times the number of all: its
  // expectation is exact.
  [[nodiscard]] virtual TreeRates rates(const ParticleGas& gas, std::size_t pairs) const = 0;
  // f(tree, number), 1/m3.
  virtual void forEachTree(const std::function<void(const Tree&, double)>& f) const = 0;
  // dN/dlog10(d) (1/m3) of primaries in equal bins of log10(d/m).
  [[nodiscard]] virtual std::vector<double> primarySizes(double logMin, double logMax, std::size_t bins) const = 0;
  [[nodiscard]] virtual std::vector<Tree> trees() const = 0;
  [[nodiscard]] virtual TreeCounters counters() const = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;  // of what grows with the number of particles and primaries

  // The complete state, for restore() after a rejected step. Trees that do not change are not copied.
  struct State {
    virtual ~State() = default;
  };
  [[nodiscard]] virtual std::unique_ptr<State> save() const = 0;
  virtual void restore(const State& state) = 0;
  // The complete state, as Ensemble::pack(), in rows of treeRows.
  [[nodiscard]] virtual std::vector<double> pack() const = 0;
  virtual void unpack(std::span<const double> state) = 0;
  // Trees of another population that is settled come in (rows without a head), of each `share` times its number: as
  // many copies of this sample's own weight as stand for that in the mean.
  virtual void join(std::span<const double> rows, double share) = 0;
  // Of the last advance(), as Ensemble::cost().
  [[nodiscard]] virtual double cost() const = 0;
};

// Throws InputError.
[[nodiscard]] std::unique_ptr<TreePopulation> makeTreePopulation(const TreeOptions& options);

}  // namespace lampblack::particles
