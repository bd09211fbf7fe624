#include "app/deck/fragmentation_deck.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/soot_models/soot_models.hpp"
#include "particles/models/sectional/sectional_soot.hpp"

namespace lampblack::app {
namespace {

void addSectionalKeys(DeckSchema& schema) {
  const std::string s = "particles.sectional.";
  const auto [breaking, factor] =
      fragmentationKeys("particles.sectional", "Whether oxidation breaks aggregates into halves.");
  schema
      .section("particles.sectional", Presence::defaulted, "Constants of the model sectional.",
               {ofModels(schema, {"sectional"})})
      .add(integerKey(s + "sections", "Number of sections of mass: more of them reach larger particles.")
               .byDefault("35")
               .atLeast(2)
               .atMost(400))
      .add(numberKey(s + "factor",
                     "Ratio of the masses of neighbouring sections: smaller resolves the distribution better and needs "
                     "more sections.")
               .byDefault("2")
               .above(1))
      .add(numberKey(s + "overflow",
                     "Largest volume fraction of soot in the last section, which cannot grow, over the largest of all: "
                     "more is a failure, of a steady state that is sought once it has been found; 1: it is only "
                     "counted (soot_in_last_section).")
               .byDefault("1e-4")
               .above(0)
               .atMost(1))
      .add(numberKey(s + "nucleus_carbon",
                     "Number of carbon atoms of a particle in the first section; absent: that of the smallest nucleus "
                     "which the PAH can make.")
               .optional()
               .above(0))
      .add(choiceKey(s + "nucleation", {"pah", "dimer"},
                     "What makes a nucleus: pah: two PAH molecules (Wang 2025, eq. 9-23); dimer: two dimers (Wang "
                     "2025, section 7.2.2).")
               .byDefault("pah"))
      .add(numberKey(s + "nucleation_factor",
                     "Part of the collisions of two PAH molecules that make a nucleus (Wang 2025, eq. 9-23).")
               .byDefault("0.002")
               .atLeast(0))
      .add(numberKey(s + "condensation_efficiency",
                     "Part of the collisions of a PAH molecule with an aggregate in which it condenses.")
               .byDefault("0.5")
               .atLeast(0)
               .atMost(1))
      .add(choiceKey(s + "aggregation", {"aggregates", "spheres"},
                     "What particles are after they coagulate: aggregates: their primary particles stay as they are "
                     "and touch; spheres: they coalesce to one sphere.")
               .byDefault("aggregates"))
      .add(
          quantityKey(s + "coalescence_diameter", units::length,
                      "Particles smaller than this diameter melt into the particle they collide with; absent: none do.")
              .optional()
              .above(0))
      .add(choiceKey(s + "active_sites", {"aggregate", "primary"},
                     "The mean size in the fraction alpha of active sites: carbon atoms per aggregate or per primary "
                     "particle.")
               .byDefault("aggregate"))
      .add(choiceKey(s + "growth_scheme", {"upwind", "limited"},
                     "How growth and oxidation move soot between sections: upwind: first order, spreads the "
                     "distribution (Wang 2025, eqs. 9-41 to 9-44); limited: second order.")
               .byDefault("upwind"))
      .add(choiceKey(s + "kernel", {"transition", "free_molecular"},
                     "Collision kernel of coagulation: transition: for particles of all sizes; free_molecular: for "
                     "particles smaller than the mean free path.")
               .byDefault("transition"))
      .add(breaking)
      .add(factor)
      .add(booleanKey(s + "carbonisation",
                      "true: soot keeps the hydrogen of PAH and loses it slowly (carbonisation); false: the hydrogen "
                      "leaves as H2 when PAH become soot.")
               .byDefault("false"))
      .add(quantityKey(s + "carbonisation_rate", units::frequency,
                       "Factor A of the rate at which soot loses hydrogen, A exp(-E/(R T)) (Dobbins 2002).")
               .byDefault("1.78e6 1/s")
               .atLeast(0))
      .add(quantityKey(s + "carbonisation_energy", units::molarEnergy,
                       "Activation energy E of the rate at which soot loses hydrogen, A exp(-E/(R T)).")
               .byDefault("1.13e5 J/mol")
               .atLeast(0));
}

SootModelOptions sectionalDefaults() {
  return SectionalSootOptions{}.soot;
}

std::unique_ptr<ParticleModel> readSectional(const Deck& deck, const Mechanism& mechanism) {
  SectionalSootOptions options;
  options.soot = readSootModelOptions(deck, mechanism, sectionalDefaults());
  const auto key = [](const char* name) { return std::string("particles.sectional.") + name; };
  options.sections = deck.integer<std::size_t>(key("sections"));
  options.factor = deck.number(key("factor"));
  if (const auto atoms = deck.optionalNumber(key("nucleus_carbon"))) options.nucleusCarbon = *atoms;
  options.nucleation = deck.choice(key("nucleation")) == "dimer" ? SectionalSootOptions::Nucleation::dimer
                                                                 : SectionalSootOptions::Nucleation::pah;
  options.nucleationFactor = deck.number(key("nucleation_factor"));
  options.condensationEfficiency = deck.number(key("condensation_efficiency"));
  options.aggregation = deck.choice(key("aggregation")) == "spheres" ? SectionalSootOptions::Aggregation::spheres
                                                                     : SectionalSootOptions::Aggregation::aggregates;
  if (const auto diameter = deck.optionalQuantity(key("coalescence_diameter"))) options.coalescenceDiameter = *diameter;
  options.activeSites = deck.choice(key("active_sites")) == "primary" ? SectionalSootOptions::ActiveSites::primary
                                                                      : SectionalSootOptions::ActiveSites::aggregate;
  if (deck.choice(key("growth_scheme")) == "limited")
    options.growthScheme = SectionalSootOptions::GrowthScheme::limited;
  if (deck.choice(key("kernel")) == "free_molecular") options.kernel = CollisionKernelType::freeMolecular;
  options.fragmentation = readFragmentation(deck, "particles.sectional");
  options.carbonisation = deck.boolean(key("carbonisation"));
  options.carbonisationRate = deck.quantity(key("carbonisation_rate"));
  options.carbonisationEnergy = deck.quantity(key("carbonisation_energy"));
  return makeSootModel<SectionalSoot>(deck, options);
}

}  // namespace

SootModelEntry sectionalEntry() {
  return {"sectional", "size distribution in sections (Wang 2025, section 9.2.2)", addSectionalKeys, sectionalDefaults,
          readSectional};
}

}  // namespace lampblack::app
