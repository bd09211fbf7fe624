// A soot particle of a stochastic population: carbon, hydrogen and number of equal primary particles. As a type of
// particles it goes through every Monte Carlo method of population/.
//
// Aggregates keep their primaries: coagulation adds them up, growth and oxidation change their diameter. Mobility and
// gyration diameter follow from primaries (Wang 2025, eqs. 9-21, 9-22), and aggregates collide with the larger of the
// two. Coalescing spheres have one primary for ever.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"

namespace lampblack::particles {

class SootAggregate {
 public:
  static constexpr bool moreThanVolume = true;  // see particle_type.hpp

  struct Particle {
    double carbon, hydrogen;  // kg
    double primaries;
    double diameter;  // m, of collision
  };

  // Density in kg/m3.
  SootAggregate(double density, bool coalescing) : density_(density), coalescing_(coalescing) {}

  [[nodiscard]] Particle make(double carbon, double hydrogen, double primaries) const {
    Particle p{carbon, hydrogen, coalescing_ ? 1 : primaries, 0};
    p.diameter = primaryDiameter(p) * collisionFactor(p.primaries);
    return p;
  }

  [[nodiscard]] double density() const { return density_; }
  [[nodiscard]] bool coalescing() const { return coalescing_; }
  // The cube of the diameter of the primaries is this times the mass over their number, m3/kg.
  [[nodiscard]] double perVolume() const { return 6 / constants::pi / density_; }
  [[nodiscard]] static double mass(const Particle& p) { return p.carbon + p.hydrogen; }
  [[nodiscard]] double volume(const Particle& p) const { return mass(p) / density_; }
  [[nodiscard]] double collisionDiameter(const Particle& p) const { return p.diameter; }
  [[nodiscard]] double primaryDiameter(const Particle& p) const {
    return cubeRoot(perVolume() * mass(p) / p.primaries);
  }
  [[nodiscard]] double surface(const Particle& p) const {
    const double d = primaryDiameter(p);
    return constants::pi * d * d * p.primaries;
  }
  [[nodiscard]] double mobilityDiameter(const Particle& p) const {
    return primaryDiameter(p) * mobilityFactor(p.primaries);
  }

  // Diameters over that of the primaries.
  [[nodiscard]] static double mobilityFactor(double primaries) {
    return primaries > 1 ? std::pow(primaries, 0.45) : 1;  // Wang (2025), eq. 9-21
  }
  [[nodiscard]] static double collisionFactor(double primaries) {
    if (primaries <= 1) return 1;
    // The gyration diameter is the larger one from 13 primaries on; below it is not, nor in the branch for 1.8 or less.
    return std::pow(primaries, 0.45) * std::max(1.0, 1 / (std::pow(primaries, -0.2) + 0.4));
  }

  // What methods need besides (particle_type.hpp). Soot grows by a law of its own, not by grown().
  [[nodiscard]] Particle make(double volume) const { return make(volume * density_, 0, 1); }
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q) const {
    return make(p.carbon + q.carbon, p.hydrogen + q.hydrogen, p.primaries + q.primaries);
  }
  // With `times` of q.
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q, double times) const {
    return make(p.carbon + times * q.carbon, p.hydrogen + times * q.hydrogen, p.primaries + times * q.primaries);
  }
  [[nodiscard]] Particle mean(const Particle& p, double wp, const Particle& q, double wq) const {
    const double a = wp / (wp + wq), b = wq / (wp + wq);
    return make(a * p.carbon + b * q.carbon, a * p.hydrogen + b * q.hydrogen,
                p.primaries + b * (q.primaries - p.primaries));  // of equal ones to the last bit
  }
  [[nodiscard]] Particle fragment(const Particle& p, double fraction) const {
    return make(fraction * p.carbon, fraction * p.hydrogen, std::max(1.0, fraction * p.primaries));
  }
  [[nodiscard]] Particle grown(const Particle& p, double, double, double) const { return p; }

 private:
  double density_;
  bool coalescing_;
};

static_assert(ParticleType<SootAggregate>);

}  // namespace lampblack::particles
