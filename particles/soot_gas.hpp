// What a soot model needs to be told: the local gas as soot sees it, the polycyclic aromatic hydrocarbons (PAH) that
// form dimers, and the constants of the soot models. Plain data, so that a reactor, a flame, a flow cell or a
// trajectory can all drive the same models.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "particles/collision_physics.hpp"

namespace lampblack {

// Largest number of PAH species a deck may list; lets the models keep per-PAH arrays on the stack.
inline constexpr std::size_t maximumPahSpecies = 16;
using PahArray = std::array<double, maximumPahSpecies>;

struct SootGasState {
  double temperature = 0;          // K
  double pressure = 0;             // Pa
  double density = 0;              // kg/m3, gas only
  double viscosity = 0;            // Pa s
  double meanMolecularWeight = 0;  // kg/mol
  // Molar concentrations, mol/m3.
  double H = 0, H2 = 0, OH = 0, H2O = 0, O2 = 0, C2H2 = 0;
  std::span<const double> pah;  // same order as SootModelOptions::pah

  [[nodiscard]] KernelGas kernelGas() const { return {temperature, pressure, viscosity, meanMolecularWeight, density}; }
};

// Concentrations (mol/m3) of the species soot exchanges with, read and written by TwoEquationSoot::advance.
struct SootCellGas {
  double H = 0, H2 = 0, OH = 0, H2O = 0, O2 = 0, C2H2 = 0, CO = 0;
  std::span<double> pah;
};

struct PahSpecies {
  std::string name;
  int carbon = 0;
  int hydrogen = 0;
  double stickingCoefficient = 0;  // of two equal molecules
};

// Published sticking coefficient of a PAH by its usual mechanism name (Blanquart and Pitsch 2009, table; thesis
// 7.2.2.4). Empty for a name that is not in the table.
[[nodiscard]] std::optional<double> defaultStickingCoefficient(std::string_view name);

// Sticking coefficient by the law behind the table: proportional to the fourth power of the molecular mass, 1.5e-11
// (g/mol)^-4 (Blanquart and Pitsch 2009). `molecularWeight` in kg/mol.
[[nodiscard]] double stickingCoefficientByMass(double molecularWeight);

// Density (kg/m3) of a PAH with the given atoms, from stacked graphitic sheets (thesis eq. 7-38): the graphite limit is
// 2270 kg/m3.
[[nodiscard]] double pahDensity(int carbon, int hydrogen);

// Coagulation kernels. Constant and additive have exact solutions and are there for verification.
enum class CoagulationKernel { transition, freeMolecular, constant, additive };

// The fraction of active sites at a temperature (K).
struct AlphaPoint {
  double temperature = 0, alpha = 0;
};

struct SootModelOptions {
  std::vector<PahSpecies> pah;
  double sootDensity = 1850;    // kg/m3 (thesis chapter 7)
  double siteDensity = 2.3e19;  // 1/m2, C-H sites (Appel, Bockhorn, Frenklach 2000)
  // Fraction of active sites: a constant, or else a table in the temperature, or else alpha(T, mu1) of ABF 2000.
  std::optional<double> alpha;
  std::vector<AlphaPoint> alphaTable;  // rising temperatures; straight in between, constant outside
  double ohEfficiency = 0.13;          // reaction probability of an OH collision (ABF 2000, S6)
  double vanDerWaals = 2.2;            // enhancement of free-molecular collisions of dimers and particles
  double carbonWeight = 12.011e-3;     // kg/mol; set to the mechanism's so that mass budgets close
  double hydrogenWeight = 1.008e-3;    // kg/mol
  bool coagulation = true;
  bool inception = true;     // off: no new particles; with condensation also off no dimers form
  bool condensation = true;  // off: dimers only nucleate
  bool surfaceGrowth = true;
  bool oxidation = true;
  double relativeTolerance = 4e-3;  // of the local error of a sub-step of TwoEquationSoot::advance
};

}  // namespace lampblack
