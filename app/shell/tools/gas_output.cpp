#include "app/shell/tools/gas_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/json.hpp"

namespace lampblack::app {
namespace {

// Species below these are left out of the table: a mole fraction, and a share of the largest production rate.
constexpr double leastFraction = 1e-12;
constexpr double leastRate = 1e-9;

const std::map<std::string, std::string> constantNames = {{"TP", "temperature and pressure"},
                                                          {"HP", "enthalpy and pressure"},
                                                          {"SP", "entropy and pressure"},
                                                          {"TV", "temperature and volume"},
                                                          {"UV", "internal energy and volume"}};

void bySpecies(JsonWriter& json, const char* key, const Mechanism& mechanism, const std::vector<double>& values) {
  json.key(key).beginObject();
  for (std::size_t k = 0; k < values.size(); ++k) json.field(mechanism.speciesName(k), values[k]);
  json.endObject();
}

void multicomponentDiffusion(JsonWriter& json, const Mechanism& mechanism, const std::vector<double>& D) {
  const std::size_t n = mechanism.numSpecies();
  json.key("multicomponent_diffusion_coefficients").beginObject();
  for (std::size_t k = 0; k < n; ++k)
    bySpecies(json, mechanism.speciesName(k).c_str(), mechanism, {D.begin() + k * n, D.begin() + (k + 1) * n});
  json.endObject();
}

void inFileOrder(JsonWriter& json, const char* key, const std::vector<double>& values) {
  json.key(key).beginArray();
  for (const double value : values) json.value(value);
  json.endArray();
}

std::string stateTable(const Mechanism& mechanism, const GasReport& gas) {
  std::string out = fmt::format("{}: {} species, {} reactions\n\n", mechanism.fileName(), mechanism.numSpecies(),
                                mechanism.numReactions());
  if (!gas.equilibrium.empty())
    out += fmt::format("  equilibrium at constant {}\n\n", constantNames.at(gas.equilibrium));
  const auto line = [&](const char* name, double value, const char* unit) {
    out += fmt::format("  {:<24}{:>14.7g} {}\n", name, value, unit);
  };
  line("temperature", gas.temperature, "K");
  line("pressure", gas.pressure, "Pa");
  line("density", gas.density, "kg/m^3");
  line("mean molecular weight", gas.meanMolecularWeight, "kg/mol");
  line("heat capacity (cp)", gas.cpMass, "J/kg/K");
  line("enthalpy", gas.enthalpyMass, "J/kg");
  line("entropy", gas.entropyMass, "J/kg/K");
  if (gas.transport) {
    line("viscosity", gas.transport->viscosity, "Pa s");
    line("thermal conductivity", gas.transport->thermalConductivity, "W/m/K");
    out += fmt::format("  {:<24}{:>14}\n", "transport", transportModelName(gas.transport->choice.model));
  } else {
    out += fmt::format("  no transport properties: {}\n", gas.transportNote);
  }
  return out;
}

std::size_t widestName(const Mechanism& mechanism) {
  std::size_t width = std::string_view("species").size();
  for (const Species& species : mechanism.allSpecies()) width = std::max(width, species.name.size());
  return width;
}

std::string speciesTable(const Mechanism& mechanism, const GasReport& gas, bool all) {
  const std::size_t width = widestName(mechanism);
  // At equilibrium net rates are what rounding leaves.
  double fastest = gas.equilibrium.empty() ? 0 : INFINITY;
  for (const double rate : gas.netProductionRates) fastest = std::max(fastest, std::abs(rate));
  std::string out = fmt::format("\n  {:<{}}{:>14}{:>14}", "species", width, "X", "Y");
  const bool soret = gas.transport && !gas.transport->thermalDiffusion.empty();
  if (gas.transport) out += fmt::format("{:>14}", "D [m^2/s]");
  if (soret) out += fmt::format("{:>15}", "DT [kg/m/s]");
  out += fmt::format("{:>18}\n", "rate [mol/m^3/s]");
  std::size_t hidden = 0;
  for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) {
    const bool matters =
        gas.moleFractions[k] > leastFraction || std::abs(gas.netProductionRates[k]) > leastRate * fastest;
    if (!all && !matters) {
      ++hidden;
      continue;
    }
    out += fmt::format("  {:<{}}{:>14.5e}{:>14.5e}", mechanism.speciesName(k), width, gas.moleFractions[k],
                       gas.massFractions[k]);
    if (gas.transport) out += fmt::format("{:>14.5e}", gas.transport->mixtureDiffusion[k]);
    if (soret) out += fmt::format("{:>15.5e}", gas.transport->thermalDiffusion[k]);
    out += fmt::format("{:>18.5e}\n", gas.netProductionRates[k]);
  }
  if (hidden > 0)
    out += fmt::format("  {} more are below X = {:g}{} (--all shows them)\n", hidden, leastFraction,
                       gas.equilibrium.empty() ? fmt::format(" and {:g} of the largest rate", leastRate) : "");
  return out;
}

std::string reactionTable(const Mechanism& mechanism, const GasReport& gas) {
  std::size_t width = std::string_view("reaction").size();
  for (const Reaction& reaction : mechanism.reactions()) width = std::max(width, reaction.equation.size());
  std::string out = "\n  rate constants in (m^3/mol)^(order-1)/s\n";
  out += fmt::format("  {:>5}  {:<{}}{:>14}{:>14}\n", "", "reaction", width, "forward", "reverse");
  for (std::size_t r = 0; r < mechanism.numReactions(); ++r)
    out += fmt::format("  {:>5}  {:<{}}{:>14.5e}{:>14.5e}\n", r + 1, mechanism.reaction(r).equation, width,
                       gas.forwardConstants[r], gas.reverseConstants[r]);
  return out;
}

}  // namespace

