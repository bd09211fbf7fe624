#include "core/errors.hpp"
#include "particles/population/monte_carlo/monte_carlo_options.hpp"

namespace lampblack {

std::unique_ptr<PopulationSolver> makeMonteCarlo(const PopulationModel&, const InitialPopulation&,
                                                 const MonteCarloOptions&) {
  throw InputError("this method is not available yet");
}

}  // namespace lampblack
