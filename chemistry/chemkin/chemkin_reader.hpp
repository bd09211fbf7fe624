// Mechanisms in the format of CHEMKIN-II (Kee, Rupley, Miller 1989, SAND89-8009), with the later keywords for rates
// that depend on pressure. docs/formats.md lists what is read.
#pragma once

#include <optional>
#include <string>

#include "chemistry/chemkin/chemkin_text.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct ChemkinFiles {
  std::string mechanism;                 // ELEMENTS, SPECIES, REACTIONS; THERMO and TRANSPORT may be there too
  std::optional<std::string> thermo;     // for species without data in the mechanism file; or transport data, alone
  std::optional<std::string> transport;  // the same
  bool permissive = false;               // as in MechanismRules
};

// Reads and converts to SI units with mol. What is doubtful but can be used (data given twice, a species without
// transport data, text behind END, light among the products) is told in the mechanism's warnings; what cannot be used
// is an InputError with file, line and what was expected.
Mechanism readChemkin(const ChemkinFiles& files);

// The same with the files in memory.
Mechanism parseChemkin(const ChemkinText& mechanism, const std::optional<ChemkinText>& thermo,
                       const std::optional<ChemkinText>& transport, bool permissive = false);

}  // namespace lampblack::chemistry
