// Soot as spheres or aggregates, an Ensemble, as a kind of stochastic population.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/stochastic/stochastic_population.hpp"

namespace lampblack::particles {

class SootEnsemble final : public StochasticPopulation {
 public:
  // InputError where the mechanism lacks a species that soot exchanges, and as makeEnsemble(). `start`: spheres of
  // carbon that are there from the beginning, as many numerical ones as there may be: of equal numbers where the method
  // has such, else as initialParticles().
  SootEnsemble(const Mechanism& mechanism, EnsembleOptions options, const InitialPopulation& start = {});

  [[nodiscard]] Ensemble& ensemble() const { return *ensemble_; }

  [[nodiscard]] double absorption(double temperature, double volumeFraction) const override;
  [[nodiscard]] bool hasPrecursors(const ParticleGas& gas) const override;
  void setRoom(std::size_t particles) override { ensemble_->setRoom(particles); }
  void advance(const ParticleGas& gas, double dt) override { ensemble_->advance(gas, 0, dt); }
  // Diluted within its splitting steps.
  void advanceDiverging(const ParticleGas& gas, double divergence, double dt) override {
    ensemble_->advance(gas, divergence, dt);
  }
  [[nodiscard]] std::vector<std::size_t> pathSpecies() const override;
  [[nodiscard]] std::size_t watchedSpecies() const override { return SootSpecies::C2H2; }
  Exchange takeExchange() override;
  [[nodiscard]] std::vector<double> resampled() const override {
    return {taken_.resampledCarbon, taken_.resampledHydrogen};
  }
  [[nodiscard]] std::vector<ParticleProcess> processes() const override { return namesOf(processes_); }
  [[nodiscard]] std::vector<double> amountsOfProcesses() const override { return amountsOf(processes_, taken_); }
  void dilute(double factor) override { ensemble_->dilute(factor); }
  [[nodiscard]] std::size_t size() const override { return ensemble_->size(); }
  [[nodiscard]] std::uint64_t removals() const override { return ensemble_->counters().removals; }
  [[nodiscard]] double cost() const override { return ensemble_->cost(); }
  [[nodiscard]] double costPerParticle() const override { return 0.06; }
  [[nodiscard]] std::vector<double> pack() const override { return ensemble_->pack(); }
  void unpack(std::span<const double> state) override { ensemble_->unpack(state); }
  [[nodiscard]] std::vector<double> content() override;
  void join(std::span<const double> rows, double share) override;
  void addAmounts(const double* row, double number, std::span<double> amounts) const override;
  void addAmountsOf(std::span<const double> of, std::span<double> amounts) const override;
  [[nodiscard]] std::vector<Quantity> columns() const override;
  [[nodiscard]] std::vector<double> values(const ParticleGas& gas) const override;
  [[nodiscard]] std::vector<std::pair<std::string, double>> counts() const override;
  [[nodiscard]] std::vector<ParticleFunctional> functionals() const override;
  [[nodiscard]] double functional(std::size_t, const double* row) const override {
    return sizes().mobilityDiameter(row);
  }
  void forEachRow(const std::function<void(const double* row)>& f) const override;

 private:
  std::unique_ptr<Ensemble> ensemble_;
  EnsembleExchange taken_;  // by the last takeExchange()
  std::vector<ProcessOf<EnsembleExchange>> processes_;
};

}  // namespace lampblack::particles
