#include "app/soot_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "particles/soot/make_soot_model.hpp"

namespace lampblack {
namespace {

struct Weights {
  double carbon, hydrogen;  // kg/mol
};

Weights readWeights(const Deck& deck, const Mechanism& mechanism) {
  const auto carbon = mechanism.findElement("C"), hydrogen = mechanism.findElement("H");
  if (!carbon || !hydrogen) throw deck.error("soot", "soot needs a mechanism with carbon and hydrogen");
  return {mechanism.atomicWeight(*carbon), mechanism.atomicWeight(*hydrogen)};
}

template <class T>
void set(T& value, const std::optional<double>& given) {
  if (given) value = *given;
}

void readShared(const Deck& deck, const Mechanism& mechanism, SootModelOptions& options) {
  const Weights weights = readWeights(deck, mechanism);
  options.carbonWeight = weights.carbon;
  options.hydrogenWeight = weights.hydrogen;
  options.pah = readPahSpecies(deck, mechanism);
  set(options.sootDensity, deck.optionalQuantity("soot.density"));
  options.siteDensity = deck.quantity("soot.site_density");
  set(options.ohEfficiency, deck.optionalNumber("soot.oh_efficiency"));
  options.vanDerWaals = deck.number("soot.van_der_waals");
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
}

void readSemiEmpirical(const Deck& deck, const Mechanism& mechanism, SemiEmpiricalOptions& options) {
  using Oxygen = SemiEmpiricalOptions::Oxygen;
  const auto number = [&](const char* key) { return deck.optionalNumber(std::string("soot.semi_empirical.") + key); };
  const auto quantity = [&](const char* key) {
    return deck.optionalQuantity(std::string("soot.semi_empirical.") + key);
  };
  options.carbonWeight = readWeights(deck, mechanism).carbon;
  set(options.density, deck.optionalQuantity("soot.density"));
  set(options.ohEfficiency, deck.optionalNumber("soot.oh_efficiency"));
  options.inception = deck.boolean("soot.inception");
  options.growth = deck.boolean("soot.growth");
  options.oxidation = deck.boolean("soot.oxidation");
  options.coagulating = deck.boolean("soot.coagulation");
  set(options.inceptionFactor, quantity("inception_factor"));
  set(options.inceptionTemperature, quantity("inception_temperature"));
  set(options.nucleusCarbon, number("nucleus_carbon"));
  set(options.growthFactor, number("growth_factor"));
  set(options.growthTemperature, quantity("growth_temperature"));
  if (const auto surface = deck.optionalString("soot.semi_empirical.growth_surface"))
    options.growthByRootOfSurface = *surface == "root";
  set(options.coagulation, number("coagulation_factor"));
  set(options.oxidationFactor, number("oxidation_factor"));
  if (const auto oxygen = deck.optionalString("soot.semi_empirical.oxygen"))
    options.oxygen = *oxygen == "leung"   ? Oxygen::leung
                     : *oxygen == "lee"   ? Oxygen::lee
                     : *oxygen == "nagle" ? Oxygen::nagle
                                          : Oxygen::none;
}

void readSectional(const Deck& deck, SectionalSootOptions& options) {
  const auto key = [](const char* name) { return std::string("soot.sectional.") + name; };
  options.sections = deck.integer<std::size_t>(key("sections"));
  options.factor = deck.number(key("factor"));
  set(options.nucleusCarbon, deck.optionalNumber(key("nucleus_carbon")));
  options.nucleation = deck.choice(key("nucleation")) == "dimer" ? SectionalSootOptions::Nucleation::dimer
                                                                 : SectionalSootOptions::Nucleation::pah;
  options.nucleationFactor = deck.number(key("nucleation_factor"));
  options.condensationEfficiency = deck.number(key("condensation_efficiency"));
  options.aggregation = deck.choice(key("aggregation")) == "spheres" ? SectionalSootOptions::Aggregation::spheres
                                                                     : SectionalSootOptions::Aggregation::aggregates;
  set(options.coalescenceDiameter, deck.optionalQuantity(key("coalescence_diameter")));
  options.activeSites = deck.choice(key("active_sites")) == "primary" ? SectionalSootOptions::ActiveSites::primary
                                                                      : SectionalSootOptions::ActiveSites::aggregate;
  if (deck.choice(key("growth_scheme")) == "limited")
    options.growthScheme = SectionalSootOptions::GrowthScheme::limited;
  if (deck.choice(key("kernel")) == "free_molecular") options.kernel = CollisionKernelType::freeMolecular;
  options.fragmentation = deck.boolean(key("fragmentation"));
  options.fragmentationFactor = deck.number(key("fragmentation_factor"));
  options.carbonisation = deck.boolean(key("carbonisation"));
  options.carbonisationRate = deck.quantity(key("carbonisation_rate"));
  options.carbonisationEnergy = deck.quantity(key("carbonisation_energy"));
}

}  // namespace

namespace {

// Two aromatic rings or more: ten carbon atoms, as naphthalene, and no more hydrogen than carbon.
constexpr int leastPahCarbon = 10;

void requirePah(const std::string& name, int carbon, int hydrogen) {
  if (carbon >= leastPahCarbon && hydrogen <= carbon) return;
  throw InputError(
      fmt::format("'{}' (C{}H{}) is not a polycyclic aromatic hydrocarbon: expected {} carbon atoms or more "
                  "(naphthalene) and no more hydrogen than carbon",
                  name, carbon, hydrogen, leastPahCarbon));
}

// The semi-empirical models know acetylene only; ensembles beside them read these keys.
void refuseUnread(const Deck& deck, const std::string& model) {
  if (deck.has("stochastic") || deck.has("trajectories")) return;
  for (const char* key : {"sticking", "site_density", "alpha", "alpha_table", "van_der_waals", "condensation"})
    if (const std::string path = std::string("soot.") + key; deck.isGiven(path))
      throw deck.error(
          path, fmt::format("the model {} does not use this key; leave it out or choose another soot.model", model));
}

}  // namespace

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
      if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
          names.begin() + static_cast<std::ptrdiff_t>(i))
        throw InputError(fmt::format("'{}' is named twice: it would count twice", names[i]));
      for (std::size_t e = 0; e < mechanism.numElements(); ++e)
        if ((e == carbon && mechanism.atoms(k, e) < 1) || (e != carbon && e != hydrogen && mechanism.atoms(k, e) != 0))
          throw InputError(fmt::format("'{}' is not a hydrocarbon", names[i]));
      PahSpecies pah{names[i], static_cast<int>(std::lround(mechanism.atoms(k, carbon))),
                     static_cast<int>(std::lround(mechanism.atoms(k, hydrogen))), 0};
      requirePah(pah.name, pah.carbon, pah.hydrogen);
      pah.stickingCoefficient = given ? sticking[i]
                                      : defaultStickingCoefficient(names[i]).value_or(
                                            stickingCoefficientByMass(mechanism.molecularWeights()[k]));
      list.push_back(std::move(pah));
    }
  } catch (const InputError& error) {
    throw deck.error("soot.pah", error.what());
  }
  return list;
}

