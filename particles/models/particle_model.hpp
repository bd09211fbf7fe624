// The interface of every particle model that a gas can carry: scalars per volume of gas, their sources, and the
// exchange with the gas. The same object serves a one-dimensional flame, a reactor and a flow cell; a model depends on
// neither mesh nor mechanism. The exchange conserves every element of scalars and gas species together, to round-off.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"

namespace lampblack::particles {

struct ElementMass {
  std::string element;  // "C"
  double mass = 0;      // kg
};

struct ParticleScalar {
  std::string name;         // "number", "section_07_aggregates"
  std::string unit;         // of its density: "1/m^3", "kg/m^3"
  std::string description;  // one line for the results file
  double scale = 1;         // typical amount per kg of gas where there are particles; unknowns are scaled by it
  std::vector<ElementMass> elements = {};  // in one unit; without those that are not in it

  // kg of an element in one unit.
  [[nodiscard]] double massOf(std::string_view element) const;
};

// Measurable properties at one point.
struct ParticleProperties {
  double numberDensity = 0;          // 1/m3, of aggregates
  double volumeFraction = 0;         // m3/m3
  double meanDiameter = 0;           // m, of the sphere of the mean volume
  double surfaceArea = 0;            // m2/m3
  double primaryDiameter = 0;        // m
  double primariesPerAggregate = 0;  // 1 for spheres
  double mobilityDiameter = 0;       // m
  double gyrationDiameter = 0;       // m
};

// How results files name them.
struct ParticlePropertyName {
  const char *name, *unit, *description;
  double ParticleProperties::*value;
};
inline constexpr std::array<ParticlePropertyName, 8> particlePropertyNames{{
    {"volume_fraction", "1", "particle volume per volume of gas", &ParticleProperties::volumeFraction},
    {"number_density", "1/m^3", "aggregates", &ParticleProperties::numberDensity},
    {"mean_diameter", "m", "of the sphere of mean volume", &ParticleProperties::meanDiameter},
    {"surface_area", "m^2/m^3", "surface of all particles", &ParticleProperties::surfaceArea},
    {"primary_diameter", "m", "of primary particles", &ParticleProperties::primaryDiameter},
    {"primaries_per_aggregate", "1", "primary particles in an aggregate", &ParticleProperties::primariesPerAggregate},
    {"mobility_diameter", "m", "mean mobility diameter", &ParticleProperties::mobilityDiameter},
    {"gyration_diameter", "m", "mean diameter of gyration", &ParticleProperties::gyrationDiameter},
}};

// Rates of the processes at one point, for budgets and figures: number in 1/m3/s, particle mass in kg/m3/s, losses
// negative.
struct ParticleProcesses {
  double nucleationNumber = 0, coagulationNumber = 0, oxidationNumber = 0, fragmentationNumber = 0;
  double nucleation = 0, condensation = 0, growth = 0, oxidationO2 = 0, oxidationOH = 0, carbonisation = 0;
  double dimerNumber = 0;      // 1/m3, where the model has dimers
  double dimerProduction = 0;  // 1/m3/s
};

// How results files name them.
struct ParticleProcessName {
  const char *name, *unit, *description;
  double ParticleProcesses::*value;
};
inline constexpr std::array<ParticleProcessName, 12> particleProcessNames{{
    {"nucleation_number", "1/m^3/s", "new particles", &ParticleProcesses::nucleationNumber},
    {"coagulation_number", "1/m^3/s", "particles lost by coagulation, negative", &ParticleProcesses::coagulationNumber},
    {"oxidation_number", "1/m^3/s", "particles lost by oxidation, negative", &ParticleProcesses::oxidationNumber},
    {"fragmentation_number", "1/m^3/s", "particles from fragmentation", &ParticleProcesses::fragmentationNumber},
    {"nucleation", "kg/m^3/s", "soot mass from nucleation", &ParticleProcesses::nucleation},
    {"condensation", "kg/m^3/s", "soot mass from condensation", &ParticleProcesses::condensation},
    {"growth", "kg/m^3/s", "soot mass from surface growth", &ParticleProcesses::growth},
    {"oxidation_O2", "kg/m^3/s", "soot mass lost by oxidation by O2, negative", &ParticleProcesses::oxidationO2},
    {"oxidation_OH", "kg/m^3/s", "soot mass lost by oxidation by OH, negative", &ParticleProcesses::oxidationOH},
    {"carbonisation", "kg/m^3/s", "soot mass lost by carbonisation, negative", &ParticleProcesses::carbonisation},
    {"dimer_number", "1/m^3", "dimers", &ParticleProcesses::dimerNumber},
    {"dimer_production", "1/m^3/s", "dimers formed", &ParticleProcesses::dimerProduction},
}};

// dN/dlog10(d) (1/m3) at diameters d (m, of the equivalent sphere).
struct SizeDistribution {
  std::vector<double> diameter, density;
};

class ParticleModel {
 public:
  // Share of the typical amount of a scalar (ParticleScalar::scale) below which the scalar is negligible.
  static constexpr double smallestShare = 1e-5;

