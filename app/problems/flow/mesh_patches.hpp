// The named groups of a mesh file and the boundaries of a deck, which go by each other's names.
#pragma once

#include <string>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "core/mesh_block.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

// What a deck calls a group: a deck's names have neither points nor brackets, but "_".
[[nodiscard]] std::string nameInDeck(std::string patch);

// "row.msh has these names: ...", as a deck writes them; or what a file without any needs.
[[nodiscard]] std::string namesText(const std::vector<std::string>& patches, const FlowCase& flowCase);

// Puts the patches of a file into the order of the case's boundaries. Returns the names that the deck does not have:
// patches behind the boundaries, for only the mesh knows whether they are part of the surface. InputError where a
// boundary has no group, more than one, or the same as another.
std::vector<std::string> orderPatches(MeshBlock& block, const FlowCase& flowCase);

}  // namespace lampblack::app
