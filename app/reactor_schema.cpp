#include "app/gas_input.hpp"
#include "app/reactor_case.hpp"
#include "chemistry/thermo.hpp"

namespace lampblack {
namespace {

DeckKey temperatureKey(std::string path, std::string doc) {
  return quantityKey(std::move(path), units::temperature, std::move(doc))
      .atLeast(Thermo::minTemperature)
      .atMost(Thermo::maxTemperature);
}

void addReactor(DeckSchema& schema) {
  schema
      .add(choiceKey("reactor.type", {"constant_pressure", "constant_volume"},
                     "constant_pressure, constant_volume: closed and well mixed."))
      .add(choiceKey("reactor.energy", {"adiabatic", "isothermal", "profile"},
                     "adiabatic; isothermal: the temperature of the start is kept; profile: it follows "
                     "temperature_profile.")
               .byDefault("adiabatic"));
}

void addProfile(DeckSchema& schema) {
  schema
      .section("temperature_profile", Presence::optional,
               "The temperature where reactor.energy is profile: straight lines between points, constant beyond them. "
               "Points here or in a file.")
      .add(quantityKey("temperature_profile.time", units::time, "Times of the points, rising.").list().optional())
      .add(temperatureKey("temperature_profile.temperature", "Temperatures of the points.").list().optional())
      .add(stringKey("temperature_profile.file",
                     "Instead: a CSV file of two columns, time in s and temperature in K; a first line of names and "
                     "lines that begin with # are skipped. Relative to the deck.")
               .optional());
}

void addIgnition(DeckSchema& schema) {
  schema
      .section("ignition", Presence::defaulted,
               "What marks ignition. Delays are found on the integrator's dense output, well below its steps.")
      .add(booleanKey("ignition.temperature_rate", "The largest dT/dt (of adiabatic reactors).").byDefault("true"))
      .add(stringKey("ignition.species",
                     "The largest mole and the largest mass fraction of these species; OH only where the mechanism has "
                     "it.")
               .list()
               .byDefault("[OH]"))
      .add(quantityKey("ignition.temperature_rise", units::temperature,
                       "The temperature first is so much above the initial one.")
               .optional()
               .above(0))
      .section("sensitivity", Presence::optional,
               "Sensitivities d ln tau / d ln k of the ignition delays to the rate constants, forward and reverse "
               "together.")
      .add(choiceKey("sensitivity.of", {"ignition_delay"}, "Of what.").byDefault("ignition_delay"))
      .add(stringKey("sensitivity.reactions",
                     "Reactions by their number in the file, from 1, or by their equation; 'all' takes every one.")
               .list()
               .byDefault("[all]"));
}

}  // namespace

DeckSchema reactorSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"reactor"}, "What is solved."))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"))
      .add(stringKey("mechanism", "Mechanism file in Cantera's YAML format, relative to the deck."))
      .add(quantityKey("pressure", units::pressure, "Pressure; of constant_volume at the start.")
               .byDefault("1 atm")
               .above(0));
  addReactor(schema);
  schema.section("initial", Presence::optional, "The gas at the start of a closed reactor.")
      .add(temperatureKey("initial.temperature", "Temperature."));
  addMixtureKeys(schema, "initial");
  addProfile(schema);
  schema.add(quantityKey("time.end", units::time, "Simulated time.").above(0))
      .add(quantityKey("time.maximum_step", units::time, "Largest step of the integrator.").optional().above(0));
  addIgnition(schema);
  schema.add(numberKey("integrator.relative_tolerance", "Of the stiff solver.").byDefault("1e-9").above(0).below(1))
      .add(numberKey("integrator.absolute_tolerance", "Of the stiff solver, in mass fraction.")
               .byDefault("1e-15")
               .above(0))
      .add(integerKey("integrator.maximum_steps", "Steps after which the run gives up.").byDefault("1000000").above(0))
      .add(quantityKey("output.interval", units::time, "Time between rows; absent: each step of the integrator.")
               .optional()
               .above(0))
      .add(stringKey("output.species", "Species whose fractions are written; 'all' writes every one.")
               .list()
               .byDefault("[all]"))
      .add(choiceKey("output.fractions", {"mole", "mass"}, "Which fractions are written.").byDefault("mole"));
  return schema;
}

}  // namespace lampblack
