// What `lampblack gas` prints: one JSON object (docs/formats.md) or tables for people.
#pragma once

#include <string>

#include "app/shell/tools/gas_report.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

std::string gasJson(const Mechanism& mechanism, const GasReport& gas);

struct GasTables {
  bool allSpecies = false;  // also those that are neither present nor produced
  bool reactions = false;   // rate constants
};

std::string gasText(const Mechanism& mechanism, const GasReport& gas, const GasTables& tables);

}  // namespace lampblack::app
