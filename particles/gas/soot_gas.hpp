// What a soot model needs to be told: the species of the gas that it sees, the polycyclic aromatic hydrocarbons (PAH)
// that form dimers, and the constants of the soot models. Plain data, so that a reactor, a flame, a flow cell or a
// trajectory can all drive the same models.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/rooms.hpp"
#include "particles/collisions/collision_physics.hpp"

namespace lampblack::particles {

// Largest number of PAH species a deck may list; lets the models keep per-PAH arrays on the stack.
inline constexpr std::size_t maximumPahSpecies = 16;
using PahArray = std::array<double, maximumPahSpecies>;

// Species that detailed soot models exchange with the gas, in this order; the PAH of the model follow.
struct SootSpecies {
  enum Index : std::size_t { H, H2, OH, H2O, O2, C2H2, CO, fixed };
};
// Amounts of all of them.
using SootSpeciesArray = std::array<double, SootSpecies::fixed + maximumPahSpecies>;

struct PahSpecies {
  std::string name;
  int carbon = 0;
  int hydrogen = 0;
  double stickingCoefficient = 0;  // of two equal molecules
};

// Published sticking coefficient of a PAH by its usual mechanism name (Blanquart and Pitsch 2009, table; Wang
// 2025, section 7.2.2.4). Empty for a name that is not in the table.
[[nodiscard]] std::optional<double> defaultStickingCoefficient(std::string_view name);

// Sticking coefficient by the law behind the table: proportional to the fourth power of the molecular mass, 1.5e-11
// (g/mol)^-4 (Blanquart and Pitsch 2009). `molecularWeight` in kg/mol.
[[nodiscard]] double stickingCoefficientByMass(double molecularWeight);

// Density (kg/m3) of a PAH with the given atoms, from stacked graphitic sheets (Wang 2025, eq. 7-38): the graphite
// limit is 2270 kg/m3.
[[nodiscard]] double pahDensity(int carbon, int hydrogen);

// The fraction of active sites at a temperature (K).
struct AlphaPoint {
  double temperature = 0, alpha = 0;
};

struct SootModelOptions {
  std::vector<PahSpecies> pah = {};
  double sootDensity = 1850;    // kg/m3 (Wang 2025, chapter 7)
  double siteDensity = 2.3e19;  // 1/m2, C-H sites (Appel, Bockhorn, Frenklach 2000)
  // Fraction of active sites: a constant, or else a table in the temperature, or else alpha(T, mu1) of Appel, Bockhorn
  // and Frenklach (2000).
  std::optional<double> alpha = {};
  std::vector<AlphaPoint> alphaTable = {};  // rising temperatures; straight in between, constant outside
  double ohEfficiency = 0.13;        // reaction probability of an OH collision (Appel, Bockhorn, Frenklach 2000, S6)
  double vanDerWaals = 2.2;          // enhancement of free-molecular collisions of dimers and particles
  double carbonWeight = 12.011e-3;   // kg/mol; set to the mechanism's so that mass budgets close
  double hydrogenWeight = 1.008e-3;  // kg/mol
  bool coagulation = true;
  bool inception = true;     // off: no new particles; with condensation also off no dimers form
  bool condensation = true;  // off: dimers only nucleate
  bool surfaceGrowth = true;
  bool oxidation = true;
};

// Names of the species, as mechanisms call them.
[[nodiscard]] std::vector<std::string> sootSpecies(const SootModelOptions& options);

// Whether a gas has PAH to speak of: a mole fraction of 1e-15 or more. `gas`: the species of sootSpecies().
[[nodiscard]] bool hasPrecursors(const ParticleGas& gas);

// Throws NumericsError, in the name of `what`, for a gas that is not physical.
void requirePhysical(const CarrierGas& gas, std::string_view what);

}  // namespace lampblack::particles
