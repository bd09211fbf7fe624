#include "app/deck/initial_distribution.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/population/population_case_parts.hpp"

namespace lampblack::app {
namespace {

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
  schema.add(populationcase::methodKeys());
  addOutput(schema);
  return schema;
}

}  // namespace lampblack::app
