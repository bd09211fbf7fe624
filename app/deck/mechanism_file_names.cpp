#include "app/deck/mechanism_file_names.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "app/run/shipped_files.hpp"
#include "chemistry/chemkin/chemkin_reader.hpp"
#include "core/errors.hpp"

namespace lampblack::app {

bool isYaml(const std::string& path) {
  const auto extension = std::filesystem::path(path).extension();
  return extension == ".yaml" || extension == ".yml";
}

Mechanism readMechanism(const MechanismFileNames& files) {
  if (!isYaml(files.mechanism)) {
    if (!files.phase.empty())
      throw InputError(
          fmt::format("--phase: phases are those of YAML files, by the endings .yaml and .yml; found '{}' "
                      "and the phase '{}'",
                      files.mechanism, files.phase));
    const auto optional = [](const std::string& path) { return path.empty() ? std::nullopt : std::optional(path); };
    return readChemkin({files.mechanism, optional(files.thermo), optional(files.transport), files.permissive});
  }
  if (!files.thermo.empty())
    throw InputError(
        fmt::format("{} is YAML, which holds thermodynamic and transport data itself; expected no further "
                    "file, found '{}'",
                    files.mechanism, files.thermo));
  return Mechanism::fromFile(findMechanism({}, files.mechanism), files.phase, files.permissive);
}

}  // namespace lampblack::app
