// What models share that see soot as equal spheres, carried as number and mass: size, surface, diffusion, and rates in
// states that no soot is in, which iterates of Newton's method visit all the same. Such a state counts as the nearest
// one that soot can be in, with which all derivatives stay bounded.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/modules.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/soot/soot_oxidation.hpp"

namespace lampblack::particles {

class EqualSpheres {
 public:
  // kg/m3 and kg; `nucleus` is the mass of the smallest particle.
  EqualSpheres(double density, double nucleus) : density_(density), nucleus_(nucleus) {}

  [[nodiscard]] double density() const { return density_; }

  // The mass (kg/m3) whose rates are taken: particles that no mass is left of are still nuclei, and go as fast as these
  // burn. Were they to stay, their rate would jump where the last of the mass goes.
  [[nodiscard]] static double possibleMass(double number, double mass) {
    return std::max(mass, number > 0 ? leastMass : 0.0);
  }

  // The number (1/m3) whose rates are taken where there are `number` particles and `mass` (kg/m3): no mean particle is
  // smaller than a nucleus or larger than 1e12 of them (some 10 um).
  [[nodiscard]] double possibleNumber(double number, double mass) const {
    const double inNuclei = std::max(mass, 0.0) / nucleus_;
    return std::clamp(number, inNuclei * 1e-12, inNuclei);
  }

  // Of the mean sphere, m; zero without soot.
  [[nodiscard]] double diameter(double number, double mass) const {
    return mass > 0 && number > 0 ? cubeRoot(6 * mass / (constants::pi * density_ * number)) : 0;
  }
  // m2/m3
  [[nodiscard]] double surface(double number, double mass) const {
    const double d = diameter(number, mass);
    return constants::pi * d * d * std::max(number, 0.0);
  }

  // Particles that vanish of the `present` ones, 1/m3/s, where `oxidised` of the mass goes and `gained` comes to the
  // particles there are (kg/m3/s). Spheres of shrinking size never vanish by themselves: of a share of the mass lost on
  // balance this share of the number goes, all of it where the mean particle is a nucleus, none where it is much
  // larger.
  [[nodiscard]] double burntOut(double present, double possible, double mass, double oxidised, double gained) const {
    if (!(mass > 0)) return 0;
    const double nucleusInMean = possible * nucleus_ / mass;
    return oxidised / mass * netOxidation(oxidised, gained) * present * nucleusInMean * nucleusInMean;
  }

  // Brownian diffusivity, m2/s, of the mean sphere, at least a nucleus in size.
  [[nodiscard]] double diffusivity(const CarrierGas& gas, double number, double mass) const {
    return brownianDiffusivity(gas, std::max(diameter(number, mass), diameter(1, nucleus_)));
  }

  // Of densities as they are, negative ones being zero.
  [[nodiscard]] ParticleProperties properties(double number, double mass) const {
    const double possible = possibleNumber(number, mass);
    ParticleProperties out;
    out.numberDensity = std::max(number, 0.0);
    out.volumeFraction = std::max(mass, 0.0) / density_;
    out.meanDiameter = diameter(possible, mass);
    out.surfaceArea = surface(possible, mass);
    out.primaryDiameter = out.meanDiameter;
    out.primariesPerAggregate = 1;
    out.mobilityDiameter = out.meanDiameter;
    out.gyrationDiameter = std::sqrt(0.6) * out.meanDiameter;  // of a solid sphere
    return out;
  }

 private:
  static constexpr double leastMass = 1e-60;  // kg/m3, far less than one atom in any domain
  double density_, nucleus_;
};

}  // namespace lampblack::particles
