// Reads one entry of a list of species of a Cantera YAML file: composition, thermodynamic and gas transport data.
#pragma once

#include <span>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/mechanism/yaml_access.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// InputError with file, line and species for what is missing, unknown or out of range. `elements` are those of the
// phase; a pressure without a unit is in `units`, unless the entry has units of its own. Keys for other programs are
// warnings (YamlMap::warnOfOthers).
Species readSpecies(const YamlAccess& yaml, const UnitSystem& units, const YAML::Node& node,
                    std::span<const Element> elements, std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
