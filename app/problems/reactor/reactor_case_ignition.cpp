// Ignition criteria and sensitivities of a reactor deck.
#include <fmt/format.h>

#include <algorithm>

#include "app/deck/gas_input.hpp"
#include "app/deck/sensitivity_deck.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "app/run/warnings.hpp"
#include "chemistry/mechanism/known_species.hpp"
#include "chemistry/thermo/equilibrium.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::app::reactorcase {
namespace {

// The temperature of equilibrium in an adiabatic reactor; none where it cannot be computed.
std::optional<double> burntTemperature(const Mechanism& mechanism, const ClosedKind& closed) {
  const double T = closed.initial.temperature, p = closed.initial.pressure;
  const std::vector<double>& start = closed.initial.Y;
  const Thermo thermo(mechanism);
  std::vector<double> Y = start;
  try {
    Equilibrium equilibrium(mechanism);
    if (closed.held == ReactorSystem::Held::Pressure)
      return equilibrium.atEnthalpyAndPressure(thermo.enthalpyMass(T, Y), p, Y);
    return equilibrium.atEnergyAndDensity(thermo.internalEnergyMass(T, start), thermo.density(T, p, start), Y);
  } catch (const NumericsError&) {
    return std::nullopt;
  }
}

// A gas that does not become hotter does not ignite.
void requireIgnition(const Deck& deck, const std::string& key, const Mechanism& mechanism, const ClosedKind& closed) {
  const auto burnt = burntTemperature(mechanism, closed);
  if (burnt && *burnt < closed.initial.temperature + 1)
    throw deck.error(key, fmt::format("this gas does not ignite: its equilibrium from {:g} K is at {:.6g} K",
                                      closed.initial.temperature, *burnt));
}

}  // namespace

void readIgnition(const Deck& deck, const ReactorCase& reactorCase, ClosedKind& closed) {
  using Kind = IgnitionCriterion::Kind;
  const Mechanism& mechanism = *reactorCase.mechanism;
  const bool adiabatic = !reactorCase.profile;
  auto& criteria = closed.ignition;
  if (adiabatic && deck.boolean("ignition.temperature_rate"))
    criteria.push_back({Kind::TemperatureRate, 0, 0.0, "max_dTdt"});
  if (adiabatic && deck.boolean("ignition.first_stage"))
    criteria.push_back({.kind = Kind::TemperatureRate, .name = "first_stage", .firstStage = true});
  if (adiabatic && closed.held != ReactorSystem::Held::Pressure && deck.boolean("ignition.pressure_rate")) {
    const GasState& start = closed.initial;
    const double density = Thermo(mechanism).density(start.temperature, start.pressure, start.Y);
    criteria.push_back({.kind = Kind::PressureRate, .name = "max_dpdt", .scale = density * constants::gasConstant});
  }
  std::vector<std::size_t> species;
  if (deck.isGiven("ignition.species"))
    species = readSpeciesList(deck, "ignition.species", mechanism);
  else if (const auto hydroxyl = findKnownSpecies(mechanism, "OH"))
    species = {*hydroxyl};
  else if (mechanism.findElement("H") && mechanism.findElement("O"))
    printWarnings(
        {"ignition: the mechanism has no species OH that could be told from others of its composition; there "
         "is no delay by it (ignition.species names others)"});
  for (const std::size_t k : species) {
    criteria.push_back({Kind::MoleFraction, k, 0.0, "max_X_" + mechanism.speciesName(k)});
    criteria.push_back({Kind::MassFraction, k, 0.0, "max_Y_" + mechanism.speciesName(k)});
  }
  if (const auto rise = deck.optionalQuantity("ignition.temperature_rise")) {
    if (!closed.volume) requireIgnition(deck, "ignition.temperature_rise", mechanism, closed);
    criteria.push_back({Kind::TemperatureRise, 0, *rise, fmt::format("rise_{:g}K", *rise)});
  }
}

void readSensitivity(const Deck& deck, const ReactorCase& reactorCase, ClosedKind& closed) {
  if (!deck.has("sensitivity")) return;
  if (closed.ignition.empty())
    throw deck.error(
        "sensitivity",
        "there is no ignition delay to compute sensitivities of; give a criterion in the section 'ignition'");
  if (!reactorCase.profile) requireIgnition(deck, "sensitivity", *reactorCase.mechanism, closed);
  closed.sensitivities = readSensitivityReactions(deck, *reactorCase.mechanism);
}

}  // namespace lampblack::app::reactorcase
