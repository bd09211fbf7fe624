// Aggregates by volume and surface (Kraft 2022, "surface-volume models"). An aggregate is thought of as n_p equal
// primaries of diameter d_p,
//
//   d_p = 6 V / S,  n_p = S^3 / (36 pi V^2),  d_c = d_p n_p^(1/D_f),
//
// with a fractal dimension D_f that is assumed. Coagulation adds volumes and surfaces. Growth leaves n_p as it is, so
// that S goes with V^(2/3). Sintering takes the surface to that of a sphere, dS/dt = -(S - S_sphere)/tau (Koch and
// Friedlander 1990). The mean of unlike particles can have less surface than a sphere, as the sum of surfaces is
// conserved: its n_p and d_c are those of a sphere.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"

namespace lampblack::particles {

// n_p of a particle of the size `size` (volume, or mass) after a gain and a loss of size at the same time: what comes
// grows on a sphere of the particle's surface, dS = 2 dV / sqrt(S/(4 pi)), so that sqrt(n_p) V + gain stays, and what
// goes leaves the primaries there are, dS = 2/3 S/V dV (Patterson, Kraft 2007, and the program MOpS). Half of the loss
// is before and half behind the gain.
[[nodiscard]] inline double primariesAfter(double primaries, double size, double gain, double loss) {
  const double there = std::max(size - 0.5 * loss, 0.5 * size);
  const double root = (std::sqrt(primaries) * there + gain) / (there + gain);
  return root * root;
}

class SurfaceVolume {
 public:
  static constexpr bool moreThanVolume = true;  // see particle_type.hpp

  struct Particle {
    double volume;   // m3
    double surface;  // m2
  };

  // Density in kg/m3, fractal dimension in [1, 3], sintering time in s (infinite: no sintering). Throws InputError.
  // Sintering takes place in grown(): see GrowthOptions::always.
  explicit SurfaceVolume(double density, double fractalDimension = 1.8,
                         double sinteringTime = std::numeric_limits<double>::infinity());

  [[nodiscard]] double fractalDimension() const { return 1 / inverseDimension_; }
  [[nodiscard]] double volume(const Particle& p) const { return p.volume; }
  [[nodiscard]] double mass(const Particle& p) const { return density_ * p.volume; }
  [[nodiscard]] double surface(const Particle& p) const { return p.surface; }
  [[nodiscard]] double primaryDiameter(const Particle& p) const { return 6 * p.volume / p.surface; }
  [[nodiscard]] double primaries(const Particle& p) const {
    const double perVolume = p.surface / p.volume;  // no powers that underflow
    return std::max(1.0, perVolume * perVolume * p.surface / (36 * constants::pi));
  }
  [[nodiscard]] double collisionDiameter(const Particle& p) const {
    const double number = primaries(p);
    return number > 1 ? primaryDiameter(p) * std::pow(number, inverseDimension_)
                      : cubeRoot(6 / constants::pi * p.volume);
  }

  [[nodiscard]] Particle make(double volume) const { return {volume, sphereSurface(volume)}; }
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q) const {
    return {p.volume + q.volume, p.surface + q.surface};
  }
  [[nodiscard]] Particle mean(const Particle& p, double wp, const Particle& q, double wq) const {
    const double w = 1 / (wp + wq);
    return {(wp * p.volume + wq * q.volume) * w, (wp * p.surface + wq * q.surface) * w};
  }
  // Surface goes with volume as long as there are primaries to share out; breaking a primary makes new surface.
  [[nodiscard]] Particle fragment(const Particle& p, double fraction) const {
    const double volume = fraction * p.volume;
    return {volume, std::max(fraction * p.surface, sphereSurface(volume))};
  }
  [[nodiscard]] Particle enlarged(const Particle& p, double change) const {  // with the primaries there are
    const double ratio = cubeRoot((p.volume + change) / p.volume);
    return {p.volume + change, p.surface * ratio * ratio};
  }
  // The diameter of the primaries obeys dd/dt = condensation d / 3 + 2 surface; sintering is split off, half of it
  // before and half of it after.
  [[nodiscard]] Particle grown(const Particle& p, double condensation, double surface, double dt) const;

 private:
  [[nodiscard]] static double sphereSurface(double volume) {
    const double d = cubeRoot(6 / constants::pi * volume);
    return constants::pi * d * d;
  }

  double density_, inverseDimension_, sinteringTime_;
};

static_assert(ParticleType<SurfaceVolume>);

}  // namespace lampblack::particles
