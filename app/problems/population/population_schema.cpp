#include "app/deck/initial_distribution.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/population/population_case_parts.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

void addParticleTypes(DeckSchema& schema) {
  SectionKeys keys("particles");
  keys.choice("type", {"volume", "fractal", "surface_volume", "components"}, rules().byDefault("volume"),
              "volume: coalescing spheres; fractal: aggregates of equal primary particles; surface_volume: volume and "
              "surface; components: spheres of several components by mass.");
  keys.quantity(
      "density", units::density,
      rules().byDefault("1800 kg/m^3").above(0).onlyWith("particles.type", {"volume", "fractal", "surface_volume"}),
      "Density of the material of the particles; components have their own.");
  keys.number("fractal_dimension",
              rules().optional().atLeast(1).atMost(3).onlyWith("particles.type", {"fractal", "surface_volume"}),
              "Fractal dimension of aggregates; 1.8 if not given. Smaller is more open.");
  keys.quantity("primary_diameter", units::length, rules().optional().above(0).onlyWith("particles.type", {"fractal"}),
                "Diameter of the primary particles.");
  keys.quantity("sintering_time", units::time,
                rules().optional().above(0).onlyWith("particles.type", {"surface_volume"}),
                "The surface approaches that of a sphere with this time; never if not given.");
  keys.section("components", Presence::optional, "Components of the particles, each with a name; four at most.",
               {{"particles.type", {"components"}}});
  keys.quantity("components.*.density", units::density, rules().above(0), "Density of the component.");
  keys.number("components.*.nucleus", rules().byDefault("0").atLeast(0),
              "Mass fraction of the component in nuclei and in the initial particles.");
  keys.number("components.*.condensing", rules().byDefault("0").atLeast(0),
              "Mass fraction of the component in what condenses or grows on the surface.");
  addInitialDistribution(keys.schema(), "initial");
  schema.add(keys.schema());
}

void addGas(DeckSchema& schema) {
  SectionKeys keys("gas");
  const std::string kernel = "processes.coagulation.kernel";
  const std::vector<std::string> slip{"continuum", "transition", "transition_fuchs", "gravitational"};
  keys.section(Presence::optional, "The gas around the particles, for the physical kernels.");
  keys.quantity("temperature", units::temperature,
                temperatureRules().optional().onlyWith(
                    kernel, {"free_molecular", "continuum", "transition", "transition_fuchs", "gravitational"}),
                "Temperature of the gas.");
  keys.quantity("pressure", units::pressure, rules().optional().above(0).onlyWith(kernel, slip),
                "Pressure of the gas.");
  keys.quantity("viscosity", units::viscosity, rules().optional().above(0).onlyWith(kernel, slip),
                "Dynamic viscosity of the gas.");
  keys.quantity("mean_molecular_weight", units::molarMass, rules().optional().above(0).onlyWith(kernel, slip),
                "Mean molar mass of the gas.");
  keys.quantity("density", units::density, rules().optional().atLeast(0).onlyWith(kernel, {"gravitational"}),
                "Density of the gas, which the particles float in; 0 if not given.");
  schema.add(keys.schema());
}

}  // namespace

DeckSchema populationSchema() {
  SectionKeys keys("");
  keys.choice("problem", {"population_balance"}, rules(), "What is solved.");
  keys.text("name", rules().byDefault("''"), "Name of the case, for tables and pictures.");
  keys.text("title", rules().byDefault("''"), "One line for reports and pictures.");
  addParticleTypes(keys.schema());
  populationcase::addProcessKeys(keys.schema());
  addGas(keys.schema());
  keys.schema().add(populationcase::methodKeys());
  keys.schema().add(populationcase::outputKeys());
  return keys.schema();
}

}  // namespace lampblack::app
