#include "app/problems/reactor/reactor_case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "app/problems/reactor/reactor_particle_output.hpp"
#include "core/errors.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {
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

// A steady state has no time; its solver has limits of its own.
void refuseTimes(const Deck& deck) {
  for (const char* key : {"time.maximum_step", "output.interval", "integrator"})
    if (deck.isGiven(key))
      throw deck.error(key,
                       "without time.end the steady state is computed, which has no use for this key; leave it out, or "
                       "give time.end");
}

void checkInterval(const Deck& deck, const ReactorCase& reactorCase, double end, const std::string& endKey,
                   const std::string& key = "output.interval") {
  if (reactorCase.output.interval && *reactorCase.output.interval > end)
    throw deck.error(key, fmt::format("expected no more than {}, {:g} (SI)", endKey, end));
}

std::shared_ptr<ClosedKind> readClosed(const Deck& deck, ReactorCase& reactorCase, ReactorSystem::Held held,
                                       bool hasVolume) {
  if (!deck.has("initial")) throw deck.error("initial", "a closed reactor needs the section 'initial'");
  const Mechanism& mechanism = *reactorCase.mechanism;
  auto closed = std::make_shared<ClosedKind>();
  closed->held = held;
  closed->initial = {readTemperature(deck, "initial.temperature", mechanism, TemperatureUse::reactor),
                     deck.quantity("pressure"), readMixture(deck, "initial", mechanism)};
  reactorCase.profile = readEnergy(deck, closed->initial.temperature, "time", mechanism);
  closed->duration = neededQuantity(deck, "time", "end", "a closed reactor");
  checkInterval(deck, reactorCase, closed->duration, "time.end");
  if (hasVolume) reactorcase::readVolume(deck, reactorCase, *closed);
  reactorcase::readIgnition(deck, reactorCase, *closed);
  reactorcase::readSensitivity(deck, reactorCase, *closed);
  return closed;
}

std::shared_ptr<const ReactorKind> readConstantPressure(const Deck& deck, ReactorCase& reactorCase) {
  return readClosed(deck, reactorCase, ReactorSystem::Held::Pressure, false);
}
std::shared_ptr<const ReactorKind> readConstantVolume(const Deck& deck, ReactorCase& reactorCase) {
  return readClosed(deck, reactorCase, ReactorSystem::Held::Density, false);
}
std::shared_ptr<const ReactorKind> readGivenVolume(const Deck& deck, ReactorCase& reactorCase) {
  return readClosed(deck, reactorCase, ReactorSystem::Held::Density, true);
}

std::shared_ptr<const ReactorKind> readPlugFlow(const Deck& deck, ReactorCase& reactorCase) {
  if (!deck.has("inlet")) throw deck.error("inlet", "a plug flow needs the section 'inlet'");
  const Mechanism& mechanism = *reactorCase.mechanism;
  auto duct = std::make_shared<PlugFlowKind>();
  GasState& inlet = duct->inlet;
  inlet = {readTemperature(deck, "inlet.temperature", mechanism, TemperatureUse::reactor), deck.quantity("pressure"),
           readMixture(deck, "inlet", mechanism)};
  duct->length = neededQuantity(deck, "reactor", "length", "a plug flow");
  reactorCase.profile = readEnergy(deck, inlet.temperature, "position", mechanism);
  if (deck.has("inlet.velocity") == deck.has("inlet.mass_flow"))
    throw deck.error("inlet", "a plug flow needs either 'velocity' or 'mass_flow'");
  const Thermo thermo(mechanism);
  const double density = thermo.density(inlet.temperature, inlet.pressure, inlet.Y);
  if (const auto velocity = deck.optionalQuantity("inlet.velocity")) {
    if (deck.has("reactor.area"))
      throw deck.error(
          "reactor.area",
          "the area is only used with 'inlet.mass_flow', but 'inlet.velocity' is given; leave one of the two out");
    duct->massFlux = *velocity * density;
  } else {
    duct->massFlux =
        deck.quantity("inlet.mass_flow") / neededQuantity(deck, "reactor", "area", "a plug flow with a mass flow");
  }
  requireLowMach(deck, deck.has("inlet.velocity") ? "inlet.velocity" : "inlet.mass_flow", thermo,
                 duct->massFlux / density, inlet.temperature, inlet.Y);
  reactorcase::readUpstream(deck, mechanism, *duct);
  reactorCase.output.interval = deck.optionalQuantity("output.spacing");
  checkInterval(deck, reactorCase, duct->length, "reactor.length", "output.spacing");
  return duct;
}

// Stirred reactors: the end is known, or zero.
std::shared_ptr<const ReactorKind> checkedTimes(const Deck& deck, const ReactorCase& reactorCase, StirredKind stirred) {
  if (stirred.duration == 0)
    refuseTimes(deck);
  else
    checkInterval(deck, reactorCase, stirred.duration, "time.end");
  return std::make_shared<StirredKind>(std::move(stirred));
}

