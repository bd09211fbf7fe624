// Reads the list `colliders` of a linear-Burke reaction of a Cantera YAML file.
#pragma once

#include <string>
#include <vector>

#include "chemistry/mechanism/reaction.hpp"
#include "chemistry/mechanism/reaction_reader.hpp"
#include "chemistry/mechanism/yaml_access.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// The colliders of a reaction whose reactants and orders are known: M first, then species with an efficiency (or the
// eigenvalue eig0, of which the efficiency is the ratio to that of M) and perhaps a rate of their own. InputError with
// file, line and equation; warnings (file and line) are appended.
std::vector<Collider> readColliders(const YamlAccess& yaml, const UnitSystem& units, const YamlMap& entry,
                                    const Reaction& reaction, const ReactionScope& scope,
                                    std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
