// Trees of primaries in the cells of a flow: the particles of a reactor (ReactorTrees), one population a cell. Trees
// have equal weights in a cell and others in the next: where they arrive, as many copies are taken as stand for them in
// the mean. What comes and goes so is counted (Change::resampled).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "coupling/cell_particles.hpp"
#include "coupling/reactor_trees.hpp"

namespace lampblack::coupling {

class CellTrees final : public CellParticles {
 public:
  // InputError as ReactorTrees.
  CellTrees(const Mechanism& mechanism, const TreeOptions& options);

  using CellParticles::addAmounts;
  void addAmounts(const double* row, double number, std::span<double> amounts) const override;
  // Of soot; silica is taken to be transparent.
  [[nodiscard]] double absorption(double temperature, double volumeFraction) const override;
  [[nodiscard]] bool hasPrecursors(const ParticleGas& gas) const override;
  [[nodiscard]] double costPerParticle() const override { return 0.25; }
  void unpack(std::span<const double> population) override;
  void join(std::span<const double> rows) override;
  Change advance(const ParticleGas& gas, double dt) override;
  [[nodiscard]] double cost() const override { return trees_.population().cost(); }
  [[nodiscard]] std::vector<double> pack() const override { return trees_.population().pack(); }

  // Packed, of `number` (1/m3) equal spheres of these units.
  [[nodiscard]] std::vector<double> packed(const TreeUnits& units, double number, std::uint64_t cell) const {
    return packed(std::vector<TreeStart>{{units, number}}, cell);
  }
  // Of all that is there at the start.
  [[nodiscard]] std::vector<double> packed(std::span<const TreeStart> starts, std::uint64_t cell) const;

 private:
  CellTrees(const Mechanism& mechanism, const TreeOptions& options, ReactorTrees trees);
  // kg/m3 of each element in so many units.
  void addElements(const TreeUnits& units, double number, std::span<double> elements) const;
  void addContent(std::span<double> elements) const;  // of the population that is here

  TreeOptions options_;
  ReactorTrees trees_;
  std::vector<TreeUnits> elementMass_;  // of each element: kg in a unit of each component
  std::vector<double> before_;          // kg/m3 of each element, of what is here
};

}  // namespace lampblack::coupling
