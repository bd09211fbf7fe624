// REACTIONS sections of CHEMKIN files as text: one entry for each reaction with its auxiliary data, not yet understood.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/chemkin/chemkin_equation.hpp"
#include "chemistry/chemkin/chemkin_text.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// "LOW / 1e20 0 100 /", "H2O/6/" or "DUP"
struct ChemkinAuxiliary {
  std::string key;
  std::vector<std::string> values;
  bool slashes = false;  // has values between slashes, be they none
  int line = 0;
};

struct ChemkinReactionEntry {
  std::string equation;
  std::array<double, 3> rate{};  // A, b, Ea as the file has them
  std::vector<ChemkinAuxiliary> auxiliaries;
  int line = 0;
};

// A line that ends with '&' goes on in the next. A line with '=' starts a reaction unless it begins with a keyword or a
// declared species and a slash. Where the last slash of a line is missing, the values end with the line, with a
// warning. Throws InputError with file and line.
std::vector<ChemkinReactionEntry> splitChemkinReactions(const ChemkinSource& source,
                                                        std::span<const ChemkinLine> section,
                                                        const ChemkinEquationParser& species,
                                                        std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
