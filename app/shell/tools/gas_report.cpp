#include "app/shell/tools/gas_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/thermo/equilibrium.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::app {
namespace {

GasReport thermodynamics(const Mechanism& mechanism, double T, double p, std::span<const double> X) {
  GasReport gas;
  gas.temperature = T;
  gas.pressure = p;
  gas.moleFractions.assign(X.begin(), X.end());
  gas.massFractions.resize(X.size());
  const Thermo thermo(mechanism);
  thermo.moleToMass(X, gas.massFractions);
  gas.meanMolecularWeight = thermo.meanMolecularWeight(gas.massFractions);
  gas.density = thermo.density(T, p, gas.massFractions);
  gas.cpMass = thermo.cpMass(T, gas.massFractions);
  gas.enthalpyMass = thermo.enthalpyMass(T, gas.massFractions);
  gas.entropyMass = thermo.entropyMass(T, p, gas.massFractions);
  return gas;
}

void setRates(const Mechanism& mechanism, GasReport& gas) {
  auto concentrations = gas.moleFractions;
  for (double& c : concentrations) c *= gas.pressure / (constants::gasConstant * gas.temperature);
  Kinetics kinetics(mechanism);
  gas.netProductionRates.resize(mechanism.numSpecies());
  kinetics.netProductionRates(gas.temperature, concentrations, gas.netProductionRates);
  gas.forwardConstants.resize(mechanism.numReactions());
  gas.reverseConstants.resize(mechanism.numReactions());
  kinetics.rateConstants(gas.temperature, concentrations, gas.forwardConstants, gas.reverseConstants);
}

void requireFinite(const GasReport& gas) {
  const auto check = [&](std::span<const double> values, const char* what) {
    if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); }))
      throw NumericsError(
          fmt::format("{} at {:.6g} K and {:.6g} Pa are not finite numbers", what, gas.temperature, gas.pressure));
  };
  const double mixture[] = {gas.density, gas.meanMolecularWeight, gas.cpMass, gas.enthalpyMass, gas.entropyMass};
  check(mixture, "the thermodynamic properties");
  check(gas.forwardConstants, "the forward rate constants");
  check(gas.reverseConstants, "the reverse rate constants");
  check(gas.netProductionRates, "the net production rates");
}

}  // namespace

GasReport gasReport(const Mechanism& mechanism, double T, double p, std::span<const double> X) {
  GasReport gas = thermodynamics(mechanism, T, p, X);
  setRates(mechanism, gas);
  requireFinite(gas);
  return gas;
}

GasReport gasAtEquilibrium(const Mechanism& mechanism, double T, double p, std::span<const double> X,
                           const std::string& constant) {
  const GasReport start = thermodynamics(mechanism, T, p, X);
  const Thermo thermo(mechanism);
  Equilibrium equilibrium(mechanism);
  std::vector<double> Y = start.massFractions, result(Y.size());
  if (constant == "TP")
    equilibrium.atTemperatureAndPressure(T, p, Y);
  else if (constant == "TV")
    equilibrium.atTemperatureAndDensity(T, start.density, Y);
  else if (constant == "HP")
    T = equilibrium.atEnthalpyAndPressure(start.enthalpyMass, p, Y);
  else if (constant == "SP")
    T = equilibrium.atEntropyAndPressure(start.entropyMass, p, Y);
  else if (constant == "UV")
    T = equilibrium.atEnergyAndDensity(thermo.internalEnergyMass(T, Y), start.density, Y);
  else
    throw std::logic_error("unknown pair of constant quantities " + constant);
  if (constant == "TV" || constant == "UV") p *= start.density / thermo.density(T, p, Y);
  thermo.massToMole(Y, result);
  GasReport gas = gasReport(mechanism, T, p, result);
  gas.equilibrium = constant;
  return gas;
}

void addTransport(const Mechanism& mechanism, const GasTransportChoice& choice, bool needed, GasReport& gas) {
  const auto compute = [&] {
    gas.transport = gasTransport(mechanism, gas.temperature, gas.pressure, gas.moleFractions, choice);
  };
  if (needed) {
    compute();
    return;
  }
  try {
    compute();
  } catch (const InputError& error) {
    gas.transportNote = error.what();
  } catch (const NumericsError& error) {
    gas.transportNote = error.what();
  }
}

std::string rangeWarning(const Mechanism& mechanism, double T) {
  std::size_t outside = 0;
  const Species* narrowest = nullptr;
  double distance = 0;
  for (const Species& species : mechanism.allSpecies()) {
    const double beyond = std::max(species.thermo.minTemperature - T, T - species.thermo.maxTemperature);
    if (!(beyond > 0)) continue;
    ++outside;
    if (beyond <= distance) continue;
    distance = beyond;
    narrowest = &species;
  }
  if (outside == 0) return {};
  return fmt::format(
      "{:.6g} K is outside the range of the thermodynamic data of {} species, whose polynomials are "
      "extrapolated; the narrowest range is that of '{}', {:.6g} to {:.6g} K",
      T, outside, narrowest->name, narrowest->thermo.minTemperature, narrowest->thermo.maxTemperature);
}

}  // namespace lampblack::app
