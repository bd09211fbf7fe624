// The Monte Carlo solvers of the particle types that come with Lampblack. Throw InputError.
#pragma once

#include "core/modules.hpp"
#include "particles/population/model/components.hpp"
#include "particles/population/model/fractal_aggregate.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/model/surface_volume.hpp"
#include "particles/population/monte_carlo_options.hpp"

namespace lampblack::particles {

[[nodiscard]] std::unique_ptr<PopulationSolver> makeMonteCarlo(const Sphere& type, const PopulationModel& model,
                                                               const InitialPopulation& initial,
                                                               const MonteCarloOptions& options);
[[nodiscard]] std::unique_ptr<PopulationSolver> makeMonteCarlo(const FractalAggregate& type,
                                                               const PopulationModel& model,
                                                               const InitialPopulation& initial,
                                                               const MonteCarloOptions& options);
[[nodiscard]] std::unique_ptr<PopulationSolver> makeMonteCarlo(const SurfaceVolume& type, const PopulationModel& model,
                                                               const InitialPopulation& initial,
                                                               const MonteCarloOptions& options);
[[nodiscard]] std::unique_ptr<PopulationSolver> makeMonteCarlo(const Components& type, const PopulationModel& model,
                                                               const InitialPopulation& initial,
                                                               const MonteCarloOptions& options);

}  // namespace lampblack::particles