SootModelOptions readSootModelOptions(const Deck& deck, const Mechanism& mechanism) {
  const std::string name = deck.choice("soot.model");
  SootModelOptions options;
  if (name != "none") {
    SootModelChoice choice = publishedSootModel(name);
    if (const SootModelOptions* published = sharedOptions(choice)) options = *published;
  }
  readShared(deck, mechanism, options);
  return options;
}

std::unique_ptr<ParticleModel> readSootModel(const Deck& deck, const Mechanism& mechanism) {
  if (!deck.has("soot")) return nullptr;
  const std::string name = deck.choice("soot.model");
  if (name == "none") return nullptr;
  SootModelChoice choice = publishedSootModel(name);
  if (SootModelOptions* shared = sharedOptions(choice)) readShared(deck, mechanism, *shared);
  if (auto* semiEmpirical = std::get_if<SemiEmpiricalOptions>(&choice))
    readSemiEmpirical(deck, mechanism, *semiEmpirical);
  if (std::holds_alternative<SemiEmpiricalOptions>(choice)) refuseUnread(deck, name);
  if (auto* sectional = std::get_if<SectionalSootOptions>(&choice)) readSectional(deck, *sectional);
  if (auto* hmom = std::get_if<HmomOptions>(&choice)) {
    hmom->fractalDimension = deck.number("soot.hmom.fractal_dimension");
    hmom->surfaceExponent = deck.number("soot.hmom.surface_exponent");
  }
  if (auto* momic = std::get_if<MomicOptions>(&choice)) momic->moments = deck.integer<std::size_t>("soot.moments");

  std::unique_ptr<ParticleModel> model;
  try {
    model = makeSootModel(choice);
  } catch (const InputError& error) {
    throw deck.error("soot", error.what());
  }
  for (const std::string& species : model->gasSpecies())
    if (!mechanism.findSpecies(species))
      throw deck.error("soot.model", fmt::format("the model needs the species '{}', but the mechanism has no species "
                                                 "of this name; choose another mechanism or another model",
                                                 species));
  return model;
}

}  // namespace lampblack
