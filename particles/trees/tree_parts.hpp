// A tree goes apart: the parts that still hang together where some necks do not hold, each a tree of its own with
// every primary, unit, surface and neck as it was.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/trees/primary_trees.hpp"

namespace lampblack::particles {

// `holds`: of each neck, whether it does. Primaries without units are in no part; their necks may not hold.
[[nodiscard]] std::vector<Tree> partsOfTree(const PrimaryTrees& type, const Tree& whole, std::span<const char> holds);
// The two sides of a neck.
[[nodiscard]] std::vector<Tree> sidesOfNeck(const PrimaryTrees& type, const Tree& whole, std::size_t neck);

}  // namespace lampblack::particles
