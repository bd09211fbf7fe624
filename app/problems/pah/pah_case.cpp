#include "app/problems/pah/pah_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "app/deck/gas_input.hpp"
#include "app/deck/pah_rates_deck.hpp"
#include "app/problems/prescribed_gas/given_gas_deck.hpp"
#include "chemistry/mechanism/known_species.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/letter_case.hpp"
#include "core/text_file.hpp"
#include "coupling/given_gas.hpp"
#include "io/deck_keys.hpp"
#include "particles/pah/molecule_growth.hpp"
#include "particles/pah/named_molecules.hpp"

namespace lampblack::app {
namespace {

std::vector<LatticeCell> readCells(const Deck& deck, const std::string& key) {
  const std::vector<std::int64_t> numbers = deck.integers(key);
  if (numbers.size() % 2 != 0)
    throw deck.error(key, fmt::format("expected two numbers for each cell, found {} in all", numbers.size()));
  std::vector<LatticeCell> cells;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    for (const std::int64_t x : {numbers[i], numbers[i + 1]})
      if (x < -1000000 || x > 1000000) throw deck.error(key, fmt::format("the cell {} is too far away", x));
    cells.push_back({static_cast<std::int32_t>(numbers[i]), static_cast<std::int32_t>(numbers[i + 1])});
  }
  return cells;
}

void readMolecule(const Deck& deck, PahCase& pah) {
  const bool isNamed = deck.has("molecule.name");
  if (isNamed == deck.has("molecule.cells"))
    throw deck.error("molecule", "expected either 'name', one that is known, or 'cells', its rings");
  pah.rings = isNamed ? namedMolecule(deck.choice("molecule.name")) : readCells(deck, "molecule.cells");
  const std::string fiveKey = "molecule.five_rings";
  if (deck.has(fiveKey)) pah.fiveRings = readCells(deck, fiveKey);
  if (!isNamed) deck.at("molecule.cells", [&] { return Molecule(pah.rings).rings(); });
  const std::size_t rings = deck.at(deck.has(fiveKey) ? fiveKey : "molecule", [&] { return pah.start().rings(); });
  pah.mostRings = deck.optionalInteger<std::size_t>("molecule.most_rings").value_or(MoleculeGrowth::noLimit);
  if (pah.mostRings < rings)
    throw deck.error("molecule.most_rings", fmt::format("expected {} or more, as the molecule has", rings));
}

// What is often beside the species that molecules react with, and takes no part. Any other name may be a slip.
constexpr std::array<std::string_view, 8> gasesWithoutPart{"N2", "Ar", "He", "Ne", "Kr", "CO", "CO2", "CH4"};

// A gas that stays as it is.
ParticlePath constantGas(const Deck& deck) {
  for (const char* key : {"temperature", "pressure", "mole_fractions", "end"})
    if (!deck.has(std::string("gas.") + key))
      throw deck.error("gas", fmt::format("a gas that stays as it is needs the key '{}'; one that does not is in "
                                          "'file' or 'flame'",
                                          key));
  GasSample sample;
  sample.gas.temperature = deck.quantity("gas.temperature");
  sample.gas.pressure = deck.quantity("gas.pressure");
  const std::vector<std::string> names = pahGasSpeciesNames();
  sample.concentrations.assign(names.size(), 0);
  const double total = sample.gas.pressure / (constants::gasConstant * sample.gas.temperature);
  double sum = 0;
  const std::vector<std::string> given = deck.children("gas.mole_fractions");
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string& name = given[i];
    const std::string key = "gas.mole_fractions." + name;
    const auto before = std::ranges::find_if(given.begin(), given.begin() + static_cast<std::ptrdiff_t>(i),
                                             [&](const std::string& other) { return sameInAnyCase(other, name); });
    if (*before != name) throw deck.error(key, fmt::format("this species is given twice, as '{}', too", *before));
    const double share = deck.number(key);
    sum += share;
    const auto found =
        std::ranges::find_if(names, [&](const std::string& known) { return sameInAnyCase(known, name); });
    if (found != names.end())
      sample.concentrations[static_cast<std::size_t>(found - names.begin())] = total * share;
    else if (std::ranges::none_of(gasesWithoutPart, [&](std::string_view gas) { return sameInAnyCase(gas, name); }))
      throw deck.error(key, fmt::format("molecules react with {} only; of others {} may be named; leave this out",
                                        fmt::join(names, ", "), fmt::join(gasesWithoutPart, ", ")));
  }
  if (sum > 1 + 1e-9) throw deck.error("gas.mole_fractions", fmt::format("they add up to {:g}, more than one", sum));
  ParticlePath path;
  path.points = {sample, sample};
  path.points[1].time = deck.quantity("gas.end");
  path.divergence.resize(1);
  return path;
}