std::shared_ptr<const ReactorKind> readStirred(const Deck& deck, ReactorCase& reactorCase) {
  return checkedTimes(deck, reactorCase, reactorcase::readStirred(deck, *reactorCase.mechanism));
}

std::shared_ptr<const ReactorKind> readNetwork(const Deck& deck, ReactorCase& reactorCase) {
  StirredKind network = reactorcase::readNetwork(deck, *reactorCase.mechanism);
  if (network.duration > 0 && !hasPopulation(deck))
    throw deck.error("time.end",
                     "the steady state of a network is computed; only with an ensemble or trees of 'particles' "
                     "is it followed in time");
  return checkedTimes(deck, reactorCase, std::move(network));
}

// Rows are kept until the end.
void refuseRows(const Deck& deck, const ReactorCase& reactorCase) {
  if (!reactorCase.output.interval) return;
  const std::string key = reactorCase.kind->intervalKey();
  const double rows = reactorCase.kind->end() / *reactorCase.output.interval;
  std::size_t columns = 6 + reactorCase.output.species.size();
  if (reactorCase.ensemble) columns = 2 * (columns + 30) * reactorCase.kind->reactors();
  if (reactorCase.soot) columns += particleColumns(*reactorCase.soot).size();
  const double bytes = sizeof(double) * static_cast<double>(columns);
  requireOutputs(deck, key, "rows of the history", rows, bytes);
  requireMemory(deck, key, fmt::format("a history of {:.3g} rows", rows), rows * bytes);
}

void readParticles(const Deck& deck, ReactorCase& reactorCase) {
  if (hasPopulation(deck)) return reactorcase::readPopulations(deck, reactorCase);
  auto model = readSootModel(deck, *reactorCase.mechanism);
  if (!model) return;
  if (deck.isGiven("particles.diffusion"))
    throw deck.error("particles.diffusion", "a reactor is well mixed and nothing diffuses in it; leave this key out");
  if (deck.has("sensitivity"))
    throw deck.error("sensitivity",
                     "sensitivities are those of a gas alone; leave out the section 'particles' or this one");
  reactorCase.soot = std::make_shared<CarriedParticles>(*reactorCase.mechanism, std::move(model));
  try {
    reactorCase.particles = std::make_shared<ReactorParticles>(*reactorCase.mechanism, *reactorCase.soot);
  } catch (const InputError& error) {
    throw deck.error(particleSection, fmt::format("particles need the gas's viscosity: {}", error.what()));
  }
  reactorCase.sootAtLimit = deck.number("particles.sectional.overflow");
}

}  // namespace

DeckKeys<StiffIntegrator::Options> reactorcase::integratorKeys() {
  using Options = StiffIntegrator::Options;
  DeckKeys<Options> keys("integrator");
  keys.section(Presence::defaulted, "The stiff solver of everything but steady states.");
  keys.number("relative_tolerance", &Options::relativeTolerance, rules().byDefault("1e-9").above(0).below(1),
              "Relative tolerance of the stiff solver of the chemistry: smaller is more accurate and slower.");
  keys.number("absolute_tolerance", &Options::absoluteTolerance, rules().byDefault("1e-15").above(0).below(1),
              "Absolute tolerance of the stiff solver of the chemistry, in mass fraction: smaller is more accurate and "
              "slower.");
  keys.integer("maximum_steps", &Options::maximumSteps, rules().byDefault("1000000").above(0),
               "Number of steps of the integrator after which the run gives up.");
  return keys;
}

const std::vector<reactorcase::NamedReactorKind>& reactorcase::reactorKinds() {
  static const std::vector<NamedReactorKind> kinds{{"constant_pressure", readConstantPressure},
                                                   {"constant_volume", readConstantVolume},
                                                   {"given_volume", readGivenVolume},
                                                   {"stirred", app::readStirred},
                                                   {"plug_flow", readPlugFlow},
                                                   {"network", app::readNetwork}};
  return kinds;
}

ReactorCase readReactorCase(const Deck& deck) {
  ReactorCase reactorCase;
  const std::string type = deck.choice("reactor.type");
  checkEnergy(deck, type);
  reactorCase.title = deck.string("title");
  reactorCase.mechanism = readMechanism(deck);
  reactorCase.integrator = reactorcase::integratorKeys().read(deck);
  reactorCase.integrator.maximumStep = deck.optionalQuantity("time.maximum_step").value_or(0.0);
  reactorCase.output = {deck.optionalQuantity("output.interval"),
                        readSpeciesList(deck, "output.species", *reactorCase.mechanism),
                        deck.choice("output.fractions") == "mass"};
  const auto& kinds = reactorcase::reactorKinds();
  reactorCase.kind = std::ranges::find(kinds, type, &reactorcase::NamedReactorKind::name)->read(deck, reactorCase);
  readParticles(deck, reactorCase);
  refuseRows(deck, reactorCase);
  return reactorCase;
}

}  // namespace lampblack::app
