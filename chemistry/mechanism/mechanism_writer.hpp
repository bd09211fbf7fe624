// Mechanisms as Cantera YAML files that Lampblack and Cantera read.
#pragma once

#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// The whole mechanism: elements with weights of their own, species with thermodynamic and transport data, reactions.
// Units are m, mol, s, Pa and K, and numbers have the fewest digits that read back as the same double, so that
// Mechanism::fromFile gives back the data bit by bit. (Quantities that the format has in other units, such as diameters
// in angstrom, do so if they came from a file with these units; at worst they change in the last bit.)
std::string mechanismYaml(const Mechanism& mechanism);

// The same in a file, which appears whole: it is written as `path`.part and renamed. InputError if that fails.
void writeMechanism(const Mechanism& mechanism, const std::string& path);

}  // namespace lampblack::chemistry