ParticlePath readGas(const Deck& deck) {
  const bool isGiven = deck.has("gas.file") || deck.has("gas.flame");
  if (!isGiven) {
    for (const char* key : {"mechanism", "phase", "gas.side", "gas.start", "gas.minimum_velocity"})
      if (deck.isGiven(key)) throw deck.error(key, "this belongs to 'gas.file' or 'gas.flame'; leave it out");
    return constantGas(deck);
  }
  requireOneGas(deck);
  for (const char* key : {"gas.temperature", "gas.pressure", "gas.mole_fractions"})
    if (deck.has(key)) throw deck.error(key, "the gas is that of 'gas.file' or 'gas.flame'; leave this out");
  if (!deck.has("mechanism"))
    throw deck.error("gas", "with 'file' or 'flame' the key 'mechanism' is needed, which has the gas's species");
  const auto mechanism = readMechanism(deck);
  for (const char* name : {"H", "H2", "C2H2"})
    deck.at("mechanism", [&] { return knownSpecies(*mechanism, name, "molecules need"); });
  return readGivenPath(deck, *mechanism, pahGasSpeciesNames(), GasViscosity::air);
}

void readRowsAndSpectra(const Deck& deck, PahCase& pah) {
  const auto& points = pah.path.points;
  std::vector<double> rows = readRows(deck, points.front().time, points.back().time);
  const double begin = rows.front(), end = rows.back();
  std::vector<double> spectra;
  if (deck.has("output.spectra")) spectra = deck.quantities("output.spectra");
  spectra.push_back(end);
  for (double& t : spectra) {
    if (t < begin || t > end)
      throw deck.error("output.spectra", fmt::format("{:g} s is outside the run, {:g} to {:g} s", t, begin, end));
    // A row that is there already, up to rounding.
    const auto row = std::ranges::find_if(rows, [&](double at) { return std::abs(at - t) <= 1e-9 * (end - begin); });
    if (row == rows.end())
      rows.push_back(t);
    else
      t = *row;
  }
  std::ranges::sort(rows);
  pah.recorded = insertPoints(pah.path, rows);
  for (const double t : spectra)
    pah.spectra.push_back(static_cast<std::size_t>(std::ranges::lower_bound(rows, t) - rows.begin()));
  std::ranges::sort(pah.spectra);
  pah.spectra.erase(std::ranges::unique(pah.spectra).begin(), pah.spectra.end());
  pah.path.points.resize(pah.recorded.back() + 1);
}

DeckKeys<PahCase> repeatKeys() {
  DeckKeys<PahCase> keys("");
  keys.integer("repeats", &PahCase::repeats, rules().byDefault("1000").atLeast(2).atMost(1e9),
               "Number of molecules, each with random numbers of its own.");
  keys.integer("seed", &PahCase::seed, rules().byDefault("1").atLeast(0),
               "Start of the random numbers: another seed gives another sample, the same seed the same result.");
  return keys;
}

}  // namespace

