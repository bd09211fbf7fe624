// A stochastic population of trees of primaries in a given gas: inception, coagulation, sintering, and what the
// material asks for: reactions of sites (TreeSites), condensation, growth and oxidation of soot (TreeSoot), or births
// and growth that are said from outside (TreeGiven). Equal weights with doubling and contraction (EqualWeightMethod).
// The gas is not changed, but what is taken from it and given to it is reported: the same atoms that the particles
// gain, to round-off.
//
// Splitting (Strang 1968): collisions and inception by jumps for half a step, growth for all of it, jumps for half a
// step (runEvents, EvenBirths), of a length over which the population changes by `splitTolerance`. Sintering is not
// split off: each tree has the time up to which it has sintered, and is brought up to date where it is looked at,
// before a collision, before it grows, and as soon as it has changed (TreeSintering). docs/theory/primary_trees.md.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/engine/even_births.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"
#include "particles/stochastic/size_bins.hpp"
#include "particles/trees/tree_given.hpp"
#include "particles/trees/tree_options.hpp"
#include "particles/trees/tree_sintering.hpp"
#include "particles/trees/tree_sites.hpp"
#include "particles/trees/tree_soot.hpp"

namespace lampblack::particles {

// Which random numbers of an owner are those of trees.
inline constexpr std::uint32_t treeStream = 0x54524545, treePairStream = 0x54524550;

class TreePopulation {
 public:
  using Method = EqualWeightMethod<PrimaryTrees, ClassStore<EqualRates<PrimaryTrees>>>;

  // InputError.
  explicit TreePopulation(const TreeOptions& options);
  TreePopulation(const TreePopulation&) = delete;
  TreePopulation& operator=(const TreePopulation&) = delete;

  // Replaces the population by such spheres, divided between numerical particles of equal weight. InputError for what
  // is not a particle.
  void fill(std::span<const TreeStart> starts);
  // By these particles, `number` (1/m3) in all.
  void fill(std::span<const TreeUnits> particles, double number);
  void fill(const TreeUnits& units, double number) { fill(std::vector<TreeStart>{{units, number}}); }
  // Of a material whose reactions are given, from now on. InputError.
  void setSources(const GivenSources& sources);
  // advance() calls it before each event and each step. An exception of it ends advance() in an incomplete state: the
  // population cannot be used further.
  void setCallback(std::function<void()> callback) { callback_ = std::move(callback); }
  // Over dt (s); the gas has the concentrations of the material's species, in their order. NumericsError.
  void advance(const ParticleGas& gas, double dt);
  void dilute(double factor) {  // all numbers per volume
    method_.dilute(factor);
    births_.dilute(factor);
  }
  [[nodiscard]] TreeExchange takeExchange() { return std::exchange(exchange_, {}); }
  // Applies deferred sintering to all trees, up to the present time.
  void applyDeferred();

  [[nodiscard]] std::size_t size() const { return method_.size(); }
  [[nodiscard]] double weight() const { return method_.weight(); }  // 1/m3 for a numerical particle
  // Whether the sample was full once (three quarters), so that it is kept so: it is not doubled before.
  [[nodiscard]] bool wasFull() const { return method_.memory()[1] != 0; }
  [[nodiscard]] TreeTotals totals() const;
  // Of the population as it is. Coagulation is that of so many pairs drawn at random, times the number of all: its
  // expectation is exact.
  [[nodiscard]] TreeRates rates(const ParticleGas& gas, std::size_t pairs) const;
  // f(tree, number), 1/m3.
  template <class F>
  void forEachTree(F f) const {
    method_.forEachParticle(f);
  }
  // dN/dlog10(d) (1/m3) of primaries.
  [[nodiscard]] std::vector<double> primarySizes(const SizeBins& bins) const;
  [[nodiscard]] std::vector<Tree> trees() const;
  [[nodiscard]] TreeCounters counters() const;
  [[nodiscard]] std::uint64_t tries() const { return type_.spheres()->tries(); }  // TreeSpheres
  // Of what grows with the number of particles and primaries.
  [[nodiscard]] std::size_t bytes() const { return type_.pool().bytes() + method_.bytes(); }

  // The complete state, for restore() after a rejected step. Trees that do not change are not copied.
  struct State {
    std::vector<Tree> trees;
    std::array<double, 2> memory{};
    std::uint64_t position = 0;
    EvenBirths::Memory births{};
    double clock = 0;
    TreeExchange exchange;
    TreeCounters counters;
    PopulationCounters method;
  };
  [[nodiscard]] State save() const;
  void restore(const State& state);
  // The complete state, as Ensemble::pack(), in rows of treeRows.
  [[nodiscard]] std::vector<double> pack() const;
  void unpack(std::span<const double> state);
  // Trees of another population that is settled come in (rows without a head), of each `share` times its number: as
  // many copies of this sample's own weight as stand for that in the mean.
  void join(std::span<const double> rows, double share);
  // Of the last advance(), as Ensemble::cost().
  [[nodiscard]] double cost() const { return cost_; }

 private:
  // What the events of the loop do here.
  template <class Reactions>
  struct Events {
    TreePopulation& of;
    Reactions& reactions;
    double weight = 0;  // before the event, 1/m3
    void look() {
      if (of.callback_) of.callback_();
    }
    void setTime(double time) {
      of.type_.clock() = time;
      weight = of.method_.weight();
    }
    void giveBirth();
    template <class Process>
    void take(const Process&, bool happened);
  };
  // Of the material's reactions, TreeSites, TreeSoot or TreeGiven.
  template <class Reactions>
  void march(Reactions& reactions, double dt);
  template <class Reactions>
  [[nodiscard]] typename Reactions::Sums sums(const Reactions& reactions) const;
  template <class Reactions>
  void jump(Reactions& reactions, const typename Reactions::Sums& sums, double dt);
  template <class Reactions>
  void change(Reactions& reactions, const typename Reactions::Sums& sums, double dt);
  void record(const TreeSintering::Changes& changes);

  TreeOptions options_;
  PrimaryTrees type_;
  RandomStream random_;
  Method method_;
  EvenBirths births_;
  TreeSintering sintering_;
  std::variant<TreeSites, TreeSoot, TreeGiven> reactions_;
  std::function<void()> callback_;
  std::optional<CollisionKernel> kernel_;
  TreeExchange exchange_;
  TreeCounters counters_;
  double cost_ = 0;
};

}  // namespace lampblack::particles
