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

#include "core/modules.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/gas/rate_constant.hpp"

namespace lampblack::chemistry {
class Mechanism;
}

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

// The surface chemistry of soot, with the constants of Appel, Bockhorn and Frenklach (2000).
struct SurfaceRateConstants {
  RateConstant openByH{4.2e13, 0, 13.0};         // C-H + H <-> C* + H2
  RateConstant closeByH2{3.9e12, 0, 11.0};       // its reverse
  RateConstant openByOH{1.0e10, 0.734, 1.43};    // C-H + OH <-> C* + H2O
  RateConstant closeByH2O{3.68e8, 1.139, 17.1};  // its reverse
  RateConstant closeByH{2.0e13, 0, 0};           // C* + H -> C-H
  RateConstant growth{8.0e7, 1.56, 3.8};         // C* + C2H2
  RateConstant oxidation{2.2e12, 0, 7.5};        // C* + O2
  std::optional<RateConstant> closeByO2 = {};    // by O2 in the balance of radical sites; absent: that of `oxidation`
  // Radical sites over C-H sites: the ratio r of what opens to what closes them; true: r/(1 + r), so that radical
  // sites and C-H sites together are what there is.
  bool bounded = false;
};

// What makes a nucleus: two dimers of PAH in steady state, or two molecules of the one PAH at the concentration that
// the gas has. The same condense on particles.
enum class InceptionBy { dimers, monomers };

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
  SurfaceRateConstants surface = {};
  InceptionBy inceptionBy = InceptionBy::dimers;
  // [dimers]/[PAH]^2 in equilibrium, cm3/mol: dimers also come apart (ensembles and trees). Absent: they do not.
  std::optional<RateConstant> dimerEquilibrium = {};
  // Of a monomer as it collides: kg, m; zero: that of its atoms, and of the sphere of soot density.
  double monomerMass = 0, monomerDiameter = 0;
  // Dimers or monomers collide with particles as if these were at rest, 1/m in place of 1/m + 1/M, as the program MOpS
  // has it.
  bool heavyParticles = false;
  SlipLaw slip = SlipLaw::davies;  // of collisions of particles, and of monomers with each other
  bool coagulation = true;
  bool inception = true;     // off: no new particles; with condensation also off no dimers form
  bool condensation = true;  // off: dimers only nucleate
  bool surfaceGrowth = true;
  bool oxidation = true;
};

// Names of the species, as mechanisms call them.
[[nodiscard]] std::vector<std::string> sootSpecies(const SootModelOptions& options);
// Their places in a mechanism. InputError where it lacks one.
[[nodiscard]] std::vector<std::size_t> indicesOfSootSpecies(const Mechanism& mechanism,
                                                            const SootModelOptions& options);
// Of the PAH alone.
[[nodiscard]] std::vector<std::string> sootPrecursors(const SootModelOptions& options);

// Whether a gas has PAH to speak of: a mole fraction of 1e-15 or more. `gas`: the species of sootSpecies().
[[nodiscard]] bool hasPrecursors(const ParticleGas& gas);

// Throws NumericsError, in the name of `what`, for a gas that is not physical.
void requirePhysical(const CarrierGas& gas, std::string_view what);

}  // namespace lampblack::particles
