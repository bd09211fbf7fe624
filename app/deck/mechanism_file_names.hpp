// A mechanism as a command line names it: one YAML file, or up to three CHEMKIN files.
#pragma once

#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

struct MechanismFileNames {
  std::string mechanism;          // YAML by its ending (.yaml, .yml), else CHEMKIN
  std::string thermo, transport;  // CHEMKIN data in files of their own; empty if not given
  std::string phase;              // of a YAML file; empty: the first ideal gas
  bool permissive = false;        // as in MechanismRules
};

inline constexpr const char* permissiveHelp =
    "Mark reactions that are the same as duplicates, and leave out efficiencies of species that are not declared, with "
    "a warning each; otherwise both are errors.";

bool isYaml(const std::string& path);

// InputError, also where a YAML file comes with others, and a CHEMKIN file with a phase.
Mechanism readMechanism(const MechanismFileNames& files);

}  // namespace lampblack::app
