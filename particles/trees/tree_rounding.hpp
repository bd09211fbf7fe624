// What a change of its primaries does to the sizes of a tree and to its necks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/trees/primary_trees.hpp"

namespace lampblack::particles {

// Where primaries have other units than their diameters say: sizes from units, and necks. `change`: of the volume of
// each primary, in pieces of `piece` (m3); it is overwritten. `changed`: the only primaries that have other units, once
// or more often; empty: any may. A neck gains 2 sigma dv/d of surface for what has grown on its primaries (Shekar,
// Smith, Kraft, Wagner 2011, eqs. 30, 31), sigma being the smoothing of the material. Primaries that shrink, as they
// burn, keep the sintering levels of their necks. One without units has no size; its necks stay as they are for who
// takes it away. All sums are those of the new sizes; the tree is to be sintered next.
void roundTree(const PrimaryTrees& type, TreeHead& tree, std::vector<double>& change, double piece,
               std::span<const std::uint32_t> changed = {});

}  // namespace lampblack::particles
