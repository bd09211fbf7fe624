// What the gas of a reactor carries and exchanges species with, such as particles, as the equations of the reactor see
// it: the amounts of some scalars, as unknowns beside mass fractions and temperature. coupling/ puts models of
// particles behind it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

class CarriedPhase {
 public:
  virtual ~CarriedPhase() = default;

  // How many scalars. Their unknowns are amounts per kg of gas and particles, in units that make them of order one
  // where there is something.
  [[nodiscard]] virtual std::size_t size() const = 0;
  // Species that it exchanges, or whose concentrations matter to it.
  [[nodiscard]] virtual const std::vector<std::size_t>& exchanged() const = 0;

  // In the gas of a temperature (K), pressure (Pa) and the concentrations (mol/m3) of all species, with the scalars'
  // amounts per m3: what each gains per m3 and s, and the production of the exchanged species, mol/m3/s. Throws
  // NumericsError.
  virtual void sources(double T, double p, std::span<const double> concentrations, std::span<const double> densities,
                       std::span<double> rates, std::span<double> exchange) = 0;
  // Derivatives of (rates, exchange), row-major, by (densities, concentrations of the exchanged species, T).
  virtual void jacobian(double T, double p, std::span<const double> concentrations, std::span<const double> densities,
                        std::span<double> values) = 0;
  // Enthalpy of a unit of each, J, and its slope, J/K. A phase has no volume: this is its internal energy, too.
  virtual void enthalpies(double T, std::span<double> h, std::span<double> slope) = 0;

 protected:
  CarriedPhase() = default;
  CarriedPhase(const CarriedPhase&) = default;
  CarriedPhase& operator=(const CarriedPhase&) = default;
};

}  // namespace lampblack::chemistry
