// What `lampblack gas` says of a gas at one state, gathered from the models of the chemistry module.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/shell/tools/gas_transport.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

struct GasReport {
  std::string equilibrium;         // "HP": what was held constant on the way to equilibrium; empty if it was not sought
  double temperature = 0;          // K
  double pressure = 0;             // Pa
  double density = 0;              // kg/m3
  double meanMolecularWeight = 0;  // kg/mol
  double cpMass = 0;               // J/kg/K, at frozen composition
  double enthalpyMass = 0;         // J/kg, with enthalpies of formation
  double entropyMass = 0;          // J/kg/K
  std::vector<double> moleFractions, massFractions;
  std::vector<double> netProductionRates;                  // mol/m3/s
  std::vector<double> forwardConstants, reverseConstants;  // (m3/mol)^(order-1)/s, in file order
  std::optional<GasTransport> transport;
  std::string transportNote;  // why there is no transport
};

// All of it at T (K), p (Pa) and mole fractions X that sum to one; `transport` is left empty. NumericsError if a number
// is not finite.
GasReport gasReport(const Mechanism& mechanism, double T, double p, std::span<const double> X);

// The same at the chemical equilibrium that T, p and X turn into while two quantities stay constant: "TP", "HP", "SP",
// "TV" or "UV" (temperature, pressure, enthalpy, entropy, volume, internal energy). NumericsError if there is none.
GasReport gasAtEquilibrium(const Mechanism& mechanism, double T, double p, std::span<const double> X,
                           const std::string& constant);

// Adds the transport properties. Without transport data, or outside the range of temperature of the model, that is an
// error if they are `needed` (InputError, NumericsError), else a note.
void addTransport(const Mechanism& mechanism, const GasTransportChoice& choice, bool needed, GasReport& gas);

// Says that T is outside the range of thermodynamic data, and names the species whose range ends first; empty if
// inside.
std::string rangeWarning(const Mechanism& mechanism, double T);

}  // namespace lampblack::app
