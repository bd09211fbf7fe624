// Sizes of the particles of packed ensembles (particles/stochastic/row_sizes.hpp) of all cells in a box: one
// distribution by mobility diameter and one by the primaries' diameter and number, from which mass and surface follow.
#pragma once

#include <span>
#include <vector>

#include "core/mesh_region.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "particles/stochastic/row_sizes.hpp"
#include "particles/stochastic/size_bins.hpp"

namespace lampblack::coupling {

// Rows of tables of a region, the same on all ranks and to the last bit on any number of them, from the populations of
// the owned cells: a row a bin of the mobility diameter. Collective.
[[nodiscard]] std::vector<Quantity> regionSizeColumns();
[[nodiscard]] std::vector<double> regionSizeRows(const RowSizes& of, const SizeBins& bins, const MeshRegion& region,
                                                 std::span<const std::vector<double>> populations);
// And one a bin of the primaries' diameter and number, where there are particles.
[[nodiscard]] std::vector<Quantity> regionJointColumns();
[[nodiscard]] std::vector<double> regionJointRows(const RowSizes& of, const SizeBins& bins, const MeshRegion& region,
                                                  std::span<const std::vector<double>> populations);

}  // namespace lampblack::coupling
