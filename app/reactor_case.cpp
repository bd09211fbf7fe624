#include "app/reactor_case.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <sstream>

#include "app/gas_input.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack {
namespace {

// Two columns of numbers, separated by a comma or blanks.
TemperatureProfile readProfileFile(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: cannot be opened", path.string()));
  std::vector<double> points, temperatures;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    for (char& c : line)
      if (c == ',' || c == '\r') c = ' ';
    const auto first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '#') continue;
    std::istringstream words(line);
    double point = 0, temperature = 0;
    std::string more;
    if (words >> point >> temperature && !(words >> more)) {
      points.push_back(point);
      temperatures.push_back(temperature);
    } else if (!points.empty() || number > 1) {
      throw InputError(fmt::format("{}:{}: expected two numbers, found '{}'", path.string(), number, line));
    }
  }
  return {std::move(points), std::move(temperatures)};
}

std::optional<TemperatureProfile> readEnergy(const Deck& deck, const GasState& initial) {
  const std::string energy = deck.choice("reactor.energy");
  if (energy != "profile" && deck.has("temperature_profile"))
    throw deck.error("temperature_profile",
                     fmt::format("reactor.energy is {}; a profile needs 'energy: profile'", energy));
  if (energy == "isothermal") return TemperatureProfile(initial.temperature);
  if (energy == "adiabatic") return std::nullopt;
  const std::string section = "temperature_profile";
  if (!deck.has(section)) throw deck.error("reactor.energy", "'profile' needs the section 'temperature_profile'");
  const bool points = deck.has(section + ".time") || deck.has(section + ".temperature");
  if (points == deck.has(section + ".file"))
    throw deck.error(section, "expected either 'time' and 'temperature' or 'file'");
  try {
    if (!points) return readProfileFile(deck.resolvePath(deck.string(section + ".file")));
    for (const char* name : {".time", ".temperature"})
      if (!deck.has(section + name)) throw InputError("'time' and 'temperature' belong together");
    return TemperatureProfile(deck.quantities(section + ".time"), deck.quantities(section + ".temperature"));
  } catch (const InputError& error) {
    throw deck.error(points ? section : section + ".file", error.what());
  }
}

void readIgnition(const Deck& deck, ReactorCase& reactorCase) {
  using Kind = IgnitionCriterion::Kind;
  const Mechanism& mechanism = *reactorCase.mechanism;
  const bool adiabatic = !reactorCase.profile;
  auto& criteria = reactorCase.ignition;
  if (adiabatic && deck.boolean("ignition.temperature_rate"))
    criteria.push_back({Kind::TemperatureRate, 0, 0.0, "max_dTdt"});
  if (!deck.isGiven("ignition.species") && !mechanism.findSpecies("OH")) {
    // The default is for mechanisms that have it.
  } else {
    for (const std::size_t k : readSpeciesList(deck, "ignition.species", mechanism)) {
      criteria.push_back({Kind::MoleFraction, k, 0.0, "max_X_" + mechanism.speciesName(k)});
      criteria.push_back({Kind::MassFraction, k, 0.0, "max_Y_" + mechanism.speciesName(k)});
    }
  }
  if (const auto rise = deck.optionalQuantity("ignition.temperature_rise")) {
    if (!adiabatic) throw deck.error("ignition.temperature_rise", "the temperature of this reactor is given");
    criteria.push_back({Kind::TemperatureRise, 0, *rise, fmt::format("rise_{:g}K", *rise)});
  }
}

// An equation without blanks, for comparisons.
std::string bare(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  return text;
}

std::vector<std::size_t> reactionsNamed(const Mechanism& mechanism, const std::string& text) {
  std::size_t number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status == std::errc{} && end == text.data() + text.size()) {
    if (number < 1 || number > mechanism.numReactions())
      throw InputError(fmt::format("there is no reaction {}; expected 1 to {}", number, mechanism.numReactions()));
    return {number - 1};
  }
  std::vector<std::size_t> found;
  std::vector<std::string> known;
  for (std::size_t r = 0; r < mechanism.numReactions(); ++r) {
    known.push_back(mechanism.reaction(r).equation);
    if (bare(known.back()) == bare(text)) found.push_back(r);
  }
  if (found.empty())
    throw InputError(fmt::format("no reaction '{}' in the mechanism{}", text, didYouMean(text, known)));
  return found;
}

void readSensitivity(const Deck& deck, ReactorCase& reactorCase) {
  if (!deck.has("sensitivity")) return;
  const Mechanism& mechanism = *reactorCase.mechanism;
  auto& reactions = reactorCase.sensitivities;
  if (reactorCase.ignition.empty())
    throw deck.error("sensitivity", "there is no criterion of ignition, so that there is no delay");
  for (const std::string& text : deck.strings("sensitivity.reactions")) {
    if (text == "all") {
      reactions.clear();
      for (std::size_t r = 0; r < mechanism.numReactions(); ++r) reactions.push_back(r);
      return;
    }
    try {
      const auto found = reactionsNamed(mechanism, text);
      reactions.insert(reactions.end(), found.begin(), found.end());
    } catch (const InputError& error) {
      throw deck.error("sensitivity.reactions", error.what());
    }
  }
  if (reactions.empty()) throw deck.error("sensitivity.reactions", "expected at least one reaction, or 'all'");
}

}  // namespace

ReactorCase readReactorCase(const Deck& deck) {
  ReactorCase reactorCase;
  reactorCase.title = deck.string("title");
  reactorCase.mechanism = readMechanism(deck);
  reactorCase.type =
      deck.choice("reactor.type") == "constant_pressure" ? ReactorType::ConstantPressure : ReactorType::ConstantVolume;
  if (!deck.has("initial")) throw deck.error("initial", "a closed reactor needs the section 'initial'");
  reactorCase.initial = {deck.quantity("initial.temperature"), deck.quantity("pressure"),
                         readMixture(deck, "initial", *reactorCase.mechanism)};
  reactorCase.profile = readEnergy(deck, reactorCase.initial);
  reactorCase.end = deck.quantity("time.end");
  reactorCase.integrator = {deck.number("integrator.relative_tolerance"), deck.number("integrator.absolute_tolerance"),
                            deck.optionalQuantity("time.maximum_step").value_or(0.0),
                            static_cast<long>(deck.integer("integrator.maximum_steps"))};
  reactorCase.output = {deck.optionalQuantity("output.interval"),
                        readSpeciesList(deck, "output.species", *reactorCase.mechanism),
                        deck.choice("output.fractions") == "mass"};
  readIgnition(deck, reactorCase);
  readSensitivity(deck, reactorCase);
  return reactorCase;
}

}  // namespace lampblack