  virtual ~ParticleModel() = default;

  // Material of the particles, "soot": the prefix of the names of scalars and properties in results files.
  [[nodiscard]] virtual std::string material() const = 0;
  // Gas species that the model depends on or exchanges, by their usual names in mechanisms. A ParticleGas has their
  // concentrations in this order.
  [[nodiscard]] virtual const std::vector<std::string>& gasSpecies() const = 0;
  // Indices in `gasSpecies` of the species without which there is no inception.
  [[nodiscard]] virtual std::vector<std::size_t> precursors() const = 0;
  [[nodiscard]] virtual const std::vector<ParticleScalar>& scalars() const = 0;

  // Weighted sums of the scalars whose profiles control the refinement of a grid: weights of all densities, such that
  // each sum is of order one per kg of gas where there are particles. Empty: every scalar by itself. Sectional models
  // give moments in place of sections.
  [[nodiscard]] virtual std::vector<std::vector<double>> gridSums() const { return {}; }

  // `densities`: of the scalars, per m3; negative ones (and negative concentrations) count as zero. `rates`: of the
  // scalars, per m3 and s. `exchange`: production of the gas species, mol/m3/s.
  virtual void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                       std::span<double> exchange) const = 0;

  // Derivatives of (rates, exchange), row-major, with respect to (densities, concentrations, temperature), each with
  // everything else held: (scalars + species) rows of (scalars + species + 1) columns. The default takes one-sided
  // differences of `sources`, away from zero, and at zero for what is negative; models with many scalars override it.
  virtual void jacobian(const ParticleGas& gas, std::span<const double> densities, std::span<double> values) const;

  // Advances the scalars' densities and the concentrations (mol/m3, in the order of gasSpecies; they come from the gas
  // and return to it) together over `dt` (s), at the temperature, pressure and viscosity of `gas`. `supply` is what
  // else brings them, per m3 and s: of the scalars, then of the species; empty: nothing does. The default integrates
  // `sources` with `jacobian` by RosenbrockSolver. Throws NumericsError without convergence.
  virtual ParticleAdvance advance(const CarrierGas& gas, double dt, std::span<double> densities,
                                  std::span<double> concentrations, std::span<const double> supply = {}) const;
  // Relative error allowed in a step of the default `advance`. At 1e-3 the volume fraction of a counterflow flame is
  // within 0.002 % (sections) to 0.13 % (MOMIC) of that at 1e-6 (docs/theory/soot_models.md).
  void setAdvanceTolerance(double relative) { advanceTolerance_ = relative; }

  // Whether the volume fraction is below 1e-21.
  [[nodiscard]] bool isNegligible(std::span<const double> densities) const;
  // Whether there are neither particles (isNegligible()) nor precursors, which are below a mole fraction of 1e-15.
  [[nodiscard]] bool idle(const ParticleGas& gas, std::span<const double> densities) const;

  // Brownian diffusivity of each scalar, m2/s. All scalars move by thermophoresis with thermophoresis().
  virtual void diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const = 0;
  // V_T = -thermophoresis() (mu/rho) grad T / T; by default Waldmann's limit of small particles with full accommodation
  // (Wang 2025, eq. 7-29).
  [[nodiscard]] virtual double thermophoresis() const;

  // Enthalpy of a unit of each scalar, J, and its slope, J/K.
  virtual void enthalpies(double temperature, std::span<double> h, std::span<double> slope) const = 0;
  // Planck-mean absorption coefficient, 1/m.
  [[nodiscard]] virtual double absorption(double temperature, double volumeFraction) const = 0;

  [[nodiscard]] virtual ParticleProperties properties(const ParticleGas& gas,
                                                      std::span<const double> densities) const = 0;
  // The same for results: all zero where isNegligible(), and no sizes where there is less than one particle per cm3, as
  // the ratio of traces that a solver leaves is no size.
  [[nodiscard]] ParticleProperties propertiesForResults(const ParticleGas& gas,
                                                        std::span<const double> densities) const;
  // m3/m3, for radiation. The default calls `properties` in a hot gas; models override the default where that is
  // costly.
  [[nodiscard]] virtual double volumeFraction(std::span<const double> densities) const;
  // The volume fraction (m3/m3) of particles of the largest size of the model, which cannot grow. A large value means
  // too few sections. Zero for models without such a size.
  [[nodiscard]] virtual double volumeFractionAtLimit(std::span<const double> densities) const;
  [[nodiscard]] virtual ParticleProcesses processes(const ParticleGas& gas,
                                                    std::span<const double> densities) const = 0;
  // Empty for models without a distribution. The diameters are the same for all densities.
  [[nodiscard]] virtual SizeDistribution sizeDistribution(std::span<const double> densities) const;

 private:
  double advanceTolerance_ = 1e-3;
};

}  // namespace lampblack::particles
