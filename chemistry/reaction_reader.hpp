// Reads one entry of the `reactions` list of a Cantera YAML file.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "chemistry/reaction.hpp"
#include "chemistry/yaml_access.hpp"

namespace lampblack {

// Index of a species of the phase; empty if it is not declared.
using SpeciesFinder = std::function<std::optional<std::size_t>(std::string_view)>;

// Throws InputError with file, line and equation.
Reaction readReaction(const YamlAccess& yaml, const FileUnits& units, const YAML::Node& node,
                      const SpeciesFinder& findSpecies);

}  // namespace lampblack
