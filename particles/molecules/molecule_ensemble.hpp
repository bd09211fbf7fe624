// Particles of molecules that grow site by site as a kind of stochastic population: soot of PAH. They have equal
// weights, in another population others: as of trees (TreeEnsemble).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "particles/molecules/molecule_options.hpp"
#include "particles/stochastic/stochastic_population.hpp"
#include "particles/trees/tree_functionals.hpp"

namespace lampblack::particles {

class MoleculePopulation;

class MoleculeEnsemble final : public StochasticPopulation {
 public:
  // InputError where the mechanism lacks a species, where the precursor's atoms are not those of the molecule, and as
  // MoleculePopulation(). Weights of C and H are the mechanism's.
  MoleculeEnsemble(const Mechanism& mechanism, const MoleculeOptions& options);
  ~MoleculeEnsemble() override;

  [[nodiscard]] MoleculePopulation& molecules() const { return *molecules_; }

  [[nodiscard]] double absorption(double temperature, double volumeFraction) const override;
  [[nodiscard]] bool hasPrecursors(const ParticleGas& gas) const override;
  void advance(const ParticleGas& gas, double dt) override;
  void applyDeferred() override {}  // nothing is put off
  [[nodiscard]] std::size_t watchedSpecies() const override { return SootSpecies::C2H2; }
  Exchange takeExchange() override;
  [[nodiscard]] std::vector<ParticleProcess> processes() const override;
  [[nodiscard]] std::vector<double> amountsOfProcesses() const override;
  [[nodiscard]] std::vector<double> resampled() const override;
  void dilute(double factor) override;
  [[nodiscard]] std::size_t size() const override;
  [[nodiscard]] std::uint64_t removals() const override;
  [[nodiscard]] double cost() const override;
  [[nodiscard]] double costPerParticle() const override { return 0.5; }
  [[nodiscard]] std::vector<double> pack() const override;
  void unpack(std::span<const double> state) override;
  [[nodiscard]] std::vector<double> content() override;
  void join(std::span<const double> rows, double share) override;
  [[nodiscard]] std::unique_ptr<State> save() const override;
  void restore(const State& state) override;
  void addAmounts(const double* row, double number, std::span<double> amounts) const override;
  [[nodiscard]] std::vector<Quantity> columns() const override;
  [[nodiscard]] std::vector<double> values(const ParticleGas& gas) const override;
  [[nodiscard]] std::vector<std::pair<std::string, double>> counts() const override;
  [[nodiscard]] std::vector<ParticleFunctional> functionals() const override { return functionals_; }
  [[nodiscard]] double functional(std::size_t which, const double* row) const override;
  void forEachRow(const std::function<void(const double* row)>& f) const override;
  [[nodiscard]] bool hasPrimarySizes() const override { return true; }
  [[nodiscard]] std::vector<double> primarySizes(const SizeBins& bins) const override;
  // Particles, and their molecules.
  [[nodiscard]] std::vector<Table> tables() const override;

 private:
  struct Saved;
  // kg of each element in so many atoms of carbon and hydrogen.
  [[nodiscard]] std::vector<double> kilograms(double carbon, double hydrogen) const;
  void addContent(std::vector<double>& elements) const;

  MoleculeOptions options_;
  TreeFunctionals ofTrees_;
  std::vector<ParticleFunctional> functionals_;
  std::unique_ptr<MoleculePopulation> molecules_;
  MoleculeExchange taken_, total_;  // by the last takeExchange(), and from the beginning
  // kg/m3 of each element: of what was unpacked and has joined, and gained by exchange since.
  std::vector<double> before_{0, 0}, gained_{0, 0};
};

}  // namespace lampblack::particles
