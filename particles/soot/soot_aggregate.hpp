// A soot particle of a stochastic population: carbon, hydrogen and number of equal primary particles. As a type of
// particles it goes through every Monte Carlo method of population/.
//
// Aggregates keep their primaries: coagulation adds them up, growth and oxidation change their diameter. Mobility and
// gyration diameter follow from primaries (Wang 2025, eqs. 9-21, 9-22), and aggregates collide with the larger of the
// two. Coalescing spheres have one primary for ever.
//
// Particles by volume and surface (Patterson, Kraft 2007; MOpS) stand as n = S^3/(36 pi V^2) primaries of 6V/S, no
// whole number. Coagulation adds volumes and surfaces up; growth and oxidation change them by primariesAfter(). They
// collide with the mean of the diameters of the spheres of their volume and of their surface, or as fractals,
// d_p n^(1/D_f).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"

namespace lampblack::particles {

enum class SootShape { spheres, aggregates, surfaceVolume };

class SootAggregate {
 public:
  static constexpr bool moreThanVolume = true;  // see particle_type.hpp

  struct Particle {
    double carbon, hydrogen;  // kg
    double primaries;
    double diameter;  // m, of collision
  };

  // Density in kg/m3. `fractalDimension`: D_f of particles by volume and surface; 0: they collide with the mean.
  SootAggregate(double density, SootShape shape, double fractalDimension = 0)
      : density_(density), inverseDimension_(fractalDimension > 0 ? 1 / fractalDimension : 0), shape_(shape) {}
  SootAggregate(double density, bool coalescing)
      : SootAggregate(density, coalescing ? SootShape::spheres : SootShape::aggregates) {}

  // Inline in any case, with what it calls: a packed particle is made again to the bits that its growth left, which
  // code of other options of the compiler would not.
  [[nodiscard, gnu::always_inline]] inline Particle make(double carbon, double hydrogen, double primaries) const {
    Particle p{carbon, hydrogen, coalescing() ? 1 : primaries, 0};
    p.diameter = primaryDiameter(p) * shapeFactor(p.primaries);
    return p;
  }

  // Makes n particles whose diameters are not there yet: f(k) is that one. To the bits of make(), in vector lanes where
  // they are spheres.
  template <class F>
  void findDiameters(std::size_t n, F f) const {
    constexpr std::size_t block = 64;
    double diameter[block];
    for (std::size_t k = 0; k < n && !coalescing(); ++k) f(k) = make(f(k).carbon, f(k).hydrogen, f(k).primaries);
    for (std::size_t first = 0; first < n && coalescing(); first += block) {
      const std::size_t count = std::min(block, n - first);
      for (std::size_t k = 0; k < count; ++k) diameter[k] = perVolume() * mass(f(first + k));
      takeRoots(diameter, count);
      for (std::size_t k = 0; k < count; ++k) {
        f(first + k).primaries = 1;
        f(first + k).diameter = diameter[k];
      }
    }
  }
  // Lengths (m) in place of n cubes of them (m3).
  static void takeRoots(double* cubes, std::size_t n) {
    double least = 1;
    for (std::size_t k = 0; k < n; ++k) least = std::min(least, cubes[k]);
    if (least > leastCube)
      for (std::size_t k = 0; k < n; ++k) cubes[k] = normalCubeRoot(cubes[k]);
    else
      for (std::size_t k = 0; k < n; ++k) cubes[k] = cubeRoot(cubes[k]);
  }

