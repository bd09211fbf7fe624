// What one step of growth does to one particle, without a branch: the loop over many particles (soot_columns.hpp) is
// compiled to vector instructions, the loop over the steps of one (SootMedium::grow) calls the same.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/modules.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/soot/dimer.hpp"

namespace lampblack::particles {

// Of every particle alike: what a step of growth starts from.
struct SootFluxes {
  double condensation = 0;    // dimers per volume times the prefactor of their collisions
  double growth = 0, O2 = 0;  // kg carbon/m2/s with all sites active (alpha = 1)
  double OH = 0;              // kg carbon/m2/s
  double alpha = 0;           // fraction of active sites
};

class SootGrowth {
 public:
  // `dimerCarbon`, `dimerHydrogen`: kg in a dimer; `leastCarbon`: kg, of the smallest particle that burns on;
  // `inertia`: of particles in collisions with dimers, 1 or 0.
  SootGrowth(const SootFluxes& fluxes, double density, const DimerProduction& dimer, double dimerCarbon,
             double dimerHydrogen, double leastCarbon, double inertia = 1)
      : gain_(fluxes.alpha * fluxes.growth),
        lossO2_(fluxes.alpha * fluxes.O2),
        lossOH_(fluxes.OH),
        density_(density),
        dimerCarbon_(dimerCarbon),
        dimerHydrogen_(dimerHydrogen),
        dimerMass_(dimerCarbon + dimerHydrogen),
        dimerDiameter_(dimer.diameter),
        leastCarbon_(leastCarbon),
        inertia_(inertia),
        sixPerDensity_(inertia * (6 / density)) {
    if (!(dimerMass_ > 0)) return;
    condensation_ = dimerMass_ * fluxes.condensation;
    perDimer_ = 1 / dimerMass_;
    dimerFraction_ = dimerHydrogen / dimerMass_;
    inverseDimer_ = 1 / dimer.mass;
  }

  [[nodiscard]] double leastCarbon() const { return leastCarbon_; }
  [[nodiscard]] double oxidation() const { return lossO2_ + lossOH_; }  // kg carbon/m2/s
  [[nodiscard]] double shareO2() const {                                // of what oxidation takes
    return lossO2_ > 0 ? lossO2_ / (lossO2_ + lossOH_) : 0;
  }

  // What a particle takes up, kg/s, as step() of it.
  [[nodiscard, gnu::always_inline]] inline double gain(double mass, double n, double shape, double d) const {
    return condensing(shape * d, inertia_ / mass) + gain_ * (n * constants::pi * d * d);
  }

  struct Step {
    double length;            // s; shorter than asked for where the diameter would change by more than a half
    double carbon, hydrogen;  // kg, of the particle at the end
    double dimers, growth, oxidationO2, oxidationOH, hydrogenO2, hydrogenOH;  // as SootTransfer
  };
  // By the midpoint rule for the diameter of the primaries, `d` at the start; `shape`: collision diameter over it.
  [[nodiscard, gnu::always_inline]] inline Step step(double carbon, double hydrogen, double n, double shape, double d,
                                                     double rest) const {
    const double mass = carbon + hydrogen, perMass = 1 / mass, fraction = hydrogen * perMass;
    const double loss = lossO2_ + lossOH_;
    // What condenses, kg/s. With the mass goes the cube of the diameter: area = 6 mass / (density d).
    const double taken = condensing(shape * d, inertia_ * perMass);
    const double v0 =
        2 / density_ * (taken * perMass * d * (density_ / 6) + gain_ - loss / (1 - fraction));  // m/s, of d
    const double speed = std::abs(v0);
    const double length = speed * rest > 0.5 * d ? 0.5 * d / speed : rest;
    const double middle = d + 0.5 * length * v0;
    const double area = n * constants::pi * d * d, surface = n * constants::pi * middle * middle;
    const double perVolumeThere = 1 / (surface * middle), perSurface = middle * perVolumeThere;
    // Hydrogen leaves with its carbon.
    const double half = 0.5 * length * (taken * (dimerFraction_ - fraction) - gain_ * area * fraction) * perMass;
    const double most = fraction > dimerFraction_ ? fraction : dimerFraction_;
    double h = fraction + half;
    h = h < 0 ? 0 : h;
    h = h > most ? most : h;
    const double perCarbon = 1 / (1 - h), withCarbon = h * perCarbon;
    const double condensed = condensing(shape * middle, sixPerDensity_ * perVolumeThere);
    const double change = length * 2 / density_ * (condensed * perSurface + gain_ - loss * perCarbon);
    const double centre = d + 0.5 * change;
    // The mass goes with the cube of the diameter, which makes this of the rates at the middle.
    const double amount =
        length * (3 * centre * centre + 0.25 * change * change) * (n * constants::pi / 3) * perSurface;
    Step s;
    s.length = length;
    s.dimers = amount * condensed * perDimer_;
    s.growth = amount * gain_ * surface;
    s.oxidationO2 = amount * lossO2_ * surface;
    s.oxidationOH = amount * lossOH_ * surface;
    s.hydrogenO2 = s.oxidationO2 * withCarbon;
    s.hydrogenOH = s.oxidationOH * withCarbon;
    s.carbon = carbon + (s.dimers * dimerCarbon_ + s.growth - s.oxidationO2 - s.oxidationOH);
    s.hydrogen = hydrogen + (s.dimers * dimerHydrogen_ - (s.hydrogenO2 + s.hydrogenOH));
    return s;
  }
  // What it took up and lost, kg.
  [[nodiscard, gnu::always_inline]] inline double gained(const Step& s) const {
    return s.dimers * dimerMass_ + s.growth;
  }
  [[nodiscard, gnu::always_inline]] inline double lost(const Step& s) const {
    return s.oxidationO2 + s.oxidationOH + s.hydrogenO2 + s.hydrogenOH;
  }

 private:
  // `perMass`: of the particle, times the inertia.
  [[nodiscard, gnu::always_inline]] inline double condensing(double diameter, double perMass) const {
    const double sum = dimerDiameter_ + diameter;
    return condensation_ * std::sqrt(inverseDimer_ + perMass) * sum * sum;
  }

  double gain_, lossO2_, lossOH_;  // kg carbon/m2/s
  double density_;
  double dimerCarbon_, dimerHydrogen_, dimerMass_, dimerDiameter_;
  double leastCarbon_, inertia_;
  double sixPerDensity_;  // m3/kg, times the inertia
  // All zero without dimers.
  double condensation_ = 0, perDimer_ = 0, dimerFraction_ = 0, inverseDimer_ = 0;
};

}  // namespace lampblack::particles
