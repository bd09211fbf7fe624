// The lists a Cantera YAML file consists of (species, reactions, elements, or sections of any name), with the units
// that hold for each entry, and sections of other files.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "chemistry/mechanism/yaml_access.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// A file as it was read. Nodes and YamlAccess live as long as the MechanismFiles that loaded it.
struct MechanismFile {
  YamlAccess yaml;
  YAML::Node root;
  UnitSystem units;
};

struct MechanismSection {
  const MechanismFile* file = nullptr;
  UnitSystem units;
  std::vector<YAML::Node> entries;
  // Entries by the text of `key` ("name", "symbol"), each once; empty for a section read without a key.
  std::unordered_map<std::string_view, std::size_t> byName;
  std::vector<std::string_view> names;
};

class MechanismFiles {
 public:
  // Reads and parses the file. InputError if that is not possible or its units make no sense.
  explicit MechanismFiles(const std::string& path);

  const MechanismFile& main() const { return *main_; }
  // "reactions", or "other.yaml/reactions" with a path relative to the folder of the main file. InputError at `where`,
  // a node of the main file, if there is no such section. A `key` other than empty names the entries; two entries of
  // one name are an error.
  const MechanismSection& section(const std::string& name, std::string_view key, const YAML::Node& where);
  bool hasSection(const char* name) const { return main().root[name].IsDefined(); }

 private:
  const MechanismFile* load(const std::string& path);

  std::map<std::string, std::unique_ptr<MechanismFile>> files_;
  const MechanismFile* main_ = nullptr;
  std::map<std::pair<std::string, std::string>, MechanismSection> sections_;  // by name and key
};

}  // namespace lampblack::chemistry
