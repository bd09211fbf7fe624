#include "particles/population/monte_carlo/population_of.hpp"
#include "particles/population/monte_carlo/shipped_types.hpp"

namespace lampblack::particles {

std::unique_ptr<PopulationSolver> makeMonteCarlo(const Sphere& type, const PopulationModel& model,
                                                 const InitialPopulation& initial, const MonteCarloOptions& options) {
  return populationOf(type, model, initial, options);
}

std::unique_ptr<PopulationSolver> makeMonteCarlo(const PopulationModel& model, const InitialPopulation& initial,
                                                 const MonteCarloOptions& options) {
  return makeMonteCarlo(Sphere(model.density), model, initial, options);
}

}  // namespace lampblack::particles
