// How the particles of packed populations stand, and what the first values of a row say of their sizes.
#pragma once

#include <span>

#include "core/modules.hpp"
#include "particles/soot/soot_aggregate.hpp"
#include "particles/stochastic/particle_rows.hpp"
#include "particles/stochastic/size_bins.hpp"

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

// Of a packed population: adds dN/dlog10(d) (1/m3) by mobility diameter.
void addSizes(const RowSizes& of, const SizeBins& bins, std::span<const double> population, std::span<double> density);
// Of the mobility diameter by number; 1 where there are no particles.
[[nodiscard]] double geometricDeviation(const RowSizes& of, std::span<const double> population);

}  // namespace lampblack::particles
