// The sections of CHEMKIN files: ELEMENTS, SPECIES, THERMO, REACTIONS, TRANSPORT, up to END.
#pragma once

#include <string>
#include <vector>

#include "chemistry/chemkin/chemkin_text.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct ChemkinSection {
  enum class Kind { Elements, Species, Thermo, Reactions, Transport };

  Kind kind = Kind::Elements;
  std::vector<std::string> options;  // the words behind the keyword, of THERMO, REACTIONS and TRANSPORT
  std::vector<ChemkinLine> lines;  // without the keyword and END; for elements and species what follows the keyword too
  int line = 0;                    // of the keyword
};

// A section ends with END or where the next begins. Keywords may be shortened as CHEMKIN allows (ELEM, SPEC, THER,
// REAC, TRAN), in letters of either case. `implied`: the kind of section that lines before any keyword belong to, if
// not null; else such lines are an error. Lines behind an END are passed over with a warning; behind the END of
// REACTIONS, or of an implied section, so is what only begins with the word of a section, and a reaction. Before it a
// reaction outside a section is an error. Throws InputError with file and line.
std::vector<ChemkinSection> splitChemkinSections(const ChemkinSource& source, const ChemkinSection::Kind* implied,
                                                 std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
