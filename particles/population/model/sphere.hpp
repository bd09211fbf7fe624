// Coalescing spheres of one density: the particle is its volume.
#pragma once

#include <cmath>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {

class Sphere {
 public:
  struct Particle {
    double volume;  // m3
  };

  explicit Sphere(double density) : density_(density) {}  // kg/m3

  [[nodiscard]] double volume(const Particle& p) const { return p.volume; }
  [[nodiscard]] double mass(const Particle& p) const { return density_ * p.volume; }
  [[nodiscard]] double collisionDiameter(const Particle& p) const { return cubeRoot(6 / constants::pi * p.volume); }
  [[nodiscard]] double surface(const Particle& p) const {
    const double d = collisionDiameter(p);
    return constants::pi * d * d;
  }

  [[nodiscard]] Particle make(double volume) const { return {volume}; }
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q) const { return {p.volume + q.volume}; }
  [[nodiscard]] Particle mean(const Particle& p, double wp, const Particle& q, double wq) const {
    return {(wp * p.volume + wq * q.volume) / (wp + wq)};
  }
  [[nodiscard]] Particle fragment(const Particle& p, double fraction) const { return {fraction * p.volume}; }
  // The diameter obeys dd/dt = condensation d / 3 + 2 surface, which is linear.
  [[nodiscard]] Particle grown(const Particle& p, double condensation, double surface, double dt) const {
    const double e = std::expm1(condensation * dt / 3);
    if (surface == 0) return {p.volume * (1 + e) * (1 + e) * (1 + e)};
    const double d = collisionDiameter(p);
    const double end = d * (1 + e) + 2 * surface * (condensation != 0 ? 3 * e / condensation : dt);
    return {end > 0 ? constants::pi / 6 * end * end * end : 0.0};
  }

 private:
  double density_;
};

}  // namespace lampblack::particles
