#include "app/soot_deck.hpp"
#include "particles/soot/make_soot_model.hpp"

namespace lampblack {
namespace {

void addShared(DeckSchema& schema) {
  std::vector<std::string> models = sootModelNames();
  models.emplace_back("none");
  schema.section("soot", Presence::optional, "Soot, carried by the gas; absent: none.")
      .add(choiceKey("soot.model", models,
                     "two_equation_dimer: Wang 2025, section 7.2.2; leung: Leung, Lindstedt, Jones 1991; "
                     "moss_brookes: Brookes and Moss 1999; sectional: Wang 2025, section 9.2.2; hmom: Mueller, "
                     "Blanquart, Pitsch 2009; momic: Frenklach 2002; "
                     "none: as if the section were absent.")
               .byDefault("two_equation_dimer")
               .formerly("two_equation", "two_equation_dimer"))
      .add(stringKey(
               "soot.pah",
               "Species that dimerise or make nuclei: hydrocarbons of ten carbon atoms or more with no more hydrogen "
               "than carbon. leung and moss_brookes do without.")
               .list()
               .byDefault("[A2]"))
      .add(numberKey("soot.sticking",
                     "Sticking coefficient of each of them; absent: the table of Blanquart and Pitsch 2009, or its law "
                     "1.5e-11 (W mol/g)^4 for others.")
               .list()
               .optional()
               .atLeast(0)
               .atMost(1))
      .add(quantityKey("soot.density", units::density,
                       "Of the particles; absent: 1850 kg/m^3, sectional and moss_brookes 1800, leung 2000.")
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
      .add(numberKey("soot.oh_efficiency",
                     "Reaction probability of an OH collision; absent: 0.13, moss_brookes 0.04, leung 0.")
               .optional()
               .atLeast(0)
               .atMost(1))
      .add(numberKey("soot.van_der_waals", "Enhancement of dimer and particle collisions.").byDefault("2.2").above(0))
      .add(booleanKey("soot.inception", "New particles.").byDefault("true"))
      .add(booleanKey("soot.condensation", "PAH on particles.").byDefault("true"))
      .add(booleanKey("soot.growth", "Surface growth.").byDefault("true"))
      .add(booleanKey("soot.oxidation", "By O2 and OH.").byDefault("true"))
      .add(booleanKey("soot.coagulation", "Of particles.").byDefault("true"))
      .add(booleanKey("soot.diffusion", "Brownian, of carried soot; ensembles along paths have none.")
               .byDefault("true"));
}

void addSemiEmpirical(DeckSchema& schema) {
  const std::string s = "soot.semi_empirical.";
  schema
      .section("soot.semi_empirical", Presence::optional,
               "Constants of leung and moss_brookes; each absent one is as published with the model.",
               {{"soot.model", {"leung", "moss_brookes", "none"}}})
      .add(quantityKey(s + "inception_factor", units::frequency, "A of A exp(-Ta/T) [C2H2].").optional().atLeast(0))
      .add(quantityKey(s + "inception_temperature", units::temperature, "Ta.").optional().atLeast(0))
      .add(numberKey(s + "nucleus_carbon", "Carbon atoms in a nucleus.").optional().above(0))
      .add(numberKey(s + "growth_factor", "A of A exp(-Ta/T) [C2H2] S, in m/s, or of the root of S, in m^0.5/s.")
               .optional()
               .atLeast(0))
      .add(quantityKey(s + "growth_temperature", units::temperature, "Ta.").optional().atLeast(0))
      .add(choiceKey(s + "growth_surface", {"linear", "root"}, "Growth by the surface or by its root.").optional())
      .add(numberKey(s + "coagulation_factor", "Enhancement of free-molecular coagulation.").optional().atLeast(0))
      .add(choiceKey(s + "oxygen", {"none", "leung", "lee", "nagle"},
                     "Oxidation by O2: Leung et al. 1991; Lee, Thring, Beer 1962; Nagle, Strickland-Constable 1962.")
               .optional())
      .add(numberKey(s + "oxidation_factor", "On all oxidation; 1 as published.").optional().atLeast(0));
}

void addSectional(DeckSchema& schema) {
  const std::string s = "soot.sectional.";
  schema
      .section("soot.sectional", Presence::defaulted, "Of the model sectional.",
               {{"soot.model", {"sectional", "none"}}})
      .add(integerKey(s + "sections", "Number of sections.").byDefault("35").atLeast(2).atMost(400))
      .add(numberKey(s + "factor", "Mass of a section over that of the one below.").byDefault("2").above(1))
      .add(numberKey(s + "overflow",
                     "Largest volume fraction of soot in the last section, which cannot grow, over the largest of all: "
                     "more is a failure; 1: it is only counted (soot_in_last_section).")
               .byDefault("1e-4")
               .above(0)
               .atMost(1))
      .add(numberKey(s + "nucleus_carbon",
                     "Carbon atoms of the first section; absent: of the smallest nucleus the PAH can make.")
               .optional()
               .above(0))
      .add(choiceKey(s + "nucleation", {"pah", "dimer"},
                     "Of two PAH (Wang 2025, eq. 9-23) or of two dimers (Wang 2025, section 7.2.2).")
               .byDefault("pah"))
      .add(numberKey(s + "nucleation_factor", "Of nucleation by PAH (Wang 2025, eq. 9-23).")
               .byDefault("0.002")
               .atLeast(0))
      .add(numberKey(s + "condensation_efficiency", "Of collisions of PAH with aggregates.")
               .byDefault("0.5")
               .atLeast(0)
               .atMost(1))
      .add(choiceKey(s + "aggregation", {"aggregates", "spheres"},
                     "Point contact of primaries, or coalescence on contact.")
               .byDefault("aggregates"))
      .add(quantityKey(s + "coalescence_diameter", units::length,
                       "Smaller particles melt into their partner; absent: none do.")
               .optional()
               .above(0))
      .add(choiceKey(s + "active_sites", {"aggregate", "primary"},
                     "Whose carbon atoms decide about the fraction of active sites.")
               .byDefault("aggregate"))
      .add(choiceKey(
               s + "growth_scheme", {"upwind", "limited"},
               "How growth and oxidation move soot between sections: Wang 2025, eqs. 9-41 to 9-44, or second order.")
               .byDefault("upwind"))
      .add(choiceKey(s + "kernel", {"transition", "free_molecular"}, "Of coagulation.").byDefault("transition"))
      .add(booleanKey(s + "fragmentation", "Break-up of aggregates by oxidation.").byDefault("false"))
      .add(numberKey(s + "fragmentation_factor", "Rate of break-up over that of oxidation per area, m^2/kg.")
               .byDefault("1e5")
               .atLeast(0))
      .add(booleanKey(s + "carbonisation", "Soot keeps the hydrogen of PAH and loses it slowly.").byDefault("false"))
      .add(quantityKey(s + "carbonisation_rate", units::frequency, "A of A exp(-E/RT) (Dobbins 2002).")
               .byDefault("1.78e6 1/s")
               .atLeast(0))
      .add(quantityKey(s + "carbonisation_energy", units::molarEnergy, "E.").byDefault("1.13e5 J/mol").atLeast(0));
}

void addMoments(DeckSchema& schema) {
  schema.section("soot.hmom", Presence::defaulted, "Of the model hmom.", {{"soot.model", {"hmom", "none"}}})
      .add(numberKey("soot.hmom.fractal_dimension", "Of collision diameters of aggregates.")
               .byDefault("1.8")
               .above(1)
               .atMost(3))
      .add(numberKey("soot.hmom.surface_exponent", "Growth of an aggregate's surface falls with n_p to minus this.")
               .byDefault("0.2043")
               .atLeast(0))
      .add(integerKey("soot.moments", "Number of moments of model momic. With 5 and 6 steady flames may not converge.")
               .byDefault("4")
               .atLeast(3)
               .atMost(6)
               .onlyWith("soot.model", {"momic", "none"}));
}

}  // namespace

void addSootModelKeys(DeckSchema& schema) {
  addShared(schema);
  addSemiEmpirical(schema);
  addSectional(schema);
  addMoments(schema);
}

}  // namespace lampblack
