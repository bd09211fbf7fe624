#include "particles/population/exact_solutions/exact_solution.hpp"

namespace lampblack {

std::unique_ptr<ExactSolution> exactSolution(const PopulationModel&, const InitialPopulation&) {
  return nullptr;
}

}  // namespace lampblack
