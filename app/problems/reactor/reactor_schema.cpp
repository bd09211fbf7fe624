#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/sensitivity_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

const std::string typeKey = "reactor.type";
const std::vector<std::string> closed{"constant_pressure", "constant_volume", "given_volume"};
const std::vector<std::string> inTime{"constant_pressure", "constant_volume", "given_volume", "stirred", "network"};
const std::vector<std::string> startsFromGas{"constant_pressure", "constant_volume", "given_volume", "stirred"};

void addReactor(DeckSchema& schema) {
  SectionKeys keys("");
  std::vector<std::string> names;
  for (const auto& kind : reactorcase::reactorKinds()) names.push_back(kind.name);
  keys.choice("reactor.type", names, rules(),
              "constant_pressure, constant_volume, given_volume (in time, by the section volume): closed and well "
              "mixed, from the section initial; stirred: perfectly stirred with a stream through it; plug_flow: a "
              "stream along a duct; network: stirred reactors joined by streams.");
  keys.choice("reactor.energy", {"adiabatic", "isothermal", "profile"}, rules().byDefault("adiabatic"),
              "adiabatic (a stirred reactor may lose heat even so); isothermal: the temperature of the start or of the "
              "inlet is kept, or reactor.temperature; profile: it follows temperature_profile.");
  keys.quantity("reactor.temperature", units::temperature,
                temperatureRules().optional().onlyWith("reactor.energy", {"isothermal"}),
                "The temperature, if not that of the start or inlet.");
  keys.choice("reactor.start", {"burnt", "fresh"}, rules().byDefault("burnt").onlyWith(typeKey, {"stirred", "network"}),
              "The steady state is searched from the equilibrium of what flows in, or from what flows in as it is.");
  keys.quantity("reactor.length", units::length, rules().optional().above(0).onlyWith(typeKey, {"plug_flow"}),
                "Length of the duct.");
  keys.quantity("reactor.area", units::area, rules().optional().above(0).onlyWith(typeKey, {"plug_flow"}),
                "Cross-section of the duct; needed where the inlet has a mass_flow.");
  reactorcase::addVesselKeys(keys.schema(), "reactor", "stirred");
  keys.section("upstream", Presence::optional,
               "A perfectly stirred reactor that the stream passes before it enters the duct: its steady state is what "
               "enters, with its particles.",
               {{typeKey, {"plug_flow"}}});
  keys.quantity("upstream.temperature", units::temperature, temperatureRules().optional(),
                "Temperature at which this reactor is held; absent: it follows from the energy equation.");
  keys.number("upstream.residence_times", rules().byDefault("8").above(0),
              "For populations of particles by Monte Carlo: number of residence times in it, from the steady state of "
              "the gas alone, until the stream enters the duct.");
  reactorcase::addVesselKeys(keys.schema(), "upstream", "plug_flow");
  keys.section("inlet", Presence::optional, "The stream that comes in.", {{typeKey, {"stirred", "plug_flow"}}});
  keys.quantity("inlet.temperature", units::temperature, temperatureRules(), "Temperature of the gas.");
  keys.quantity("inlet.mass_flow", units::massFlow, rules().optional().above(0),
                "Mass flow into the reactor: a stirred one with reactor.volume, plug flow with reactor.area, also with "
                "upstream.volume.");
  keys.quantity("inlet.velocity", units::velocity, rules().optional().above(0).onlyWith(typeKey, {"plug_flow"}),
                "Velocity of the stream at the inlet, in place of mass_flow.");
  addMixtureKeys(keys.schema(), "inlet");
  schema.add(keys.schema());
}

void addProfile(DeckSchema& schema) {
  SectionKeys keys("temperature_profile");
  keys.section(Presence::optional,
               "The given temperature: straight lines between points, constant beyond them. Points here or in a file.",
               {{"reactor.energy", {"profile"}},
                {typeKey, {"constant_pressure", "constant_volume", "given_volume", "plug_flow"}}});
  keys.quantity("time", units::time, rules().list().optional().onlyWith(typeKey, closed),
                "Times of the points, rising.");
  keys.quantity("position", units::length, rules().list().optional().onlyWith(typeKey, {"plug_flow"}),
                "Places of the points, rising.");
  addTemperatureProfileKeys(keys.schema(), "time in s (place in m)");
  schema.add(keys.schema());
}

