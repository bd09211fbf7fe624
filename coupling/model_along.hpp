// A ParticleModel, sections or moments, along a path through a gas that is known and changes by what the particles take
// of some species alone.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/gas/gas_path.hpp"
#include "particles/models/particle_model.hpp"

namespace lampblack::coupling {

struct ModelRecord {
  std::vector<double> densities;  // of the scalars, per m3
  ParticleProperties properties;
  ParticleProcesses processes;
  SizeDistribution sizes;
  std::vector<double> depleted;  // mol/m3, what the gas has of these species
};

struct ModelAlong {
  std::vector<ModelRecord> records;  // one a recorded point
  long steps = 0;                    // of the model's integrator
};

// From no particles. `recorded`: points of the path, rising. `depleted`: species of the model, of which the gas makes
// as much as the path says or loses as large a part (gas_along.hpp); all others are as the path has them. In each
// constant state of the gas (`division`) particles are diluted for half of it, change, and are diluted for the other
// half: second order. InputError as marchPath(); NumericsError where the model's integrator fails.
[[nodiscard]] ModelAlong marchModel(const ParticleModel& model, const ParticlePath& path,
                                    std::span<const std::size_t> recorded, std::span<const std::size_t> depleted = {},
                                    GasDivision division = {});

}  // namespace lampblack::coupling
