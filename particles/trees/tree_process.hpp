// Inside of makeTreePopulation(). Not for other modules.
#pragma once

#include <optional>
#include <variant>

#include "core/modules.hpp"
#include "particles/population/engine/even_births.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"
#include "particles/trees/tree_population.hpp"
#include "particles/trees/tree_sintering.hpp"
#include "particles/trees/tree_sites.hpp"
#include "particles/trees/tree_soot.hpp"

namespace lampblack::particles {

// Which random numbers of an owner are those of trees.
inline constexpr std::uint32_t treeStream = 0x54524545, treePairStream = 0x54524550;

class TreeProcess final : public TreePopulation {
 public:
  using Method = EqualWeightMethod<PrimaryTrees, ClassStore<EqualRates<PrimaryTrees>>>;

  TreeProcess(const TreeOptions& options, const PopulationModel& model, const MonteCarloOptions& monteCarlo);

  using TreePopulation::fill;
  void fill(std::span<const TreeStart> starts) override;
  void advance(const ParticleGas& gas, double dt) override;
  void dilute(double factor) override {
    method_.dilute(factor);
    births_.dilute(factor);
  }
  [[nodiscard]] TreeExchange takeExchange() override { return std::exchange(exchange_, {}); }
  void applyDeferred() override;

  [[nodiscard]] std::size_t size() const override { return method_.size(); }
  [[nodiscard]] double weight() const override { return method_.weight(); }
  [[nodiscard]] bool wasFull() const override { return method_.memory()[1] != 0; }
  [[nodiscard]] TreeTotals totals() const override;
  [[nodiscard]] TreeRates rates(const ParticleGas& gas, std::size_t pairs) const override;
  void forEachTree(const std::function<void(const Tree&, double)>& f) const override { method_.forEachParticle(f); }
  [[nodiscard]] std::vector<double> primarySizes(double logMin, double logMax, std::size_t bins) const override;
  [[nodiscard]] std::vector<Tree> trees() const override;
  [[nodiscard]] TreeCounters counters() const override;
  [[nodiscard]] std::size_t bytes() const override { return type_.pool().bytes() + method_.bytes(); }
  [[nodiscard]] std::unique_ptr<State> save() const override;
  void restore(const State& state) override;
  [[nodiscard]] std::vector<double> pack() const override;
  void unpack(std::span<const double> state) override;
  void join(std::span<const double> rows, double share) override;
  [[nodiscard]] double cost() const override { return cost_; }

 private:
  struct Saved final : State {
    std::vector<Tree> trees;
    std::array<double, 2> memory{};
    std::uint64_t position = 0;
    EvenBirths::Memory births{};
    double clock = 0;
    TreeExchange exchange;
    TreeCounters counters;
    PopulationCounters method;
  };
  // What the events of the loop do here.
  template <class Reactions>
  struct Events {
    TreeProcess& of;
    Reactions& reactions;
    double weight = 0;  // before the event, 1/m3
    void look() {}
    void setTime(double time) {
      of.type_.clock() = time;
      weight = of.method_.weight();
    }
    void giveBirth();
    template <class Process>
    void take(const Process&, bool happened);
  };
  // Of the material's reactions, TreeSites or TreeSoot.
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
  std::variant<TreeSites, TreeSoot> reactions_;
  std::optional<CollisionKernel> kernel_;
  TreeExchange exchange_;
  TreeCounters counters_;
  double cost_ = 0;
};

}  // namespace lampblack::particles
