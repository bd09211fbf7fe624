// Inside of makeTreePopulation(). Not for other rooms.
#pragma once

#include <optional>

#include "core/rooms.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"
#include "particles/trees/tree_growth.hpp"
#include "particles/trees/tree_population.hpp"
#include "particles/trees/tree_sintering.hpp"

namespace lampblack::particles {

// Which random numbers of an owner are those of trees.
inline constexpr std::uint32_t treeStream = 0x54524545;

class TreeProcess final : public TreePopulation {
 public:
  using Method = EqualWeightMethod<PrimaryTrees, ClassStore<EqualRates<PrimaryTrees>>>;

  TreeProcess(const TreeOptions& options, const PopulationModel& model, const MonteCarloOptions& monteCarlo);

  void fill(const TreeUnits& units, double number) override;
  void advance(const ParticleGas& gas, double dt) override;
  void dilute(double factor) override { method_.dilute(factor); }
  [[nodiscard]] TreeExchange takeExchange() override { return std::exchange(exchange_, {}); }
  void settle() override;

  [[nodiscard]] std::size_t size() const override { return method_.size(); }
  [[nodiscard]] double weight() const override { return method_.weight(); }
  [[nodiscard]] TreeTotals totals() const override;
  [[nodiscard]] std::vector<double> sizeDistribution(Diameter of, double logMin, double logMax,
                                                     std::size_t bins) const override;
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
    double clock = 0;
    TreeExchange exchange;
    TreeCounters counters;
    PopulationCounters method;
  };
  struct Sums {  // per m3
    double number = 0, volume = 0, sites = 0, diameters = 0, sintering = 0, surface = 0;
    double primaries = 0;  // of the numerical particles
  };
  [[nodiscard]] Sums sums() const;
  [[nodiscard]] double step(const Sums& sums, double remaining) const;
  void jump(double dt);
  void change(double dt);
  void record(const TreeSintering::Changes& changes);

  TreeOptions options_;
  PrimaryTrees type_;
  RandomStream random_;
  Method method_;
  TreeSintering sintering_;
  TreeGrowth growth_;
  std::optional<CollisionKernel> kernel_;
  TreeExchange exchange_;
  TreeCounters counters_;
  double cost_ = 0;
  double inception_ = 0, growthRate_ = 0;  // 1/m3/s; 1/s for each site
};

}  // namespace lampblack::particles
