// Trees of primaries of any material as a kind of stochastic population. Trees have equal weights, in another
// population others: where they join, as many copies are taken as stand for them in the mean. What comes and goes so is
// counted (resampled()).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "particles/stochastic/stochastic_population.hpp"
#include "particles/trees/tree_functionals.hpp"
#include "particles/trees/tree_options.hpp"

namespace lampblack::particles {

class TreePopulation;

class TreeEnsemble final : public StochasticPopulation {
 public:
  // InputError where the mechanism lacks a species or an element, where a process of a material with sites does
  // not keep the atoms of these species, and as TreePopulation(). `start`: what is there from the beginning.
  TreeEnsemble(const Mechanism& mechanism, const TreeOptions& options, std::span<const TreeStart> start = {});
  ~TreeEnsemble() override;

  [[nodiscard]] TreePopulation& trees() const { return *trees_; }

  // Of soot; silica is taken to be transparent.
  [[nodiscard]] double absorption(double temperature, double volumeFraction) const override;
  [[nodiscard]] bool hasPrecursors(const ParticleGas& gas) const override {
    return options_.material.hasPrecursors(gas);
  }
  void advance(const ParticleGas& gas, double dt) override;
  void applyDeferred() override;
  [[nodiscard]] std::size_t watchedSpecies() const override {
    return options_.material.soot() != nullptr ? std::size_t{SootSpecies::C2H2} : 0;
  }
  Exchange takeExchange() override;
  [[nodiscard]] std::vector<ParticleProcess> processes() const override { return namesOf(events_); }
  [[nodiscard]] std::vector<double> amountsOfProcesses() const override { return amountsOf(events_, taken_); }
  [[nodiscard]] std::vector<double> resampled() const override;
  // Of the precursor of a material with sites.
  [[nodiscard]] std::optional<double> rateOf(std::size_t i, const ParticleGas& gas) const override;
  void dilute(double factor) override;
  [[nodiscard]] std::size_t size() const override;
  [[nodiscard]] std::uint64_t removals() const override;
  [[nodiscard]] double cost() const override;
  [[nodiscard]] double costPerParticle() const override { return 0.25; }
  [[nodiscard]] std::vector<double> pack() const override;
  void unpack(std::span<const double> state) override;
  [[nodiscard]] std::vector<double> content() override;
  void join(std::span<const double> rows, double share) override;
  // Trees that do not change are not copied.
  [[nodiscard]] std::unique_ptr<State> save() const override;
  void restore(const State& state) override;
  void addAmounts(const double* row, double number, std::span<double> amounts) const override;
  [[nodiscard]] std::vector<Quantity> columns() const override;
  [[nodiscard]] std::vector<double> values(const ParticleGas& gas) const override;
  [[nodiscard]] std::vector<std::pair<std::string, double>> counts() const override;
  [[nodiscard]] std::vector<ParticleFunctional> functionals() const override { return functionals_.all(); }
  [[nodiscard]] double functional(std::size_t which, const double* row) const override;
  void forEachRow(const std::function<void(const double* row)>& f) const override;
  [[nodiscard]] bool hasPrimarySizes() const override { return true; }
  [[nodiscard]] std::vector<double> primarySizes(const SizeBins& bins) const override;
  // Particles, their primaries, and the necks between these.
  [[nodiscard]] std::vector<Table> tables() const override;

 private:
  struct Saved;
  void requireAtoms(const Mechanism& mechanism, const SiteReactions& reactions) const;
  // kg/m3 of each element in so many units.
  void addElements(const TreeUnits& units, double number, std::span<double> elements) const;
  void addContent(std::span<double> elements) const;  // of the population that is here

  TreeOptions options_;
  TreeFunctionals functionals_;
  std::vector<TreeEvent> events_;
  std::unique_ptr<TreePopulation> trees_;
  std::vector<std::vector<double>> perMole_;  // kg of each element in a mole of each species
  std::vector<TreeUnits> elementMass_;        // of each element: kg in a unit of each component
  TreeExchange total_;                        // from the beginning
  TreeExchange taken_;                        // by the last takeExchange()
  // kg/m3 of each element: of what was unpacked and has joined, and gained by exchange since.
  std::vector<double> before_, gained_;
};

}  // namespace lampblack::particles