DeckSchema pahSchema() {
  SectionKeys keys("");
  const std::vector<std::string> processes = pahProcessNames();
  keys.choice("problem", {"pah"}, rules(), "What is solved.");
  keys.text("title", rules().byDefault("''"), "One line for reports and pictures.");
  keys.text("mechanism", rules().optional(),
            "Mechanism that has the species of gas.file or gas.flame: a file in Cantera's YAML format, relative to the "
            "deck, or the name of one that ships.");
  keys.text("phase", rules().optional(), "Name of the phase of the mechanism file; without it the first ideal gas.");
  keys.section("molecule", Presence::required, "The molecule at the start. Either 'name' or 'cells'.");
  keys.choice("molecule.name", moleculeNames(), rules().optional(), "A molecule that is known by its name.");
  keys.integer("molecule.cells", rules().list().optional(),
               "Rings of six of the molecule, as cells of a lattice of hexagons, two numbers each: [0, 0, 1, 0] is "
               "naphthalene. The neighbours of (q, r) are (q+1, r), (q, r+1), (q-1, r+1) and their opposites.");
  keys.integer("molecule.five_rings", rules().list().optional(),
               "Rings of five of the molecule, as cells between two of the rings of six.");
  keys.integer("molecule.most_rings", rules().optional().atLeast(1),
               "A molecule with more rings has left: it grows no further and is in no mean; how many have is said. "
               "Absent: no limit.");
  keys.section("gas", Presence::required,
               "The gas. Either temperature, pressure, mole_fractions and end, for one that stays as it is, or 'file' "
               "or 'flame'.");
  keys.quantity("gas.temperature", units::temperature, rules().optional().above(0),
                "Temperature of a gas that stays as it is.");
  keys.quantity("gas.pressure", units::pressure, rules().optional().above(0), "Pressure of a gas that stays as it is.");
  keys.number(
      "gas.mole_fractions.*", rules().optional().atLeast(0).atMost(1),
      fmt::format("Mole fraction of a species that molecules react with, one of {}. All others take no part and "
                  "need not be named; these may be: {}.",
                  fmt::join(pahGasSpeciesNames(), ", "), fmt::join(gasesWithoutPart, ", ")));
  addGivenGasKeys(keys.schema());
  keys.choice("description", {"lattice", "sites"}, rules().byDefault("lattice"),
              "What is known of a molecule. lattice: where its rings are; sites: how many sites of each type it has, "
              "what is beside them by a table of runs on the lattice (docs/theory/site_counting.md).");
  keys.text("closure", rules().optional().onlyWith("description", {"sites"}),
            "File of the table of neighbours that 'output.closure' of a run on the lattice has written, relative to "
            "the deck. It belongs to gases like that run's.");
  keys.choice("processes", processes, rules().list().optional(),
              "Processes that take place; absent: all. Their names are those of docs/theory/pah.md.");
  keys.number("rate_change", rules().byDefault("0.05").above(0).atMost(1),
              "Largest part by which a rate changes over a time in which rates are taken as constant; smaller is more "
              "accurate. Has a meaning where the gas changes.");
  keys.schema().add(repeatKeys().schema());
  addPahRateKeys(keys.schema());
  addRowKeys(keys.schema());
  keys.quantity("output.spectra", units::time, rules().list().optional(),
                "Times of mass spectra besides that of the end.");
  keys.integer("output.molecules",
               rules().byDefault("12").atLeast(0).atMost(10000).onlyWith("description", {"lattice"}),
               "Number of molecules whose rings are written at the end, for pictures.");
  keys.boolean(
      "output.closure", rules().byDefault("false").onlyWith("description", {"lattice"}),
      "Write closure.csv, the sites of all molecules at all rows and what is beside them, for 'description: sites'.");
  keys.schema().add(checkpointKeys("more repeats").schema());
  return keys.schema();
}

PahCase readPahCase(const Deck& deck) {
  PahCase pah;
  pah.title = deck.string("title");
  readMolecule(deck, pah);
  pah.path = readGas(deck);
  pah.constants = readPahRates(deck);
  readRowsAndSpectra(deck, pah);
  pah.growth = deck.at("rates", [&] {
    try {
      return growthPath(pah.path, pah.recorded, pah.constants, readPahProcesses(deck, "processes"),
                        deck.number("rate_change"));
    } catch (const NumericsError& error) {
      throw InputError(error.what());
    }
  });
  repeatKeys().read(deck, pah, "");
  pah.checkpoints = checkpointKeys("more repeats").read(deck);
  if (deck.choice("description") == "sites") {
    if (!deck.has("closure")) throw deck.error("description", "sites need the key 'closure', a table of neighbours");
    pah.closure = deck.at("closure", [&] {
      return std::make_shared<const SiteClosure>(
          SiteClosure::read(readTextFile(deck.resolvePath(deck.string("closure")), "a table of neighbours")));
    });
  } else {
    pah.writesClosure = deck.boolean("output.closure");
    pah.drawn = std::min(deck.integer<std::size_t>("output.molecules"), static_cast<std::size_t>(pah.repeats));
  }
  return pah;
}

}  // namespace lampblack::app
