#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/radiation_deck.hpp"
#include "app/deck/sensitivity_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/deck/transport_deck.hpp"
#include "app/problems/flame/flame_case.hpp"
#include "app/problems/flame/flame_solver_deck.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

void addStream(DeckSchema& schema, const std::string& section, const std::string& doc,
               const std::vector<std::string>& types) {
  SectionKeys keys(section);
  keys.section(Presence::optional, doc, {{"flame.type", types}});
  keys.quantity("temperature", units::temperature, temperatureRules(), "Temperature of the gas.");
  keys.quantity("velocity", units::velocity, rules().optional().above(0).onlyWith("flame.nozzles", {"plug"}),
                "Velocity of the stream into the domain; free flame: a first guess of the flame speed, estimated if "
                "not given. Not with potential flow.");
  keys.quantity("mass_flux", units::massFlux, rules().optional().above(0).onlyWith("flame.nozzles", {"plug"}),
                "Mass flux of the stream into the domain, in place of a velocity.");
  addMixtureKeys(keys.schema(), section);
  schema.add(keys.schema());
}

void addFlame(DeckSchema& schema) {
  SectionKeys keys("");
  keys.choice("flame.type", {"free", "burner", "wall", "counterflow"}, rules(),
              "free: premixed, propagating freely, its speed is found; burner: premixed, on a burner of given mass "
              "flux; wall: a stream against a wall; counterflow: two streams against each other.");
  keys.quantity("flame.length", units::length, rules().byDefault("20 mm").above(0),
                "Length of the domain: from the burner to where nothing changes, from nozzle to wall, or from nozzle "
                "to nozzle. A free flame may widen it.");
  keys.choice("flame.nozzles", {"plug", "potential"},
              rules().byDefault("plug").onlyWith("flame.type", {"wall", "counterflow"}),
              "plug: velocities given, no spreading at the nozzles; potential: the streams come from afar, the strain "
              "rate is given.");
  keys.quantity("flame.strain_rate", units::frequency,
                rules()
                    .optional()
                    .above(0)
                    .onlyWith("flame.type", {"wall", "counterflow"})
                    .onlyWith("flame.nozzles", {"potential"}),
                "Strain rate of the stream on the right (flame against a wall: of the stream).");
  keys.quantity(
      "flame.stagnation_plane", units::length,
      rules().optional().above(0).onlyWith("flame.type", {"counterflow"}).onlyWith("flame.nozzles", {"potential"}),
      "Position where the streams meet; absent: the middle of the domain.");
  keys.quantity("flame.wall_temperature", units::temperature,
                temperatureRules().optional().onlyWith("flame.type", {"wall"}),
                "Temperature of the wall; absent with flame.energy given: that of the profile there.");
  keys.choice("flame.energy", {"solved", "given"},
              rules().byDefault("solved").onlyWith("flame.type", {"burner", "wall"}),
              "solved: the temperature follows from the energy equation; given: it is the measured one of the section "
              "temperature_profile.");
  addStream(keys.schema(), "inlet", "The stream that comes in on the left.", {"free", "burner", "wall"});
  addStream(keys.schema(), "left", "The stream from the left, by custom the fuel.", {"counterflow"});
  addStream(keys.schema(), "right", "The stream from the right, by custom the oxidiser.", {"counterflow"});
  keys.section("temperature_profile", Presence::optional,
               "The given temperature: straight lines between points, constant beyond them. Points here or in a file.",
               {{"flame.energy", {"given"}}});
  keys.quantity("temperature_profile.position", units::length, rules().list().optional(),
                "Distances of the points from the burner, rising.");
  addTemperatureProfileKeys(keys.schema(), "distance in m");
  keys.quantity("temperature_profile.smoothing", units::length, rules().optional().above(0),
                "Half the distance over which the temperature is averaged, with weights that fall linearly to its "
                "ends: for measured values whose kinks and steps of rounding the grid would follow. The values at both "
                "ends of the flame stay. Absent: as it is given.");
  schema.add(keys.schema());
}

void addPhysics(DeckSchema& schema) {
  addTransportKeys(schema);
  addRadiationKeys(schema);
}

}  // namespace

DeckSchema flameSchema() {
  SectionKeys keys("");
  keys.choice("problem", {"flame1d"}, rules(), "What is solved.");
  keys.text("title", rules().byDefault("''"), "One line for reports and pictures.");
  addMechanismKeys(keys.schema());
  keys.quantity("pressure", units::pressure, rules().byDefault("1 atm").above(0), "Pressure of the gas.");
  addFlame(keys.schema());
  addPhysics(keys.schema());
  addParticleKeys(keys.schema(),
                  {.description = "Particles, carried by the gas or along the flame's paths, by repeats of "
                                  "independent random numbers; absent: none.",
                   .besideModel = true,
                   .treeNumber = "2048"});
  addStochasticKeys(keys.schema());
  addFlameSolverKeys(keys.schema());
  addSensitivityKeys(keys.schema(),
                     "Sensitivities d ln S_u / d ln k of the flame speed to the rate constants, forward and reverse "
                     "together, by the adjoint of the flame.",
                     "flame_speed", {{"flame.type", {"free"}}});
  return keys.schema();
}

}  // namespace lampblack::app
