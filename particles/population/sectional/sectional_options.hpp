// The sectional method: the volume axis in geometric sections, each with its number in a fixed pivot; number and mass
// are conserved by every process (Kumar and Ramkrishna 1996). Integrated by CVODE.
#pragma once

#include <cstddef>
#include <memory>

#include "particles/population/population_solver.hpp"

namespace lampblack {

struct SectionalOptions {
  std::size_t sections = 100;  // 20 to 400
  double smallest = 0;         // m3, volume of the first pivot
  double spacing = 0;          // ratio of neighbouring pivots, above 1; zero: from `largest`
  double largest = 0;          // m3, volume of the last pivot
  double relativeTolerance = 1e-8;
  double absoluteTolerance = 1e-12;  // of the initial or largest number density
};

// Coalescing spheres. Throws InputError; the solver throws NumericsError when particles reach the last section.
[[nodiscard]] std::unique_ptr<PopulationSolver> makeSectional(const PopulationModel& model,
                                                              const InitialPopulation& initial,
                                                              const SectionalOptions& options);

}  // namespace lampblack
