// Enthalpy of particles by the elements that they are made of, for balances with a gas: whatever the particles are kept
// as, what they gain of an element has that of the element in their material.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

// J and J/K in a kg of an element in particles, standard enthalpy of formation included, at a temperature (K).
using ElementEnthalpy = std::pair<double, double> (*)(double temperature);

// In the order of the elements; nothing where the heat of particles of these is not known. Of carbon and hydrogen it is
// that of soot: graphite and H2. Of silicon, oxygen and hydrogen that of silica: silicon with two oxygen as quartz,
// from 298 to 1996 K (Chase 1998; above as its formula goes on), every two hydrogen with one oxygen as water vapour,
// which they came from and become again; so oxygen has none of its own.
[[nodiscard]] std::optional<std::vector<ElementEnthalpy>> elementEnthalpies(std::span<const std::string> elements);

}  // namespace lampblack::particles
