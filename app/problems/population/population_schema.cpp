#include "app/deck/initial_distribution.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/problems/population/population_case_parts.hpp"

namespace lampblack::app {
namespace {

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

}  // namespace

DeckSchema populationSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"population_balance"}, "What is solved."))
      .add(stringKey("name", "Name of the case, for tables and pictures.").byDefault("''"))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addParticleTypes(schema);
  populationcase::addProcessKeys(schema);
  addGas(schema);
  schema.add(populationcase::methodKeys());
  schema.add(populationcase::outputKeys());
  return schema;
}

}  // namespace lampblack::app
