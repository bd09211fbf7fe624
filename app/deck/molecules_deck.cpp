#include "app/deck/molecules_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/deck/pah_rates_deck.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/tree_material_deck.hpp"
#include "app/deck/two_columns.hpp"
#include "chemistry/mechanism/known_species.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "io/csv.hpp"
#include "io/deck_keys.hpp"
#include "io/table_columns.hpp"
#include "particles/pah/molecule.hpp"
#include "particles/pah/named_molecules.hpp"

namespace lampblack::app {
namespace {

const std::string section = "particles.molecules";

std::string names(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& name : all) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Those of other descriptions of soot that mean nothing here.
constexpr const char* meaningless[] = {
    "particles.sticking",     "particles.alpha",           "particles.site_density",     "particles.oh_efficiency",
    "particles.inception_by", "particles.heavy_particles", "particles.keep_hydrogen",    "particles.active_sites",
    "particles.surface",      "particles.alpha_table",     "particles.dimer_equilibrium"};

DeckKeys<MoleculeOptions> collisionKeys() {
  using Options = MoleculeOptions;
  using Rule = MoleculeSticking::Rule;
  constexpr auto sticking = [](auto member) { return inner(&Options::sticking, member); };
  DeckKeys<MoleculeOptions> keys(section);
  keys.choice(
      "inception", &Options::inception,
      {{"pairs", Options::Inception::pairs},
       {"as_in_gas", Options::Inception::asInGas},
       {"by_formation", Options::Inception::byFormation}},
      rules().byDefault("pairs"),
      "How molecules of the gas become particles. pairs: two that collide and stick are a particle, and single ones "
      "condense on particles; as_in_gas: as many particles of one molecule are there as the gas has molecules of "
      "particles.pah, and meet others as particles do, in a gas that stays as it is given: prescribed_gas, one way; "
      "by_formation: each molecule that the gas forms (formation) is a particle, in such a gas.");
  keys.text("formation", rules().optional().onlyWith(section + ".inception", {"by_formation"}),
            "Table of two columns: time since the particles set out, and rate at which the gas forms molecules of "
            "particles.pah, \"time [s], formation [mol/m^3/s]\"; straight in between, none outside and where it is "
            "below zero. Relative to the deck.");
  keys.number("inception_efficiency", &Options::inceptionEfficiency,
              rules().byDefault("1").atLeast(0).atMost(1).onlyWith(section + ".inception", {"pairs"}),
              "Factor of the collisions of pairs that become a particle, besides what sticks.");
  keys.number("condensation_efficiency", &Options::condensationEfficiency,
              rules().byDefault("1").atLeast(0).atMost(1).onlyWith(section + ".inception", {"pairs"}),
              "Factor of the collisions of molecules of the gas with particles, besides what sticks.");
  keys.choice(
      "sticks", sticking(&MoleculeSticking::rule),
      {{"always", Rule::always},
       {"smaller", Rule::smaller},
       {"larger", Rule::larger},
       {"together", Rule::together},
       {"reduced", Rule::reduced},
       {"by_size", Rule::bySize},
       {"by_table", Rule::byTable}},
      rules().byDefault("always"),
      "Which molecules stick to each other and to particles, of which the largest molecule counts: all; where "
      "the smaller one, the larger one, both together, or the product over the sum of both has sticking_rings; "
      "by_size: with the probability 1/(1 + exp(-A (d^3/m + (m/B)^6 - C))) of the smaller one, d in Angstrom, "
      "m = 12 times its carbon atoms; by_table: with that of sticking_table at the temperature and the smaller one's "
      "carbon atoms. Particles of several molecules always stick to each other.");
  keys.number(
      "sticking_rings", sticking(&MoleculeSticking::rings),
      rules().byDefault("0").atLeast(0).onlyWith(section + ".sticks", {"smaller", "larger", "together", "reduced"}),
      "Rings that are needed to stick.");
  keys.text("sticking_table", rules().optional().onlyWith(section + ".sticks", {"by_table"}),
            "Table with columns temperature, carbon (atoms) and probability, all pairs of the temperatures and numbers "
            "of atoms in it; straight in between, as at its ends beyond. Relative to the deck.");
  keys.number("sticking_constants", rules().list(3).optional().onlyWith(section + ".sticks", {"by_size"}),
              "A, B and C of by_size.");
  return keys;
}

// Rows in any order.
void readStickingTable(const std::filesystem::path& file, MoleculeSticking& sticking) {
  const TextTable table = readCsv(readTextFile(file, "a table of sticking"));
  std::map<std::pair<double, double>, double> found;
  try {
    const TableColumns columns(table);
    const auto read = [&](const char* name, const units::Dimension& dimension) {
      const auto column = columns.find({name});
      if (!column) throw InputError(fmt::format("expected a column '{}'; found {}", name, columns.listed()));
      return columns.read(*column, dimension);
    };
    const auto temperature = read("temperature", units::temperature), carbon = read("carbon", units::dimensionless);
    const auto probability = read("probability", units::dimensionless);
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (!found.try_emplace({temperature[row], carbon[row]}, probability[row]).second)
        throw InputError(fmt::format("line {}: a second row of this temperature and carbon", table.lines[row]));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  std::set<double> temperatures, carbons;
  for (const auto& [at, probability] : found) {
    temperatures.insert(at.first);
    carbons.insert(at.second);
    sticking.probabilities.push_back(probability);
  }
  sticking.temperatures.assign(temperatures.begin(), temperatures.end());
  sticking.carbons.assign(carbons.begin(), carbons.end());
  if (found.empty() || found.size() != temperatures.size() * carbons.size())
    throw InputError(
        fmt::format("{}: expected a row for each of {} temperatures with each of {} numbers of carbon "
                    "atoms, found {}",
                    file.string(), temperatures.size(), carbons.size(), found.size()));
}

void readConstants(const Deck& deck, MoleculeSticking& sticking) {
  const std::string key = section + ".sticking_constants";
  if (!deck.has(key)) throw deck.error(section + ".sticks", "by_size needs sticking_constants: A, B, C");
  const std::vector<double> constants = deck.numbers(key);
  sticking.A = constants[0];
  sticking.B = constants[1];
  sticking.C = constants[2];
  if (!(sticking.B > 0)) throw deck.error(key, "expected B above zero");
}

NucleationOptions readFormation(const Deck& deck) {
  const std::string key = section + ".formation";
  if (!deck.has(key)) throw deck.error(section + ".inception", "by_formation needs formation, a table over time");
  return deck.at(key, [&] {
    TwoColumns table =
        readTwoColumns(deck.resolvePath(deck.string(key)), units::time, units::concentration / units::time,
                       "time [s], formation [mol/m^3/s]", [](double) {});
    NucleationOptions formation;
    formation.source = NucleationOptions::Source::table;
    formation.times = std::move(table.points);
    // Straight between the points, none where that is below zero.
    const std::vector<double>&times = formation.times, &values = table.values;
    std::vector<double> all;
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (k > 0 && values[k - 1] * values[k] < 0) {
        all.push_back(times[k - 1] + (times[k] - times[k - 1]) * values[k - 1] / (values[k - 1] - values[k]));
        formation.rates.push_back(0);
      }
      all.push_back(times[k]);
      formation.rates.push_back(std::max(values[k], 0.0) * constants::avogadro);
    }
    formation.times = std::move(all);
    return formation;
  });
}

// Where the gas is as given, whatever particles take.
bool isGasGiven(const Deck& deck) {
  return deck.choice("problem") == "prescribed_gas" && deck.choice("gas.exchange") == "one_way";
}

// The species of the gas that is the molecule: the deck's; or the mechanism's by the molecule's name, by the name that
// mechanisms of soot have for it, or by its formula.
std::string readPrecursor(const Deck& deck, const Mechanism& mechanism, const std::vector<LatticeCell>& rings) {
  if (deck.isGiven("particles.pah")) {
    const std::vector<std::string> pah = deck.strings("particles.pah");
    if (pah.size() != 1)
      throw deck.error("particles.pah", fmt::format("molecules are of one species, not of {}", pah.size()));
    deck.at("particles.pah", [&] { return mechanism.speciesIndex(pah[0]); });
    return pah[0];
  }
  const std::string name = deck.string(section + ".molecule");
  const Molecule molecule(rings);
  const std::string formula = fmt::format("C{}H{}", molecule.carbon(), molecule.hydrogen());
  for (const auto& [of, brief] : {std::pair("benzene", "A1"), std::pair("naphthalene", "A2"),
                                  std::pair("phenanthrene", "A3"), std::pair("pyrene", "A4")})
    if (name == of && mechanism.findSpecies(brief)) return brief;
  for (const std::string& called : {name, formula})
    if (const auto k = findKnownSpecies(mechanism, called)) return mechanism.speciesName(*k);
  throw deck.error("particles.pah", fmt::format("which species of the mechanism is {} ({})? Name it, '[A4]'; without "
                                                "one, choose another mechanism or particles.molecules.molecule",
                                                name, formula));
}

DeckKeys<MoleculeOptions> moleculeKeys() {
  DeckKeys<MoleculeOptions> keys(section);
  keys.section(Presence::defaulted,
               "Particles of molecules that grow site by site (docs/theory/molecules_in_particles.md). Their matter is "
               "the one species of particles.pah.",
               {ofMolecules()});
  keys.text("molecule", rules().byDefault("pyrene"),
            "The molecule of particles.pah by its name: " + names(moleculeNames()) + ".");
  keys.number("growth_factor", &MoleculeOptions::growthFactor, rules().byDefault("1").atLeast(0).atMost(1),
              "Factor of all rates of molecules in a primary with growth_factor_from of them or more, from 0 to 1: a "
              "number that is fitted to measurements, not derived; 1 takes them as free.");
  keys.integer("growth_factor_from", &MoleculeOptions::growthFactorFrom, rules().byDefault("2").atLeast(1),
               "Molecules of a primary from which on its growth factor holds.");
  keys.choice("shape", &MoleculeOptions::spheres, {{"primaries", false}, {"spheres", true}},
              rules().byDefault("primaries"),
              "What becomes of particles that stick. primaries: they touch at one of each, which share surface, sinter "
              "by particles.sintering, and become one; spheres: all molecules are in one primary.");
  keys.choice("processes", pahProcessNames(), rules().list().optional(),
              "Processes of molecules that take place; absent: all. Their names are those of docs/theory/pah.md.");
  keys.quantity("at_start", units::perVolume, &MoleculeOptions::atStart, rules().byDefault("0 1/m^3").atLeast(0),
                "Particles of one molecule that are there at the start.");
  keys.text(
      "band_gap", rules().optional(),
      "Table of two columns: carbon atoms of a molecule, and its optical band gap in eV, \"carbon, band_gap\"; "
      "straight in between, as at its ends beyond. Particles have that of their largest molecule, a column of the "
      "results. None is shipped. Relative to the deck.");
  keys.schema().add(collisionKeys().schema());
  addPahRateKeys(keys.schema(), section + ".rates");
  return keys;
}

}  // namespace

void addMoleculeKeys(DeckSchema& schema) {
  schema.add(moleculeKeys().schema());
}

MoleculeOptions readMoleculeOptions(const Deck& deck, const Mechanism& mechanism) {
  for (const char* key : meaningless)
    if (deck.isGiven(key)) throw deck.error(key, "has no meaning with 'description: molecules'; leave it out");
  MoleculeOptions o = moleculeKeys().read(deck);
  collisionKeys().read(deck, o, section);
  o.rings = deck.at(section + ".molecule", [&] { return namedMolecule(deck.string(section + ".molecule")); });
  o.precursor = readPrecursor(deck, mechanism, o.rings);
  using Inception = MoleculeOptions::Inception;
  const std::string inception = section + ".inception";
  const std::string how = deck.choice(inception);
  if (o.inception != Inception::pairs && !isGasGiven(deck))
    throw deck.error(inception, how +
                                    " needs a gas that stays as it is given, 'problem: prescribed_gas' with 'exchange: "
                                    "one_way'; where particles take from the gas, use 'pairs'");
  if (o.inception != Inception::pairs && deck.isGiven("particles.condensation"))
    throw deck.error("particles.condensation", "has no meaning with 'inception: " + how +
                                                   "', where molecules are particles that collide; leave it out, or "
                                                   "set particles.coagulation");
  if (o.inception == Inception::byFormation) o.formation = readFormation(deck);
  if (!deck.boolean("particles.condensation") && o.inception == Inception::pairs) o.condensationEfficiency = 0;
  if (!deck.boolean("particles.inception") && o.inception != Inception::pairs)
    throw deck.error("particles.inception", "is false, so that 'inception: " + how +
                                                "' of molecules would do nothing; leave one of the two out");
  if (!deck.boolean("particles.inception")) o.inception = Inception::none;
  if (o.sticking.rule == MoleculeSticking::Rule::bySize) readConstants(deck, o.sticking);
  if (o.sticking.rule == MoleculeSticking::Rule::byTable) {
    const std::string table = section + ".sticking_table";
    if (!deck.has(table)) throw deck.error(section + ".sticks", "by_table needs sticking_table");
    deck.at(table, [&] {
      readStickingTable(deck.resolvePath(deck.string(table)), o.sticking);
      return 0;
    });
  }
  if (const std::string key = section + ".band_gap"; deck.has(key))
    deck.at(key, [&] {
      TwoColumns table = readTwoColumns(deck.resolvePath(deck.string(key)), units::dimensionless, units::dimensionless,
                                        "carbon, band_gap", [](double gap) {
                                          if (gap < 0) throw InputError("a band gap may not be below zero");
                                        });
      o.bandGapCarbons = std::move(table.points);
      o.bandGaps = std::move(table.values);
      return 0;
    });
  for (const char* key : {"particles.sintering", "particles.fractal_dimension"})
    if (o.spheres && deck.isGiven(key))
      throw deck.error(key, "has no meaning with 'shape: spheres', whose particles have one primary; leave it out");
  o.rates = readPahRates(deck, section + ".rates");
  o.active = readPahProcesses(deck, section + ".processes");
  for (std::size_t p = 0; p < pahProcessCount; ++p) {
    const bool isOxidation = pahProcesses[p].name[0] == 'O';
    o.active[p] = o.active[p] && deck.boolean(isOxidation ? "particles.oxidation" : "particles.growth");
  }
  o.density = deck.optionalQuantity("particles.density").value_or(o.density);
  o.fractalDimension = deck.optionalNumber("particles.fractal_dimension").value_or(o.fractalDimension);
  o.sintering = readSintering(deck, o.sintering);
  o.sinteringTolerance = deck.number("particles.sintering.tolerance");
  o.coagulation = deck.boolean("particles.coagulation");
  o.kernel = readCollisions(deck);
  o.particles = readSampleNumber(deck, particleSection, 10000);  // some molecules each
  o.splitTolerance = deck.number("particles.split_tolerance");
  return o;
}

}  // namespace lampblack::app
