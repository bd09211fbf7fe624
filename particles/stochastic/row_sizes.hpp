// How the particles of packed populations stand, and what the first values of a row say of their sizes.
#pragma once

#include "core/modules.hpp"
#include "particles/soot/soot_aggregate.hpp"
#include "particles/stochastic/particle_rows.hpp"

namespace lampblack::particles {

struct RowSizes {
  SootAggregate type;
  ParticleRows rows;

  [[nodiscard]] SootAggregate::Particle particle(const double* row) const {
    const GivenParticle p = particleAt(row);
    return type.make(p.carbon, p.hydrogen, p.primaries);
  }
  [[nodiscard]] double mobilityDiameter(const double* row) const {  // m
    return type.mobilityDiameter(particle(row));
  }
};

}  // namespace lampblack::particles
