// A ParticleModel, sections or moments, along a path through a gas that is known and does not change by what the
// particles take.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/rooms.hpp"
#include "particles/ensemble/ensemble_path.hpp"
#include "particles/models/particle_model.hpp"

namespace lampblack::coupling {

struct ModelRecord {
  std::vector<double> densities;  // of the scalars, per m3
  ParticleProperties properties;
  ParticleProcesses processes;
  SizeDistribution sizes;
};

struct ModelAlong {
  std::vector<ModelRecord> records;  // one a recorded point
  long steps = 0;                    // of the model's integrator
};

// From no particles. `recorded`: points of the path, rising. In each constant state of the gas (`division`) particles
// are diluted for half of it, change, and are diluted for the other half: second order. InputError as marchPath();
// NumericsError where the model's integrator fails.
[[nodiscard]] ModelAlong marchModel(const ParticleModel& model, const ParticlePath& path,
                                    std::span<const std::size_t> recorded, GasDivision division = {});

}  // namespace lampblack::coupling
