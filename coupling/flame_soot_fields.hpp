// What is looked at in a sooting flame: the soot's scalars, properties, processes and sizes over z.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "coupling/carried_particles.hpp"
#include "flow/flame/flame_fields.hpp"

namespace lampblack::coupling {

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

}  // namespace lampblack::coupling
