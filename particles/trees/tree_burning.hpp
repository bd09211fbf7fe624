// What is left of a tree where primaries have burnt away.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "particles/trees/primary_trees.hpp"

namespace lampblack::particles {

// For a tree with primaries without units, not all of them.
// Each burnt primary goes; what touched it touches that neighbour of it with which it shared most surface, at the same
// sintering levels.
void joinOverBurnt(const PrimaryTrees& type, Tree& tree);
// The burnt primaries go, and with them all their necks: the parts that then hang together, each a tree.
[[nodiscard]] std::vector<Tree> partsAroundBurnt(const PrimaryTrees& type, const Tree& tree);

}  // namespace lampblack::particles