std::string gasJson(const Mechanism& mechanism, const GasReport& gas) {
  JsonWriter json;
  json.beginObject();
  json.field("temperature", gas.temperature).field("pressure", gas.pressure).field("density", gas.density);
  json.field("mean_molecular_weight", gas.meanMolecularWeight);
  json.field("cp_mass", gas.cpMass).field("enthalpy_mass", gas.enthalpyMass).field("entropy_mass", gas.entropyMass);
  if (gas.transport) {
    json.field("viscosity", gas.transport->viscosity);
    json.field("thermal_conductivity", gas.transport->thermalConductivity);
  } else {
    json.key("viscosity").null().key("thermal_conductivity").null();
  }
  bySpecies(json, "mole_fractions", mechanism, gas.moleFractions);
  const auto orNull = [&](const char* key, const std::vector<double>* values) {
    if (values && !values->empty()) {
      bySpecies(json, key, mechanism, *values);
    } else {
      json.key(key).null();
    }
  };
  orNull("mixture_diffusion_coefficients", gas.transport ? &gas.transport->mixtureDiffusion : nullptr);
  orNull("thermal_diffusion_coefficients", gas.transport ? &gas.transport->thermalDiffusion : nullptr);
  inFileOrder(json, "forward_rate_constants", gas.forwardConstants);
  inFileOrder(json, "reverse_rate_constants", gas.reverseConstants);
  bySpecies(json, "net_production_rates", mechanism, gas.netProductionRates);
  bySpecies(json, "mass_fractions", mechanism, gas.massFractions);
  json.key("equilibrium");
  gas.equilibrium.empty() ? json.null() : json.value(gas.equilibrium);
  json.key("transport_model");
  gas.transport ? json.value(transportModelName(gas.transport->choice.model)) : json.null();
  if (!gas.transport) json.field("transport_note", gas.transportNote);
  if (gas.transport && !gas.transport->multicomponentDiffusion.empty())
    multicomponentDiffusion(json, mechanism, gas.transport->multicomponentDiffusion);
  json.endObject();
  return json.text() + "\n";
}

std::string gasText(const Mechanism& mechanism, const GasReport& gas, const GasTables& tables) {
  std::string out = stateTable(mechanism, gas) + speciesTable(mechanism, gas, tables.allSpecies);
  if (tables.reactions) out += reactionTable(mechanism, gas);
  return out;
}

}  // namespace lampblack::app
