#include "app/prescribed_gas/prescribed_gas_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/flame1d/flame_file.hpp"
#include "app/prescribed_gas/gas_table.hpp"
#include "app/reactor/reactor_case_parts.hpp"
#include "app/tools/gas_input.hpp"
#include "chemistry/mechanism/known_species.hpp"
#include "core/errors.hpp"
#include "coupling/flame_trajectory.hpp"
#include "io/hdf5_reader.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {
namespace {

constexpr std::size_t defaultRows = 100;
// Of what the gas has of depleted species, a linear problem between rows.
constexpr double relativeTolerance = 1e-8, absoluteTolerance = 1e-15;
constexpr long mostSteps = 1000000;

std::string gasKey(const Deck& deck) {
  return deck.has("gas.flame") ? "gas.flame" : "gas.file";
}

bool isTwoWay(const Deck& deck) {
  return deck.choice("gas.exchange") == "two_way";
}

void checkGas(const Deck& deck) {
  if (deck.has("gas.file") == deck.has("gas.flame"))
    throw deck.error("gas", "expected either 'file', the history of a gas, or 'flame', the results of a flame");
  if (!deck.has("gas.flame")) {
    for (const char* key : {"gas.side", "gas.start", "gas.minimum_velocity"})
      if (deck.isGiven(key)) throw deck.error(key, "this is of a path through a flame ('gas.flame'); leave it out");
  } else if (deck.optionalString("gas.viscosity") == "air") {
    throw deck.error("gas.viscosity", "that of a flame comes from its transport data; leave this out");
  }
}

ParticlePath throughFlame(const Deck& deck, const Mechanism& mechanism, const std::vector<std::string>& species) {
  const std::filesystem::path file = deck.resolvePath(deck.string("gas.flame"));
  const NamedFlameProfile flame = readFlameProfile(file);
  bool same = flame.species.size() == mechanism.numSpecies();
  for (std::size_t k = 0; same && k < flame.species.size(); ++k) same = flame.species[k] == mechanism.speciesName(k);
  if (!same) throw InputError(fmt::format("{}: the flame has other species than the mechanism", file.string()));
  const double pressure = Hdf5Reader(file).numberAttribute("/flame", "pressure");
  FlamePathOptions options;
  options.fromRight = deck.choice("gas.side") == "right";
  options.start = deck.optionalQuantity("gas.start");
  options.slowest = deck.quantity("gas.minimum_velocity");
  ParticlePath path =
      flamePath(flameGasOf(species, flame.profile, mechanism, pressure, waldmannThermophoresis()), options).path;
  if (path.points.empty())
    throw InputError(fmt::format("{}: particles do not move into the flame from its {} end", file.string(),
                                 deck.choice("gas.side")));
  return path;
}

ParticlePath readPath(const Deck& deck, const Mechanism& mechanism, const std::vector<std::string>& species) {
  return deck.at(gasKey(deck), [&] {
    if (deck.has("gas.flame")) return throughFlame(deck, mechanism, species);
    const GasHistory history = readGasTable(deck.resolvePath(deck.string("gas.file")), mechanism);
    const bool isAir = deck.optionalString("gas.viscosity") == "air";
    return givenPath(mechanism, history, species, isAir ? GasViscosity::air : GasViscosity::transport);
  });
}

// Of all species.
GasHistory readHistory(const Deck& deck, const Mechanism& mechanism) {
  return deck.at(gasKey(deck), [&] {
    if (deck.has("gas.file")) {
      GasHistory history = readGasTable(deck.resolvePath(deck.string("gas.file")), mechanism);
      requireHistory(mechanism, history);
      return history;
    }
    std::vector<std::string> species;
    for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) species.push_back(mechanism.speciesName(k));
    return historyAlong(throughFlame(deck, mechanism, species));
  });
}

// Times of the rows, the last one of which ends the run, of a gas that is known from `begin` to `last`.
std::vector<double> readRows(const Deck& deck, double begin, double last) {
  const double end = deck.optionalQuantity("gas.end").value_or(last);
  if (!(end > begin) || end > last)
    throw deck.error(
        deck.has("gas.end") ? "gas.end" : "gas",
        fmt::format("expected an end after {:g} s, at most {:g} s, as far as the gas is known", begin, last));
  const double interval = deck.optionalQuantity("output.interval").value_or((end - begin) / defaultRows);
  requireOutputs(deck, "output.interval", "rows of the history", (end - begin) / interval, 1000);
  std::vector<double> rows;
  for (std::size_t i = 0; begin + static_cast<double>(i) * interval < end - 1e-9 * interval; ++i)
    rows.push_back(begin + static_cast<double>(i) * interval);
  if (deck.has("output.times"))
    for (const double t : deck.quantities("output.times")) {
      if (t < begin || t > end)
        throw deck.error("output.times", fmt::format("{:g} s is outside the run, {:g} to {:g} s", t, begin, end));
      rows.push_back(t);
    }
  rows.push_back(end);
  std::ranges::sort(rows);
  const auto same = [&](double a, double b) { return b - a <= 1e-9 * interval; };
  rows.erase(std::unique(rows.begin(), rows.end(), same), rows.end());
  return rows;
}

