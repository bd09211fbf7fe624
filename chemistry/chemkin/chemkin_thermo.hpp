// THERMO sections of CHEMKIN files: NASA-7 cards in columns of 80.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "chemistry/chemkin/chemkin_text.hpp"
#include "chemistry/mechanism/species.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct ChemkinThermo {
  Nasa7 thermo;
  std::optional<Nasa9> nasa9;                         // of a section THERMO NASA9 (chemkin_nasa9.hpp)
  std::vector<std::pair<std::string, double>> atoms;  // symbols in upper case, each once
  std::string place;                                  // "file:line"
};

using ChemkinThermoTable = std::unordered_map<std::string, ChemkinThermo>;

// Reads the lines of one section, its heading word and END left out, into a table of the species for which `wanted`
// holds; cards of others are passed over unread. A species that stands twice in the section keeps its first card, with
// a warning. Species that are already in the table keep what they have. Throws InputError with file and line.
//
// The first line may hold the three default temperatures (low, mid, high; 300, 1000, 5000 K without it).
//
// Card 1: name (columns 1-18), elements (25-44, 74-78, and from 81 on if nothing else is there; or free on lines
// announced by '&'), temperatures (46-55 low,
// 56-65 high, 66-73 mid; blank: the default). Cards 2-4: coefficients in columns of 15, of the upper range first;
// blank: zero. Fields that slipped out of their columns are read as words where these are unambiguous. A tabulator
// counts as one column, as Fortran has it, or, where a line cannot be read so, reaches to the next of every eight
// columns. A letter of the phase in the field of a fourth element is none. Both are warnings.
void readChemkinThermo(const ChemkinSource& source, std::span<const ChemkinLine> section,
                       const std::function<bool(std::string_view)>& wanted, ChemkinThermoTable& table,
                       std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
