#include "chemistry/mechanism/phase_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lampblack::chemistry {

namespace {

constexpr std::string_view kIdealGas = "ideal-gas";

std::string nameOf(const YamlAccess& yaml, const YamlMap& phase) {
  return phase.has("name") ? yaml.text(phase.at("name"), "phase name") : "";
}

std::string typeOf(const YamlAccess& yaml, const YamlMap& phase) {
  return phase.has("thermo") ? yaml.text(phase.at("thermo"), "phase 'thermo'") : "no type";
}

// "'gas' (ideal-gas), 'Pt_surf' (ideal-surface)"
std::string listed(const YamlAccess& yaml, const std::vector<YamlMap>& phases) {
  std::string text;
  for (const auto& phase : phases)
    text += fmt::format("{}'{}' ({})", text.empty() ? "" : ", ", nameOf(yaml, phase), typeOf(yaml, phase));
  return text.empty() ? "none" : text;
}

}  // namespace

YamlMap choosePhase(const MechanismFile& file, const std::string& name) {
  const auto& yaml = file.yaml;
  const YAML::Node list = file.root["phases"];
  if (!list.IsDefined()) yaml.fail(file.root, "mechanism file has no 'phases'");
  yaml.requireSequence(list, "phases");
  std::vector<YamlMap> phases;
  for (const auto& node : list) phases.emplace_back(yaml, node, "phase");
  const auto found = std::ranges::find_if(phases, [&](const auto& phase) {
    return name.empty() ? typeOf(yaml, phase) == kIdealGas : nameOf(yaml, phase) == name;
  });
  if (found == phases.end())
    yaml.fail(list, name.empty()
                        ? fmt::format("no ideal-gas phase, and others are not supported; the phases are {}",
                                      listed(yaml, phases))
                        : fmt::format("there is no phase '{}'; the phases are {}", name, listed(yaml, phases)));
  found->rename(fmt::format("phase '{}'", nameOf(yaml, *found)));
  if (const auto type = typeOf(yaml, *found); type != kIdealGas)
    yaml.fail(found->node(), fmt::format("{} is of type '{}', which is not supported; expected ideal-gas; the phases "
                                         "are {}",
                                         found->what(), type, listed(yaml, phases)));
  return *found;
}

std::vector<ReactionRule> reactionRules(const MechanismFiles& files, const YamlMap& phase) {
  const auto& yaml = files.main().yaml;
  const auto *kinetics = phase.find("kinetics"), *list = phase.find("reactions");
  const bool none = kinetics == nullptr || isWord(kinetics, "none") || isWord(kinetics, "None");
  constexpr std::array<std::string_view, 4> gas{"gas", "bulk", "Gas", "gaskinetics"};
  if (!none && std::ranges::none_of(gas, [&](auto word) { return isWord(kinetics, word); }))
    yaml.fail(*kinetics, fmt::format("{}: kinetics '{}' is not supported; expected gas, bulk or none", phase.what(),
                                     yaml.text(*kinetics, phase.what() + ", 'kinetics'")));
  if (isWord(list, "none")) return {};
  if (none) {
    if (list != nullptr)
      yaml.fail(*list,
                fmt::format("{} has 'reactions' but no 'kinetics'; expected 'kinetics: gas' beside it", phase.what()));
    return {};
  }
  if (list != nullptr && !list->IsSequence() && !isWord(list, "all") && !isWord(list, "declared-species"))
    yaml.fail(*list,
              fmt::format("{}, 'reactions': expected all, none, declared-species or a list of sections", phase.what()));
  if (list == nullptr || list->IsScalar()) {
    const auto& where = list == nullptr ? phase.node() : *list;
    if (!files.hasSection("reactions"))
      yaml.fail(where, fmt::format("{} asks for the section 'reactions', which is not there; expected it, or "
                                   "'reactions: none' in the phase",
                                   phase.what()));
    return {{"reactions", list == nullptr ? "all" : list->Scalar(), where}};
  }
  std::vector<ReactionRule> rules;
  for (const auto& item : *list) {
    if (item.IsMap()) {
      const auto [name, rule] = sectionRule(yaml, item, phase.what());
      rules.push_back({name, yaml.text(rule, phase.what() + ", 'reactions'"), item});
    } else {
      rules.push_back({yaml.text(item, phase.what() + ", 'reactions'"), "all", item});
    }
  }
  std::erase_if(rules, [](const auto& rule) { return rule.rule == "none"; });
  return rules;
}

std::string transportWarning(const YamlAccess& yaml, const YamlMap& phase) {
  const auto* node = phase.find("transport");
  if (node == nullptr || node->IsNull()) return {};
  const auto& model = yaml.text(*node, phase.what() + ", 'transport'");
  constexpr std::array<std::string_view, 11> ideal{"none",
                                                   "default",
                                                   "mixture-averaged",
                                                   "mixture-averaged-CK",
                                                   "multicomponent",
                                                   "multicomponent-CK",
                                                   "CK_Mix",
                                                   "CK_Multi",
                                                   "Mix",
                                                   "Multi",
                                                   "unity-Lewis-number"};
  if (std::ranges::find(ideal, model) != ideal.end()) return {};
  return fmt::format(
      "{}:{}: {} asks for the transport model '{}', which is not there; all species are treated as neutral molecules "
      "of an ideal gas",
      yaml.file(), YamlAccess::line(*node), phase.what(), model);
}

bool isWord(const YAML::Node* node, std::string_view word) {
  return node != nullptr && node->IsScalar() && node->Scalar() == word;
}

std::pair<std::string, YAML::Node> sectionRule(const YamlAccess& yaml, const YAML::Node& item,
                                               const std::string& what) {
  const YamlMap map(yaml, item, what);
  if (map.entries().size() != 1) yaml.fail(item, fmt::format("{}: expected one section and its names", what));
  return {std::string(map.entries()[0].key), map.entries()[0].value};
}

}  // namespace lampblack::chemistry