void readParticles(const Deck& deck, PrescribedGasCase& along) {
  if (!hasPopulation(deck)) {
    along.model = readSootModel(deck, *along.mechanism);
    if (!along.model) throw deck.error(descriptionKey, "expected a model, an ensemble or trees");
    if (carriedModel(deck) == "sectional") along.sootAtLimit = deck.number("particles.sectional.overflow");
    return;
  }
  for (const char* key : {"particles.coupling", "particles.coupling_change"})
    if (deck.isGiven(key)) throw deck.error(key, "with gas.exchange: one_way nothing is coupled; leave this out");
  along.ensemble = readPopulation(deck, along.mechanism);
}

std::vector<std::string> precursorsOf(const Deck& deck, const Mechanism& mechanism) {
  if (isOfTrees(deck)) return readTreeOptions(deck, mechanism).material.precursors();
  return sootPrecursors(readSootModelOptions(deck, mechanism));
}

// Trees, or ensembles that deplete the gas.
ReactorCase readCoupled(const Deck& deck, const PrescribedGasCase& along) {
  const Mechanism& mechanism = *along.mechanism;
  ReactorCase coupled;
  coupled.title = along.title;
  coupled.mechanism = along.mechanism;
  coupled.type = ReactorType::GivenGas;
  coupled.integrator = {relativeTolerance, absoluteTolerance, 0.0, mostSteps};
  const auto history = std::make_shared<GasHistory>(readHistory(deck, mechanism));
  coupled.history = history;
  coupled.rows = readRows(deck, history->time.front(), history->time.back());
  coupled.end = coupled.rows.back();
  if (isTwoWay(deck)) {
    if (deck.has("gas.depleted")) {
      coupled.depleted = readSpeciesList(deck, "gas.depleted", mechanism);
    } else {
      for (const std::string& name : precursorsOf(deck, mechanism))
        coupled.depleted.push_back(deck.at("gas.exchange", [&] { return mechanism.speciesIndex(name); }));
    }
  }
  coupled.output.species = coupled.depleted;
  reactorcase::readPopulations(deck, coupled);
  for (const double t : coupled.ensemble->tablesAt)
    if (t < coupled.rows.front() || t > coupled.end)
      throw deck.error("particles.tables_at",
                       fmt::format("{:g} s is outside the run, {:g} to {:g} s", t, coupled.rows.front(), coupled.end));
  const auto& seen = coupled.ensemble->species;
  for (const std::size_t k : coupled.depleted)
    if (std::ranges::find(seen, k) == seen.end())
      throw deck.error("gas.depleted",
                       fmt::format("particles exchange nothing of {}; leave it out", mechanism.speciesName(k)));
  return coupled;
}

// Of the model's species, by their number in it.
std::vector<std::size_t> readDepleted(const Deck& deck, const Mechanism& mechanism, const ParticleModel& model) {
  if (!isTwoWay(deck)) return {};
  if (!deck.has("gas.depleted")) return model.precursors();
  std::vector<std::size_t> depleted;
  const auto seen = knownSpecies(mechanism, model.gasSpecies(), "the model needs");
  for (const std::string& name : deck.strings("gas.depleted")) {
    const auto k = mechanism.findSpecies(name);
    const auto at = k ? std::ranges::find(seen, *k) : seen.end();
    if (at == seen.end())
      throw deck.error("gas.depleted", fmt::format("particles exchange nothing of {}; leave it out", name));
    depleted.push_back(static_cast<std::size_t>(at - seen.begin()));
  }
  return depleted;
}

}  // namespace

PrescribedGasCase readPrescribedGasCase(const Deck& deck) {
  PrescribedGasCase along;
  along.title = deck.string("title");
  along.mechanism = readMechanism(deck);
  checkGas(deck);
  if (isOfTrees(deck) || (hasPopulation(deck) && isTwoWay(deck))) {
    along.coupled = readCoupled(deck, along);
    return along;
  }
  readParticles(deck, along);
  if (along.model) along.depleted = readDepleted(deck, *along.mechanism, *along.model);
  std::vector<std::string> seen;
  if (along.ensemble)
    for (const std::size_t k : along.ensemble->species) seen.push_back(along.mechanism->speciesName(k));
  else
    seen = along.model->gasSpecies();
  along.path = readPath(deck, *along.mechanism, seen);
  const std::vector<double> rows = readRows(deck, along.path.points.front().time, along.path.points.back().time);
  along.recorded = insertPoints(along.path, rows);
  along.path.points.resize(along.recorded.back() + 1);
  along.path.divergence.resize(along.recorded.back());
  if (along.ensemble) {
    requireMemory(deck, "particles.repeats", "what the repeats leave",
                  8.0 * static_cast<double>(along.ensemble->repeats * rows.size() * (50 + along.ensemble->bins.count)));
  }
  return along;
}

}  // namespace lampblack::app
