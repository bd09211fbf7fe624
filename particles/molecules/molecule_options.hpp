// What a population of particles of molecules is asked for, and what it tells of itself: plain data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/molecules/molecule_sticking.hpp"
#include "particles/pah/lattice.hpp"
#include "particles/pah/pah_rates.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/trees/tree_material.hpp"

namespace lampblack::particles {

struct MoleculeOptions {
  std::string precursor;           // species of the gas whose molecules become particles
  std::vector<LatticeCell> rings;  // of such a molecule
  // How they become particles. pairs: two that collide are a particle, and single ones condense on particles. asInGas:
  // as many single ones are particles as the gas has, and all meet as particles do; the gas stays as it is given.
  // byFormation: each one that is formed is a particle.
  enum class Inception { none, pairs, asInGas, byFormation } inception = Inception::pairs;
  NucleationOptions formation;  // of byFormation, over the time since the population began
  double inceptionEfficiency = 1, condensationEfficiency = 1;  // factors of what sticks
  MoleculeSticking sticking;
  // eV, of a molecule by its carbon atoms: points that rise, straight in between. Empty: nothing is said of it.
  std::vector<double> bandGapCarbons = {}, bandGaps = {};
  // Factor of all rates of a molecule in a primary with `growthFactorFrom` of them or more.
  double growthFactor = 1;
  std::size_t growthFactorFrom = 2;
  PahRateConstants rates;
  std::array<bool, pahProcessCount> active = [] {
    std::array<bool, pahProcessCount> all;
    all.fill(true);
    return all;
  }();
  // Density, weights of C and H, sintering of primaries.
  double density = 1470;                                       // kg/m3
  double fractalDimension = 1.8;                               // of aggregates
  double carbonWeight = 12.011e-3, hydrogenWeight = 1.008e-3;  // kg/mol
  SinteringLaw sintering;
  double sinteringTolerance = 1e-3;
  bool spheres = false;  // molecules of particles that meet are in one primary at once

  std::size_t particles = 2000;  // most numerical ones, at least 8
  std::uint64_t seed = 1, owner = 0;
  // Of coagulation, inception and condensation; the gas gives its gas.
  CollisionKernelOptions kernel{.type = CollisionKernelType::transition, .enhancement = 2.2};
  bool coagulation = true;
  double splitTolerance = 0.05;  // relative change of the population in a splitting step
  double fullAt = 1e18;          // 1/m3, number density at which the sample is full first
  double atStart = 0;            // 1/m3, single molecules that are there from the beginning

  [[nodiscard]] TreeMaterial material() const;
  // eV, of a molecule of so many carbon atoms; as at the ends beyond the points.
  [[nodiscard]] double bandGap(double carbon) const;
  // Species of the gas: those of soot, then the precursor.
  [[nodiscard]] std::vector<std::string> species() const;
  static constexpr std::size_t precursorAt = SootSpecies::fixed;
};

// InputError for numbers that are none, molecules that are none.
void requireMolecules(const MoleculeOptions& options);

// Events and transferred amounts since the previous takeExchange(), per m3 of the gas at the time of each event.
struct MoleculeExchange {
  std::array<double, SootSpecies::fixed + 1> gas{};  // mol, of species()
  double carbon = 0, hydrogen = 0;                   // atoms that the particles gained
  double inceptions = 0, coagulations = 0, condensations = 0;
  double came = 0, went = 0;                              // single molecules, as the gas has more or fewer
  std::array<double, pahProcessCount> events{}, voids{};  // of molecules
};

// Sums per m3, means by number (SI).
struct MoleculeTotals {
  double number = 0, volume = 0, mass = 0, massSquared = 0, surface = 0, carbon = 0, hydrogen = 0;
  double primaries = 0, molecules = 0, rings = 0;  // rings: of all molecules
  double single = 0;                               // particles of one molecule
  double collisionDiameter = 0, primaryDiameter = 0, sinteringLevel = 1;
  std::size_t mostMolecules = 0;
};

// What molecules take from the gas and give to it, for events of each process (any unit): carbon comes and goes as
// C2H2, what is oxidised as CO, and H2 makes up for hydrogen. `byOH`: the part of oxidation that OH does.
void addGasOfEvents(const std::array<double, pahProcessCount>& events, double byOH,
                    std::array<double, SootSpecies::fixed + 1>& gas);

}  // namespace lampblack::particles
