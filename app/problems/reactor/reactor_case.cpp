#include "app/problems/reactor/reactor_case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "app/problems/reactor/reactor_driver.hpp"
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

void checkInterval(const Deck& deck, const std::string& key, const ReactorCase& reactorCase, double end,
                   const std::string& endKey) {
  if (reactorCase.output.interval && *reactorCase.output.interval > end)
    throw deck.error(key, fmt::format("expected no more than {}, {:g} (SI)", endKey, end));
}

void readClosed(const Deck& deck, ReactorCase& reactorCase) {
  if (!deck.has("initial")) throw deck.error("initial", "a closed reactor needs the section 'initial'");
  const Mechanism& mechanism = *reactorCase.mechanism;
  reactorCase.initial = {readTemperature(deck, "initial.temperature", mechanism, TemperatureUse::reactor),
                         deck.quantity("pressure"), readMixture(deck, "initial", *reactorCase.mechanism)};
  reactorCase.profile = readEnergy(deck, reactorCase.initial.temperature, "time", mechanism);
  reactorCase.end = neededQuantity(deck, "time", "end", "a closed reactor");
  checkInterval(deck, "output.interval", reactorCase, reactorCase.end, "time.end");
  if (reactorCase.type == ReactorType::GivenVolume) reactorcase::readVolume(deck, reactorCase);
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
  const Thermo thermo(mechanism);
  const double density = thermo.density(inlet.temperature, inlet.pressure, inlet.Y);
  if (const auto velocity = deck.optionalQuantity("inlet.velocity")) {
    if (deck.has("reactor.area"))
      throw deck.error(
          "reactor.area",
          "the area is only used with 'inlet.mass_flow', but 'inlet.velocity' is given; leave one of the two out");
    reactorCase.massFlux = *velocity * density;
  } else {
    reactorCase.massFlux =
        deck.quantity("inlet.mass_flow") / neededQuantity(deck, "reactor", "area", "a plug flow with a mass flow");
  }
  requireLowMach(deck, deck.has("inlet.velocity") ? "inlet.velocity" : "inlet.mass_flow", thermo,
                 reactorCase.massFlux / density, inlet.temperature, inlet.Y);
  reactorcase::readUpstream(deck, reactorCase);
  reactorCase.output.interval = deck.optionalQuantity("output.spacing");
  checkInterval(deck, "output.spacing", reactorCase, reactorCase.length, "reactor.length");
}

// Stirred reactors: the end is known, or zero.
void checkTimes(const Deck& deck, const ReactorCase& reactorCase) {
  if (reactorCase.end == 0)
    refuseTimes(deck);
  else
    checkInterval(deck, "output.interval", reactorCase, reactorCase.end, "time.end");
}

void readStirred(const Deck& deck, ReactorCase& reactorCase) {
  reactorcase::readStirred(deck, reactorCase);
  checkTimes(deck, reactorCase);
}

void readNetwork(const Deck& deck, ReactorCase& reactorCase) {
  reactorcase::readNetwork(deck, reactorCase);
  reactorCase.end = deck.optionalQuantity("time.end").value_or(0.0);
  if (reactorCase.end > 0 && !hasPopulation(deck))
    throw deck.error("time.end",
                     "the steady state of a network is computed; only with an ensemble or trees of 'particles' "
                     "is it followed in time");
  checkTimes(deck, reactorCase);
}

std::unique_ptr<ReactorDriver> stirredDriver(const ReactorCase& reactorCase) {
  return reactorCase.end > 0 ? stirredTransientDriver(reactorCase) : steadyNetworkDriver(reactorCase);
}

// Rows are kept until the end: `range` is the time or length of the run.
void refuseRows(const Deck& deck, const std::string& key, const ReactorCase& reactorCase, double range) {
  if (!reactorCase.output.interval) return;
  const double rows = range / *reactorCase.output.interval;
  std::size_t columns = 6 + reactorCase.output.species.size();
  if (reactorCase.ensemble)
    columns = 2 * (columns + 30) * std::max<std::size_t>(reactorCase.network.reactors.size(), 1);
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

const std::vector<ReactorKind>& reactorKinds() {
  using Type = ReactorType;
  static const std::vector<ReactorKind> kinds{
      {"constant_pressure", Type::ConstantPressure, readClosed, closedReactorDriver},
      {"constant_volume", Type::ConstantVolume, readClosed, closedReactorDriver},
      {"given_volume", Type::GivenVolume, readClosed, closedReactorDriver},
      {"stirred", Type::Stirred, readStirred, stirredDriver},
      {"plug_flow", Type::PlugFlow, readPlugFlow, plugFlowDriver},
      {"network", Type::Network, readNetwork, steadyNetworkDriver}};
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
  const ReactorKind& kind = *std::ranges::find(reactorKinds(), type, &ReactorKind::name);
  reactorCase.type = kind.type;
  kind.read(deck, reactorCase);
  readParticles(deck, reactorCase);
  const bool plugFlow = reactorCase.type == ReactorType::PlugFlow;
  refuseRows(deck, plugFlow ? "output.spacing" : "output.interval", reactorCase,
             plugFlow ? reactorCase.length : reactorCase.end);
  return reactorCase;
}

}  // namespace lampblack::app
