// Sizes of the particles of packed ensembles (particles/ensemble/particle_rows.hpp): of one cell, and of all cells in
// a box, one distribution by mobility diameter and one by the primaries' diameter and number, from which mass and
// surface follow.
#pragma once

#include <span>
#include <vector>

#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "particles/ensemble/particle_rows.hpp"
#include "particles/ensemble/size_bins.hpp"
#include "particles/soot/soot_aggregate.hpp"

namespace lampblack::coupling {

// How the particles of packed populations stand, and what their first values say of their sizes.
struct RowSizes {
  SootAggregate type;
  ParticleRows rows;
};

// Adds dN/dlog10(d) (1/m3) by mobility diameter, as Ensemble::sizeDistribution().
void addSizes(const RowSizes& of, const SizeBins& bins, std::span<const double> population, std::span<double> density);
// Of the mobility diameter by number; 1 where there are no particles.
[[nodiscard]] double geometricDeviation(const RowSizes& of, std::span<const double> population);

// The cells of a box, by their centres.
class EnsembleRegion {
 public:
  // Collective. `from` is below `to` along each axis of the mesh.
  EnsembleRegion(const Mesh& mesh, const Vector3& from, const Vector3& to);

  [[nodiscard]] bool isEmpty() const { return !(volume_ > 0.0); }

  // Rows of a table, the same on all ranks and to the last bit on any number of them: a row a bin. Collective.
  [[nodiscard]] static std::vector<Quantity> sizeColumns();
  [[nodiscard]] std::vector<double> sizeRows(const RowSizes& of, const SizeBins& bins,
                                             std::span<const std::vector<double>> populations) const;
  // The same of those bins where there are particles.
  [[nodiscard]] static std::vector<Quantity> jointColumns();
  [[nodiscard]] std::vector<double> jointRows(const RowSizes& of, const SizeBins& bins,
                                              std::span<const std::vector<double>> populations) const;

 private:
  const Mesh& mesh_;
  std::vector<int> cells_;
  double volume_ = 0.0;  // of the region
};

}  // namespace lampblack::coupling
