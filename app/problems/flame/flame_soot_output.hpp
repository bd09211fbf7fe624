// What is looked at in a sooting flame: the soot's scalars, properties, processes and sizes over z, and the few numbers
// that studies compare.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "coupling/carried_particles.hpp"
#include "flow/flame/flame_fields.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

// A number that names the flame: as attribute of /flame, in run.json and so in the tables of studies.
struct NamedNumber {
  std::string name;  // "flame_speed"
  std::string unit;  // "m/s"; "1" for a plain number
  double value = 0;
};

// One value a point.
struct FlameSootFields {
  struct Field {
    std::string name, unit, description;
    std::vector<double> values;
  };
  std::vector<Field> scalars, properties, processes;
  // dN/dlog10(d), point-major, at the diameters; both empty where the model has none.
  std::vector<double> diameter, sizeDistribution;
  // Largest volume fraction in particles that cannot grow any more (ParticleModel::volumeFractionAtLimit), over the
  // largest of all.
  double partAtLimit = 0;

  [[nodiscard]] const Field& property(const std::string& name) const;
};

[[nodiscard]] FlameSootFields flameSootFields(const Mechanism& mechanism, double pressure, const CarriedParticles& soot,
                                              const FlameProfile& profile, const FlameFields& gas);

[[nodiscard]] std::vector<NamedNumber> namedSootNumbers(const FlameFields& gas, const FlameSootFields& soot);

// Collective: /flame/soot.
void writeFlameSoot(ResultsWriter& results, const FlameSootFields& soot);

}  // namespace lampblack::app
