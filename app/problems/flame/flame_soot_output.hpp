// What is looked at in a sooting flame: the soot's scalars, properties, processes and sizes over z, and the few numbers
// that studies compare.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "coupling/flame_soot_fields.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

// A number that names the flame: as attribute of /flame, in run.json and so in the tables of studies.
struct NamedNumber {
  std::string name;  // "flame_speed"
  std::string unit;  // "m/s"; "1" for a plain number
  double value = 0;
};

[[nodiscard]] std::vector<NamedNumber> namedSootNumbers(const FlameFields& gas, const FlameSootFields& soot);

// Collective: /flame/soot.
void writeFlameSoot(ResultsWriter& results, const FlameSootFields& soot);

}  // namespace lampblack::app
