#include "app/soot_deck.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "app/flame_soot.hpp"
#include "particles/soot/dimer_soot.hpp"
#include "particles/soot/hmom.hpp"
#include "particles/soot/momic_soot.hpp"

namespace lampblack {
namespace {

SootModelOptions readOptions(const Deck& deck, const Mechanism& mechanism) {
  SootModelOptions options;
  const auto carbon = mechanism.findElement("C"), hydrogen = mechanism.findElement("H");
  if (!carbon || !hydrogen) throw deck.error("soot", "soot needs a mechanism with carbon and hydrogen");
  options.carbonWeight = mechanism.atomicWeight(*carbon);
  options.hydrogenWeight = mechanism.atomicWeight(*hydrogen);
  options.sootDensity = deck.optionalQuantity("soot.density").value_or(options.sootDensity);
  options.siteDensity = deck.quantity("soot.site_density");
  options.ohEfficiency = deck.number("soot.oh_efficiency");
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
  return options;
}

}  // namespace

std::vector<PahSpecies> readPahSpecies(const Deck& deck, const Mechanism& mechanism) {
  const bool given = deck.has("soot.sticking");
  const std::vector<std::string> names = deck.strings("soot.pah");
  const std::vector<double> sticking = given ? deck.numbers("soot.sticking") : std::vector<double>{};
  if (given && sticking.size() != names.size())
    throw deck.error("soot.sticking", fmt::format("{} coefficients for {} PAH", sticking.size(), names.size()));
  if (names.size() > maximumPahSpecies)
    throw deck.error("soot.pah", fmt::format("{} species; at most {} are possible", names.size(), maximumPahSpecies));
  std::vector<PahSpecies> list;
  try {
    const std::size_t carbon = mechanism.elementIndex("C"), hydrogen = mechanism.elementIndex("H");
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::size_t k = mechanism.speciesIndex(names[i]);
      for (std::size_t e = 0; e < mechanism.numElements(); ++e)
        if ((e == carbon && mechanism.atoms(k, e) < 1) || (e != carbon && e != hydrogen && mechanism.atoms(k, e) != 0))
          throw InputError(fmt::format("'{}' is not a hydrocarbon", names[i]));
      PahSpecies pah{names[i], static_cast<int>(std::lround(mechanism.atoms(k, carbon))),
                     static_cast<int>(std::lround(mechanism.atoms(k, hydrogen))), 0};
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

void addSootModelKeys(DeckSchema& schema) {
  schema.section("soot", Presence::optional, "Soot, carried by the flame; absent: none.")
      .add(
          choiceKey("soot.model", {"two_equation_dimer", "leung", "moss_brookes", "sectional", "hmom", "momic", "none"},
                    "Dimers with two equations (thesis 7.2.2); Leung, Lindstedt, Jones 1991; Brookes and Moss 1999; "
                    "sections; hybrid method of moments; moments by interpolation; none as if the section were absent.")
              .byDefault("two_equation_dimer"))
      .add(stringKey("soot.pah", "Species that dimerise.").list().byDefault("[A2]"))
      .add(numberKey("soot.sticking",
                     "Sticking coefficient of each of them; absent: the table of Blanquart and Pitsch 2009, or its law "
                     "1.5e-11 (W mol/g)^4 for others.")
               .list()
               .optional()
               .atLeast(0)
               .atMost(1))
      .add(quantityKey("soot.density", units::density, "Of the particles; absent: as published with the model.")
               .optional()
               .above(0))
      .add(quantityKey("soot.site_density", units::perArea, "C-H sites of the surface (HACA).")
               .byDefault("2.3e19 1/m^2")
               .atLeast(0))
      .add(numberKey("soot.alpha",
                     "Constant fraction of active sites; absent, and without a table: the ABF function of temperature "
                     "and size.")
               .optional()
               .atLeast(0)
               .atMost(1))
      .add(quantityKey("soot.alpha_table[].temperature", units::temperature,
                       "Table of the fraction: rising temperatures, straight in between, constant outside.")
               .above(0))
      .add(numberKey("soot.alpha_table[].alpha", "Fraction there.").atLeast(0).atMost(1))
      .add(integerKey("soot.moments", "Number of moments of model momic.").byDefault("6").atLeast(3).atMost(6))
      .add(numberKey("soot.oh_efficiency", "Reaction probability of an OH collision.")
               .byDefault("0.13")
               .atLeast(0)
               .atMost(1))
      .add(numberKey("soot.van_der_waals", "Enhancement of dimer and particle collisions.").byDefault("2.2").above(0))
      .add(booleanKey("soot.inception", "New particles.").byDefault("true"))
      .add(booleanKey("soot.condensation", "PAH on particles.").byDefault("true"))
      .add(booleanKey("soot.growth", "Surface growth.").byDefault("true"))
      .add(booleanKey("soot.oxidation", "By O2 and OH.").byDefault("true"))
      .add(booleanKey("soot.coagulation", "Of particles.").byDefault("true"));
}

std::unique_ptr<SootModel> readSootModel(const Deck& deck, const Mechanism& mechanism) {
  if (!deck.has("soot")) return nullptr;
  const std::string name = deck.choice("soot.model");
  if (name == "none") return nullptr;
  SootModelOptions options = readOptions(deck, mechanism);
  std::unique_ptr<SootModel> model;
  if (name == "two_equation_dimer") {
    options.pah = readPahSpecies(deck, mechanism);
    model = std::make_unique<DimerSoot>(std::move(options));
  } else if (name == "hmom" || name == "momic") {
    options.pah = readPahSpecies(deck, mechanism);
    if (name == "hmom") {
      model = std::make_unique<HmomSoot>(HmomOptions{std::move(options)});
    } else {
      const auto moments = static_cast<std::size_t>(deck.integer("soot.moments"));
      model = std::make_unique<MomicSoot>(MomicOptions{std::move(options), moments});
    }
  } else {
    throw deck.error("soot.model", fmt::format("'{}' is not there yet", name));
  }
  for (const std::string& species : model->gasSpecies())
    if (!mechanism.findSpecies(species))
      throw deck.error("soot.model", fmt::format("it needs the species '{}', which the mechanism has not", species));
  return model;
}

}  // namespace lampblack
