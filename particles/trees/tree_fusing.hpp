// Two primaries of a tree become one, or one of it and a single one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/modules.hpp"
#include "particles/trees/tree_shape.hpp"

namespace lampblack::particles {

// Makes the two primaries of the k-th neck one, in the place of the left one: its part of the tree goes where the right
// one stood. Sums are not touched. Levels of other necks stay. Returns
// from which neck on there are others than before.
std::size_t fuseNeck(TreeHead& tree, std::size_t k, const TreeMaterial& material);

// The same of the primary `at` and a single one of these units that has touched it: to the bits of a neck behind all
// others, but no other primary moves. Returns whether its necks are not fused (isFused) by what it has grown.
bool absorb(TreeHead& tree, std::uint32_t at, const TreeUnits& units, const TreeMaterial& material);

}  // namespace lampblack::particles
