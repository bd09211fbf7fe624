#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/sensitivity_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"

namespace lampblack::app {
namespace {

const std::string typeKey = "reactor.type";
const std::vector<std::string> closed{"constant_pressure", "constant_volume", "given_volume"};
const std::vector<std::string> inTime{"constant_pressure", "constant_volume", "given_volume", "stirred", "network"};
const std::vector<std::string> startsFromGas{"constant_pressure", "constant_volume", "given_volume", "stirred"};

// What a stirred reactor has, alone or in a network.
void addVesselKeys(DeckSchema& schema, const std::string& section, const std::string& type) {
  schema
      .add(quantityKey(section + ".volume", units::volume, "Volume of the reactor; either this or residence_time.")
               .optional()
               .above(0)
               .onlyWith(typeKey, {type}))
      .add(quantityKey(
               section + ".residence_time", units::time,
               "Residence time, the mass inside over the mass flow; the volume follows from it. Either this or volume.")
               .optional()
               .above(0)
               .onlyWith(typeKey, {type}))
      .section(section + ".heat_loss", Presence::optional, "Where there is an energy equation.", {{typeKey, {type}}})
      .add(quantityKey(section + ".heat_loss.conductance", units::watt / units::temperature,
                       "Heat lost per time and kelvin above the surroundings, in W/K: bigger cools more.")
               .atLeast(0))
      .add(quantityKey(section + ".heat_loss.surroundings", units::temperature,
                       "Temperature of the surroundings that heat is lost to.")
               .atLeast(0)
               .byDefault("300 K"));
}

void addReactor(DeckSchema& schema) {
  schema
      .add(choiceKey("reactor.type",
                     {"constant_pressure", "constant_volume", "given_volume", "stirred", "plug_flow", "network"},
                     "constant_pressure, constant_volume, given_volume (in time, by the section volume): closed and "
                     "well mixed, from the section initial; stirred: "
                     "perfectly stirred with a stream through it; plug_flow: a stream along a duct; network: stirred "
                     "reactors joined by streams."))
      .add(choiceKey("reactor.energy", {"adiabatic", "isothermal", "profile"},
                     "adiabatic (a stirred reactor may lose heat even so); isothermal: the temperature of the start or "
                     "of the inlet is kept, or reactor.temperature; profile: it follows temperature_profile.")
               .byDefault("adiabatic"))
      .add(temperatureKey("reactor.temperature", "The temperature, if not that of the start or inlet.")
               .optional()
               .onlyWith("reactor.energy", {"isothermal"}))
      .add(choiceKey("reactor.start", {"burnt", "fresh"},
                     "The steady state is searched from the equilibrium of what flows in, or from what flows in as it "
                     "is.")
               .byDefault("burnt")
               .onlyWith(typeKey, {"stirred", "network"}))
      .add(quantityKey("reactor.length", units::length, "Length of the duct.")
               .optional()
               .above(0)
               .onlyWith(typeKey, {"plug_flow"}))
      .add(
          quantityKey("reactor.area", units::area, "Cross-section of the duct; needed where the inlet has a mass_flow.")
              .optional()
              .above(0)
              .onlyWith(typeKey, {"plug_flow"}));
  addVesselKeys(schema, "reactor", "stirred");
  schema
      .section("upstream", Presence::optional,
               "A perfectly stirred reactor that the stream passes before it enters the duct: its steady state is what "
               "enters, with its particles.",
               {{typeKey, {"plug_flow"}}})
      .add(temperatureKey("upstream.temperature",
                          "Temperature at which this reactor is held; absent: it follows from the energy equation.")
               .optional())
      .add(numberKey("upstream.residence_times",
                     "For populations of particles by Monte Carlo: number of residence times in it, from the steady "
                     "state of the gas alone, until the stream enters the duct.")
               .byDefault("8")
               .above(0));
  addVesselKeys(schema, "upstream", "plug_flow");
  schema.section("inlet", Presence::optional, "The stream that comes in.", {{typeKey, {"stirred", "plug_flow"}}})
      .add(temperatureKey("inlet.temperature", "Temperature of the gas."))
      .add(quantityKey(
               "inlet.mass_flow", units::massFlow,
               "Mass flow into the reactor: a stirred one with reactor.volume, plug flow with reactor.area, also with "
               "upstream.volume.")
               .optional()
               .above(0))
      .add(quantityKey("inlet.velocity", units::velocity, "Velocity of the stream at the inlet, in place of mass_flow.")
               .optional()
               .above(0)
               .onlyWith(typeKey, {"plug_flow"}));
  addMixtureKeys(schema, "inlet");
}

void addNetwork(DeckSchema& schema) {
  schema
      .section("network", Presence::optional, "Stirred reactors of one pressure and the streams between them.",
               {{typeKey, {"network"}}})
      .section("network.reactors", Presence::required, "Named reactors.")
      .add(temperatureKey("network.reactors.*.temperature",
                          "Temperature at which this reactor is held; absent: it follows from the energy equation.")
               .optional());
  addVesselKeys(schema, "network.reactors.*", "network");
  schema.section("network.inlets", Presence::required, "Named streams from outside.")
      .add(stringKey("network.inlets.*.to", "Name of the reactor that the stream flows into."))
      .add(quantityKey("network.inlets.*.mass_flow", units::massFlow, "Mass flow of the stream.").above(0))
      .add(temperatureKey("network.inlets.*.temperature", "Temperature of the gas."));
  addMixtureKeys(schema, "network.inlets.*");
  schema
      .section("network.connections", Presence::optional,
               "Streams between reactors. What a reactor does not pass on leaves the network.")
      .add(stringKey("network.connections[].from", "Name of the reactor that the stream leaves."))
      .add(stringKey("network.connections[].to", "Name of the reactor that the stream flows into."))
      .add(numberKey("network.connections[].fraction",
                     "Part of all that flows through the reactor it leaves that takes this connection; 1 if neither "
                     "this nor mass_flow is given.")
               .optional()
               .above(0)
               .atMost(1))
      .add(quantityKey("network.connections[].mass_flow", units::massFlow,
                       "Mass flow of the connection, in place of a fraction.")
               .optional()
               .above(0));
}

void addProfile(DeckSchema& schema) {
  schema
      .section("temperature_profile", Presence::optional,
               "The given temperature: straight lines between points, constant beyond them. Points here or in a file.",
               {{"reactor.energy", {"profile"}},
                {typeKey, {"constant_pressure", "constant_volume", "given_volume", "plug_flow"}}})
      .add(quantityKey("temperature_profile.time", units::time, "Times of the points, rising.")
               .list()
               .optional()
               .onlyWith(typeKey, closed))
      .add(quantityKey("temperature_profile.position", units::length, "Places of the points, rising.")
               .list()
               .optional()
               .onlyWith(typeKey, {"plug_flow"}));
  addTemperatureProfileKeys(schema, "time in s (place in m)");
}

void addIgnition(DeckSchema& schema) {
  schema
      .section("ignition", Presence::defaulted,
               "What marks ignition in a closed reactor. Delays are found on the integrator's dense output, well below "
               "its steps.",
               {{typeKey, closed}})
      .add(booleanKey("ignition.temperature_rate",
                      "Whether the time of the largest dT/dt is reported as an ignition delay.")
               .byDefault("true")
               .onlyWith("reactor.energy", {"adiabatic"}))
      .add(booleanKey("ignition.first_stage",
                      "Whether the time of the first maximum of dT/dt is reported as an ignition delay, where a higher "
                      "one follows: that of a cool flame. Below 1 K of heating it does not count.")
               .byDefault("false")
               .onlyWith("reactor.energy", {"adiabatic"}))
      .add(booleanKey("ignition.pressure_rate",
                      "Whether the time of the largest dp/dt is reported as an ignition delay.")
               .byDefault("false")
               .onlyWith("reactor.energy", {"adiabatic"})
               .onlyWith(typeKey, {"constant_volume", "given_volume"}))
      .add(choiceKey("ignition.from", {"start", "end_of_compression"},
                     "What delays count from: the start of the run, or the time of the smallest volume, before which "
                     "nothing counts as ignition.")
               .byDefault("end_of_compression")
               .onlyWith(typeKey, {"given_volume"}))
      .add(stringKey("ignition.species",
                     "Species whose times of the largest mole and of the largest mass fraction are reported as "
                     "ignition delays; OH only where the mechanism has it.")
               .list()
               .byDefault("[OH]"))
      .add(quantityKey("ignition.temperature_rise", units::temperature,
                       "Reports as an ignition delay when the temperature first is this much above the initial one.")
               .optional()
               .above(0)
               .onlyWith("reactor.energy", {"adiabatic"}));
  addSensitivityKeys(
      schema,
      "Sensitivities d ln tau / d ln k of the ignition delays to the rate constants, forward and reverse "
      "together.",
      "ignition_delay", {{typeKey, {"constant_pressure", "constant_volume"}}});
}

}  // namespace

DeckSchema reactorSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"reactor"}, "What is solved."))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addMechanismKeys(schema);
  schema.add(quantityKey("pressure", units::pressure,
                         "Pressure of the gas; with constant_volume and given_volume that at the start.")
                 .byDefault("1 atm")
                 .above(0));
  addReactor(schema);
  schema
      .section("initial", Presence::optional, "The gas at the start; a stirred reactor may do without.",
               {{typeKey, startsFromGas}})
      .add(temperatureKey("initial.temperature", "Temperature of the gas."));
  addMixtureKeys(schema, "initial");
  addProfile(schema);
  reactorcase::addVolumeKeys(schema);
  addNetwork(schema);
  schema
      .add(quantityKey("time.end", units::time,
                       "Simulated time of a closed reactor. A stirred reactor with it is a transient, without it the "
                       "steady state is searched; a network has it with populations, where it is needed.")
               .optional()
               .above(0)
               .onlyWith(typeKey, inTime))
      .add(quantityKey("time.maximum_step", units::time, "Largest step of the integrator.")
               .optional()
               .above(0)
               .onlyWith(typeKey, inTime));
  addIgnition(schema);
  addParticleKeys(schema,
                  {.description = "Particles, coupled with the gas both ways; of ensembles and trees every repeat is a "
                                  "reactor, or a network, of its own. Without the heat of the material, known for soot "
                                  "and silica, the temperature has to be given. Absent: none."});
  addRepeatKeys(schema);
  addCouplingKeys(schema);
  addTreeReactorKeys(schema);
  schema.section("integrator", Presence::defaulted, "The stiff solver of everything but steady states.")
      .add(numberKey("integrator.relative_tolerance",
                     "Relative tolerance of the stiff solver of the chemistry: smaller is more accurate and slower.")
               .byDefault("1e-9")
               .above(0)
               .below(1))
      .add(numberKey("integrator.absolute_tolerance",
                     "Absolute tolerance of the stiff solver of the chemistry, in mass fraction: smaller is more "
                     "accurate and slower.")
               .byDefault("1e-15")
               .above(0)
               .below(1))
      .add(integerKey("integrator.maximum_steps", "Number of steps of the integrator after which the run gives up.")
               .byDefault("1000000")
               .above(0))
      .add(quantityKey("output.interval", units::time, "Time between rows; absent: each step of the integrator.")
               .optional()
               .above(0)
               .onlyWith(typeKey, inTime))
      .add(quantityKey("output.spacing", units::length, "Distance between rows; absent: each step of the integrator.")
               .optional()
               .above(0)
               .onlyWith(typeKey, {"plug_flow"}))
      .add(stringKey("output.species", "Species whose fractions are written; 'all' writes every one.")
               .list()
               .byDefault("[all]"))
      .add(choiceKey("output.fractions", {"mole", "mass"}, "Whether mole or mass fractions of the species are written.")
               .byDefault("mole"));
  return schema;
}

}  // namespace lampblack::app
