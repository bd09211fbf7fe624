// TRANSPORT files and sections of CHEMKIN: one line a species.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "chemistry/chemkin/chemkin_text.hpp"
#include "chemistry/mechanism/species.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct ChemkinTransport {
  TransportData data;
  std::string place;  // "file:line"
};

using ChemkinTransportTable = std::unordered_map<std::string, ChemkinTransport>;

// Reads the lines of one section, its heading word and END left out, into a table of the species for which `wanted`
// holds: name, geometry (0 atom, 1 linear, 2 nonlinear), eps/k (K), diameter (angstrom), dipole (debye),
// polarizability (cubic angstrom), rotational relaxation number at 298 K; text behind these is ignored, a seventh
// number an error. A species that
// stands twice keeps its first line, with a warning where both are in the same section. Throws InputError with file and
// line.
void readChemkinTransport(const ChemkinSource& source, std::span<const ChemkinLine> section,
                          const std::function<bool(std::string_view)>& wanted, ChemkinTransportTable& table,
                          std::vector<std::string>& warnings);

// Whether a file is one of transport data, whatever it was given for: by its heading or its first line.
bool isChemkinTransport(const ChemkinSource& source);

}  // namespace lampblack::chemistry
