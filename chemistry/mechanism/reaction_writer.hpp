// One reaction as Cantera YAML; see mechanism_writer.hpp.
#pragma once

#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/mechanism/reaction.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// An entry of the list `reactions`, in units of m, mol, s, Pa and K.
std::string reactionYaml(const Reaction& reaction, const Mechanism& mechanism);

}  // namespace lampblack::chemistry
