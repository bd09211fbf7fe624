// What every soot model that a gas can carry looks like from outside: a few (or many) scalars per volume of gas, their
// sources, and what they exchange with the gas. The same object serves a one-dimensional flame, a reactor and a flow
// cell; it knows neither mesh nor mechanism. Exchange conserves every element to round-off: the carbon and hydrogen
// (and mass) of the scalars plus those of the gas species do not change.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/particle_gas.hpp"

namespace lampblack {

struct SootScalar {
  std::string name;         // "number", "section_07_aggregates"
  std::string unit;         // of its density: "1/m3", "kg/m3"
  std::string description;  // one line for the results file
  double scale = 1;         // typical amount per kg of gas in a sooting flame; unknowns are scaled by it
  double carbon = 0;        // kg of carbon in one unit
  double hydrogen = 0;      // kg of hydrogen in one unit
};

// What is measured or plotted, at one point.
struct SootProperties {
  double numberDensity = 0;          // 1/m3, of aggregates
  double volumeFraction = 0;         // m3/m3
  double meanDiameter = 0;           // m, of the sphere of the mean volume
  double surfaceArea = 0;            // m2/m3
  double primaryDiameter = 0;        // m
  double primariesPerAggregate = 0;  // 1 for spheres
  double mobilityDiameter = 0;       // m
  double gyrationDiameter = 0;       // m
};

// Rates of the processes at one point, for budgets and figures: number in 1/m3/s, mass of soot in kg/m3/s, losses
// negative.
struct SootProcesses {
  double nucleationNumber = 0, coagulationNumber = 0, oxidationNumber = 0, fragmentationNumber = 0;
  double nucleation = 0, condensation = 0, growth = 0, oxidationO2 = 0, oxidationOH = 0, carbonisation = 0;
  double dimerNumber = 0;      // 1/m3, where the model has dimers
  double dimerProduction = 0;  // 1/m3/s
};

// dN/dlog10(d) (1/m3) at diameters d (m, of the equivalent sphere).
struct SootSizeDistribution {
  std::vector<double> diameter, density;
};

class SootModel {
 public:
  virtual ~SootModel() = default;

  // Gas species by their usual mechanism names, whose concentrations matter or that are exchanged: those of a
  // ParticleGas, in this order.
  [[nodiscard]] virtual const std::vector<std::string>& gasSpecies() const = 0;
  [[nodiscard]] virtual const std::vector<SootScalar>& scalars() const = 0;

  // Sums over the scalars whose profiles decide how fine a grid has to be: weights of all scalars' densities, each sum
  // of order one per kg of gas in a sooting flame. Empty: every scalar by itself. Sections travel as waves of their
  // own, but what is asked of them are moments.
  [[nodiscard]] virtual std::vector<std::vector<double>> gridSums() const { return {}; }

  // `densities`: of the scalars, per m3; negative ones (and negative concentrations) count as zero. `rates`: of the
  // scalars, per m3 and s. `exchange`: production of the gas species, mol/m3/s.
  virtual void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                       std::span<double> exchange) const = 0;

  // Derivatives of (rates, exchange), row-major, with respect to (densities, concentrations, temperature), each with
  // everything else held: (scalars + species) rows of (scalars + species + 1) columns. The default takes one-sided
  // differences of `sources`, away from zero, and at zero for what is negative; models with many scalars override it.
  virtual void jacobian(const ParticleGas& gas, std::span<const double> densities, std::span<double> values) const;

  // Brownian diffusivity of each scalar, m2/s. All scalars move by thermophoresis with sootThermophoresis().
  virtual void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const = 0;

  [[nodiscard]] virtual SootProperties properties(const ParticleGas& gas, std::span<const double> densities) const = 0;
  // m3/m3, for radiation. The default asks `properties` in some hot gas; models override it where that costs.
  [[nodiscard]] virtual double volumeFraction(std::span<const double> densities) const;
  // The part of it in particles as large as the model can have, which grow no more: where it counts, the model has too
  // few sections. Zero where there is no such limit.
  [[nodiscard]] virtual double volumeFractionAtLimit(std::span<const double> densities) const;
  [[nodiscard]] virtual SootProcesses processes(const ParticleGas& gas, std::span<const double> densities) const = 0;
  // Empty where the model has none.
  [[nodiscard]] virtual SootSizeDistribution sizeDistribution(std::span<const double> densities) const;
};

// V_T = -sootThermophoresis() (mu/rho) grad T / T (thesis eq. 7-29, full accommodation).
[[nodiscard]] double sootThermophoresis();
// Enthalpy of soot carbon (graphite) and hydrogen (as in H2), J/kg, and slopes, J/kg/K (NASA polynomials of Gurvich's
// data; Burcat and Ruscic 2005).
[[nodiscard]] std::pair<double, double> sootCarbonEnthalpy(double temperature);
[[nodiscard]] std::pair<double, double> sootHydrogenEnthalpy(double temperature);

}  // namespace lampblack
