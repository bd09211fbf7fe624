// Makes the Monte Carlo solver of any particle type. A type of one's own is solved by including this header; the
// library has the shipped types compiled in.
#pragma once

#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/population/monte_carlo_options.hpp"

namespace lampblack::particles {

// One maker for each family of methods, defined in equal_weight_solver.hpp, weighted_solver.hpp, pair_solver.hpp and
// hybrid_solver.hpp.
template <ParticleType Type>
std::unique_ptr<PopulationSolver> makeEqualWeight(const Type&, const PopulationModel&, const InitialPopulation&,
                                                  const MonteCarloOptions&);
template <ParticleType Type>
std::unique_ptr<PopulationSolver> makeWeighted(const Type&, const PopulationModel&, const InitialPopulation&,
                                               const MonteCarloOptions&);
template <ParticleType Type>
std::unique_ptr<PopulationSolver> makePairs(const Type&, const PopulationModel&, const InitialPopulation&,
                                            const MonteCarloOptions&);
template <ParticleType Type>
std::unique_ptr<PopulationSolver> makeHybrid(const Type&, const PopulationModel&, const InitialPopulation&,
                                             const MonteCarloOptions&);

}  // namespace lampblack::particles
