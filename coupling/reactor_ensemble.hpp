// A stochastic population of soot as the particles of a split reactor.
#pragma once

#include <memory>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "coupling/reactor_population.hpp"
#include "particles/ensemble/ensemble.hpp"

namespace lampblack::coupling {

class ReactorEnsemble final : public ReactorPopulation {
 public:
  // InputError where the mechanism lacks a species that soot exchanges, and as makeEnsemble().
  ReactorEnsemble(const Mechanism& mechanism, EnsembleOptions options);

  [[nodiscard]] const Ensemble& population() const { return *population_; }

  [[nodiscard]] const std::vector<std::size_t>& species() const override { return species_; }
  Exchange advance(const ParticleGas& gas, double dt) override;
  void dilute(double factor) override;
  [[nodiscard]] std::vector<double> content() const override;
  void join(std::span<const double> content, double share) override;
  [[nodiscard]] bool idle(const ParticleGas& gas) const override;
  [[nodiscard]] std::uint64_t removals() const override { return population_->counters().removals; }
  [[nodiscard]] std::unique_ptr<State> save() const override {
    return std::make_unique<PackedSplitState>(population_->pack());
  }
  void restore(const State& state) override {
    population_->unpack(dynamic_cast<const PackedSplitState&>(state).values);
  }

  [[nodiscard]] std::string material() const override { return "soot"; }
  [[nodiscard]] std::vector<Column> columns() const override;
  [[nodiscard]] std::vector<double> values(const ParticleGas& gas) const override;
  [[nodiscard]] std::vector<Distribution> distributions() const override;
  [[nodiscard]] std::vector<double> distribution(std::size_t k, double logMin, double logMax,
                                                 std::size_t bins) const override;
  [[nodiscard]] std::vector<std::pair<std::string, double>> counts() const override { return {}; }

 private:
  std::unique_ptr<Ensemble> population_;
  std::vector<std::size_t> species_;
};

}  // namespace lampblack::coupling
