// Moment methods: the population by its first moments, closed by quadrature (QMOM; McGraw 1997) or by interpolation of
// the logarithms of the moments (MOMIC; Frenklach and Harris 1987; Frenklach 2002).
#pragma once

#include <cstddef>
#include <memory>

#include "particles/population/population_solver.hpp"

namespace lampblack {

enum class MomentMethod { qmom, momic };
enum class QuadratureInversion { wheeler, productDifference };

struct MomentOptions {
  MomentMethod method = MomentMethod::qmom;
  std::size_t moments = 6;  // even for QMOM: twice the number of nodes; 3 to 8 for MOMIC
  QuadratureInversion inversion = QuadratureInversion::wheeler;
  double relativeTolerance = 1e-8;
};

// Coalescing spheres. Throws InputError for a process or kernel the closure cannot do.
[[nodiscard]] std::unique_ptr<PopulationSolver> makeMoments(const PopulationModel& model,
                                                            const InitialPopulation& initial,
                                                            const MomentOptions& options);

}  // namespace lampblack
