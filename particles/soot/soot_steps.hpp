// What a gas does to a population of soot as a whole in a step of splitting, from sums over its particles: how long the
// step may be, what is born in it, what condenses and how active its surface is, and what the gas gives and gets.
// Shared by populations of spheres and aggregates (Ensemble) and of trees of primaries. docs/theory/stochastic_soot.md.
#pragma once

#include "core/modules.hpp"
#include "particles/gas/species_exchanged.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/soot/soot_columns.hpp"

namespace lampblack::particles {

// What of a population does not change.
struct SootPopulationLaw {
  const SootModelOptions& soot;
  const DimerModel& dimers;
  const CollisionKernel* kernel = nullptr;  // null: no coagulation
  // By what the diameter of collision of two equal particles grows as they become one.
  double joined = 1;
  bool alphaOfPrimaries = false, byEvents = false;  // as EnsembleOptions
  double splitTolerance = 0.01;
};

// Two dimers, as a sphere.
[[nodiscard]] inline SootAggregate::Particle sootNucleus(const SootMedium& medium, double density) {
  return SootAggregate(density, true).make(2 * medium.dimerCarbon(), 2 * medium.dimerHydrogen(), 1);
}

// The step (s) over which nothing changes by more than the tolerance: the share of dimers that condense, by inception;
// the diameters, by growth; the number, by coagulation; and what is born in it. At most `remaining`; `fastest` (1/s):
// what else changes.
[[nodiscard]] double sootStep(const SootPopulationLaw& law, const SootMedium& medium, const SootSums& sums,
                              double fastest, double remaining);

// Nuclei per m3 and s in the middle of a time dt in which particles are born and coagulate.
[[nodiscard]] double sootInception(const SootPopulationLaw& law, const SootMedium& medium, const SootSums& sums,
                                   double dt);

// Condensation and active sites of the middle of a time dt of growth, to first order: makes the whole second order.
[[nodiscard]] SootFluxes sootFluxes(const SootPopulationLaw& law, const SootMedium& medium, const SootSums& sums,
                                    double dt);

// What the gas gives (negative) and gets, mol/m3, for dimers that became soot (1/m3) and for what surface reactions
// moved (surface_chemistry.hpp).
void exchangeDimers(const SootMedium& medium, const SootModelOptions& soot, double dimers, SootSpeciesArray& gas);
void exchangeSurface(const SootModelOptions& soot, const SootTransfer& moved, SootSpeciesArray& gas);
// Which species these are, of dimers (inception and condensation) and of each surface reaction.
[[nodiscard]] SpeciesExchanged exchangedByDimers(const SootModelOptions& soot);
[[nodiscard]] SpeciesExchanged exchangedByGrowth();
[[nodiscard]] SpeciesExchanged exchangedByO2();
[[nodiscard]] SpeciesExchanged exchangedByOH();

}  // namespace lampblack::particles
