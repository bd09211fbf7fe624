// The sectional method: the volume axis in geometric sections, each with its number in a fixed pivot; number and mass
// are conserved by every process (Kumar and Ramkrishna 1996). Integrated by CVODES. See
// docs/theory/population_balance/sections.md.
#pragma once

#include <cstddef>
#include <memory>

#include "core/modules.hpp"
#include "particles/population/population_solver.hpp"

namespace lampblack::particles {

// How continuous growth and shrinkage move number between pivots. Both conserve number and give exactly dv/dt of mass.
enum class SectionGrowthScheme {
  upwind,  // donor cell: first order, spreads the volumes by (spacing - 1) v dv/dt of variance in unit time
  limited  // second order where the spectrum is smooth, upwind where it is steep
};

struct SectionalOptions {
  std::size_t sections = 100;  // 20 to 400
  double smallest = 0;         // m3, volume of the first pivot
  double spacing = 0;          // ratio of neighbouring pivots, above 1; zero: from `largest`
  double largest = 0;          // m3, volume of the last pivot; zero: from `spacing`
  double relativeTolerance = 1e-8;
  double absoluteTolerance = 1e-12;  // of the number of particles of a section that would hold all of any of M_0 to M_3
  SectionGrowthScheme growth = SectionGrowthScheme::limited;
  double overflow = 1e-6;  // part of the volume that may pass the last pivot before that is an error
};

// Coalescing spheres. Throws InputError; the solver throws NumericsError when more than `overflow` of the volume has
// grown beyond the last pivot, and GelationError when it is a kernel that gels. The solver is a SectionalSolver.
[[nodiscard]] std::unique_ptr<PopulationSolver> makeSectional(const PopulationModel& model,
                                                              const InitialPopulation& initial,
                                                              const SectionalOptions& options);

}  // namespace lampblack::particles
