// A stochastic population of trees of primaries as the particles of a split reactor.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "coupling/reactor_population.hpp"
#include "coupling/tree_functionals.hpp"
#include "particles/trees/tree_population.hpp"

namespace lampblack::coupling {

class ReactorTrees final : public ReactorPopulation {
 public:
  // InputError where the mechanism lacks a species or an element, where a process of a material with sites does
  // not keep the atoms of these species, and as makeTreePopulation().
  ReactorTrees(const Mechanism& mechanism, const TreeOptions& options, GasViscosity viscosity,
               std::span<const TreeStart> start);

  [[nodiscard]] TreePopulation& population() const { return *population_; }
  // Whether particles can be born of this gas.
  [[nodiscard]] bool canBeBorn(const ParticleGas& gas) const { return material_.hasPrecursors(gas); }

  [[nodiscard]] const std::vector<std::string>& elements() const override { return elements_; }
  [[nodiscard]] GasViscosity viscosity() const override { return viscosity_; }
  [[nodiscard]] const std::vector<std::size_t>& species() const override { return species_; }
  Exchange advance(const ParticleGas& gas, double dt) override;
  // advance(), then the deferred sintering of all trees.
  Exchange advanceAndApplyDeferred(const ParticleGas& gas, double dt);
  // Of the precursor of a material with sites.
  [[nodiscard]] std::optional<double> rateOf(std::size_t i, const ParticleGas& gas) const override;
  void dilute(double factor) override;
  [[nodiscard]] std::vector<double> content() const override;
  void join(std::span<const double> content, double share) override;
  [[nodiscard]] bool idle(const ParticleGas& gas) const override;
  [[nodiscard]] std::uint64_t removals() const override { return population_->counters().removals; }
  [[nodiscard]] std::unique_ptr<State> save() const override;
  void restore(const State& state) override;

  [[nodiscard]] std::string material() const override { return material_.name; }
  [[nodiscard]] std::vector<Column> columns() const override;
  void applyDeferred() override;
  [[nodiscard]] std::vector<double> values(const ParticleGas& gas) const override;
  [[nodiscard]] std::vector<Distribution> distributions() const override;
  [[nodiscard]] std::vector<double> distribution(std::size_t k, double logMin, double logMax,
                                                 std::size_t bins) const override;
  // Of the sintering level and the ratio of elements.
  [[nodiscard]] std::vector<Distribution> shares() const override;
  [[nodiscard]] std::vector<double> shareDistribution(std::size_t k, std::size_t bins) const override;
  // By diameter of collision and by number of primaries; averages of all functionals.
  [[nodiscard]] std::vector<Column> classedBy() const override;
  [[nodiscard]] std::vector<Column> classAverages() const override;
  [[nodiscard]] std::vector<double> classSums(std::size_t by, std::span<const double> edges) const override;
  // Particles, their primaries, and the necks between these.
  [[nodiscard]] std::vector<Table> tables() const override;
  [[nodiscard]] std::vector<std::pair<std::string, double>> counts() const override;

 private:
  Exchange takeExchange();
  struct Saved final : State {
    std::unique_ptr<TreePopulation::State> population;
    TreeExchange total;
  };
  void requireAtoms(const Mechanism& mechanism, const SiteReactions& reactions) const;

  TreeMaterial material_;
  TreeFunctionals functionals_;
  std::vector<TreeEvent> events_;
  GasViscosity viscosity_;
  std::unique_ptr<TreePopulation> population_;
  std::vector<std::size_t> species_;
  std::vector<std::string> elements_;
  std::vector<std::vector<double>> perMole_;  // kg of each element in a mole of each species
  TreeExchange total_;                        // from the beginning
};

}  // namespace lampblack::coupling
