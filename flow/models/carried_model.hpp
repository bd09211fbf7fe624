// What a flame or a flow carries besides its gas (numbers, masses, sections, moments of particles), without knowing its
// meaning: how many scalars there are, how they move, what they take from and give to the gas. coupling/ puts models of
// particles behind it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/particle_gas.hpp"
#include "core/quantity.hpp"

namespace lampblack::flow {

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
    Quantity density;              // per m3
    double scale = 1;              // typical amount per kg of gas: the flame's unknown is amount per kg over this
    double thermophoresis = 0;     // V = -thermophoresis (mu/rho) grad T / T
    std::vector<double> elements;  // kg of each element of the mechanism per unit
    double negligible = 0;         // amount per kg of gas that counts as nothing; 0: unknown
  };

  virtual ~CarriedModel() = default;
  // What it is made of, "soot": results put it before the names of scalars and properties.
  [[nodiscard]] virtual std::string material() const = 0;
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
  // Densities and concentrations over `dt`, at what `gas` has beside its concentrations. `supply`: what else brings
  // them, per m3 and s, of the scalars, then of the species; empty: nothing does. Throws NumericsError.
  virtual ParticleAdvance advance(const CarrierGas& gas, double dt, std::span<double> densities,
                                  std::span<double> concentrations, std::span<const double> supply) = 0;
  // Nothing is there, and nothing can come of this gas.
  [[nodiscard]] virtual bool idle(const ParticleGas&, std::span<const double>) const { return false; }
  virtual void diffusivities(const ParticleGas& gas, std::span<const double> densities,
                             std::span<double> D) = 0;  // m2/s
  // Enthalpy of a unit of each scalar, J, and its slope, J/K.
  virtual void enthalpies(double temperature, std::span<double> h, std::span<double> slope) = 0;
  // Planck-mean absorption coefficient, 1/m.
  virtual double absorption(double temperature, std::span<const double> densities) = 0;

  // What is looked at besides the scalars.
  [[nodiscard]] virtual std::vector<Quantity> properties() const { return {}; }
  virtual void evaluateProperties(const ParticleGas&, std::span<const double>, std::span<double>) const {}
  [[nodiscard]] virtual double volumeFraction(std::span<const double>) const { return 0; }
  // The part of it in particles as large as the model can have.
  [[nodiscard]] virtual double volumeFractionAtLimit(std::span<const double>) const { return 0; }
};

}  // namespace lampblack::flow
