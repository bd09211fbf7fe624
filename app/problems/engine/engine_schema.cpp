#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/problems/engine/engine_case.hpp"

namespace lampblack::app {
namespace {

void addEngine(DeckSchema& schema) {
  schema.section("engine", Presence::required, "The engine, and the part of a cycle in which its valves are closed.")
      .add(quantityKey("engine.bore", units::length, "Bore of the cylinder.").above(0))
      .add(quantityKey("engine.stroke", units::length, "Stroke of the piston.").above(0))
      .add(quantityKey("engine.rod", units::length, "Length of the connecting rod.").above(0))
      .add(numberKey("engine.compression_ratio", "Largest over smallest volume.").above(1))
      .add(quantityKey("engine.speed", units::angularVelocity, "Speed of the crank, '1000 rpm'.").above(0))
      .add(quantityKey("engine.start", units::angle,
                       "Crank angle from the upper dead centre at which the inlet closes, '-142 deg'."))
      .add(quantityKey("engine.end", units::angle, "Crank angle at which the exhaust opens."));
}

void addCharge(DeckSchema& schema) {
  schema.section("charge", Presence::required, "The gas as the inlet closes.")
      .add(
          quantityKey("charge.temperature", units::temperature, "Temperature of the charge, fresh and burnt gas alike.")
              .above(0))
      .add(quantityKey("charge.pressure", units::pressure, "Pressure of the charge as the inlet closes.").above(0));
  addMixtureKeys(schema, "charge");
  schema
      .add(quantityKey("charge.temperature_deviation", units::temperature,
                       "Standard deviation of the particles' temperatures, normal.")
               .byDefault("0 K")
               .atLeast(0))
      .add(numberKey("charge.ratio_deviation",
                     "Standard deviation of the particles' equivalence ratios, normal; of a charge given by them.")
               .byDefault("0")
               .atLeast(0))
      .add(numberKey("charge.exhaust", "Part of the charge that is cooled exhaust of the same mixture.")
               .byDefault("0")
               .atLeast(0)
               .below(1))
      .add(choiceKey("charge.exhaust_by", {"mass", "mole"}, "What that part is counted by.").byDefault("mass"))
      .add(quantityKey("charge.exhaust_frozen", units::temperature,
                       "The exhaust has the composition of equilibrium at this temperature.")
               .byDefault("1000 K")
               .above(200));
  schema.section("cycles", Presence::optional, "Cycles, each with a part of the gas that the last one left.")
      .add(numberKey("cycles.residual",
                     "Part by mass that stays from the cycle before, expanded to the pressure of the charge.")
               .atLeast(0)
               .below(1))
      .add(integerKey("cycles.most", "Number of cycles after which the run ends, steady or not.")
               .byDefault("20")
               .atLeast(2)
               .atMost(1000))
      .add(quantityKey("cycles.angle_tolerance", units::angle,
                       "Largest difference of the angle at which half of the heat is free, from cycle to cycle, with "
                       "which cycles end.")
               .byDefault("0.1 deg")
               .above(0))
      .add(
          quantityKey("cycles.temperature_tolerance", units::temperature,
                      "Largest difference of the temperature at the start, from cycle to cycle, with which cycles end.")
              .byDefault("0.5 K")
              .above(0));
}

void addProcesses(DeckSchema& schema) {
  schema.section("mixing", Presence::optional, "How particles mix.")
      .add(choiceKey("mixing.model", {"none", "iem", "curl", "modified_curl"},
                     "none; iem: all with their mean; curl: pairs become their mean; modified_curl: pairs come a "
                     "uniformly drawn part of the way to it.")
               .byDefault("modified_curl"))
      .add(numberKey("mixing.constant", "C of the decay of a variance, exp(-C t/tau).")
               .byDefault("2")
               .above(0)
               .onlyWith("mixing.model", {"iem", "curl", "modified_curl"}))
      .add(quantityKey("mixing.time", units::time, "Time scale tau of the turbulence: one, or one for each angle.")
               .list()
               .byDefault("[15 ms]")
               .above(0)
               .onlyWith("mixing.model", {"iem", "curl", "modified_curl"}))
      .add(quantityKey("mixing.angles", units::angle, "Crank angles of these times, linear in between.")
               .list()
               .optional()
               .onlyWith("mixing.model", {"iem", "curl", "modified_curl"}));
  schema.section("walls", Presence::optional, "Loss of heat to the walls.")
      .add(choiceKey("walls.model", {"woschni", "hohenberg", "nusselt", "constant", "none"},
                     "Correlation of the heat transfer coefficient.")
               .byDefault("woschni"))
      .add(
          quantityKey("walls.temperature", units::temperature, "Temperature of the walls.").byDefault("400 K").above(0))
      .add(quantityKey("walls.head_area", units::area, "Area of the head; that of the bore if not given.")
               .optional()
               .above(0))
      .add(quantityKey("walls.piston_area", units::area, "Area of the piston; that of the bore if not given.")
               .optional()
               .above(0))
      .add(numberKey("walls.jumps",
                     "C_h: a particle loses one C_h-th of its difference to the walls at once, C_h times as often; 0: "
                     "all lose heat evenly.")
               .byDefault("15")
               .atLeast(0))
      .add(numberKey("walls.factor",
                     "Factor of the correlation; 3.26, 129.8 and 0.035 if not given; of constant in W/m^2/K.")
               .optional()
               .above(0))
      .add(numberKey("walls.pressure_power", "Power of the pressure.")
               .optional()
               .onlyWith("walls.model", {"woschni", "hohenberg"}))
      .add(numberKey("walls.temperature_power", "Power of the temperature.")
               .optional()
               .onlyWith("walls.model", {"woschni", "hohenberg"}))
      .add(numberKey("walls.speed_power", "Power of the speed of the gas in the coefficient.")
               .optional()
               .onlyWith("walls.model", {"woschni", "hohenberg"}))
      .add(numberKey("walls.size_power", "Power of the bore, of hohenberg of the volume.")
               .optional()
               .onlyWith("walls.model", {"woschni", "hohenberg"}))
      .add(numberKey("walls.piston_speed", "Gas's speed over the mean speed of the piston.")
               .optional()
               .atLeast(0)
               .onlyWith("walls.model", {"woschni", "nusselt"}))
      .add(numberKey("walls.swirl_speed", "Gas's speed by swirl, over that times walls.swirl.")
               .optional()
               .atLeast(0)
               .onlyWith("walls.model", {"woschni", "nusselt"}))
      .add(numberKey("walls.combustion_speed", "Factor in m/s/K of the gas's speed by combustion.")
               .optional()
               .atLeast(0)
               .onlyWith("walls.model", {"woschni", "nusselt"}))
      .add(numberKey("walls.speed_offset", "Speed in m/s that hohenberg adds to the piston's.")
               .optional()
               .atLeast(0)
               .onlyWith("walls.model", {"hohenberg"}))
      .add(numberKey("walls.reynolds_power", "a of Nu = factor Re^a Pr^b.")
               .optional()
               .onlyWith("walls.model", {"nusselt"}))
      .add(numberKey("walls.prandtl_power", "b of Nu = factor Re^a Pr^b.")
               .optional()
               .onlyWith("walls.model", {"nusselt"}))
      .add(numberKey("walls.swirl", "Speed of swirl over that of the piston.")
               .byDefault("0")
               .atLeast(0)
               .onlyWith("walls.model", {"woschni", "nusselt"}))
      .add(numberKey("walls.motored_exponent", "Polytropic exponent of the pressure without combustion.")
               .byDefault("1.35")
               .above(1)
               .onlyWith("walls.model", {"woschni", "nusselt"}));
  schema.section("injection", Presence::optional, "Fuel sprayed into the cylinder.")
      .add(stringKey("injection.fuel", "Mole fractions of the fuel."))
      .add(quantityKey("injection.angles", units::angle, "Crank angles of the rates, linear in between.").list())
      .add(quantityKey("injection.rates", units::massFlow, "Mass of fuel per time at each of them.").list().atLeast(0))
      .add(quantityKey("injection.temperature", units::temperature, "Temperature of the liquid.")
               .byDefault("300 K")
               .above(0))
      .add(quantityKey("injection.latent_heat", units::specificEnergy, "Heat that evaporates it there.")
               .byDefault("0 J/kg")
               .atLeast(0))
      .add(numberKey("injection.dilution", "Mass of gas, of all particles alike, in which a mass of fuel evaporates.")
               .byDefault("5")
               .atLeast(0))
      .add(integerKey("injection.most_particles",
                      "Most particles: the nearest merge beyond that; twice those at the start if not given.")
               .optional()
               .atLeast(4)
               .atMost(1e6));
}

void addNumerics(DeckSchema& schema) {
  schema.add(integerKey("sample.particles", "Particles of gas at the start.").byDefault("100").atLeast(1).atMost(1e6))
      .add(integerKey("sample.repeats", "Independent repeats, of which means and intervals are.")
               .byDefault("1")
               .atLeast(1)
               .atMost(1e5))
      .add(integerKey("sample.seed",
                      "Start of the random numbers: another seed gives another sample, the same seed the same result.")
               .byDefault("1")
               .atLeast(0));
  schema
      .add(quantityKey("step.angle", units::angle, "Longest step, as an angle of the crank.")
               .byDefault("0.5 deg")
               .above(0))
      .add(numberKey("step.pressure_change", "A step that changes the pressure by a larger part is halved.")
               .byDefault("0.1")
               .above(0))
      .add(quantityKey(
               "step.temperature_change", units::temperature,
               "A step in which reactions change a particle's temperature by more is halved; no matter if not given.")
               .optional()
               .above(0))
      .add(integerKey("step.halvings", "How often a step is halved at most.").byDefault("6").atLeast(0).atMost(30))
      .add(booleanKey("step.reactions", "Whether the gas reacts; false: a motored engine.").byDefault("true"))
      .add(numberKey("step.relative_tolerance", "Relative error of the reactions in a step.")
               .byDefault("1e-6")
               .above(0)
               .below(1))
      .add(numberKey("step.absolute_tolerance", "Absolute error of a mass fraction.").byDefault("1e-12").above(0));
  schema
      .add(quantityKey("output.every", units::angle, "Crank angle from a row of the history to the next.")
               .byDefault("0.5 deg")
               .above(0))
      .add(quantityKey("output.particles_at", units::angle, "Crank angles at which all particles are written.")
               .list()
               .byDefault("[]"))
      .add(stringKey("output.species", "Species of the history, the particles and the emissions.")
               .list()
               .byDefault("[]"));
  schema.add(checkpointKeys("more repeats").schema());
}

}  // namespace

DeckSchema engineSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"engine"}, "What is solved."))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addMechanismKeys(schema);
  addEngine(schema);
  addCharge(schema);
  addProcesses(schema);
  addNumerics(schema);
  addParticleKeys(schema,
                  {.description = "Soot: a model whose scalars each particle of gas carries, or an ensemble, trees "
                                  "or molecules along the mean gas, as which they leave it, and both "
                                  "(particles.carried). The history then has all species.",
                   .besideModel = true});
  addRepeatKeys(schema);
  addTreeRunKeys(schema);
  return schema;
}

}  // namespace lampblack::app
