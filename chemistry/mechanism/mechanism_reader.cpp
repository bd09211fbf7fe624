// Mechanism::fromFile: the phase of a Cantera YAML file and what it is made of.
#include <fmt/format.h>

#include <filesystem>

#include "chemistry/mechanism/elements.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/mechanism/mechanism_checks.hpp"
#include "chemistry/mechanism/mechanism_sections.hpp"
#include "chemistry/mechanism/phase_entries.hpp"
#include "chemistry/mechanism/reaction_reader.hpp"
#include "chemistry/mechanism/species_reader.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::chemistry {

namespace {

class MechanismReader {
 public:
  MechanismReader(const std::string& path, const std::string& phase, bool permissive)
      : files_(path), yaml_(files_.main().yaml), phase_(choosePhase(files_.main(), phase)), permissive_(permissive) {}

  Mechanism read() {
    phase_.warnOfOthers({"name", "thermo", "elements", "species", "kinetics", "reactions", "transport", "state",
                         "skip-undeclared-elements", "skip-undeclared-third-bodies", "explicit-third-body-duplicates",
                         "units", "note", "comment", "reference"},
                        warnings_, YamlMap::Slips::Warnings);
    if (auto text = transportWarning(yaml_, phase_); !text.empty()) warnings_.push_back(std::move(text));
    findSpecies();
    readElements();
    readSpeciesEntries();
    for (const auto& rule : reactionRules(files_, phase_)) addReactions(rule);
    resolveColliders();
    const MechanismRules rules{.permissive = permissive_};
    settleReactions(yaml_.file(), species_, reactions_, rules, warnings_);
    std::string description;
    if (const YAML::Node text = files_.main().root["description"]; text.IsDefined())
      description = yaml_.text(text, "description");
    return Mechanism(yaml_.file(), description, std::move(elements_), std::move(species_), std::move(reactions_),
                     std::move(warnings_), rules);
  }

 private:
  struct SpeciesEntry {
    const MechanismSection* section;
    std::size_t index;
    const YAML::Node& node() const { return section->entries[index]; }
  };

  void findSpecies() {
    const auto* list = phase_.find("species");
    if (list == nullptr || isWord(list, "all")) {
      addAllSpecies(files_.section("species", "name", list == nullptr ? phase_.node() : *list));
    } else {
      yaml_.requireSequence(*list, phase_.what() + ", 'species'");
      for (const auto& item : *list) {
        if (!item.IsMap()) {
          addSpecies(files_.section("species", "name", item), item);
          continue;
        }
        const auto [name, names] = sectionRule(yaml_, item, phase_.what());
        const auto& section = files_.section(name, "name", item);
        if (isWord(&names, "all")) {
          addAllSpecies(section);
        } else {
          yaml_.requireSequence(names, fmt::format("{}, species of '{}'", phase_.what(), name));
          for (const auto& one : names) addSpecies(section, one);
        }
      }
    }
    if (speciesEntries_.empty()) yaml_.fail(phase_.node(), "the phase has no species");
  }

  void addAllSpecies(const MechanismSection& section) {
    for (std::size_t i = 0; i < section.entries.size(); ++i) speciesEntries_.push_back({&section, i});
  }

  void addSpecies(const MechanismSection& section, const YAML::Node& node) {
    const auto& name = yaml_.text(node, phase_.what() + ", 'species'");
    const auto found = section.byName.find(name);
    if (found == section.byName.end())
      yaml_.fail(node, fmt::format("species '{}' of the phase is not declared under 'species'; the nearest name is "
                                   "'{}'",
                                   name, closestName(name, section.names)));
    speciesEntries_.push_back({&section, found->second});
  }

  void addElement(const MechanismSection* own, const std::string& name, const YAML::Node& where,
                  const YamlAccess& yaml) {
    for (const auto& e : elements_)
      if (e.name == name) return;
    if (own != nullptr)
      if (const auto found = own->byName.find(name); found != own->byName.end()) {
        const auto& file = own->file->yaml;
        const YamlMap entry(file, own->entries[found->second], fmt::format("element '{}'", name));
        entry.allowOnly({"symbol", "atomic-weight", "atomic-number", "entropy298", "note"});
        const double weight = file.number(entry.at("atomic-weight"), entry.what());
        if (!(weight > 0)) file.fail(entry.at("atomic-weight"), entry.what() + ": expected a positive atomic weight");
        elements_.push_back({name, weight * 1e-3});
        return;
      }
    const auto weight = standardAtomicWeight(name);
    if (!weight)
      yaml.fail(where, fmt::format("unknown element '{}'; an element of the file's own has to be in the phase's list "
                                   "'elements'",
                                   name));
    elements_.push_back({name, *weight});
  }

