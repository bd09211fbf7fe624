#include "app/problems/prescribed_gas/given_gas_deck.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/problems/flame/flame_file.hpp"
#include "app/problems/prescribed_gas/gas_table.hpp"
#include "core/errors.hpp"
#include "coupling/flame_trajectory.hpp"
#include "coupling/given_gas.hpp"
#include "io/deck_keys.hpp"
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
  options.slowest = deck.quantity("gas.minimum_velocity");
  ParticlePath path =
      flamePath(flameGasOf(species, flame.profile, mechanism, pressure, waldmannThermophoresis()), options).path;
  if (path.points.empty())
    throw InputError(fmt::format("{}: particles do not move into the flame from its {} end", file.string(),
                                 deck.choice("gas.side")));
  return path;
}

}  // namespace

void addGivenGasKeys(DeckSchema& schema) {
  SectionKeys keys("gas");
  keys.text("file", rules().optional(),
            "CSV file with columns time, temperature, pressure and X_<species> (mole fractions), units in brackets, as "
            "\"time [ms]\", or in SI; the particles move with the gas, but for a column number_loss_rate (1/s), the "
            "rate at which particles per kg of gas become fewer. Tables of a flow's streamlines are such "
            "(trajectories.gas_tables). Relative to the deck.");
  keys.text("flame", rules().optional(),
            "Results file (results.h5) of a run with problem: flame1d and the same mechanism; the particles move with "
            "the gas and by thermophoresis, on the axis of the flame. Relative to the deck.");
  keys.choice("side", {"left", "right"}, rules().byDefault("left"),
              "The end of the flame that the particles come from.");
  keys.quantity("start", units::length, rules().optional().atLeast(0),
                "Position of the flame's grid from which on the particles are followed; absent: its end.");
  keys.quantity("minimum_velocity", units::velocity, rules().formerly("slowest").byDefault("1 mm/s").above(0),
                "Speed of the particles below which a path through a flame ends, near the stagnation plane.");
  keys.quantity("end", units::time, rules().optional(), "Time at which the run ends; absent: the last of the gas.");
  schema.add(keys.schema());
}

void addRowKeys(DeckSchema& schema) {
  SectionKeys keys("output");
  keys.section(Presence::defaulted, "Rows of the history.");
  keys.quantity("interval", units::time, rules().optional().above(0),
                "Time between rows; absent: a hundredth of the run.");
  keys.quantity("times", units::time, rules().list().optional(), "Times with rows besides.");
  schema.add(keys.schema());
}

void requireOneGas(const Deck& deck) {
  if (deck.has("gas.file") == deck.has("gas.flame"))
    throw deck.error("gas", "expected either 'file', the history of a gas, or 'flame', the results of a flame");
  if (deck.has("gas.flame")) return;
  for (const char* key : {"gas.side", "gas.start", "gas.minimum_velocity"})
    if (deck.isGiven(key)) throw deck.error(key, "this is of a path through a flame ('gas.flame'); leave it out");
}

ParticlePath readGivenPath(const Deck& deck, const Mechanism& mechanism, const std::vector<std::string>& species,
                           GasViscosity viscosity) {
  return deck.at(deck.has("gas.flame") ? "gas.flame" : "gas.file", [&] {
    if (deck.has("gas.flame")) return throughFlame(deck, mechanism, species);
    const GasHistory history = readGasTable(deck.resolvePath(deck.string("gas.file")), mechanism);
    return givenPath(mechanism, history, species, viscosity);
  });
}

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

}  // namespace lampblack::app
