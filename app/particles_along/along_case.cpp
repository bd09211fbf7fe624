#include "app/particles_along/along_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/deck/soot_deck.hpp"
#include "app/flame1d/flame_file.hpp"
#include "app/particles_along/gas_table.hpp"
#include "app/tools/gas_input.hpp"
#include "core/errors.hpp"
#include "coupling/ensemble_species.hpp"
#include "coupling/flame_trajectory.hpp"
#include "io/hdf5_reader.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {
namespace {

constexpr std::size_t defaultRows = 100;

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
  options.slowest = deck.quantity("gas.slowest");
  ParticlePath path =
      flamePath(flameGasOf(species, flame.profile, mechanism, pressure, waldmannThermophoresis()), options).path;
  if (path.points.empty())
    throw InputError(fmt::format("{}: particles do not move into the flame from its {} end", file.string(),
                                 deck.choice("gas.side")));
  return path;
}

ParticlePath readPath(const Deck& deck, const Mechanism& mechanism, const std::vector<std::string>& species) {
  if (deck.has("gas.file") == deck.has("gas.flame"))
    throw deck.error("gas", "expected either 'file', the history of a gas, or 'flame', the results of a flame");
  if (deck.choice("gas.exchange") == "two_way")
    throw deck.error("gas.exchange", "particles that change a given gas are not there yet; expected one_way");
  const bool ofFlame = deck.has("gas.flame");
  if (!ofFlame)
    for (const char* key : {"gas.side", "gas.start", "gas.slowest"})
      if (deck.isGiven(key)) throw deck.error(key, "this is of a path through a flame ('gas.flame'); leave it out");
  if (ofFlame && deck.choice("gas.viscosity") == "air")
    throw deck.error("gas.viscosity", "that of a flame comes from its transport data; leave this out");
  try {
    if (ofFlame) return throughFlame(deck, mechanism, species);
    const GasHistory history = readGasTable(deck.resolvePath(deck.string("gas.file")), mechanism);
    return givenPath(mechanism, history, species,
                     deck.choice("gas.viscosity") == "air" ? GasViscosity::air : GasViscosity::transport);
  } catch (const InputError& error) {
    throw deck.error(ofFlame ? "gas.flame" : "gas.file", error.what());
  }
}

// Times of the rows; the path ends with the last.
std::vector<double> readRows(const Deck& deck, ParticlePath& path) {
  const double begin = path.points.front().time, last = path.points.back().time;
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

void readParticles(const Deck& deck, AlongCase& along) {
  if (!deck.has("soot")) throw deck.error("soot", "particles need the section 'soot'");
  if (!deck.has("stochastic")) {
    along.model = readSootModel(deck, *along.mechanism);
    if (!along.model) throw deck.error("soot.model", "expected a model, or the section 'stochastic' for ensembles");
    if (deck.choice("soot.model") == "sectional") along.sootAtLimit = deck.number("soot.sectional.overflow");
    return;
  }
  if (deck.isGiven("soot.model") && deck.choice("soot.model") != "none")
    throw deck.error("soot.model",
                     "an ensemble takes the place of a model: leave this out, or the section 'stochastic'");
  along.ensemble = readEnsemble(deck, readSootModelOptions(deck, *along.mechanism));
  try {
    static_cast<void>(indicesOfSootSpecies(*along.mechanism, along.ensemble->soot.soot));
    static_cast<void>(makeEnsemble(along.ensemble->soot));
  } catch (const InputError& error) {
    throw deck.error("stochastic", error.what());
  }
}

}  // namespace

AlongCase readAlongCase(const Deck& deck) {
  AlongCase along;
  along.title = deck.string("title");
  along.mechanism = readMechanism(deck);
  readParticles(deck, along);
  along.path = readPath(deck, *along.mechanism,
                        along.ensemble ? sootSpecies(along.ensemble->soot.soot) : along.model->gasSpecies());
  const std::vector<double> rows = readRows(deck, along.path);
  along.recorded = putPointsAt(along.path, rows);
  along.path.points.resize(along.recorded.back() + 1);
  along.path.divergence.resize(along.recorded.back());
  if (along.ensemble) {
    requireMemory(deck, "stochastic.repeats", "what the repeats leave",
                  8.0 * static_cast<double>(along.ensemble->repeats * rows.size() * (50 + along.ensemble->bins.count)));
  }
  return along;
}

}  // namespace lampblack::app
