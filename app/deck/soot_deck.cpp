#include "app/deck/soot_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/deck/particles_deck.hpp"
#include "chemistry/mechanism/known_species.hpp"
#include "io/deck_keys.hpp"

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
  SectionKeys keys("particles.surface");
  const std::string law = ", A T^n exp(-E/(R T)): A in cm^3/mol/s, n, E in kcal/mol.";
  keys.section(
      Presence::defaulted,
      "Rate constants of the surface of soot; the defaults are those of Appel, Bockhorn and Frenklach (2000).");
  const SurfaceRateConstants published;
  for (const SurfaceRateKey& key : surfaceRateKeys)
    keys.number(key.name, rules().list(3).byDefault(listOf(published.*key.value)),
                std::string("Rate constant ") + key.reaction + law);
  keys.number("close_by_o2", rules().list(3).optional(),
              "Rate constant by which O2 counts among what closes radical sites" + law + " Absent: as oxidation.");
  keys.boolean("bounded", rules().byDefault("false"),
               "Whether radical sites and C-H sites together are what there is: their ratio r becomes r/(1 + r).");
  schema.add(keys.schema());
}

DeckKeys<SootModelOptions> inceptionKeys() {
  using Options = SootModelOptions;
  DeckKeys<Options> keys("particles");
  keys.choice(
      "inception_by", &Options::inceptionBy, {{"dimers", InceptionBy::dimers}, {"monomers", InceptionBy::monomers}},
      rules().byDefault("dimers"),
      "What makes a nucleus and condenses. dimers: two dimers of PAH in steady state (Blanquart and Pitsch 2009); "
      "monomers: two molecules of the one PAH, at the rate of all their collisions in the transition regime.");
  keys.number("dimer_equilibrium", rules().list(3).optional().onlyWith("particles.inception_by", {"dimers"}),
              "Dimers come apart again: [dimers]/[PAH]^2 in equilibrium, A T^n exp(-E/(R T)), A in cm^3/mol, n, E in "
              "kcal/mol, E below zero for what binds; one for all pairs. Absent: dimers stay.");
  keys.quantity("monomer_mass", units::mass, &Options::monomerMass,
                rules().optional().above(0).onlyWith("particles.inception_by", {"monomers"}),
                "Mass of a monomer as it collides; absent: that of its atoms.");
  keys.quantity("monomer_diameter", units::length, &Options::monomerDiameter,
                rules().optional().above(0).onlyWith("particles.inception_by", {"monomers"}),
                "Diameter of a monomer as it collides; absent: of a sphere of the density of soot.");
  keys.boolean("heavy_particles", &Options::heavyParticles, rules().byDefault("false"),
               "true: dimers or monomers meet particles of ensembles as if these were at rest, the limit of heavy "
               "ones, as the program MOpS does; false: by the reduced mass.");
  return keys;
}

DeckKeys<SootModelOptions> physicsKeys() {
  using Options = SootModelOptions;
  DeckKeys<Options> keys("particles");
  keys.text("pah", rules().list().byDefault("[A2]"),
            "PAH species that make dimers or nuclei: hydrocarbons of ten carbon atoms or more with no more hydrogen "
            "than carbon. leung and moss_brookes do not use them; with molecules it is the species of "
            "particles.molecules.molecule, where the deck does not say another.");
  keys.number("sticking", rules().list().optional().atLeast(0).atMost(1),
              "Probability that two molecules of a PAH stick when they collide, one number for each species of "
              "particles.pah; absent: the table of Blanquart and Pitsch (2009), for other species its law 1.5e-11 (W "
              "mol/g)^4, W the molar mass.");
  keys.quantity("site_density", units::perArea, &Options::siteDensity, rules().byDefault("2.3e19 1/m^2").atLeast(0),
                "Number of C-H sites per surface of soot, where HACA growth and oxidation by O2 start: both are "
                "proportional to it.");
  keys.number("alpha", &Options::alpha, rules().optional().atLeast(0).atMost(1),
              "Fraction alpha of the sites that are active, the same everywhere; absent, and without "
              "particles.alpha_table: the function of temperature and size of Appel, Bockhorn and Frenklach (2000).");
  keys.quantity("alpha_table[].temperature", units::temperature, rules().above(0),
                "Temperature of a point of the table of alpha, the fraction of active sites: rising, straight lines in "
                "between, constant outside.");
  keys.number("alpha_table[].alpha", rules().atLeast(0).atMost(1),
              "Fraction of active sites at the temperature of this point.");
  keys.number("oh_efficiency", &Options::ohEfficiency, rules().optional().atLeast(0).atMost(1),
              "Probability that an OH which hits the surface takes a carbon atom; absent: 0.13, with moss_brookes "
              "0.04, with leung 0.");
  keys.boolean("inception", &Options::inception, rules().byDefault("true"),
               "Whether new particles form (inception); false: none do.");
  keys.boolean("condensation", &Options::condensation, rules().byDefault("true"),
               "Whether PAH or their dimers condense on particles.");
  keys.boolean("growth", &Options::surfaceGrowth, rules().byDefault("true"),
               "Whether particles grow by acetylene at their surface (HACA, or the law of the model).");
  keys.boolean("oxidation", &Options::oxidation, rules().byDefault("true"), "Whether O2 and OH oxidise soot.");
  keys.schema().add(inceptionKeys().schema(), ofPopulations());
  addSurfaceRates(keys.schema());
  return keys;
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
  const std::string name = carriedModel(deck);
  return *std::ranges::find(models, name, &SootModelEntry::name);
}

}  // namespace

