// The gas around a stochastic soot population, digested once for a step of time, and what it does to one particle:
// condensation of dimers, surface growth, oxidation (Wang 2025, sections 7.2.2, 9.2.2). Where nuclei are of monomers
// (SootModelOptions::inceptionBy), "dimers" are the molecules of the PAH: as many as the gas has, whatever takes them.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/modules.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/population/model/surface_volume.hpp"
#include "particles/soot/dimer.hpp"
#include "particles/soot/soot_aggregate.hpp"
#include "particles/soot/soot_growth.hpp"
#include "particles/soot/surface_chemistry.hpp"

namespace lampblack::particles {

// Soot mass (kg) that processes moved; in a population per m3. Oxidation is positive here.
struct SootTransfer {
  double dimers = 0;                        // number of dimers that condensed
  double growth = 0;                        // carbon
  double oxidationO2 = 0, oxidationOH = 0;  // carbon
  double hydrogenO2 = 0, hydrogenOH = 0;    // hydrogen that left with it
  double lost = 0;                          // particles that were oxidised away
  void add(double weight, const SootTransfer& other);
};

class SootMedium {
 public:
  // `gas`: negative concentrations count as zero. Without `keepsHydrogen` that of the PAH returns to the gas as they
  // are taken up. Throws NumericsError for a gas that is not physical.
  SootMedium(const SootModelOptions& options, const DimerModel& dimers, const ParticleGas& gas, bool keepsHydrogen);

  [[nodiscard]] const DimerProduction& dimer() const { return dimer_; }
  // Moles of each PAH in a mole of dimers.
  [[nodiscard]] const PahArray& pahOfDimer() const { return pahOfDimer_; }
  [[nodiscard]] bool incepting() const { return selfCollision_ > 0; }
  [[nodiscard]] bool condensing() const { return condensing_; }
  [[nodiscard]] bool surfaceActive() const { return surfaceActive_; }
  [[nodiscard]] const CarrierGas& gas() const { return gas_; }
  [[nodiscard]] double dimerCarbon() const { return dimerCarbon_; }                                // kg in a dimer
  [[nodiscard]] double dimerHydrogen() const { return dimerHydrogen_; }                            // kg in a dimer
  [[nodiscard]] double carbonAtom() const { return options_.carbonWeight / constants::avogadro; }  // kg
  [[nodiscard]] double freedHydrogen() const { return freedHydrogen_; }  // kg that a dimer gives back as H2

  // Collision rate of a dimer with a particle, m3/s, and its derivative by the logarithm of the particle's diameter
  // with the mass going with its cube.
  [[nodiscard]] double collision(const SootAggregate::Particle& p) const {
    return condensing_ ? condensingCollision(p) : 0;
  }
  [[nodiscard]] double condensingCollision(const SootAggregate::Particle& p) const {  // where condensing()
    const double sum = dimer_.diameter + p.diameter;
    return freeMolecular_ * std::sqrt(1 / dimer_.mass + inertia_ / SootAggregate::mass(p)) * sum * sum;
  }
  // `shapeGain`: SootAggregate::shapeGain().
  [[nodiscard]] double collisionSlope(const SootAggregate::Particle& p, double collision, double shapeGain = 1) const {
    const double part = inertia_ * dimer_.mass, share = part / (SootAggregate::mass(p) + part);
    return collision * (2 * shapeGain * p.diameter / (dimer_.diameter + p.diameter) - 1.5 * share);
  }
  // Whether the number of dimers() is that of the gas's molecules and does not depend on collisions.
  [[nodiscard]] bool ofMonomers() const { return monomers_ > 0; }
  // Dimers (1/m3) in steady state, `collisions` being the sum of collision() per m3.
  [[nodiscard]] double dimers(double collisions) const;
  [[nodiscard]] double breaking() const { return breaking_; }  // 1/s, at which dimers come apart
  // Nuclei per m3 and s.
  [[nodiscard]] double inception(double collisions) const {
    const double n = dimers(collisions);
    return 0.5 * selfCollision_ * n * n;
  }
  [[nodiscard]] SootFluxes fluxes() const;
  [[nodiscard]] double condensation(double dimers) const { return dimers * freeMolecular_; }
  [[nodiscard]] double alpha(double meanCarbonAtoms) const { return surface_.alpha(meanCarbonAtoms); }

  [[nodiscard]] SootGrowth growth(const SootFluxes& fluxes) const {
    return {fluxes, options_.sootDensity, dimer_, dimerCarbon_, dimerHydrogen_, leastCarbon_, inertia_};
  }
  // Grows one particle over dt (s) by midpoint steps of the diameter of its primaries; false when it falls below the
  // carbon of the smallest nucleus, all of it then being oxidised. `moved` gets what it took and lost, to round-off.
  bool grow(const SootAggregate& type, const SootFluxes& fluxes, double dt, SootAggregate::Particle& p,
            SootTransfer& moved) const;

 private:
  void takeDimers(const DimerModel& dimers, std::span<const double> concentrations);  // mol/m3
  void takeMonomers(const DimerModel& dimers, double concentration);

  SootModelOptions const& options_;
  SurfaceChemistry surface_;
  DimerProduction dimer_;
  PahArray pahOfDimer_{};
  CarrierGas gas_;
  double selfCollision_ = 0, freeMolecular_ = 0, monomers_ = 0, breaking_ = 0;
  double inertia_;  // of particles in collisions with dimers: 1, or 0 where they are as at rest
  double dimerCarbon_ = 0, dimerHydrogen_ = 0, freedHydrogen_ = 0;
  double growth_ = 0, O2_ = 0, OH_ = 0;  // kg carbon/m2/s
  double leastCarbon_;                   // kg
  bool condensing_ = false, surfaceActive_ = false;
};

// Primaries, shape and diameter by which a particle grows over dt (s): its own; by volume and surface of the mass (kg)
// it has with the surface of the middle, so that the step is of second order.
struct GrowingShape {
  double primaries, factor, diameter;
};
[[nodiscard, gnu::always_inline]] inline GrowingShape growingShape(const SootGrowth& law, const SootAggregate& type,
                                                                   double mass, double primaries, double dt) {
  const auto of = [&](double n) {
    return GrowingShape{n, type.shapeFactor(n), normalCubeRoot(type.perVolume() * mass / n)};
  };
  const GrowingShape first = of(primaries);
  if (type.shape() != SootShape::surfaceVolume) return first;
  const double gain = std::min(0.5 * dt * law.gain(mass, first.primaries, first.factor, first.diameter), mass);
  return of(primariesAfter(primaries, mass, gain, 0));
}

}  // namespace lampblack::particles