void addIgnition(DeckSchema& schema) {
  SectionKeys keys("ignition");
  keys.section(Presence::defaulted,
               "What marks ignition in a closed reactor. Delays are found on the integrator's dense output, well below "
               "its steps.",
               {{typeKey, closed}});
  keys.boolean("temperature_rate", rules().byDefault("true").onlyWith("reactor.energy", {"adiabatic"}),
               "Whether the time of the largest dT/dt is reported as an ignition delay.");
  keys.boolean("first_stage", rules().byDefault("false").onlyWith("reactor.energy", {"adiabatic"}),
               "Whether the time of the first maximum of dT/dt is reported as an ignition delay, where a higher one "
               "follows: that of a cool flame. Below 1 K of heating it does not count.");
  keys.boolean("pressure_rate",
               rules()
                   .byDefault("false")
                   .onlyWith("reactor.energy", {"adiabatic"})
                   .onlyWith(typeKey, {"constant_volume", "given_volume"}),
               "Whether the time of the largest dp/dt is reported as an ignition delay.");
  keys.choice("from", {"start", "end_of_compression"},
              rules().byDefault("end_of_compression").onlyWith(typeKey, {"given_volume"}),
              "What delays count from: the start of the run, or the time of the smallest volume, before which nothing "
              "counts as ignition.");
  keys.text("species", rules().list().byDefault("[OH]"),
            "Species whose times of the largest mole and of the largest mass fraction are reported as ignition delays; "
            "OH only where the mechanism has it.");
  keys.quantity("temperature_rise", units::temperature,
                rules().optional().above(0).onlyWith("reactor.energy", {"adiabatic"}),
                "Reports as an ignition delay when the temperature first is this much above the initial one.");
  addSensitivityKeys(
      keys.schema(),
      "Sensitivities d ln tau / d ln k of the ignition delays to the rate constants, forward and reverse "
      "together.",
      "ignition_delay", {{typeKey, {"constant_pressure", "constant_volume"}}});
  schema.add(keys.schema());
}

}  // namespace

DeckSchema reactorSchema() {
  SectionKeys keys("");
  keys.choice("problem", {"reactor"}, rules(), "What is solved.");
  keys.text("title", rules().byDefault("''"), "One line for reports and pictures.");
  addMechanismKeys(keys.schema());
  keys.quantity("pressure", units::pressure, rules().byDefault("1 atm").above(0),
                "Pressure of the gas; with constant_volume and given_volume that at the start.");
  addReactor(keys.schema());
  keys.section("initial", Presence::optional, "The gas at the start; a stirred reactor may do without.",
               {{typeKey, startsFromGas}});
  keys.quantity("initial.temperature", units::temperature, temperatureRules(), "Temperature of the gas.");
  addMixtureKeys(keys.schema(), "initial");
  addProfile(keys.schema());
  reactorcase::addVolumeKeys(keys.schema());
  reactorcase::addNetworkKeys(keys.schema());
  keys.quantity("time.end", units::time, rules().optional().above(0).onlyWith(typeKey, inTime),
                "Simulated time of a closed reactor. A stirred reactor with it is a transient, without it the steady "
                "state is searched; a network has it with populations, where it is needed.");
  keys.quantity("time.maximum_step", units::time, rules().optional().above(0).onlyWith(typeKey, inTime),
                "Largest step of the integrator.");
  addIgnition(keys.schema());
  addParticleKeys(keys.schema(),
                  {.description = "Particles, coupled with the gas both ways; of ensembles and trees every repeat is a "
                                  "reactor, or a network, of its own. Without the heat of the material, known for soot "
                                  "and silica, the temperature has to be given. Absent: none."});
  addRepeatKeys(keys.schema());
  addCouplingKeys(keys.schema());
  addTreeReactorKeys(keys.schema());
  keys.schema().add(reactorcase::integratorKeys().schema());
  keys.quantity("output.interval", units::time, rules().optional().above(0).onlyWith(typeKey, inTime),
                "Time between rows; absent: each step of the integrator.");
  keys.quantity("output.spacing", units::length, rules().optional().above(0).onlyWith(typeKey, {"plug_flow"}),
                "Distance between rows; absent: each step of the integrator.");
  keys.text("output.species", rules().list().byDefault("[all]"),
            "Species whose fractions are written; 'all' writes every one.");
  keys.choice("output.fractions", {"mole", "mass"}, rules().byDefault("mole"),
              "Whether mole or mass fractions of the species are written.");
  return keys.schema();
}

}  // namespace lampblack::app