  [[nodiscard]] double density() const { return density_; }
  [[nodiscard]] SootShape shape() const { return shape_; }
  [[nodiscard]] bool coalescing() const { return shape_ == SootShape::spheres; }
  // The cube of the diameter of the primaries is this times the mass over their number, m3/kg.
  [[nodiscard]] double perVolume() const { return 6 / constants::pi / density_; }
  [[nodiscard]] static double mass(const Particle& p) { return p.carbon + p.hydrogen; }
  [[nodiscard]] double volume(const Particle& p) const { return mass(p) / density_; }
  [[nodiscard]] double collisionDiameter(const Particle& p) const { return p.diameter; }
  [[nodiscard, gnu::always_inline]] inline double primaryDiameter(const Particle& p) const {
    // Spheres have one: no division that an event would wait for.
    const double cube = coalescing() ? perVolume() * mass(p) : perVolume() * mass(p) / p.primaries;
    return cube > leastCube ? normalCubeRoot(cube) : std::cbrt(cube);
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

  // Diameter of collision over that of the primaries.
  [[nodiscard, gnu::always_inline]] inline double shapeFactor(double primaries) const {
    if (shape_ != SootShape::surfaceVolume) return collisionFactor(primaries);
    return inverseDimension_ > 0 ? std::pow(primaries, inverseDimension_)
                                 : 0.5 * (normalCubeRoot(primaries) + std::sqrt(primaries));
  }
  // By how much the diameter of collision follows a gain of volume, over a third: 1 where the primaries stay.
  [[nodiscard]] double shapeGain(double primaries) const {
    if (shape_ != SootShape::surfaceVolume) return 1;
    const double root = std::sqrt(primaries), third = cubeRoot(primaries);
    if (inverseDimension_ > 0) return 3 - 6 * inverseDimension_ + (6 * inverseDimension_ - 2) / root;
    return (third + 1) / (third + root);
  }

  // What methods need besides (particle_type.hpp). Soot grows by a law of its own, not by grown().
  [[nodiscard]] Particle make(double volume) const { return make(volume * density_, 0, 1); }
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q) const {
    const double carbon = p.carbon + q.carbon, hydrogen = p.hydrogen + q.hydrogen;
    if (shape_ == SootShape::surfaceVolume)
      return make(carbon, hydrogen, primariesOf(carbon + hydrogen, surfaceMeasure(p) + surfaceMeasure(q)));
    return make(carbon, hydrogen, p.primaries + q.primaries);
  }
  // With `times` of q.
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q, double times) const {
    const double carbon = p.carbon + times * q.carbon, hydrogen = p.hydrogen + times * q.hydrogen;
    if (shape_ == SootShape::surfaceVolume)
      return make(carbon, hydrogen, primariesOf(carbon + hydrogen, surfaceMeasure(p) + times * surfaceMeasure(q)));
    return make(carbon, hydrogen, p.primaries + times * q.primaries);
  }
  // By volume and surface the mean of unlike particles can have less surface than a sphere: it is one then.
  [[nodiscard]] Particle mean(const Particle& p, double wp, const Particle& q, double wq) const {
    const double a = wp / (wp + wq), b = wq / (wp + wq);
    const double carbon = a * p.carbon + b * q.carbon, hydrogen = a * p.hydrogen + b * q.hydrogen;
    if (shape_ == SootShape::surfaceVolume)
      return make(carbon, hydrogen, primariesOf(carbon + hydrogen, a * surfaceMeasure(p) + b * surfaceMeasure(q)));
    return make(carbon, hydrogen, p.primaries + b * (q.primaries - p.primaries));  // of equal ones to the last bit
  }
  [[nodiscard]] Particle fragment(const Particle& p, double fraction) const {
    return make(fraction * p.carbon, fraction * p.hydrogen, std::max(1.0, fraction * p.primaries));
  }
  [[nodiscard]] Particle grown(const Particle& p, double, double, double) const { return p; }

 private:
  // Surface over what a sphere of 1 kg has, kg^(2/3), and the primaries of a mass with it.
  [[nodiscard]] static double surfaceMeasure(const Particle& p) {
    const double m = cubeRoot(mass(p));
    return cubeRoot(p.primaries) * m * m;
  }
  [[nodiscard]] static double primariesOf(double mass, double measure) {
    const double perMass = measure / mass;  // no powers that underflow
    return std::max(1.0, perMass * perMass * measure);
  }

  static constexpr double leastCube = 1e-290;  // m3, of normalCubeRoot()
  double density_, inverseDimension_;
  SootShape shape_;
};

static_assert(ParticleType<SootAggregate>);

}  // namespace lampblack::particles
