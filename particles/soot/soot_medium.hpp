// The gas around a stochastic soot population, digested once for a step of time, and what it does to one particle:
// condensation of dimers, surface growth, oxidation (Wang 2025, sections 7.2.2, 9.2.2).
#pragma once

#include "core/rooms.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/soot/dimer.hpp"
#include "particles/soot/soot_aggregate.hpp"
#include "particles/soot/soot_growth.hpp"
#include "particles/soot/surface_chemistry.hpp"

namespace lampblack::particles {

// Soot mass (kg) that processes moved; in a population per m3. Oxidation is positive here.
struct SootMoved {
  double dimers = 0;                        // number of dimers that condensed
  double growth = 0;                        // carbon
  double oxidationO2 = 0, oxidationOH = 0;  // carbon
  double hydrogenO2 = 0, hydrogenOH = 0;    // hydrogen that left with it
  double lost = 0;                          // particles that were oxidised away
  void add(double weight, const SootMoved& other);
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
  [[nodiscard]] double dimerCarbon() const { return dimerCarbon_; }      // kg in a dimer
  [[nodiscard]] double dimerHydrogen() const { return dimerHydrogen_; }  // kg in a dimer
  [[nodiscard]] double freedHydrogen() const { return freedHydrogen_; }  // kg that a dimer gives back as H2

  // Collision rate of a dimer with a particle, m3/s, and its derivative by the logarithm of the particle's diameter
  // with the mass going with its cube.
  [[nodiscard]] double collision(const SootAggregate::Particle& p) const {
    return condensing_ ? condensingCollision(p) : 0;
  }
  [[nodiscard]] double condensingCollision(const SootAggregate::Particle& p) const {  // where condensing()
    return DimerModel::particleCollision(dimer_, freeMolecular_, SootAggregate::mass(p), p.diameter);
  }
  [[nodiscard]] double collisionSlope(const SootAggregate::Particle& p, double collision) const {
    const double share = dimer_.mass / (SootAggregate::mass(p) + dimer_.mass);
    return collision * (2 * p.diameter / (dimer_.diameter + p.diameter) - 1.5 * share);
  }
  // Dimers (1/m3) in steady state, `collisions` being the sum of collision() per m3.
  [[nodiscard]] double dimers(double collisions) const;
  // Nuclei per m3 and s.
  [[nodiscard]] double inception(double collisions) const {
    const double n = dimers(collisions);
    return 0.5 * selfCollision_ * n * n;
  }
  [[nodiscard]] SootFluxes fluxes() const;
  [[nodiscard]] double condensation(double dimers) const { return dimers * freeMolecular_; }
  [[nodiscard]] double alpha(double meanCarbonAtoms) const { return surface_.alpha(meanCarbonAtoms); }

  [[nodiscard]] SootGrowth growth(const SootFluxes& fluxes) const {
    return {fluxes, options_.sootDensity, dimer_, dimerCarbon_, dimerHydrogen_, leastCarbon_};
  }
  // Grows one particle over dt (s) by midpoint steps of the diameter of its primaries; false when it falls below the
  // carbon of the smallest nucleus, all of it then being oxidised. `moved` gets what it took and lost, to round-off.
  bool grow(const SootAggregate& type, const SootFluxes& fluxes, double dt, SootAggregate::Particle& p,
            SootMoved& moved) const;

 private:
  SootModelOptions const& options_;
  SurfaceChemistry surface_;
  DimerProduction dimer_;
  PahArray pahOfDimer_{};
  CarrierGas gas_;
  double selfCollision_ = 0, freeMolecular_ = 0;
  double dimerCarbon_ = 0, dimerHydrogen_ = 0, freedHydrogen_ = 0;
  double growth_ = 0, O2_ = 0, OH_ = 0;  // kg carbon/m2/s
  double leastCarbon_;                   // kg
  bool condensing_ = false, surfaceActive_ = false;
};

}  // namespace lampblack::particles
