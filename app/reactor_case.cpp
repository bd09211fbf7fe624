#include "app/reactor_case.hpp"

#include <fmt/format.h>

#include "app/gas_input.hpp"
#include "app/reactor_case_parts.hpp"
#include "app/temperature_input.hpp"
#include "core/errors.hpp"

namespace lampblack {
namespace {

// The points of a profile stand in the key `points` ("time" or "position").
TemperatureProfile readProfile(const Deck& deck, const std::string& points, const Mechanism& mechanism) {
  if (!deck.has("temperature_profile"))
    throw deck.error("reactor.energy", "'profile' needs the section 'temperature_profile'");
  return readTemperatureProfile(deck, points, mechanism, TemperatureUse::reactor);
}

// `own`: the temperature of the start or the inlet.
std::optional<TemperatureProfile> readEnergy(const Deck& deck, double own, const std::string& points,
                                             const Mechanism& mechanism) {
  const std::string energy = deck.choice("reactor.energy");
  if (energy == "adiabatic") return std::nullopt;
  if (energy == "profile") return readProfile(deck, points, mechanism);
  return TemperatureProfile(deck.has("reactor.temperature")
                                ? readTemperature(deck, "reactor.temperature", mechanism, TemperatureUse::reactor)
                                : own);
}

// Energies that a type of reactor does not have.
void checkEnergy(const Deck& deck, const std::string& type) {
  const std::string energy = deck.choice("reactor.energy");
  if (energy != "adiabatic" && type == "network")
    throw deck.error("reactor.energy", "in a network each reactor may have a 'temperature' of its own");
  if (energy == "profile" && type == "stirred")
    throw deck.error("reactor.energy", "a stirred reactor has one temperature: 'isothermal' with 'temperature'");
}

void readClosed(const Deck& deck, ReactorCase& reactorCase) {
  if (!deck.has("initial")) throw deck.error("initial", "a closed reactor needs the section 'initial'");
  const Mechanism& mechanism = *reactorCase.mechanism;
  reactorCase.initial = {readTemperature(deck, "initial.temperature", mechanism, TemperatureUse::reactor),
                         deck.quantity("pressure"), readMixture(deck, "initial", *reactorCase.mechanism)};
  reactorCase.profile = readEnergy(deck, reactorCase.initial.temperature, "time", mechanism);
  reactorCase.end = neededQuantity(deck, "time", "end", "a closed reactor");
  reactorcase::readIgnition(deck, reactorCase);
  reactorcase::readSensitivity(deck, reactorCase);
}

void readPlugFlow(const Deck& deck, ReactorCase& reactorCase) {
  if (!deck.has("inlet")) throw deck.error("inlet", "a plug flow needs the section 'inlet'");
  const Mechanism& mechanism = *reactorCase.mechanism;
  GasState& inlet = reactorCase.inlet;
  inlet = {readTemperature(deck, "inlet.temperature", mechanism, TemperatureUse::reactor), deck.quantity("pressure"),
           readMixture(deck, "inlet", mechanism)};
  reactorCase.length = neededQuantity(deck, "reactor", "length", "a plug flow");
  reactorCase.profile = readEnergy(deck, inlet.temperature, "position", mechanism);
  if (deck.has("inlet.velocity") == deck.has("inlet.mass_flow"))
    throw deck.error("inlet", "a plug flow needs either 'velocity' or 'mass_flow'");
  if (const auto velocity = deck.optionalQuantity("inlet.velocity"))
    reactorCase.massFlux = *velocity * Thermo(mechanism).density(inlet.temperature, inlet.pressure, inlet.Y);
  else
    reactorCase.massFlux =
        deck.quantity("inlet.mass_flow") / neededQuantity(deck, "reactor", "area", "a plug flow with a mass flow");
  reactorCase.output.interval = deck.optionalQuantity("output.spacing");
}

}  // namespace

ReactorCase readReactorCase(const Deck& deck) {
  ReactorCase reactorCase;
  const std::string type = deck.choice("reactor.type");
  checkEnergy(deck, type);
  reactorCase.title = deck.string("title");
  reactorCase.mechanism = readMechanism(deck);
  reactorCase.integrator = {deck.number("integrator.relative_tolerance"), deck.number("integrator.absolute_tolerance"),
                            deck.optionalQuantity("time.maximum_step").value_or(0.0),
                            static_cast<long>(deck.integer("integrator.maximum_steps"))};
  reactorCase.output = {deck.optionalQuantity("output.interval"),
                        readSpeciesList(deck, "output.species", *reactorCase.mechanism),
                        deck.choice("output.fractions") == "mass"};
  if (type == "constant_pressure" || type == "constant_volume") {
    reactorCase.type = type == "constant_pressure" ? ReactorType::ConstantPressure : ReactorType::ConstantVolume;
    readClosed(deck, reactorCase);
  } else if (type == "plug_flow") {
    reactorCase.type = ReactorType::PlugFlow;
    readPlugFlow(deck, reactorCase);
  } else if (type == "stirred") {
    reactorCase.type = ReactorType::Stirred;
    reactorcase::readStirred(deck, reactorCase);
  } else {
    reactorCase.type = ReactorType::Network;
    reactorcase::readNetwork(deck, reactorCase);
  }
  return reactorCase;
}

}  // namespace lampblack
