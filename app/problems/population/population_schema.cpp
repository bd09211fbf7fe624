#include "app/deck/initial_distribution.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/population/population_case.hpp"

namespace lampblack::app {
namespace {

// Who has which keys.
const std::vector<std::string> jumping{
    "dsmc", "constant_volume", "constant_number_mass", "constant_number_number", "mmc", "wfmc", "samwfmc", "sammc",
    "swa",  "hybrid"};
const std::vector<std::string> monteCarlo = [] {
  std::vector<std::string> all = jumping;
  all.emplace_back("pairs");
  return all;
}();
const std::vector<std::string> weighted{"mmc", "wfmc", "samwfmc", "sammc", "swa", "pairs"};
const std::vector<std::string> fractions{"wfmc", "samwfmc", "sammc"};

// The rate rate (v / reference_volume)^exponent of a process of single particles.
void addSizeDependentRate(DeckSchema& schema, const std::string& section, const std::string& what) {
  schema.add(quantityKey(section + ".rate", units::frequency, what + " of a particle of reference_volume.").atLeast(0))
      .add(numberKey(section + ".exponent", "Exponent e of the volume v in the rate, rate (v / reference_volume)^e.")
               .byDefault("0"))
      .add(quantityKey(section + ".reference_volume", units::volume,
                       "Volume of a particle that has just the rate; of no effect where the exponent is 0.")
               .byDefault("1 m^3")
               .above(0));
}

void addParticleTypes(DeckSchema& schema) {
  schema
      .add(choiceKey(
               "particles.type", {"volume", "fractal", "surface_volume", "components"},
               "volume: coalescing spheres; fractal: aggregates of equal primary particles; surface_volume: volume "
               "and surface; components: spheres of several components by mass.")
               .byDefault("volume"))
      .add(quantityKey("particles.density", units::density,
                       "Density of the material of the particles; components have their own.")
               .byDefault("1800 kg/m^3")
               .above(0)
               .onlyWith("particles.type", {"volume", "fractal", "surface_volume"}))
      .add(numberKey("particles.fractal_dimension",
                     "Fractal dimension of aggregates; 1.8 if not given. Smaller is more open.")
               .optional()
               .atLeast(1)
               .atMost(3)
               .onlyWith("particles.type", {"fractal", "surface_volume"}))
      .add(quantityKey("particles.primary_diameter", units::length, "Diameter of the primary particles.")
               .optional()
               .above(0)
               .onlyWith("particles.type", {"fractal"}))
      .add(quantityKey("particles.sintering_time", units::time,
                       "The surface approaches that of a sphere with this time; never if not given.")
               .optional()
               .above(0)
               .onlyWith("particles.type", {"surface_volume"}))
      .section("particles.components", Presence::optional,
               "Components of the particles, each with a name; four at most.", {{"particles.type", {"components"}}})
      .add(quantityKey("particles.components.*.density", units::density, "Density of the component.").above(0))
      .add(numberKey("particles.components.*.nucleus",
                     "Mass fraction of the component in nuclei and in the initial particles.")
               .byDefault("0")
               .atLeast(0))
      .add(numberKey("particles.components.*.condensing",
                     "Mass fraction of the component in what condenses or grows on the surface.")
               .byDefault("0")
               .atLeast(0));
  addInitialDistribution(schema, "initial");
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
               .optional()
               .onlyWith(at + ".kernel", {"constant", "additive", "multiplicative"}))
      .add(numberKey(at + ".efficiency", "Probability that a collision sticks.").byDefault("1").above(0).atMost(1))
      .add(quantityKey(at + ".efficiency_diameter", units::length,
                       "Below about this diameter of the smaller particle collisions stick less: the efficiency is "
                       "multiplied by 1 / (1 + (efficiency_diameter / d)^efficiency_exponent).")
               .optional()
               .above(0))
      .add(numberKey(at + ".efficiency_exponent",
                     "Exponent in the efficiency of collisions of small particles, 1 / (1 + (efficiency_diameter / "
                     "d)^efficiency_exponent): bigger makes a sharper limit.")
               .optional()
               .above(0))
      .add(numberKey(at + ".enhancement", "Factor by which van der Waals forces enhance free-molecular collisions.")
               .optional()
               .above(0)
               .onlyWith(at + ".kernel", {"free_molecular", "transition", "transition_fuchs"}))
      .add(quantityKey(at + ".shear_rate", units::frequency, "Velocity gradient of the gas.")
               .optional()
               .above(0)
               .onlyWith(at + ".kernel", {"shear"}));
}

void addNucleation(DeckSchema& schema) {
  const std::string at = "processes.nucleation";
  schema.section(at, Presence::optional, "New particles of one volume.")
      .add(
          choiceKey(at + ".source", {"constant", "precursor", "table"},
                    "constant: `rate`; precursor: rate_constant precursor exp(-rate_constant t); table: straight lines "
                    "between `rates` at `times`, zero outside.")
              .byDefault("constant"))
      .add(quantityKey(at + ".rate", units::ratePerVolume, "Nuclei per volume and time.")
               .optional()
               .above(0)
               .onlyWith(at + ".source", {"constant"}))
      .add(quantityKey(at + ".rate_constant", units::frequency,
                       "Rate constant of the first-order reaction of the precursor to nuclei.")
               .optional()
               .above(0)
               .onlyWith(at + ".source", {"precursor"}))
      .add(quantityKey(at + ".precursor", units::perVolume, "Number density of the precursor at time zero.")
               .optional()
               .above(0)
               .onlyWith(at + ".source", {"precursor"}))
      .add(quantityKey(at + ".times", units::time, "Times of the points of the table, rising.")
               .list()
               .optional()
               .onlyWith(at + ".source", {"table"}))
      .add(quantityKey(at + ".rates", units::ratePerVolume, "Nuclei per volume and time at the times of the table.")
               .list()
               .optional()
               .atLeast(0)
               .onlyWith(at + ".source", {"table"}));
  addParticleSize(schema, at, "of a nucleus");
}

void addSingleProcesses(DeckSchema& schema) {
  schema.section("processes.breakage", Presence::optional, "Particles break into pieces.");
  addSizeDependentRate(schema, "processes.breakage", "Rate of breakage");
  schema
      .add(integerKey("processes.breakage.fragments", "Number of pieces that a particle breaks into.")
               .byDefault("2")
               .atLeast(2)
               .atMost(1000))
      .add(choiceKey("processes.breakage.daughters", {"equal", "uniform"},
                     "equal: all pieces alike; uniform (two pieces): every split equally probable.")
               .byDefault("equal"));
  schema.section("processes.condensation", Presence::optional, "dv/dt = rate v; evaporation where it is negative.")
      .add(quantityKey("processes.condensation.rate", units::frequency,
                       "Relative rate at which every volume grows, the rate in dv/dt = rate v; negative: evaporation."))
      .section("processes.surface_growth", Presence::optional, "dv/dt = rate S, with the surface S of the particle.")
      .add(quantityKey("processes.surface_growth.rate", units::velocity,
                       "Speed at which the surface of particles grows outwards, the rate in dv/dt = rate S.")
               .above(0))
      .section("processes.oxidation", Presence::optional, "dv/dt = -rate S.")
      .add(quantityKey("processes.oxidation.rate", units::velocity,
                       "Speed at which the surface of particles recedes, the rate in dv/dt = -rate S.")
               .above(0))
      .section("processes.growth", Presence::optional, "How condensation, surface growth and oxidation are computed.")
      .add(
          choiceKey("processes.growth.treatment", {"split", "deferred", "jumps"},
                    "Monte Carlo. split: all particles together, in steps between the jumps; deferred: each when it is "
                    "looked at, at the latest at the end of a step; jumps: one monomer at a time, as jumps.")
              .byDefault("split"))
      .add(quantityKey("processes.growth.step", units::time, "Length of a step; chosen from the rates if not given.")
               .optional()
               .above(0)
               .onlyWith("processes.growth.treatment", {"split", "deferred"}))
      .add(quantityKey("processes.growth.monomer", units::volume, "Volume of a monomer.")
               .optional()
               .above(0)
               .onlyWith("processes.growth.treatment", {"jumps"}))
      .add(quantityKey("processes.growth.smallest_volume", units::volume,
                       "Volume below which particles that shrink vanish.")
               .optional()
               .above(0))
      .section("processes.deposition", Presence::optional, "Particles are lost.");
  addSizeDependentRate(schema, "processes.deposition", "Rate of loss");
  schema
      .section("processes.dilution", Presence::optional,
               "All number densities fall at this rate, as where the gas expands; negative: compression.")
      .add(quantityKey("processes.dilution.rate", units::frequency,
                       "Relative rate at which all number densities fall as the gas expands, dn/dt = -rate n; "
                       "negative: compression."));
}

void addGas(DeckSchema& schema) {
  const std::string kernel = "processes.coagulation.kernel";
  const std::vector<std::string> slip{"continuum", "transition", "transition_fuchs", "gravitational"};
  schema.section("gas", Presence::optional, "The gas around the particles, for the physical kernels.")
      .add(temperatureKey("gas.temperature", "Temperature of the gas.")
               .optional()
               .onlyWith(kernel, {"free_molecular", "continuum", "transition", "transition_fuchs", "gravitational"}))
      .add(quantityKey("gas.pressure", units::pressure, "Pressure of the gas.")
               .optional()
               .above(0)
               .onlyWith(kernel, slip))
      .add(quantityKey("gas.viscosity", units::viscosity, "Dynamic viscosity of the gas.")
               .optional()
               .above(0)
               .onlyWith(kernel, slip))
      .add(quantityKey("gas.mean_molecular_weight", units::molarMass, "Mean molar mass of the gas.")
               .optional()
               .above(0)
               .onlyWith(kernel, slip))
      .add(quantityKey("gas.density", units::density,
                       "Density of the gas, which the particles float in; 0 if not given.")
               .optional()
               .atLeast(0)
               .onlyWith(kernel, {"gravitational"}));
}

void addMethods(DeckSchema& schema) {
  const std::string at = "methods.*";
  schema.section("methods", Presence::required, "Named methods: all are run and compared.")
      .add(choiceKey(at + ".type",
                     {"dsmc", "constant_volume", "constant_number_mass", "constant_number_number", "mmc", "wfmc",
                      "samwfmc", "sammc", "swa", "pairs", "hybrid", "sectional", "qmom", "momic"},
                     "Equal weights: dsmc, constant_volume (stepwise), constant_number_mass, constant_number_number; "
                     "different weights: mmc, wfmc, samwfmc, sammc, swa; pairs: different weights, pairs drawn in time "
                     "steps; hybrid: small particles as numbers; sections "
                     "and moments: sectional, qmom, momic."))
      .add(choiceKey(at + ".unbiased_moments", {"M0", "M1", "M2", "M3"},
                     "Moments in which the method has to show no bias; [] where it is known to have one.")
               .formerly("claims")
               .list()
               .byDefault("[M0, M1, M2, M3]"))
      .add(choiceKey(at + ".mass", {"conserved", "mean"},
                     "What is asked of M1 where the processes conserve it: the same in every repeat to 1e-11, or only "
                     "in the mean. If not given: mean for constant_number_number, for swa but with the weight transfer "
                     "mass, and for dsmc, constant_volume, hybrid and mmc where particles break.")
               .optional())
      .add(integerKey(at + ".particles", "Numerical particles; 2000 if not given.")
               .optional()
               .atLeast(2)
               .atMost(1e9)
               .onlyWith(at + ".type", monteCarlo))
      .add(choiceKey(at + ".rates", {"majorant", "exact"},
                     "How events are drawn: majorant: from upper bounds of the rates, with fictitious jumps, fast; "
                     "exact: from the sums of all rates, at a cost that goes with the number of particles.")
               .optional()
               .onlyWith(at + ".type", jumping))
      .add(choiceKey(at + ".fraction", {"one", "hyperbolic", "exponential", "stepwise", "constant"},
                     "Fraction function of coagulation alpha: the part of the smaller weight that coagulates in an "
                     "event (Wang 2025, eqs. 4-11 to 4-14).")
               .optional()
               .onlyWith(at + ".type", fractions))
      .add(choiceKey(at + ".fraction_of", {"volumes", "weights"},
                     "What of the two particles the fraction function compares: volumes or weights.")
               .optional()
               .onlyWith(at + ".fraction", {"hyperbolic", "exponential", "stepwise"}))
      .add(numberKey(at + ".fraction_constant", "The constant value of the fraction function alpha.")
               .optional()
               .above(0)
               .atMost(1)
               .onlyWith(at + ".fraction", {"constant"}))
      .add(choiceKey(at + ".merging", {"absolute", "relative"},
                     "Which difference of the volumes of neighbours is to be smallest.")
               .optional()
               .onlyWith(at + ".type", {"sammc", "swa"}))
      .add(choiceKey(at + ".weight_transfer", {"mass", "half", "harmonic"},
                     "Weight transfer function gamma of the stochastic weighted algorithm: the weight of the particle "
                     "that two make (Patterson, Wagner, Kraft 2011).")
               .optional()
               .onlyWith(at + ".type", {"swa"}))
      .add(choiceKey(at + ".nucleation", {"even", "random"},
                     "Nuclei evenly spaced in the integral of their rate (hardly any noise) or at random.")
               .optional()
               .onlyWith(at + ".type", jumping))
      .add(choiceKey(at + ".initial_weights", {"moments", "equal"},
                     "What the particles of the initial distribution stand for: moments (if not given): the large ones "
                     "for fewer real ones, so that none holds more than 4/particles of any of M0 to M3; equal: all for "
                     "as many.")
               .optional()
               .onlyWith(at + ".type", weighted))
      .add(
          quantityKey(at + ".nucleus_weight", units::perVolume,
                      "Number density of real particles that a new numerical particle (nucleus) stands for: smaller "
                      "is more accurate and slower. pairs: most that a nucleus stands for, three times the mean if not "
                      "given.")
              .optional()
              .above(0)
              .onlyWith(at + ".type", weighted))
      .add(quantityKey(at + ".expected_number", units::perVolume,
                       "Monte Carlo that starts without particles: number density at which the sample is full.")
               .optional()
               .above(0)
               .onlyWith(at + ".type", jumping))
      .add(numberKey(at + ".pair_probability",
                     "Probability that a candidate pair is to happen with at most, 0.2 if not given: higher draws "
                     "fewer pairs, and pairs that would be above 1 collide too seldom (counted as limited).")
               .optional()
               .above(0)
               .atMost(1)
               .onlyWith(at + ".type", {"pairs"}))
      .add(numberKey(at + ".split_change",
                     "Part by which coagulation or another process may change the population in a step where there "
                     "are several, 0.1 if not given: the error of splitting goes with its square.")
               .optional()
               .above(0)
               .atMost(1)
               .onlyWith(at + ".type", {"pairs"}))
      .add(integerKey(at + ".threshold",
                      "Largest size, in nuclei, of particles that are kept as a number of each size; larger ones are "
                      "kept one by one.")
               .optional()
               .atLeast(1)
               .onlyWith(at + ".type", {"hybrid"}))
      .add(integerKey(at + ".sections", "Number of sections of mass: more of them reach larger particles.")
               .optional()
               .atLeast(20)
               .atMost(400)
               .onlyWith(at + ".type", {"sectional"}))
      .add(quantityKey(at + ".smallest", units::volume, "Volume of the first pivot.")
               .optional()
               .above(0)
               .onlyWith(at + ".type", {"sectional"}))
      .add(quantityKey(at + ".largest", units::volume, "Volume of the last pivot.")
               .optional()
               .above(0)
               .onlyWith(at + ".type", {"sectional"}))
      .add(numberKey(at + ".spacing", "Ratio of the volumes of neighbouring pivots.")
               .optional()
               .above(1)
               .onlyWith(at + ".type", {"sectional"}))
      .add(choiceKey(at + ".growth_scheme", {"limited", "upwind"},
                     "Flux of growing particles; limited (if not given) is of second order, upwind of first.")
               .optional()
               .onlyWith(at + ".type", {"sectional"}))
      .add(numberKey(at + ".overflow",
                     "Part of the volume that may pass the last pivot before that is an error; 1e-6 if not "
                     "given.")
               .optional()
               .above(0)
               .atMost(1)
               .onlyWith(at + ".type", {"sectional"}))
      .add(integerKey(at + ".moments", "qmom (even), momic: number of moments.")
               .optional()
               .atLeast(2)
               .atMost(20)
               .onlyWith(at + ".type", {"qmom", "momic"}))
      .add(choiceKey(at + ".inversion", {"wheeler", "product_difference"},
                     "Algorithm that finds nodes and weights of the quadrature from the moments.")
               .optional()
               .onlyWith(at + ".type", {"qmom"}))
      .add(numberKey(at + ".relative_tolerance",
                     "Relative tolerance of the integrator: smaller is more accurate and slower.")
               .optional()
               .above(0)
               .below(1)
               .onlyWith(at + ".type", {"sectional", "qmom", "momic"}))
      .add(numberKey(at + ".absolute_tolerance",
                     "Absolute tolerance of the integrator, as part of the number of particles of a section that would "
                     "hold all "
                     "of any of M0 to M3; 1e-12 if not given.")
               .optional()
               .above(0)
               .below(1)
               .onlyWith(at + ".type", {"sectional"}));
}

void addOutput(DeckSchema& schema) {
  schema.add(quantityKey("time.end", units::time, "Time at which the run ends, from zero.").above(0))
      .add(integerKey("time.outputs", "Rows of the histories after that at time zero.")
               .byDefault("100")
               .atLeast(1)
               .atMost(100000))
      .add(choiceKey("time.spacing", {"linear", "logarithmic"}, "Spacing of the rows in time.").byDefault("linear"))
      .add(quantityKey("time.first", units::time, "Time of the first row after that at time zero.")
               .optional()
               .above(0)
               .onlyWith("time.spacing", {"logarithmic"}))
      .add(integerKey("repeats",
                      "Number of repeats of each Monte Carlo method, with random numbers of their own: more have less "
                      "noise and cost more.")
               .byDefault("20")
               .atLeast(1)
               .atMost(1e8))
      .add(integerKey("seed",
                      "Start of the random numbers: another seed gives another sample, the same seed the same result.")
               .byDefault("1")
               .atLeast(0));
  schema.section("distribution", Presence::optional, "Number densities in bins of volume.")
      .add(quantityKey("distribution.minimum", units::volume, "Volume at the lower edge of the first bin.").atLeast(0))
      .add(quantityKey("distribution.maximum", units::volume, "Volume at the upper edge of the last bin.").above(0))
      .add(integerKey("distribution.bins", "Number of bins of the distribution.")
               .byDefault("50")
               .atLeast(1)
               .atMost(100000))
      .add(choiceKey("distribution.spacing", {"logarithmic", "linear"}, "Spacing of the edges of the bins.")
               .byDefault("logarithmic"))
      .add(quantityKey("distribution.times", units::time,
                       "Times at which the distribution is written; absent: at time.end.")
               .list()
               .optional()
               .atLeast(0));
}

}  // namespace

DeckSchema populationSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"population_balance"}, "What is solved."))
      .add(stringKey("name", "Name of the case, for tables and pictures.").byDefault("''"))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addParticleTypes(schema);
  addCoagulation(schema);
  addNucleation(schema);
  addSingleProcesses(schema);
  addGas(schema);
  addMethods(schema);
  addOutput(schema);
  return schema;
}

}  // namespace lampblack::app
