#include "app/deck/fragmentation_deck.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/soot_models/soot_models.hpp"
#include "io/deck_keys.hpp"
#include "particles/models/sectional/sectional_soot.hpp"

namespace lampblack::app {
namespace {

DeckKeys<SectionalSootOptions> sectionalKeys() {
  using Options = SectionalSootOptions;
  DeckKeys<Options> keys("particles.sectional");
  keys.integer("sections", &Options::sections, rules().atLeast(2).atMost(400),
               "Number of sections of mass: more of them reach larger particles.");
  keys.number("factor", &Options::factor, rules().above(1),
              "Ratio of the masses of neighbouring sections: smaller resolves the distribution better and needs "
              "more sections.");
  keys.number("overflow", rules().byDefault("1e-4").above(0).atMost(1),
              "Largest volume fraction of soot in the last section, which cannot grow, over the largest of all: "
              "more is a failure, of a steady state that is sought once it has been found; 1: it is only "
              "counted (soot_in_last_section).");
  keys.number("nucleus_carbon", &Options::nucleusCarbon, rules().optional().above(0),
              "Number of carbon atoms of a particle in the first section; absent: that of the smallest nucleus "
              "which the PAH can make.");
  keys.choice("nucleation", &Options::nucleation,
              {{"pah", Options::Nucleation::pah}, {"dimer", Options::Nucleation::dimer}}, rules(),
              "What makes a nucleus: pah: two PAH molecules (Wang 2025, eq. 9-23); dimer: two dimers (Wang "
              "2025, section 7.2.2).");
  keys.number("nucleation_factor", &Options::nucleationFactor, rules().atLeast(0),
              "Part of the collisions of two PAH molecules that make a nucleus (Wang 2025, eq. 9-23).");
  keys.number("condensation_efficiency", &Options::condensationEfficiency, rules().atLeast(0).atMost(1),
              "Part of the collisions of a PAH molecule with an aggregate in which it condenses.");
  keys.choice("aggregation", &Options::aggregation,
              {{"aggregates", Options::Aggregation::aggregates}, {"spheres", Options::Aggregation::spheres}}, rules(),
              "What particles are after they coagulate: aggregates: their primary particles stay as they are "
              "and touch; spheres: they coalesce to one sphere.");
  keys.quantity("coalescence_diameter", units::length, &Options::coalescenceDiameter, rules().optional().above(0),
                "Particles smaller than this diameter melt into the particle they collide with; absent: none do.");
  keys.choice("active_sites", &Options::activeSites,
              {{"aggregate", Options::ActiveSites::aggregate}, {"primary", Options::ActiveSites::primary}}, rules(),
              "The mean size in the fraction alpha of active sites: carbon atoms per aggregate or per primary "
              "particle.");
  keys.choice("growth_scheme", &Options::growthScheme,
              {{"upwind", Options::GrowthScheme::upwind}, {"limited", Options::GrowthScheme::limited}}, rules(),
              "How growth and oxidation move soot between sections: upwind: first order, spreads the "
              "distribution (Wang 2025, eqs. 9-41 to 9-44); limited: second order.");
  keys.choice("kernel", &Options::kernel,
              {{"transition", CollisionKernelType::transition}, {"free_molecular", CollisionKernelType::freeMolecular}},
              rules(),
              "Collision kernel of coagulation: transition: for particles of all sizes; free_molecular: for "
              "particles smaller than the mean free path.");
  const auto [breaking, factor] =
      fragmentationKeys("particles.sectional", "Whether oxidation breaks aggregates into halves.");
  keys.add(breaking);
  keys.add(factor);
  keys.boolean("carbonisation", &Options::carbonisation, rules(),
               "true: soot keeps the hydrogen of PAH and loses it slowly (carbonisation); false: the hydrogen "
               "leaves as H2 when PAH become soot.");
  keys.quantity("carbonisation_rate", units::frequency, &Options::carbonisationRate,
                rules().byDefault("1.78e6 1/s").atLeast(0),
                "Factor A of the rate at which soot loses hydrogen, A exp(-E/(R T)) (Dobbins 2002).");
  keys.quantity("carbonisation_energy", units::molarEnergy, &Options::carbonisationEnergy,
                rules().byDefault("1.13e5 J/mol").atLeast(0),
                "Activation energy E of the rate at which soot loses hydrogen, A exp(-E/(R T)).");
  return keys;
}

void addSectionalKeys(DeckSchema& schema) {
  schema.add(sectionalKeys().schema())
      .section("particles.sectional", Presence::defaulted, "Constants of the model sectional.",
               {ofModels(schema, {"sectional"})});
}

SootModelOptions sectionalDefaults() {
  return SectionalSootOptions{}.soot;
}

std::unique_ptr<ParticleModel> readSectional(const Deck& deck, const Mechanism& mechanism) {
  SectionalSootOptions options;
  options.soot = readSootModelOptions(deck, mechanism, sectionalDefaults());
  sectionalKeys().read(deck, options, "particles.sectional");
  options.fragmentation = readFragmentation(deck, "particles.sectional");
  return makeSootModel<SectionalSoot>(deck, options);
}

}  // namespace

SootModelEntry sectionalEntry() {
  return {"sectional", "size distribution in sections (Wang 2025, section 9.2.2)", addSectionalKeys, sectionalDefaults,
          readSectional};
}

}  // namespace lampblack::app
