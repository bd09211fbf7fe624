#include "core/errors.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/monte_carlo/equal_weight_solver.hpp"
#include "particles/population/monte_carlo/hybrid_solver.hpp"
#include "particles/population/monte_carlo/weighted_solver.hpp"

namespace lampblack {

std::unique_ptr<PopulationSolver> makeMonteCarlo(const PopulationModel& model, const InitialPopulation& initial,
                                                 const MonteCarloOptions& options) {
  check(model, initial);
  const Sphere sphere(model.density);
  switch (options.method) {
    case MonteCarloMethod::dsmc:
    case MonteCarloMethod::constantVolume:
    case MonteCarloMethod::constantNumberByMass:
    case MonteCarloMethod::constantNumberByNumber:
      return makeEqualWeight(sphere, model, initial, options);
    case MonteCarloMethod::hybrid:
      return makeHybrid(sphere, model, initial, options);
    case MonteCarloMethod::mmc:
    case MonteCarloMethod::wfmc:
    case MonteCarloMethod::samwfmc:
    case MonteCarloMethod::sammc:
    case MonteCarloMethod::swa:
      return makeWeighted(sphere, model, initial, options);
  }
  throw InputError("there is no such method");
}

}  // namespace lampblack
