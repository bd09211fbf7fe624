// What a population of trees is asked for, and what it tells of itself: plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "core/modules.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/population/population_solver.hpp"
#include "particles/stochastic/particle_process.hpp"
#include "particles/stochastic/particle_rows.hpp"
#include "particles/trees/tree_shape.hpp"

namespace lampblack::particles {

struct TreeOptions {
  TreeMaterial material;
  std::size_t particles = 8192;  // most numerical ones, at least 8
  std::uint64_t seed = 1, owner = 0;
  // Of coagulation and inception; the gas gives its gas.
  CollisionKernelOptions kernel{.type = CollisionKernelType::transition, .enhancement = 2.2, .slip = SlipLaw::air};
  CollisionSize size = CollisionSize::primaries;
  // By volume and surface: of materials with sites. The diameter of collision is of 6V/S, and so is the law of
  // sintering, dS/dt = -(S - S_sphere)/tau(6V/S) (Koch, Friedlander 1990).
  TreeShape shape = TreeShape::primaries;
  bool coagulation = true;
  double splitTolerance = 0.05;      // relative change of the population in a splitting step
  double sinteringTolerance = 1e-3;  // TreeSintering
  double sphereTolerance = 1e-4;     // of a step of sintering of spheres in space (SphereSintering)
  double fullAt = 1e18;              // 1/m3, number density at which the sample is full first
};

// Events and transferred amounts since the previous takeExchange(), per m3 of the gas at the time of each event.
struct TreeExchange {
  SootSpeciesArray gas{};  // mol/m3, of the material's species
  TreeUnits units{};       // of the particles, by all processes, 1/m3
  // Events, 1/m3.
  double inceptions = 0, coagulations = 0;
  // Of materials with sites; of sintering and of reactions within particles, pairs of sites.
  double reactions = 0, condensations = 0, sinteredPairs = 0;
  // Of soot: dimers that condensed, additions of C2H2, attacks by O2 and by OH; primaries and whole particles that
  // burnt away, and particles that broke as one of their primaries did.
  double dimers = 0, grown = 0, oxidisedO2 = 0, oxidisedOH = 0, burntPrimaries = 0, burnt = 0, broken = 0;
  double fragmentations = 0;  // necks that oxidation broke
};

struct TreeCounters {
  std::uint64_t inceptions = 0, coagulations = 0, fictitious = 0, fused = 0, doublings = 0, removals = 0;
  std::uint64_t splitSteps = 0;
  std::uint64_t reactions = 0, condensations = 0;  // at surfaces; within particles, of pairs of sites
  std::uint64_t limited = 0;                       // reactions within particles bounded at zero or without two sites
  std::uint64_t withoutSites = 0;                  // necks that sintered by more sites than a primary had
  std::uint64_t burnt = 0, broken = 0;  // particles that burnt away, and that broke as one of their primaries did
  std::uint64_t fragmentations = 0;     // necks that oxidation broke
};

// Rates of events in a gas, 1/m3/s, counted as in TreeExchange. Of soot: inception, coagulation and fragmentation only.
struct TreeRates {
  double inceptions = 0, coagulations = 0, reactions = 0, condensations = 0, fragmentations = 0;
};

// A process of a material: its name is that of its events, which the amount counts. `singular` names the rate; null
// where a material has no rate of these events. `count`: how many the sample had; may be null.
struct TreeEvent : ProcessOf<TreeExchange> {
  const char* singular = nullptr;
  double TreeRates::*rate = nullptr;
  std::uint64_t TreeCounters::*count = nullptr;
};
[[nodiscard]] std::vector<TreeEvent> treeEvents(const TreeMaterial& material);

// Sums per m3, means by number (SI).
struct TreeTotals {
  double number = 0, volume = 0, mass = 0, surface = 0, primaries = 0, sinteringRate = 0;
  TreeUnits units{};
  double sphereDiameter = 0, collisionDiameter = 0, primaryDiameter = 0,
         sinteringLevel = 1;                            // means; level 1: one primary
  double massSquared = 0;                               // kg2/m3
  double collisionDeviation = 1, primaryDeviation = 1;  // geometric, by number
  std::size_t largest = 0;                              // primaries
};

// How trees stand in a packed population (packed_tree.hpp).
inline constexpr ParticleRows treeRows{21 + sizeof(TreeExchange) / sizeof(double) + std::size(populationCounters), true,
                                       true};

// Spheres that a population begins with: `number` of them (1/m3), each of these units; or with a distribution of
// volumes of their own, which has the number, in the proportions of the units.
struct TreeStart {
  TreeUnits units{};
  double number = 0;
  InitialPopulation sizes = {};
};

}  // namespace lampblack::particles
