// Reads one entry of a list of reactions of a Cantera YAML file.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/mechanism/reaction.hpp"
#include "chemistry/mechanism/yaml_access.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// What a reaction needs to know about the phase it belongs to.
struct ReactionScope {
  // Index of a species of the phase; empty if it is not declared.
  std::function<std::optional<std::size_t>(std::string_view)> findSpecies;
  bool skipUndeclaredSpecies = false;  // leave out reactions of species that the phase does not have
  bool skipUndeclaredThirdBodies =
      false;  // leave out efficiencies of such species, and reactions they alone collide in
};

// Empty if the scope leaves the reaction out. Throws InputError with file, line and equation. Numbers without a unit
// are in `units`, unless the entry has units of its own. Warnings (file and line) are appended.
std::optional<Reaction> readReaction(const YamlAccess& yaml, const UnitSystem& units, const YAML::Node& node,
                                     const ReactionScope& scope, std::vector<std::string>& warnings);

}  // namespace lampblack::chemistry