  void readElements() {
    const auto* list = phase_.find("elements");
    if (list != nullptr) {
      const auto* own = files_.hasSection("elements") ? &files_.section("elements", "symbol", phase_.node()) : nullptr;
      yaml_.requireSequence(*list, phase_.what() + ", 'elements'");
      for (const auto& item : *list) {
        if (!item.IsMap()) {
          addElement(own, yaml_.text(item, "element"), item, yaml_);
          continue;
        }
        const auto [name, names] = sectionRule(yaml_, item, phase_.what());
        const auto* section = name == "default" ? nullptr : &files_.section(name, "symbol", item);
        yaml_.requireSequence(names, fmt::format("{}, elements of '{}'", phase_.what(), name));
        for (const auto& one : names) {
          const auto& symbol = yaml_.text(one, "element");
          if (section != nullptr && !section->byName.contains(symbol))
            yaml_.fail(one, fmt::format("element '{}' is not declared under '{}'; the nearest name is '{}'", symbol,
                                        name, closestName(symbol, section->names)));
          addElement(section, symbol, one, yaml_);
        }
      }
      return;
    }
    // Without a list, standard elements alone: the file's own may be isotopes of another phase.
    for (const auto& entry : speciesEntries_) {
      const auto& yaml = entry.section->file->yaml;
      const YAML::Node composition = entry.node()["composition"];
      if (!composition.IsDefined() || !composition.IsMap()) continue;  // said when the species is read
      for (const auto& atoms : composition)
        addElement(nullptr, yaml.text(atoms.first, "composition"), atoms.first, yaml);
    }
  }

  // Species of elements that the phase does not have, where it asks to leave them out.
  bool hasUndeclaredElement(const YAML::Node& species) const {
    const YAML::Node composition = species["composition"];
    if (!composition.IsDefined() || !composition.IsMap()) return false;
    for (const auto& atoms : composition) {
      bool known = false;
      for (const auto& e : elements_) known = known || (atoms.first.IsScalar() && e.name == atoms.first.Scalar());
      if (!known) return true;
    }
    return false;
  }

  void readSpeciesEntries() {
    const bool skip = phase_.flag("skip-undeclared-elements", false);
    for (const auto& entry : speciesEntries_) {
      if (skip && hasUndeclaredElement(entry.node())) continue;
      const auto& file = *entry.section->file;
      auto species = readSpecies(file.yaml, entry.section->units, entry.node(), elements_, warnings_);
      if (&file != &files_.main()) species.file = file.yaml.file();
      if (!speciesByName_.emplace(species.name, species_.size()).second)
        yaml_.fail(phase_.node(), fmt::format("species '{}' is in the phase twice", species.name));
      species_.push_back(std::move(species));
    }
  }

  void addReactions(const ReactionRule& from) {
    const auto& [name, rule, where] = from;
    if (rule != "all" && rule != "declared-species")
      yaml_.fail(where, fmt::format("{}: unknown rule '{}' for the reactions of '{}'; expected all, none or "
                                    "declared-species",
                                    phase_.what(), rule, name));
    ReactionScope scope;
    scope.findSpecies = [this](std::string_view species) -> std::optional<std::size_t> {
      const auto found = speciesByName_.find(species);
      if (found == speciesByName_.end()) return std::nullopt;
      return found->second;
    };
    scope.skipUndeclaredSpecies = rule == "declared-species";
    scope.skipUndeclaredThirdBodies = phase_.flag("skip-undeclared-third-bodies", false);
    const auto& section = files_.section(name, "", where);
    for (const auto& node : section.entries) {
      auto reaction = readReaction(section.file->yaml, section.units, node, scope, warnings_);
      if (!reaction) continue;
      if (section.file != &files_.main()) reaction->file = section.file->yaml.file();
      reactions_.push_back(std::move(*reaction));
    }
  }

  // What the phase wants done about a collider that acts by its own reaction and by that with M. Left alone, it is a
  // warning of the mechanism.
  void resolveColliders() {
    const auto* node = phase_.find("explicit-third-body-duplicates");
    if (node == nullptr || isWord(node, "warn")) return;
    const auto& rule = yaml_.text(*node, phase_.what());
    if (rule != "error" && rule != "mark-duplicate" && rule != "modify-efficiency")
      yaml_.fail(*node, fmt::format("{}: expected warn, error, mark-duplicate or modify-efficiency, found '{}'",
                                    phase_.what(), rule));
    for (const auto& pair : findColliderPairs(species_, reactions_)) {
      auto &mixture = reactions_[pair.mixture], &named = reactions_[pair.named];
      if (rule == "error")
        throw InputError(fmt::format("{}:{}: reaction '{}' has the collider {} of '{}' at line {} a second time",
                                     named.file.empty() ? yaml_.file() : named.file, named.line, named.equation,
                                     species_[pair.collider].name, mixture.equation, mixture.line));
      if (rule == "mark-duplicate") {
        mixture.duplicate = named.duplicate = true;
      } else {
        std::erase_if(mixture.thirdBody->efficiencies, [&](const auto& e) { return e.species == pair.collider; });
        mixture.thirdBody->efficiencies.push_back({pair.collider, 0.0});
      }
    }
  }

  struct TextHash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>{}(text); }
  };

  MechanismFiles files_;
  const YamlAccess& yaml_;
  YamlMap phase_;
  std::vector<SpeciesEntry> speciesEntries_;
  std::vector<Element> elements_;
  std::vector<Species> species_;
  std::unordered_map<std::string, std::size_t, TextHash, std::equal_to<>> speciesByName_;
  std::vector<Reaction> reactions_;
  std::vector<std::string> warnings_;
  bool permissive_;
};

}  // namespace

Mechanism Mechanism::fromFile(const std::string& path, const std::string& phase, bool permissive) {
  try {
    return MechanismReader(path, phase, permissive).read();
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}:{}: not valid YAML: {}", path, error.mark.line + 1, error.msg));
  }
}

}  // namespace lampblack::chemistry
