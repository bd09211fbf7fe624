// Standard atomic weights of the elements, and the electron's.
#pragma once

#include <optional>
#include <string_view>

#include "core/modules.hpp"

namespace lampblack::chemistry {

// kg/mol; the name is matched without regard to letter case ("AR", "Ar"). Abridged standard atomic weights, IUPAC 2021
// (Prohaska et al., Pure Appl. Chem. 94 (2022) 573-600). Empty if the element is unknown here.
std::optional<double> standardAtomicWeight(std::string_view element);

}  // namespace lampblack::chemistry
