// Soot in the cells of a flow: an Ensemble each.
#pragma once

#include <memory>
#include <vector>

#include "core/modules.hpp"
#include "coupling/cell_particles.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/population/model/population_model.hpp"

namespace lampblack::coupling {

class CellSoot final : public CellParticles {
 public:
  // Of State::carried, as AmountPlaces has them.
  enum Amount : std::size_t { number, carbon, hydrogen, primaries, surface, diameters, owedC, owedH, owedO };

  // InputError where the mechanism lacks a species. `owner` is that of each cell.
  CellSoot(const Mechanism& mechanism, const EnsembleOptions& options);

  using CellParticles::addAmounts;
  void addAmounts(const double* row, double number, std::span<double> amounts) const override;
  [[nodiscard]] double absorption(double temperature, double volumeFraction) const override;
  [[nodiscard]] bool hasPrecursors(const ParticleGas& gas) const override;
  void unpack(std::span<const double> population) override { engine_->unpack(population); }
  void join(std::span<const double> rows) override;
  Change advance(const ParticleGas& gas, double dt) override;
  [[nodiscard]] double cost() const override { return engine_->cost(); }
  [[nodiscard]] double costPerParticle() const override { return 0.06; }
  [[nodiscard]] std::vector<double> pack() const override { return engine_->pack(); }

  // Packed, of the given particles; as Ensemble::initialise().
  [[nodiscard]] std::vector<double> packed(std::span<const GivenParticle> population, std::uint64_t cell) const;
  // Packed, of spheres of carbon whose sizes are drawn for the cell, as many as there may be: of equal numbers where
  // the method has such, else as initialParticles().
  [[nodiscard]] std::vector<double> packed(const InitialPopulation& sizes, std::uint64_t cell) const;

 private:
  std::unique_ptr<Ensemble> engine_;
};

}  // namespace lampblack::coupling
