#include "app/problems/flame/flame_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/deck/gas_input.hpp"
#include "app/deck/radiation_deck.hpp"
#include "app/deck/sensitivity_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/deck/transport_deck.hpp"
#include "app/problems/flame/flame_file.hpp"
#include "app/problems/flame/flame_solver_deck.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/errors.hpp"
#include "flow/flame/stream_mixture.hpp"

namespace lampblack::app {
namespace {

FlameType typeOf(const std::string& name) {
  if (name == "free") return FlameType::Free;
  if (name == "burner") return FlameType::Burner;
  return name == "wall" ? FlameType::Wall : FlameType::Counterflow;
}

enum class Flux { needed, guess, none };

FlameStream readStream(const Deck& deck, const std::string& section, const FlameCase& flame, Flux flux) {
  if (!deck.has(section))
    throw deck.error(section, fmt::format("a {} flame needs the section '{}'", nameOf(flame.problem.type), section));
  FlameStream stream;
  stream.temperature = readTemperature(deck, section + ".temperature", *flame.mechanism, TemperatureUse::transport);
  stream.Y = readMixture(deck, section, *flame.mechanism);
  const auto velocity = deck.optionalQuantity(section + ".velocity");
  const auto massFlux = deck.optionalQuantity(section + ".mass_flux");
  if (velocity && massFlux) throw deck.error(section, "expected 'velocity' or 'mass_flux', found both");
  if (flux == Flux::needed && !velocity && !massFlux)
    throw deck.error(section, "this stream needs either 'velocity' or 'mass_flux'");
  const Thermo thermo(*flame.mechanism);
  const double density = thermo.density(stream.temperature, flame.problem.pressure, stream.Y);
  if (flux != Flux::none) {
    stream.massFlux = massFlux.value_or(density * velocity.value_or(0.0));
    requireLowMach(deck, section + (massFlux ? ".mass_flux" : ".velocity"), thermo, stream.massFlux / density,
                   stream.temperature, stream.Y);
  }
  return stream;
}

// The speed 2 a z of a potential flow at the ends of the domain.
void requireLowStrain(const Deck& deck, const FlameCase& flame) {
  const FlameProblem& problem = flame.problem;
  const Thermo thermo(*flame.mechanism);
  const FlameStream& known = problem.right ? *problem.right : problem.left;
  const double distance = problem.right ? problem.length - problem.stagnationPlane : problem.length;
  requireLowMach(deck, "flame.strain_rate", thermo, 2 * problem.strainRate * distance, known.temperature, known.Y);
}

constexpr double agrees = 1;  // K, of two temperatures at one place

// The wall has the temperature that the gas is given there.
void setWallTemperature(const Deck& deck, FlameProblem& problem) {
  const double last = problem.given->at(problem.length);
  if (deck.optionalQuantity("flame.wall_temperature") && std::abs(last - problem.wallTemperature) > agrees)
    throw deck.error("flame.wall_temperature",
                     fmt::format("the wall is {:g} K, the profile {:g} K there: expected the same, or no "
                                 "'wall_temperature'",
                                 problem.wallTemperature, last));
  problem.wallTemperature = last;
}

// What a burner at one temperature lets through cannot begin at another.
void requireTemperatureOfInlet(const Deck& deck, const FlameProblem& problem) {
  const GivenTemperature& given = *problem.given;
  const double first = given.at(0), inlet = problem.left.temperature;
  if (std::abs(first - inlet) > agrees)
    throw deck.error("temperature_profile",
                     fmt::format("the profile is {:g} K at the burner, the inlet {:g} K: expected the same; where the "
                                 "burner is warmer than the gas was measured, 'inlet.mass_flux' says how much flows",
                                 first, inlet));
}

void readConfiguration(const Deck& deck, FlameCase& flame) {
  FlameProblem& problem = flame.problem;
  const std::string type = deck.choice("flame.type");
  const bool potential = deck.choice("flame.nozzles") == "potential", given = deck.choice("flame.energy") == "given";
  if (given && !deck.has("temperature_profile"))
    throw deck.error("flame.energy", "'given' needs the section 'temperature_profile'");
  problem.type = typeOf(type);
  problem.nozzles = potential ? FlameNozzles::Potential : FlameNozzles::Plug;
  problem.pressure = deck.quantity("pressure");
  problem.length = deck.quantity("flame.length");
  const Flux flux = potential ? Flux::none : problem.type == FlameType::Free ? Flux::guess : Flux::needed;
  if (problem.type == FlameType::Counterflow) {
    problem.left = readStream(deck, "left", flame, flux);
    problem.right = readStream(deck, "right", flame, flux);
  } else {
    problem.left = readStream(deck, "inlet", flame, flux);
  }
  if (problem.type == FlameType::Wall && !(given && !deck.optionalQuantity("flame.wall_temperature"))) {
    problem.wallTemperature = neededQuantity(deck, "flame", "wall_temperature", "a flame against a wall");
    requireTemperature(deck, "flame.wall_temperature", problem.wallTemperature, *flame.mechanism,
                       TemperatureUse::transport);
  }
  if (potential) {
    problem.strainRate = neededQuantity(deck, "flame", "strain_rate", "potential flow");
    problem.stagnationPlane = deck.optionalQuantity("flame.stagnation_plane").value_or(0.5 * problem.length);
    if (problem.stagnationPlane >= problem.length)
      throw deck.error("flame.stagnation_plane",
                       fmt::format("expected a place between the streams, below {:g} m, found "
                                   "{:g} m",
                                   problem.length, problem.stagnationPlane));
  }
  if (potential) requireLowStrain(deck, flame);
  if (given) {
    const TemperatureProfile profile =
        readTemperatureProfile(deck, "position", *flame.mechanism, TemperatureUse::transport);
    problem.given = GivenTemperature{profile.points(), profile.temperatures()};
    requireTemperatureOfInlet(deck, problem);
    if (const auto width = deck.optionalQuantity("temperature_profile.smoothing")) {
      if (*width > 0.5 * problem.length)
        throw deck.error(
            "temperature_profile.smoothing",
            fmt::format("expected at most half of 'flame.length', {:g} m, found {:g} m", 0.5 * problem.length, *width));
      problem.given = problem.given->smoothed(*width, problem.length);
    }
    if (problem.type == FlameType::Wall) setWallTemperature(deck, problem);
  }
  if (problem.type == FlameType::Free)
    if (const std::string reason = inertReason(*flame.mechanism, problem); !reason.empty())
      throw deck.error("inlet", reason + "; a free flame has to burn");
}

// Paths begin where streams are, and end where particles are slow: a limit above the streams' own speeds leaves
// nothing. Where streams have no speed of their own (potential flow, free flames) the flame has to tell.
void requirePaths(const Deck& deck, const FlameCase& flame) {
  const FlameProblem& problem = flame.problem;
  if (problem.nozzles == FlameNozzles::Potential || problem.type == FlameType::Free) return;
  double fastest = 0;
  for (const FlamePathOptions& path : flame.stochastic->coupling.ensemble.paths) {
    if (path.start) return;
    const FlameStream& stream = path.fromRight ? *problem.right : problem.left;
    fastest = std::max(
        fastest, stream.massFlux / Thermo(*flame.mechanism).density(stream.temperature, problem.pressure, stream.Y));
  }
  if (const double slowest = deck.quantity("particles.minimum_velocity"); slowest >= fastest)
    throw deck.error("particles.minimum_velocity",
                     fmt::format("expected less than {:.4g} m/s, with which the gas comes in, found {:g} m/s: no "
                                 "ensemble would be left",
                                 fastest, slowest));
}

// What else may have been meant by results that cannot be read: those in a folder, those of a run that failed.
std::string hintOnResults(const std::filesystem::path& path) {
  std::error_code error;
  const bool isFolder = std::filesystem::is_directory(path, error);
  const std::filesystem::path file = isFolder ? path / "results.h5" : path;
  if (isFolder && std::filesystem::exists(file, error)) return fmt::format("; it has {}", file.string());
  const std::filesystem::path part = file.string() + ".part";
  if (!std::filesystem::exists(file, error) && std::filesystem::exists(part, error))
    return fmt::format("; {} is there, of a flame that did not converge or is still running", part.string());
  return {};
}

}  // namespace

const char* nameOf(FlameType type) {
  switch (type) {
    case FlameType::Free:
      return "free";
    case FlameType::Burner:
      return "burner";
    case FlameType::Wall:
      return "wall";
    case FlameType::Counterflow:
      return "counterflow";
  }
  return "";
}

std::vector<std::string> FlameCase::scalarNames() const {
  std::vector<std::string> names;
  if (soot)
    for (const CarriedModel::Scalar& scalar : soot->scalars()) names.push_back(scalar.density.name);
  return names;
}

FlameCase readFlameCase(const Deck& deck) {
  FlameCase flame;
  flame.title = deck.string("title");
  flame.mechanism = readMechanism(deck);
  readConfiguration(deck, flame);
  flame.problem.transport = readTransport(deck, *flame.mechanism);
  flame.problem.radiation = readRadiation(deck, *flame.mechanism);
  readFlameSolver(deck, flame);
  if (deck.has("sensitivity")) flame.sensitivities = readSensitivityReactions(deck, *flame.mechanism);
  if (auto model = readSootModel(deck, *flame.mechanism)) {
    flame.soot =
        std::make_unique<CarriedParticles>(*flame.mechanism, std::move(model), deck.boolean("particles.diffusion"));
    flame.sootAtLimit = deck.number("particles.sectional.overflow");
  }
  flame.stochastic =
      readStochastic(deck, flame.mechanism, flame.problem.length, flame.problem.type == FlameType::Counterflow);
  if (flame.stochastic) requirePaths(deck, flame);
  if (const auto file = deck.optionalString("initial")) {
    const std::filesystem::path path = deck.resolvePath(*file);
    try {
      flame.initial = readFlameProfile(path);
    } catch (const InputError& error) {
      throw deck.error("initial", error.what() + hintOnResults(path));
    }
  }
  return flame;
}

}  // namespace lampblack::app
