// THERMO NASA9 sections of CHEMKIN files: NASA-9 records in columns of 80 (McBride, Zehe, Gordon 2002, appendix A).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/chemkin/chemkin_text.hpp"
#include "chemistry/chemkin/chemkin_thermo.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// As readChemkinThermo, of records of this form. The first line may hold default temperatures, which mean nothing here.
//
// Line 1: name, comments. Line 2: number of ranges (columns 1-2), five elements with their numbers of atoms (11-50, in
// columns of 2 and 6). For each range: its temperatures (1-11, 12-22), the number of coefficients (23) and the
// exponents of the temperature (24-63), which have to be the seven from -2 to 4; a1 to a5 in columns of 16; a6, a7, a
// blank field, b1, b2. The standard pressure is 1 atm, as in all CHEMKIN files.
void readChemkinNasa9(const ChemkinSource& source, std::span<const ChemkinLine> section,
                      const std::function<bool(std::string_view)>& wanted, ChemkinThermoTable& table,
                      std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
