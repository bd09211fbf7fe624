// A tree as a row of a packed population (particles/stochastic/particle_rows.hpp): what moves it and how large it is,
// the row's length, its sums, its primaries, its necks and, of trees with places in space, its spheres.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/stochastic/particle_rows.hpp"
#include "particles/trees/tree.hpp"

namespace lampblack::particles {

// Of its row.
[[nodiscard]] std::size_t lengthOfRow(const Tree& tree, const TreeMaterial& material);
// Adds the row of a tree that stands for `number` (1/m3); or its fixed part alone, without primaries and necks.
void packTree(const Tree& tree, double number, const TreeMaterial& material, std::vector<double>& to);
void packSums(const Tree& tree, double number, const TreeMaterial& material, std::vector<double>& to);
// The tree of the first of these rows. InputError for what packTree() did not write.
[[nodiscard]] Tree unpackTree(std::span<const double> rows, TreePool& pool, const TreeMaterial& material);

// The sums of a packed tree, from the fixed part of its row: all of its head but what says where it is.
[[nodiscard]] TreeHead headOfPackedTree(const double* row);

}  // namespace lampblack::particles