void addSootModelKeys(DeckSchema& schema, const std::vector<SootModelEntry>& models) {
  schema.add(physicsKeys().schema(), ofSoot());
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
  if (!carbon || !hydrogen) throw deck.error(particleSection, "soot needs a mechanism with carbon and hydrogen");
  return {mechanism.atomicWeight(*carbon), mechanism.atomicWeight(*hydrogen)};
}

std::vector<PahSpecies> readPahSpecies(const Deck& deck, const Mechanism& mechanism) {
  const bool given = deck.has("particles.sticking");
  const std::vector<std::string> names = deck.strings("particles.pah");
  const std::vector<double> sticking = given ? deck.numbers("particles.sticking") : std::vector<double>{};
  if (given && sticking.size() != names.size())
    throw deck.error("particles.sticking", fmt::format("{} coefficients for {} PAH", sticking.size(), names.size()));
  if (names.empty()) throw deck.error("particles.pah", "expected a PAH: without one no soot is ever formed");
  if (names.size() > maximumPahSpecies)
    throw deck.error("particles.pah",
                     fmt::format("{} species; at most {} are possible", names.size(), maximumPahSpecies));
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
    throw deck.error("particles.pah", error.what());
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
    rates.*key.value = readRate(deck, std::string("particles.surface.") + key.name);
  if (deck.has("particles.surface.close_by_o2")) rates.closeByO2 = readRate(deck, "particles.surface.close_by_o2");
  rates.bounded = deck.boolean("particles.surface.bounded");
}

}  // namespace

SootModelOptions readSootModelOptions(const Deck& deck, const Mechanism& mechanism, SootModelOptions options) {
  const SootWeights weights = readSootWeights(deck, mechanism);
  options.carbonWeight = weights.carbon;
  options.hydrogenWeight = weights.hydrogen;
  options.pah = readPahSpecies(deck, mechanism);
  options.sootDensity = deck.optionalQuantity("particles.density").value_or(options.sootDensity);
  physicsKeys().read(deck, options, "particles");
  inceptionKeys().read(deck, options, "particles");
  options.vanDerWaals = deck.number("particles.van_der_waals");
  if (deck.has("particles.dimer_equilibrium")) {
    options.dimerEquilibrium = readRate(deck, "particles.dimer_equilibrium");
    if (!(options.dimerEquilibrium->A > 0)) throw deck.error("particles.dimer_equilibrium", "expected A above zero");
  }
  options.slip = deck.choice("particles.slip") == "air" ? SlipLaw::air : SlipLaw::davies;
  readSurfaceRates(deck, options.surface);
  options.coagulation = deck.boolean("particles.coagulation");
  for (std::size_t i = 0; i < deck.size("particles.alpha_table"); ++i) {
    const std::string item = fmt::format("particles.alpha_table[{}].", i);
    options.alphaTable.push_back({deck.quantity(item + "temperature"), deck.number(item + "alpha")});
    if (i > 0 && !(options.alphaTable[i].temperature > options.alphaTable[i - 1].temperature))
      throw deck.error(item + "temperature", "the temperatures of the table have to rise");
  }
  if (options.alpha && !options.alphaTable.empty())
    throw deck.error("particles.alpha", "either a constant 'alpha' or an 'alpha_table'");
  return options;
}

SootModelOptions readSootModelOptions(const Deck& deck, const Mechanism& mechanism) {
  const bool none = carriedModel(deck) == "none";
  return readSootModelOptions(deck, mechanism, none ? SootModelOptions{} : entryOf(deck, sootModels()).defaults());
}

std::unique_ptr<ParticleModel> readSootModel(const Deck& deck, const Mechanism& mechanism,
                                             const std::vector<SootModelEntry>& models) {
  requireDescription(deck);
  if (carriedModel(deck) == "none") return nullptr;
  for (const char* key :
       {"particles.inception_by", "particles.dimer_equilibrium", "particles.heavy_particles", "particles.slip"})
    if (deck.isGiven(key))
      throw deck.error(key, fmt::format("a model that the gas carries does not have this; leave it out, or '{}'",
                                        carriedModelKey(deck)));
  std::unique_ptr<ParticleModel> model = entryOf(deck, models).read(deck, mechanism);
  deck.at(carriedModelKey(deck), [&] { return knownSpecies(mechanism, model->gasSpecies(), "the model needs"); });
  return model;
}

}  // namespace lampblack::app
