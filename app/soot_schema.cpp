#include "app/soot_deck.hpp"
#include "particles/soot/make_soot_model.hpp"

namespace lampblack {
namespace {

void addShared(DeckSchema& schema) {
  std::vector<std::string> models = sootModelNames();
  models.emplace_back("none");
  schema.section("soot", Presence::optional, "Soot, carried by the gas; absent: none.")
      .add(
          choiceKey("soot.model", models,
                    "Model of the soot that the gas carries. two_equation_dimer: number and mass, nuclei of PAH dimers "
                    "(Wang 2025, section 7.2.2); leung (Leung, Lindstedt, Jones 1991) and moss_brookes (Brookes and "
                    "Moss 1999): number and mass, nuclei of acetylene; sectional: size distribution in sections (Wang "
                    "2025, section 9.2.2); hmom: hybrid method of moments (Mueller, Blanquart, Pitsch 2009); momic: "
                    "moments with interpolative closure (Frenklach 2002); none: as if the section were absent.")
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
}

void addSemiEmpirical(DeckSchema& schema) {
  const std::string s = "soot.semi_empirical.";
  schema
      .section("soot.semi_empirical", Presence::optional,
               "Constants of leung and moss_brookes; each absent one is as published with the model.",
               {{"soot.model", {"leung", "moss_brookes", "none"}}})
      .add(quantityKey(s + "inception_factor", units::frequency,
                       "Factor A of the rate of inception, A exp(-Ta/T) [C2H2], acetylene per volume and time: bigger "
                       "makes more nuclei.")
               .optional()
               .atLeast(0))
      .add(quantityKey(s + "inception_temperature", units::temperature,
                       "Activation temperature Ta of the rate of inception, A exp(-Ta/T) [C2H2].")
               .optional()
               .atLeast(0))
      .add(numberKey(s + "nucleus_carbon",
                     "Number of carbon atoms of a new particle (nucleus): bigger makes fewer of the same mass.")
               .optional()
               .above(0))
      .add(numberKey(s + "growth_factor",
                     "Factor A of the rate of surface growth, A exp(-Ta/T) [C2H2] f, with f = S, the surface of soot "
                     "per volume (A in m/s), or f = sqrt(S) (A in m^0.5/s).")
               .optional()
               .atLeast(0))
      .add(quantityKey(s + "growth_temperature", units::temperature,
                       "Activation temperature Ta of the rate of surface growth, A exp(-Ta/T) [C2H2] f.")
               .optional()
               .atLeast(0))
      .add(choiceKey(s + "growth_surface", {"linear", "root"},
                     "How surface growth depends on the surface of soot per volume S: linear: f = S; root: f = "
                     "sqrt(S), with which growth does not double where the surface doubles.")
               .optional())
      .add(numberKey(s + "coagulation_factor",
                     "Factor on the rate of free-molecular coagulation of equal spheres: bigger makes fewer and larger "
                     "particles.")
               .optional()
               .atLeast(0))
      .add(choiceKey(s + "oxygen", {"none", "leung", "lee", "nagle"},
                     "Law of oxidation by O2: leung: Leung, Lindstedt, Jones (1991); lee: Lee, Thring, Beer (1962); "
                     "nagle: Nagle, Strickland-Constable (1962); none: O2 does not oxidise.")
               .optional())
      .add(numberKey(s + "oxidation_factor", "Factor on the rates of all oxidation of soot; 1 is the published rate.")
               .optional()
               .atLeast(0));
}

void addSectional(DeckSchema& schema) {
  const std::string s = "soot.sectional.";
  schema
      .section("soot.sectional", Presence::defaulted, "Constants of the model sectional.",
               {{"soot.model", {"sectional", "none"}}})
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
                     "more is a failure; 1: it is only counted (soot_in_last_section).")
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
      .add(booleanKey(s + "fragmentation", "Whether oxidation breaks aggregates into halves.").byDefault("false"))
      .add(numberKey(s + "fragmentation_factor",
                     "Factor A of the rate of break-up, A w n_p^(1/1.8), with w the carbon oxidised per area and time "
                     "and n_p the primary particles; in m^2/kg.")
               .byDefault("1e5")
               .atLeast(0))
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

void addMoments(DeckSchema& schema) {
  schema.section("soot.hmom", Presence::defaulted, "Constants of the model hmom.", {{"soot.model", {"hmom", "none"}}})
      .add(numberKey(
               "soot.hmom.fractal_dimension",
               "Fractal dimension D_f in the collision diameter of aggregates, d_p n_p^(1/D_f): smaller is more open.")
               .byDefault("1.8")
               .above(1)
               .atMost(3))
      .add(numberKey("soot.hmom.surface_exponent",
                     "Exponent e in the growth of an aggregate's surface with its volume, dS/dV = 2/3 S/V n_p^(-e), "
                     "n_p the number of primary particles.")
               .byDefault("0.2043")
               .atLeast(0))
      .add(integerKey("soot.moments",
                      "Number of moments that the model momic carries. With 5 and 6 steady flames may not converge.")
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
