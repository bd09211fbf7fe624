#include "app/deck/soot_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/mechanism/known_species.hpp"

namespace lampblack::app {
namespace {

// Of the rate constants of the surface: their keys, and what they are of.
struct SurfaceRateKey {
  const char *name, *reaction;
  RateConstant SurfaceRateConstants::*value;
};
constexpr SurfaceRateKey surfaceRateKeys[] = {
    {"open_by_h", "that H opens a C-H site", &SurfaceRateConstants::openByH},
    {"close_by_h2", "that H2 closes a radical site", &SurfaceRateConstants::closeByH2},
    {"open_by_oh", "that OH opens a C-H site", &SurfaceRateConstants::openByOH},
    {"close_by_h2o", "that H2O closes a radical site", &SurfaceRateConstants::closeByH2O},
    {"close_by_h", "that H closes a radical site", &SurfaceRateConstants::closeByH},
    {"growth", "that C2H2 adds two carbon atoms to a radical site", &SurfaceRateConstants::growth},
    {"oxidation", "that O2 takes two carbon atoms from a radical site", &SurfaceRateConstants::oxidation}};

std::string listOf(const RateConstant& k) {
  return fmt::format("[{}, {}, {}]", k.A, k.n, k.E);
}

void addSurfaceRates(DeckSchema& schema) {
  const std::string s = "soot.surface.", law = ", A T^n exp(-E/(R T)): A in cm^3/mol/s, n, E in kcal/mol.";
  schema.section(
      "soot.surface", Presence::defaulted,
      "Rate constants of the surface of soot; the defaults are those of Appel, Bockhorn and Frenklach (2000).");
  const SurfaceRateConstants published;
  for (const SurfaceRateKey& key : surfaceRateKeys)
    schema.add(numberKey(s + key.name, std::string("Rate constant ") + key.reaction + law)
                   .list(3)
                   .byDefault(listOf(published.*key.value)));
  schema
      .add(numberKey(s + "close_by_o2", "Rate constant by which O2 counts among what closes radical sites" + law +
                                            " Absent: as oxidation.")
               .list(3)
               .optional())
      .add(
          booleanKey(s + "bounded",
                     "Whether radical sites and C-H sites together are what there is: their ratio r becomes r/(1 + r).")
              .byDefault("false"));
}

void addInception(DeckSchema& schema) {
  schema
      .add(choiceKey(
               "soot.inception_by", {"dimers", "monomers"},
               "What makes a nucleus and condenses. dimers: two dimers of PAH in steady state (Blanquart and Pitsch "
               "2009); monomers: two molecules of the one PAH, at the rate of all their collisions in the transition "
               "regime. monomers: only ensembles have them.")
               .byDefault("dimers"))
      .add(quantityKey("soot.monomer_mass", units::mass, "Mass of a monomer as it collides; absent: that of its atoms.")
               .optional()
               .above(0)
               .onlyWith("soot.inception_by", {"monomers"}))
      .add(quantityKey("soot.monomer_diameter", units::length,
                       "Diameter of a monomer as it collides; absent: of a sphere of the density of soot.")
               .optional()
               .above(0)
               .onlyWith("soot.inception_by", {"monomers"}))
      .add(booleanKey(
               "soot.heavy_particles",
               "true: dimers or monomers meet particles of ensembles as if these were at rest, the limit of heavy "
               "ones, as the program MOpS does; false: by the reduced mass.")
               .byDefault("false"))
      .add(choiceKey(
               "soot.slip", {"davies", "air"},
               "Slip correction in collisions of ensembles' particles. davies: Davies (1945), by the gas's mean free "
               "path; air: 1 + 1.257 Kn, Kn that of air at the gas's temperature and pressure (Shekar et al. 2011, "
               "eqs. 37, 38).")
               .byDefault("davies"));
}

void addShared(DeckSchema& schema, const std::vector<SootModelEntry>& models) {
  std::vector<std::string> names;
  std::string words = "Model of the soot that the gas carries. ";
  for (const SootModelEntry& model : models) {
    names.push_back(model.name);
    words += model.name + ": " + model.description + "; ";
  }
  names.emplace_back("none");
  schema.section("soot", Presence::optional, "Soot, carried by the gas; absent: none.")
      .add(choiceKey("soot.model", names, words + "none: as if the section were absent.")
               .byDefault("two_equation_dimer")
               .formerly("two_equation", "two_equation_dimer"))
      .add(stringKey("soot.pah",
                     "PAH species that make dimers or nuclei: hydrocarbons of ten carbon atoms or more with no more "
                     "hydrogen than carbon. leung and moss_brookes do not use them.")
               .list()
               .byDefault("[A2]"))
      .add(numberKey("soot.sticking",
                     "Probability that two molecules of a PAH stick when they collide, one number for each species of "
                     "soot.pah; absent: the table of Blanquart and Pitsch (2009), for other species its law 1.5e-11 (W "
                     "mol/g)^4, W the molar mass.")
               .list()
               .optional()
               .atLeast(0)
               .atMost(1))
      .add(quantityKey("soot.density", units::density,
                       "Density of soot; absent: 1850 kg/m^3, with sectional and moss_brookes 1800, with leung 2000.")
               .optional()
               .above(0))
      .add(quantityKey("soot.site_density", units::perArea,
                       "Number of C-H sites per surface of soot, where HACA growth and oxidation by O2 start: both are "
                       "proportional to it.")
               .byDefault("2.3e19 1/m^2")
               .atLeast(0))
      .add(numberKey("soot.alpha",
                     "Fraction alpha of the sites that are active, the same everywhere; absent, and without "
                     "soot.alpha_table: the function of temperature and size of Appel, Bockhorn and Frenklach (2000).")
               .optional()
               .atLeast(0)
               .atMost(1))
      .add(quantityKey("soot.alpha_table[].temperature", units::temperature,
                       "Temperature of a point of the table of alpha, the fraction of active sites: rising, straight "
                       "lines in between, constant outside.")
               .above(0))
      .add(numberKey("soot.alpha_table[].alpha", "Fraction of active sites at the temperature of this point.")
               .atLeast(0)
               .atMost(1))
      .add(numberKey("soot.oh_efficiency",
                     "Probability that an OH which hits the surface takes a carbon atom; absent: 0.13, with "
                     "moss_brookes 0.04, with leung 0.")
               .optional()
               .atLeast(0)
               .atMost(1))
      .add(numberKey("soot.van_der_waals",
                     "Factor by which van der Waals forces enhance free-molecular collisions of dimers and particles.")
               .byDefault("2.2")
               .above(0))
      .add(booleanKey("soot.inception", "Whether new particles form (inception); false: none do.").byDefault("true"))
      .add(booleanKey("soot.condensation", "Whether PAH or their dimers condense on particles.").byDefault("true"))
      .add(booleanKey("soot.growth",
                      "Whether particles grow by acetylene at their surface (HACA, or the law of the model).")
               .byDefault("true"))
      .add(booleanKey("soot.oxidation", "Whether O2 and OH oxidise soot.").byDefault("true"))
      .add(booleanKey("soot.coagulation", "Whether particles that collide become one.").byDefault("true"))
      .add(booleanKey("soot.diffusion",
                      "Whether soot diffuses by Brownian motion. Ensembles of particles that are followed along paths "
                      "never do.")
               .byDefault("true"));
  addInception(schema);
  addSurfaceRates(schema);
}

// Two aromatic rings or more: ten carbon atoms, as naphthalene, and no more hydrogen than carbon.
constexpr int leastPahCarbon = 10;

void requirePah(const std::string& name, int carbon, int hydrogen) {
  if (carbon >= leastPahCarbon && hydrogen <= carbon) return;
  throw InputError(
      fmt::format("'{}' (C{}H{}) is not a polycyclic aromatic hydrocarbon: expected {} carbon atoms or more "
                  "(naphthalene) and no more hydrogen than carbon",
                  name, carbon, hydrogen, leastPahCarbon));
}

const SootModelEntry& entryOf(const Deck& deck, const std::vector<SootModelEntry>& models) {
  const std::string name = deck.choice("soot.model");
  return *std::ranges::find(models, name, &SootModelEntry::name);
}

}  // namespace

void addSootModelKeys(DeckSchema& schema, const std::vector<SootModelEntry>& models) {
  addShared(schema, models);
  for (const SootModelEntry& model : models)
    if (model.addKeys != nullptr) model.addKeys(schema);
}

std::vector<DeckKey> sootParticleKeys(const std::string& section) {
  return {choiceKey(section + ".active_sites", {"particle", "primary"},
                    "The mean size in the fraction alpha of active sites (Appel, Bockhorn, Frenklach 2000): carbon "
                    "atoms of the mean particle or of the mean primary particle.")
              .byDefault("particle"),
          booleanKey(section + ".keep_hydrogen",
                     "true: soot keeps the hydrogen of PAH; false: it returns to the gas as H2 when PAH become soot.")
              .byDefault("true")};
}

SootWeights readSootWeights(const Deck& deck, const Mechanism& mechanism) {
  const auto carbon = mechanism.findElement("C"), hydrogen = mechanism.findElement("H");
  if (!carbon || !hydrogen) throw deck.error("soot", "soot needs a mechanism with carbon and hydrogen");
  return {mechanism.atomicWeight(*carbon), mechanism.atomicWeight(*hydrogen)};
}

std::vector<PahSpecies> readPahSpecies(const Deck& deck, const Mechanism& mechanism) {
  const bool given = deck.has("soot.sticking");
  const std::vector<std::string> names = deck.strings("soot.pah");
  const std::vector<double> sticking = given ? deck.numbers("soot.sticking") : std::vector<double>{};
  if (given && sticking.size() != names.size())
    throw deck.error("soot.sticking", fmt::format("{} coefficients for {} PAH", sticking.size(), names.size()));
  if (names.empty()) throw deck.error("soot.pah", "expected a PAH: without one no soot is ever formed");
  if (names.size() > maximumPahSpecies)
    throw deck.error("soot.pah", fmt::format("{} species; at most {} are possible", names.size(), maximumPahSpecies));
  std::vector<PahSpecies> list;
  try {
    const std::size_t carbon = mechanism.elementIndex("C"), hydrogen = mechanism.elementIndex("H");
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::size_t k = mechanism.speciesIndex(names[i]);
      const std::string& name = mechanism.speciesName(k);
      if (std::ranges::find(list, name, &PahSpecies::name) != list.end())
        throw InputError(fmt::format("'{}' is named twice: it would count twice", name));
      for (std::size_t e = 0; e < mechanism.numElements(); ++e)
        if ((e == carbon && mechanism.atoms(k, e) < 1) || (e != carbon && e != hydrogen && mechanism.atoms(k, e) != 0))
          throw InputError(fmt::format("'{}' is not a hydrocarbon", name));
      PahSpecies pah{name, static_cast<int>(std::lround(mechanism.atoms(k, carbon))),
                     static_cast<int>(std::lround(mechanism.atoms(k, hydrogen))), 0};
      requirePah(pah.name, pah.carbon, pah.hydrogen);
      pah.stickingCoefficient =
          given ? sticking[i]
                : defaultStickingCoefficient(name).value_or(stickingCoefficientByMass(mechanism.molecularWeights()[k]));
      list.push_back(std::move(pah));
    }
  } catch (const InputError& error) {
    throw deck.error("soot.pah", error.what());
  }
  return list;
}

