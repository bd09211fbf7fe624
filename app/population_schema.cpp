#include "app/population_case.hpp"

namespace lampblack {
namespace {

// A size of a particle, as a volume or as the diameter of the sphere that has it.
void addSize(DeckSchema& schema, const std::string& section, const std::string& what) {
  schema.add(quantityKey(section + ".volume", units::volume, "Volume " + what + ", or diameter.").optional().above(0))
      .add(quantityKey(section + ".diameter", units::length, "Instead: diameter of the sphere of that volume.")
               .optional()
               .above(0));
}

// The rate rate (v / reference_volume)^exponent of a process of single particles.
void addSizeDependentRate(DeckSchema& schema, const std::string& section, const std::string& what) {
  schema.add(quantityKey(section + ".rate", units::frequency, what + " of a particle of reference_volume.").atLeast(0))
      .add(numberKey(section + ".exponent", "The rate goes with this power of the volume.").byDefault("0"))
      .add(quantityKey(section + ".reference_volume", units::volume,
                       "The volume that has the rate, if it depends on it.")
               .byDefault("1 m^3")
               .above(0));
}

void addParticles(DeckSchema& schema) {
  schema
      .add(choiceKey(
               "particles.type", {"volume", "fractal", "surface_volume", "components"},
               "volume: coalescing spheres; fractal: aggregates of equal primary particles; surface_volume: volume "
               "and surface; components: spheres of several components by mass.")
               .byDefault("volume"))
      .add(quantityKey("particles.density", units::density, "Of the material; components have their own.")
               .byDefault("1800 kg/m^3")
               .above(0))
      .add(numberKey("particles.fractal_dimension", "fractal, surface_volume: of aggregates; 1.8 if not given.")
               .optional()
               .atLeast(1)
               .atMost(3))
      .add(quantityKey("particles.primary_diameter", units::length, "fractal: of the primary particles.")
               .optional()
               .above(0))
      .add(quantityKey("particles.sintering_time", units::time,
                       "surface_volume: the surface approaches that of a sphere with this time; never if not given.")
               .optional()
               .above(0))
      .section("particles.components", Presence::optional, "components: named, four at most.")
      .add(quantityKey("particles.components.*.density", units::density, "Of the component.").above(0))
      .add(numberKey("particles.components.*.nucleus", "Mass fraction in nuclei and in the initial particles.")
               .byDefault("0")
               .atLeast(0))
      .add(numberKey("particles.components.*.condensing", "Mass fraction in what condenses or grows on the surface.")
               .byDefault("0")
               .atLeast(0));
  schema
      .add(choiceKey("initial.distribution", {"none", "monodisperse", "exponential", "lognormal"},
                     "Of the volumes at time zero; lognormal: of the diameters.")
               .byDefault("none"))
      .add(quantityKey("initial.number", units::perVolume, "Number density.").optional().above(0));
  addSize(schema, "initial", "of all (monodisperse), mean (exponential) or median by number (lognormal)");
  schema.add(numberKey("initial.geometric_deviation", "lognormal: geometric standard deviation of the diameter.")
                 .optional()
                 .above(1));
}

void addCoagulation(DeckSchema& schema) {
  const std::string at = "processes.coagulation";
  schema.section(at, Presence::optional, "Pairs of particles collide and become one.")
      .add(choiceKey(at + ".kernel",
                     {"constant", "additive", "multiplicative", "free_molecular", "continuum", "transition",
                      "transition_fuchs", "shear", "gravitational"},
                     "constant: A, additive: A (u + v), multiplicative: A u v, with the volumes u and v; transition: "
                     "harmonic mean of free-molecular and continuum; transition_fuchs: interpolation of Fuchs."))
      .add(stringKey(at + ".rate",
                     "A of the first three kernels, with its unit: m^3/s (constant), 1/s (additive), 1/(m^3 s) "
                     "(multiplicative).")
               .optional())
      .add(numberKey(at + ".efficiency", "Probability that a collision sticks.").byDefault("1").above(0).atMost(1))
      .add(quantityKey(at + ".efficiency_diameter", units::length,
                       "Below about this diameter of the smaller particle collisions stick less: the efficiency is "
                       "multiplied by 1 / (1 + (efficiency_diameter / d)^efficiency_exponent).")
               .optional()
               .above(0))
      .add(numberKey(at + ".efficiency_exponent", "See efficiency_diameter.").optional().above(0))
      .add(numberKey(at + ".enhancement", "Of free-molecular collisions by van der Waals forces.").optional().above(0))
      .add(quantityKey(at + ".shear_rate", units::frequency, "shear: velocity gradient of the gas.")
               .optional()
               .above(0));
}

void addNucleation(DeckSchema& schema) {
  const std::string at = "processes.nucleation";
  schema.section(at, Presence::optional, "New particles of one volume.")
      .add(
          choiceKey(at + ".source", {"constant", "precursor", "table"},
                    "constant: `rate`; precursor: rate_constant precursor exp(-rate_constant t); table: straight lines "
                    "between `rates` at `times`, zero outside.")
              .byDefault("constant"))
      .add(quantityKey(at + ".rate", units::ratePerVolume, "constant: nuclei per volume and time.").optional().above(0))
      .add(quantityKey(at + ".rate_constant", units::frequency, "precursor: of its first-order reaction.")
               .optional()
               .above(0))
      .add(quantityKey(at + ".precursor", units::perVolume, "precursor: number density at time zero.")
               .optional()
               .above(0))
      .add(quantityKey(at + ".times", units::time, "table: times, rising.").list().optional())
      .add(quantityKey(at + ".rates", units::ratePerVolume, "table: rates at the times.").list().optional().atLeast(0));
  addSize(schema, at, "of a nucleus");
}

void addSingleProcesses(DeckSchema& schema) {
  schema.section("processes.breakage", Presence::optional, "Particles break into pieces.");
  addSizeDependentRate(schema, "processes.breakage", "Rate");
  schema.add(integerKey("processes.breakage.fragments", "Number of pieces.").byDefault("2").atLeast(2).atMost(1000))
      .add(choiceKey("processes.breakage.daughters", {"equal", "uniform"},
                     "equal: all pieces alike; uniform (two pieces): every split equally probable.")
               .byDefault("equal"));
  schema.section("processes.condensation", Presence::optional, "dv/dt = rate v; evaporation where it is negative.")
      .add(quantityKey("processes.condensation.rate", units::frequency, "Rate."))
      .section("processes.surface_growth", Presence::optional, "dv/dt = rate S, with the surface S of the particle.")
      .add(quantityKey("processes.surface_growth.rate", units::velocity, "Growth normal to the surface.").above(0))
      .section("processes.oxidation", Presence::optional, "dv/dt = -rate S.")
      .add(quantityKey("processes.oxidation.rate", units::velocity, "Recession normal to the surface.").above(0))
      .section("processes.growth", Presence::optional, "How condensation, surface growth and oxidation are computed.")
      .add(
          choiceKey("processes.growth.treatment", {"split", "deferred", "jumps"},
                    "Monte Carlo. split: all particles together, in steps between the jumps; deferred: each when it is "
                    "looked at, at the latest at the end of a step; jumps: one monomer at a time, as jumps.")
              .byDefault("split"))
      .add(quantityKey("processes.growth.step", units::time,
                       "split, deferred: length of a step; chosen from the rates if not given.")
               .optional()
               .above(0))
      .add(quantityKey("processes.growth.monomer", units::volume, "jumps: volume of a monomer.").optional().above(0))
      .add(quantityKey("processes.growth.smallest_volume", units::volume, "Particles that shrink below it vanish.")
               .optional()
               .above(0))
      .section("processes.deposition", Presence::optional, "Particles are lost.");
  addSizeDependentRate(schema, "processes.deposition", "Rate");
  schema
      .section("processes.dilution", Presence::optional,
               "All number densities fall at this rate, as where the gas expands; negative: compression.")
      .add(quantityKey("processes.dilution.rate", units::frequency, "Rate."));
}

void addGas(DeckSchema& schema) {
  schema.section("gas", Presence::optional, "The gas around the particles, for the physical kernels.")
      .add(quantityKey("gas.temperature", units::temperature, "Temperature.").optional().above(0))
      .add(quantityKey("gas.pressure", units::pressure, "Pressure.").optional().above(0))
      .add(quantityKey("gas.viscosity", units::viscosity, "Dynamic viscosity.").optional().above(0))
      .add(quantityKey("gas.mean_molecular_weight", units::molarMass, "Mean molar mass.").optional().above(0))
      .add(quantityKey("gas.density", units::density, "Density; gravitational kernel only.").optional().atLeast(0));
}

void addMethods(DeckSchema& schema) {
  const std::string at = "methods.*";
  schema.section("methods", Presence::required, "Named methods: all are run and compared.")
      .add(choiceKey(at + ".type",
                     {"dsmc", "constant_volume", "constant_number_mass", "constant_number_number", "mmc", "wfmc",
                      "samwfmc", "sammc", "swa", "hybrid", "sectional", "qmom", "momic"},
                     "Equal weights: dsmc, constant_volume (stepwise), constant_number_mass, constant_number_number; "
                     "different weights: mmc, wfmc, samwfmc, sammc, swa; hybrid: small particles as numbers; sections "
                     "and moments: sectional, qmom, momic."))
      .add(choiceKey(at + ".claims", {"M0", "M1", "M2", "M3"},
                     "Moments in which the method has to show no bias; [] where it is known to have one.")
               .list()
               .byDefault("[M0, M1, M2, M3]"))
      .add(choiceKey(at + ".mass", {"conserved", "mean"},
                     "What is asked of M1 where the processes conserve it: the same in every repeat to 1e-11, or only "
                     "in the mean. If not given: mean for constant_number_number, for swa but with the weight transfer "
                     "mass, and for dsmc, constant_volume, hybrid and mmc where particles break.")
               .optional())
      .add(integerKey(at + ".particles", "Monte Carlo: numerical particles; 2000 if not given.")
               .optional()
               .atLeast(2)
               .atMost(1e9))
      .add(choiceKey(at + ".rates", {"majorant", "exact"},
                     "Monte Carlo: rates bounded by majorants, with fictitious jumps; or every rate summed, O(N).")
               .optional())
      .add(choiceKey(at + ".fraction", {"one", "hyperbolic", "exponential", "stepwise", "constant"},
                     "wfmc, samwfmc, sammc: fraction function of coagulation.")
               .optional())
      .add(choiceKey(at + ".fraction_of", {"volumes", "weights"}, "What the fraction function compares.").optional())
      .add(numberKey(at + ".fraction_constant", "constant: the fraction.").optional().above(0).atMost(1))
      .add(choiceKey(at + ".merging", {"absolute", "relative"},
                     "sammc, swa: which difference of the volumes of neighbours is to be smallest.")
               .optional())
      .add(
          choiceKey(at + ".weight_transfer", {"mass", "half", "harmonic"}, "swa: weight transfer function.").optional())
      .add(choiceKey(at + ".nucleation", {"even", "random"},
                     "Monte Carlo: nuclei evenly spaced in the integral of their rate (hardly any noise) or at random.")
               .optional())
      .add(quantityKey(at + ".nucleus_weight", units::perVolume,
                       "Different weights: number density a nucleus stands for.")
               .optional()
               .above(0))
      .add(quantityKey(at + ".expected_number", units::perVolume,
                       "Monte Carlo that starts without particles: number density at which the sample is full.")
               .optional()
               .above(0))
      .add(integerKey(at + ".threshold", "hybrid: largest size, in nuclei, kept as a number.").optional().atLeast(1))
      .add(integerKey(at + ".sections", "sectional: number of sections.").optional().atLeast(20).atMost(400))
      .add(quantityKey(at + ".smallest", units::volume, "sectional: volume of the first pivot.").optional().above(0))
      .add(quantityKey(at + ".largest", units::volume, "sectional: volume of the last pivot.").optional().above(0))
      .add(numberKey(at + ".spacing", "sectional: ratio of the volumes of neighbouring pivots.").optional().above(1))
      .add(
          choiceKey(at + ".growth_scheme", {"limited", "upwind"},
                    "sectional: flux of growing particles; limited (if not given) is of second order, upwind of first.")
              .optional())
      .add(numberKey(at + ".overflow",
                     "sectional: part of the volume that may pass the last pivot before that is an error; 1e-6 if not "
                     "given.")
               .optional()
               .above(0)
               .atMost(1))
      .add(integerKey(at + ".moments", "qmom (even), momic: number of moments.").optional().atLeast(2).atMost(20))
      .add(choiceKey(at + ".inversion", {"wheeler", "product_difference"}, "qmom: moments to quadrature.").optional())
      .add(numberKey(at + ".relative_tolerance", "sectional, qmom, momic: of the integrator.")
               .optional()
               .above(0)
               .below(1))
      .add(numberKey(at + ".absolute_tolerance", "sectional: in the largest number density.").optional().above(0));
}

void addOutput(DeckSchema& schema) {
  schema.add(quantityKey("time.end", units::time, "Simulated time.").above(0))
      .add(integerKey("time.outputs", "Rows of the histories after that at time zero.")
               .byDefault("100")
               .atLeast(1)
               .atMost(100000))
      .add(choiceKey("time.spacing", {"linear", "logarithmic"}, "Of the rows.").byDefault("linear"))
      .add(quantityKey("time.first", units::time, "logarithmic: the first row after that at time zero.")
               .optional()
               .above(0))
      .add(integerKey("repeats", "Of each Monte Carlo method, with random numbers of their own.")
               .byDefault("20")
               .atLeast(1)
               .atMost(1e8))
      .add(integerKey("seed", "Of the random numbers.").byDefault("1").atLeast(0));
  schema.section("distribution", Presence::optional, "Number densities in bins of volume.")
      .add(quantityKey("distribution.minimum", units::volume, "Lower edge of the first bin.").atLeast(0))
      .add(quantityKey("distribution.maximum", units::volume, "Upper edge of the last bin.").above(0))
      .add(integerKey("distribution.bins", "Number of bins.").byDefault("50").atLeast(1).atMost(100000))
      .add(choiceKey("distribution.spacing", {"logarithmic", "linear"}, "Of the edges.").byDefault("logarithmic"))
      .add(quantityKey("distribution.times", units::time, "When; time.end if not given.").list().optional().atLeast(0));
}

}  // namespace

DeckSchema populationSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"population_balance"}, "What is solved."))
      .add(stringKey("name", "Of the case, for tables and pictures.").byDefault("''"))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addParticles(schema);
  addCoagulation(schema);
  addNucleation(schema);
  addSingleProcesses(schema);
  addGas(schema);
  addMethods(schema);
  addOutput(schema);
  return schema;
}

}  // namespace lampblack
