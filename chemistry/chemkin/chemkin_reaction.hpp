// Reactions of CHEMKIN files: an entry of a REACTIONS section understood and converted to SI units with mol.
#pragma once

#include <string>
#include <vector>

#include "chemistry/chemkin/chemkin_equation.hpp"
#include "chemistry/chemkin/chemkin_keywords.hpp"
#include "chemistry/chemkin/chemkin_reaction_lines.hpp"
#include "chemistry/chemkin/chemkin_text.hpp"
#include "chemistry/mechanism/reaction.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// One reaction; two where REV gives a rate of its own to the reverse direction: both are irreversible then. `units` are
// those of the section. `permissive`: efficiencies of species that are not declared are left out, with a warning.
// Throws InputError with file, line and what was expected.
std::vector<Reaction> readChemkinReaction(const ChemkinSource& source, const ChemkinReactionEntry& entry,
                                          const ChemkinUnits& units, const ChemkinEquationParser& species,
                                          bool permissive, std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
