// What a flame carries besides its gas (numbers, masses, sections, moments of particles), without knowing its meaning:
// how many scalars there are, how they move, what they take from and give to the gas. app/ puts soot models behind it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/particle_gas.hpp"

namespace lampblack {

// Where the derivatives of the sources go, row-major: rows are the scalars, then the exchanged species; columns the
// scalars' densities, then the concentrations of the exchanged species, then the temperature (all else held).
struct CarriedJacobian {
  std::span<double> values;
  std::size_t columns = 0;
  double& operator()(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

class CarriedModel {
 public:
  struct Scalar {
    std::string name, unit;        // unit of the density per m3, "1/m3"
    double scale = 1;              // typical amount per kg of gas: the flame's unknown is amount per kg over this
    double thermophoresis = 0;     // V = -thermophoresis (mu/rho) grad T / T
    std::vector<double> elements;  // kg of each element of the mechanism per unit
  };

  virtual ~CarriedModel() = default;
  [[nodiscard]] virtual const std::vector<Scalar>& scalars() const = 0;
  // Species of the mechanism whose concentrations matter and that may be exchanged: those of a ParticleGas.
  [[nodiscard]] virtual const std::vector<std::size_t>& exchanged() const = 0;

  // Sums over the scalars whose profiles, beside those of the gas, decide about the grid: weights of all scalars'
  // densities, sums of like size. Empty: every scalar decides.
  [[nodiscard]] virtual std::vector<std::vector<double>> gridSums() const { return {}; }

  // `densities`: of every scalar per m3, negative ones count as zero. `rates`: of the scalars, per m3 and s;
  // `exchange`: production of the exchanged species, mol/m3/s.
  virtual void sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                       std::span<double> exchange) = 0;
  virtual void jacobian(const ParticleGas& gas, std::span<const double> densities, const CarriedJacobian& out) = 0;
  virtual void diffusivities(const ParticleGas& gas, std::span<const double> densities,
                             std::span<double> D) = 0;  // m2/s
  // Enthalpy of a unit of each scalar, J, and its slope, J/K.
  virtual void enthalpies(double temperature, std::span<double> h, std::span<double> slope) = 0;
  // Planck-mean absorption coefficient, 1/m.
  virtual double absorption(double temperature, std::span<const double> densities) = 0;
};

}  // namespace lampblack
