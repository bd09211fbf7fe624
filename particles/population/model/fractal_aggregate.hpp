// Aggregates of equal primary particles in point contact: the particle is its volume. Up to the volume of one primary
// it is a sphere; above, its primaries are V/V_p, its surface theirs, and its collision diameter that of a fractal,
// d_c = d_p (V/V_p)^(1/D_f). Growth adds primaries, as their diameter is fixed: a type for coagulation first of all.
#pragma once

#include <cmath>

#include "core/constants.hpp"
#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/sphere.hpp"

namespace lampblack::particles {

class FractalAggregate {
 public:
  using Particle = Sphere::Particle;

  // Density in kg/m3, primary diameter in m, fractal dimension in [1, 3]. Throws InputError.
  FractalAggregate(double density, double primaryDiameter, double fractalDimension = 1.8);

  [[nodiscard]] double fractalDimension() const { return 1 / inverseDimension_; }
  [[nodiscard]] double volume(const Particle& p) const { return p.volume; }
  [[nodiscard]] double mass(const Particle& p) const { return sphere_.mass(p); }
  [[nodiscard]] double collisionDiameter(const Particle& p) const {
    if (p.volume <= primaryVolume_) return sphere_.collisionDiameter(p);
    return primaryDiameter_ * std::pow(p.volume / primaryVolume_, inverseDimension_);
  }
  [[nodiscard]] double surface(const Particle& p) const {
    return p.volume <= primaryVolume_ ? sphere_.surface(p) : 6 * p.volume / primaryDiameter_;
  }

  [[nodiscard]] Particle make(double volume) const { return {volume}; }
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q) const { return sphere_.coagulated(p, q); }
  [[nodiscard]] Particle mean(const Particle& p, double wp, const Particle& q, double wq) const {
    return sphere_.mean(p, wp, q, wq);
  }
  [[nodiscard]] Particle fragment(const Particle& p, double fraction) const { return sphere_.fragment(p, fraction); }
  // Exponential above one primary, where the surface goes with the volume, and as a sphere below.
  [[nodiscard]] Particle grown(const Particle& p, double condensation, double surface, double dt) const;

 private:
  Sphere sphere_;
  double primaryDiameter_, primaryVolume_, inverseDimension_;
};

static_assert(ParticleType<FractalAggregate>);

}  // namespace lampblack::particles
