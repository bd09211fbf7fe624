// Molecules of rings of six by their names, as cells of the lattice.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"
#include "particles/pah/lattice.hpp"

namespace lampblack::particles {

// In the order of their size.
[[nodiscard]] std::vector<std::string> moleculeNames();
// InputError for another name.
[[nodiscard]] std::vector<LatticeCell> namedMolecule(std::string_view name);

}  // namespace lampblack::particles
