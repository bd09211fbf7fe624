#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/radiation_deck.hpp"
#include "app/deck/sensitivity_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/deck/transport_deck.hpp"
#include "app/problems/flame/flame_case.hpp"
#include "app/problems/flame/flame_solver_deck.hpp"

namespace lampblack::app {
namespace {

void addStream(DeckSchema& schema, const std::string& section, const std::string& doc,
               const std::vector<std::string>& types) {
  schema.section(section, Presence::optional, doc, {{"flame.type", types}})
      .add(temperatureKey(section + ".temperature", "Temperature of the gas."))
      .add(quantityKey(section + ".velocity", units::velocity,
                       "Velocity of the stream into the domain; free flame: a first guess of the flame speed, "
                       "estimated if not given. Not with potential flow.")
               .optional()
               .above(0)
               .onlyWith("flame.nozzles", {"plug"}))
      .add(quantityKey(section + ".mass_flux", units::massFlux,
                       "Mass flux of the stream into the domain, in place of a velocity.")
               .optional()
               .above(0)
               .onlyWith("flame.nozzles", {"plug"}));
  addMixtureKeys(schema, section);
}

void addFlame(DeckSchema& schema) {
  schema
      .add(choiceKey("flame.type", {"free", "burner", "wall", "counterflow"},
                     "free: premixed, propagating freely, its speed is found; burner: premixed, on a burner of given "
                     "mass flux; wall: a stream against a wall; counterflow: two streams against each other."))
      .add(quantityKey("flame.length", units::length,
                       "Length of the domain: from the burner to where nothing changes, from nozzle to wall, or from "
                       "nozzle to nozzle. A free flame may widen it.")
               .byDefault("20 mm")
               .above(0))
      .add(choiceKey("flame.nozzles", {"plug", "potential"},
                     "plug: velocities given, no spreading at the nozzles; potential: the streams come from afar, the "
                     "strain rate is given.")
               .byDefault("plug")
               .onlyWith("flame.type", {"wall", "counterflow"}))
      .add(quantityKey("flame.strain_rate", units::frequency,
                       "Strain rate of the stream on the right (flame against a wall: of the stream).")
               .optional()
               .above(0)
               .onlyWith("flame.type", {"wall", "counterflow"})
               .onlyWith("flame.nozzles", {"potential"}))
      .add(quantityKey("flame.stagnation_plane", units::length,
                       "Position where the streams meet; absent: the middle of the domain.")
               .optional()
               .above(0)
               .onlyWith("flame.type", {"counterflow"})
               .onlyWith("flame.nozzles", {"potential"}))
      .add(temperatureKey("flame.wall_temperature",
                          "Temperature of the wall; absent with flame.energy given: that of the profile there.")
               .optional()
               .onlyWith("flame.type", {"wall"}))
      .add(choiceKey("flame.energy", {"solved", "given"},
                     "solved: the temperature follows from the energy equation; given: it is the measured one of the "
                     "section temperature_profile.")
               .byDefault("solved")
               .onlyWith("flame.type", {"burner", "wall"}));
  addStream(schema, "inlet", "The stream that comes in on the left.", {"free", "burner", "wall"});
  addStream(schema, "left", "The stream from the left, by custom the fuel.", {"counterflow"});
  addStream(schema, "right", "The stream from the right, by custom the oxidiser.", {"counterflow"});
  schema
      .section("temperature_profile", Presence::optional,
               "The given temperature: straight lines between points, constant beyond them. Points here or in a file.",
               {{"flame.energy", {"given"}}})
      .add(
          quantityKey("temperature_profile.position", units::length, "Distances of the points from the burner, rising.")
              .list()
              .optional());
  addTemperatureProfileKeys(schema, "distance in m");
  schema.add(quantityKey("temperature_profile.smoothing", units::length,
                         "Half the distance over which the temperature is averaged, with weights that fall linearly to "
                         "its ends: for measured values whose kinks and steps of rounding the grid would follow. The "
                         "values at both ends of the flame stay. Absent: as it is given.")
                 .optional()
                 .above(0));
}

void addPhysics(DeckSchema& schema) {
  addTransportKeys(schema);
  addRadiationKeys(schema);
}

}  // namespace

DeckSchema flameSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"flame1d"}, "What is solved."))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addMechanismKeys(schema);
  schema.add(quantityKey("pressure", units::pressure, "Pressure of the gas.").byDefault("1 atm").above(0));
  addFlame(schema);
  addPhysics(schema);
  addParticleKeys(schema, {.description = "Particles, carried by the gas or along the flame's paths, by repeats of "
                                          "independent random numbers; absent: none.",
                           .besideModel = true,
                           .treeNumber = "2048"});
  addStochasticKeys(schema);
  addFlameSolverKeys(schema);
  addSensitivityKeys(schema,
                     "Sensitivities d ln S_u / d ln k of the flame speed to the rate constants, forward and reverse "
                     "together, by the adjoint of the flame.",
                     "flame_speed", {{"flame.type", {"free"}}});
  return schema;
}

}  // namespace lampblack::app
