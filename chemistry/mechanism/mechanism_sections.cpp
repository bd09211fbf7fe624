#include "chemistry/mechanism/mechanism_sections.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/errors.hpp"
#include "core/nearest_name.hpp"
#include "core/text_file.hpp"

namespace lampblack::chemistry {

namespace {

YAML::Node parseFile(const std::string& path) {
  const std::string content = readTextFile(path, "a mechanism");
  try {
    return YAML::Load(content);
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}:{}: not valid YAML: {}", path, error.mark.line + 1, error.msg));
  }
}

// "- units: {...}" alone, as the first entry, holds for the whole list.
bool isUnitsEntry(const YAML::Node& entry) {
  return entry.IsMap() && entry.size() == 1 && entry.begin()->first.IsScalar() &&
         entry.begin()->first.Scalar() == "units";
}

std::vector<std::string_view> sectionNames(const YAML::Node& root) {
  std::vector<std::string_view> names;
  for (const auto& entry : root)
    if (entry.first.IsScalar() && entry.second.IsSequence()) names.push_back(entry.first.Scalar());
  return names;
}

}  // namespace

MechanismFiles::MechanismFiles(const std::string& path) : main_(load(path)) {}

const MechanismFile* MechanismFiles::load(const std::string& path) {
  auto& file = files_[path];
  if (!file) {
    const YamlAccess yaml(path);
    const YAML::Node root = parseFile(path);
    yaml.requireMap(root, "mechanism file");
    const YAML::Node units = root["units"];
    file = std::make_unique<MechanismFile>(
        MechanismFile{yaml, root, units.IsDefined() ? yaml.units(units, {}) : UnitSystem{}});
  }
  return file.get();
}

const MechanismSection& MechanismFiles::section(const std::string& name, std::string_view key,
                                                const YAML::Node& where) {
  auto [place, isNew] = sections_.try_emplace({name, std::string(key)});
  auto& section = place->second;
  if (!isNew) return section;
  section.file = main_;
  auto inFile = name;
  if (const auto slash = name.rfind('/'); slash != std::string::npos) {
    const auto path = std::filesystem::path(main_->yaml.file()).parent_path() / name.substr(0, slash);
    if (std::error_code error; !std::filesystem::is_regular_file(path, error))
      main_->yaml.fail(where,
                       fmt::format("section '{}' is in another file, but there is no file {}", name, path.string()));
    section.file = load(path.string());
    inFile = name.substr(slash + 1);
  }
  const auto& [yaml, root, units] = *section.file;
  const YAML::Node list = root[inFile];
  if (!list.IsDefined())
    main_->yaml.fail(where, fmt::format("there is no section '{}' in {}; the nearest name is '{}'", inFile, yaml.file(),
                                        closestName(inFile, sectionNames(root))));
  yaml.requireSequence(list, inFile);
  section.units = units;
  bool first = true;
  for (const auto& entry : list) {
    if (std::exchange(first, false) && isUnitsEntry(entry)) {
      section.units = yaml.units(entry["units"], units);
      continue;
    }
    if (!key.empty()) {
      yaml.requireMap(entry, inFile);
      const YAML::Node named = entry[std::string(key)];
      if (!named.IsDefined()) yaml.fail(entry, fmt::format("an entry of {} has no '{}'", inFile, key));
      section.names.push_back(yaml.text(named, fmt::format("{} of {}", key, inFile)));
      if (!section.byName.emplace(section.names.back(), section.entries.size()).second)
        yaml.fail(entry, fmt::format("'{}' is declared twice in {}", section.names.back(), inFile));
    }
    section.entries.push_back(entry);
  }
  return section;
}

}  // namespace lampblack::chemistry
