// The entries of a Cantera YAML file's list `phases`: which of them is read, and what one says about reactions and
// transport.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chemistry/mechanism/mechanism_sections.hpp"
#include "chemistry/mechanism/yaml_access.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// The phase of this name, or the first ideal gas if the name is empty. InputError with the names there are if it is not
// among them, and with the phase's type if that is not an ideal gas.
YamlMap choosePhase(const MechanismFile& file, const std::string& name);

// A section of reactions and what to take of it: "all" or "declared-species".
struct ReactionRule {
  std::string section, rule;
  YAML::Node where;
};

// By the format's rules: none without `kinetics`; with it those of `reactions`, which is the section of that name where
// the phase does not say. InputError for `reactions` without `kinetics`, for a section that is not there, and for
// kinetics of surfaces.
std::vector<ReactionRule> reactionRules(const MechanismFiles& files, const YamlMap& phase);

// What to say about a transport model the phase asks for and Lampblack does not have; empty if there is none.
std::string transportWarning(const YamlAccess& yaml, const YamlMap& phase);

// Whether the node is this one word ("all").
bool isWord(const YAML::Node* node, std::string_view word);

// The one key and value of "- {section: ...}"; `what` names the list in messages.
std::pair<std::string, YAML::Node> sectionRule(const YamlAccess& yaml, const YAML::Node& item, const std::string& what);

}  // namespace lampblack::chemistry
