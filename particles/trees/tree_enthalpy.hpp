// Enthalpy of what trees are made of, by their elements.
#pragma once

#include <optional>
#include <string>

#include "core/rooms.hpp"

namespace lampblack::particles {

// J in a kg of the element in particles of the material, standard enthalpy of formation included; nothing where it is
// not known. Silica: silicon and two oxygen as quartz, from 298 to 1996 K (Chase 1998; above as its formula goes on),
// every two hydrogen and one oxygen as water vapour, which they came from and become again; so oxygen has none of its
// own. Soot: carbon as graphite, hydrogen as H2.
[[nodiscard]] std::optional<double> treeEnthalpy(const std::string& material, const std::string& element,
                                                 double temperature);

}  // namespace lampblack::particles
