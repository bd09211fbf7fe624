#include "app/problems/prescribed_gas/prescribed_gas_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/problems/prescribed_gas/gas_table.hpp"
#include "app/problems/prescribed_gas/given_gas_deck.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "app/problems/reactor/reactor_driver.hpp"
#include "chemistry/mechanism/known_species.hpp"
#include "core/errors.hpp"
#include "coupling/gas_along.hpp"
#include "coupling/split_gas.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {
namespace {

// Of what the gas has of depleted species, a linear problem between rows.
constexpr double relativeTolerance = 1e-8, absoluteTolerance = 1e-15;
constexpr long mostSteps = 1000000;

bool isTwoWay(const Deck& deck) {
  return deck.choice("gas.exchange") == "two_way";
}

ParticlePath readPath(const Deck& deck, const Mechanism& mechanism, const std::vector<std::string>& species) {
  const bool isAir = deck.optionalString("gas.viscosity") == "air";
  return readGivenPath(deck, mechanism, species, isAir ? GasViscosity::air : GasViscosity::transport);
}

// Of all species.
GasHistory readHistory(const Deck& deck, const Mechanism& mechanism) {
  if (deck.has("gas.flame")) {
    std::vector<std::string> species;
    for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) species.push_back(mechanism.speciesName(k));
    return historyAlong(readGivenPath(deck, mechanism, species, GasViscosity::transport));
  }
  return deck.at("gas.file", [&] {
    GasHistory history = readGasTable(deck.resolvePath(deck.string("gas.file")), mechanism);
    requireHistory(mechanism, history);
    return history;
  });
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

// A gas whose history is given, beside populations that may deplete species of it.
struct GivenGasKind final : ReactorKind {
  std::shared_ptr<const GasHistory> history;
  std::vector<std::size_t> depleted;
  std::vector<double> times;  // s, rising, of the rows

  [[nodiscard]] std::unique_ptr<ReactorDriver> driver(const ReactorCase& reactorCase) const override {
    return ensembleReactorDriver(reactorCase);
  }
  [[nodiscard]] RepeatGas repeatGas(const ReactorCase& reactorCase, ParticlesAtRest& carried,
                                    SplitParticles* /*population*/) const override {
    const auto along = std::make_shared<GasAlong>(*reactorCase.mechanism, *history, depleted, &carried);
    return {along, splitGas(*along), along->initialState()};
  }
  [[nodiscard]] double begin() const override { return times.front(); }
  [[nodiscard]] double end() const override { return times.back(); }
  [[nodiscard]] std::vector<double> rows() const override { return times; }
  [[nodiscard]] bool isGiven() const override { return true; }
};

// Trees, molecules, or ensembles that deplete the gas.
ReactorCase readCoupled(const Deck& deck, const PrescribedGasCase& along) {
  const Mechanism& mechanism = *along.mechanism;
  ReactorCase coupled;
  coupled.title = along.title;
  coupled.mechanism = along.mechanism;
  coupled.integrator = {relativeTolerance, absoluteTolerance, 0.0, mostSteps};
  const auto given = std::make_shared<GivenGasKind>();
  const auto history = std::make_shared<GasHistory>(readHistory(deck, mechanism));
  given->history = history;
  given->times = readRows(deck, history->time.front(), history->time.back());
  if (isTwoWay(deck)) {
    if (deck.has("gas.depleted")) {
      given->depleted = readSpeciesList(deck, "gas.depleted", mechanism);
    } else {
      for (const std::string& name : precursorsOf(deck, mechanism))
        given->depleted.push_back(deck.at("gas.exchange", [&] { return mechanism.speciesIndex(name); }));
    }
  }
  coupled.output.species = given->depleted;
  coupled.kind = given;
  reactorcase::readPopulations(deck, coupled);
  for (const double t : coupled.ensemble->tablesAt)
    if (t < given->begin() || t > given->end())
      throw deck.error("particles.tables_at",
                       fmt::format("{:g} s is outside the run, {:g} to {:g} s", t, given->begin(), given->end()));
  const auto& seen = coupled.ensemble->species;
  for (const std::size_t k : given->depleted)
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
  requireOneGas(deck);
  if (deck.has("gas.flame") && deck.optionalString("gas.viscosity") == "air")
    throw deck.error("gas.viscosity", "that of a flame comes from its transport data; leave this out");
  if (isOfTrees(deck) || isOfMolecules(deck) || (hasPopulation(deck) && isTwoWay(deck))) {
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
