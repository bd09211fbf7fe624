// A tree as a row of a packed population (particles/ensemble/particle_rows.hpp): what moves it and how large it is, the
// row's length, its sums, its primaries and its necks.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/ensemble/particle_rows.hpp"
#include "particles/trees/tree.hpp"

namespace lampblack::particles {

// Adds the row of a tree that stands for `number` (1/m3).
void packTree(const Tree& tree, double number, const TreeMaterial& material, std::vector<double>& to);
// The tree of the first of these rows. InputError for what packTree() did not write.
[[nodiscard]] Tree unpackTree(std::span<const double> rows, TreePool& pool, const TreeMaterial& material);

// Sums of a packed tree, without unpacking it.
struct PackedTreeSums {
  double count = 0;  // primaries
  TreeUnits units{};
  double surface = 0;  // m2
};
[[nodiscard]] PackedTreeSums sumsOfPackedTree(const double* row);

}  // namespace lampblack::particles
