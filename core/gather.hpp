// A cell field in natural order on every rank, for what follows the whole domain (streamlines, profiles).
#pragma once

#include <span>
#include <vector>

#include "core/mesh.hpp"

namespace lampblack {

// Collective. `values`: `components` a cell, owned cells first. Returns totalCells * components values in natural
// order, the same on every rank.
std::vector<double> gatherNatural(const Mesh& mesh, std::span<const double> values, int components);

}  // namespace lampblack