namespace {

RateConstant readRate(const Deck& deck, const std::string& key) {
  const std::vector<double> numbers = deck.numbers(key);
  if (!(numbers[0] >= 0)) throw deck.error(key, "expected a factor A of zero or more");
  return {numbers[0], numbers[1], numbers[2]};
}

void readSurfaceRates(const Deck& deck, SurfaceRateConstants& rates) {
  for (const SurfaceRateKey& key : surfaceRateKeys)
    rates.*key.value = readRate(deck, std::string("soot.surface.") + key.name);
  if (deck.has("soot.surface.close_by_o2")) rates.closeByO2 = readRate(deck, "soot.surface.close_by_o2");
  rates.bounded = deck.boolean("soot.surface.bounded");
}

}  // namespace

SootModelOptions readSootModelOptions(const Deck& deck, const Mechanism& mechanism, SootModelOptions options) {
  const SootWeights weights = readSootWeights(deck, mechanism);
  options.carbonWeight = weights.carbon;
  options.hydrogenWeight = weights.hydrogen;
  options.pah = readPahSpecies(deck, mechanism);
  options.sootDensity = deck.optionalQuantity("soot.density").value_or(options.sootDensity);
  options.siteDensity = deck.quantity("soot.site_density");
  options.ohEfficiency = deck.optionalNumber("soot.oh_efficiency").value_or(options.ohEfficiency);
  options.vanDerWaals = deck.number("soot.van_der_waals");
  options.inceptionBy = deck.choice("soot.inception_by") == "monomers" ? InceptionBy::monomers : InceptionBy::dimers;
  options.monomerMass = deck.optionalQuantity("soot.monomer_mass").value_or(0);
  options.monomerDiameter = deck.optionalQuantity("soot.monomer_diameter").value_or(0);
  options.heavyParticles = deck.boolean("soot.heavy_particles");
  options.slip = deck.choice("soot.slip") == "air" ? SlipLaw::air : SlipLaw::davies;
  readSurfaceRates(deck, options.surface);
  options.inception = deck.boolean("soot.inception");
  options.condensation = deck.boolean("soot.condensation");
  options.surfaceGrowth = deck.boolean("soot.growth");
  options.oxidation = deck.boolean("soot.oxidation");
  options.coagulation = deck.boolean("soot.coagulation");
  options.alpha = deck.optionalNumber("soot.alpha");
  for (std::size_t i = 0; i < deck.size("soot.alpha_table"); ++i) {
    const std::string item = fmt::format("soot.alpha_table[{}].", i);
    options.alphaTable.push_back({deck.quantity(item + "temperature"), deck.number(item + "alpha")});
    if (i > 0 && !(options.alphaTable[i].temperature > options.alphaTable[i - 1].temperature))
      throw deck.error(item + "temperature", "the temperatures of the table have to rise");
  }
  if (options.alpha && !options.alphaTable.empty())
    throw deck.error("soot.alpha", "either a constant 'alpha' or an 'alpha_table'");
  return options;
}

SootModelOptions readSootModelOptions(const Deck& deck, const Mechanism& mechanism) {
  const bool none = deck.choice("soot.model") == "none";
  return readSootModelOptions(deck, mechanism, none ? SootModelOptions{} : entryOf(deck, sootModels()).defaults());
}

std::unique_ptr<ParticleModel> readSootModel(const Deck& deck, const Mechanism& mechanism,
                                             const std::vector<SootModelEntry>& models) {
  if (!deck.has("soot") || deck.choice("soot.model") == "none") return nullptr;
  for (const char* key : {"soot.inception_by", "soot.heavy_particles", "soot.slip"})
    if (deck.isGiven(key))
      throw deck.error(key, "only ensembles (section 'stochastic', without 'soot.model') have this; leave it out");
  std::unique_ptr<ParticleModel> model = entryOf(deck, models).read(deck, mechanism);
  deck.at("soot.model", [&] { return knownSpecies(mechanism, model->gasSpecies(), "the model needs"); });
  return model;
}

}  // namespace lampblack::app
