// The solutions behind exactSolution(), one class each in a file of its own. Rates that act on every particle alike -
// losses, condensation in proportion to the volume - are added by `scaledInTime`.
#pragma once

#include <memory>

#include "core/modules.hpp"
#include "particles/population/exact_solutions/exact_solution.hpp"

namespace lampblack::particles::exact {

// Coagulation alone with one of the three kernels of closed form; `rate` is its A.
std::unique_ptr<ExactSolution> coagulation(CollisionKernelType kernel, double rate, const InitialPopulation& initial);

// Breakage alone; null where no solution is known.
std::unique_ptr<ExactSolution> breakage(const BreakageOptions& options, const InitialPopulation& initial);

// A solution of coagulation or breakage alone, whose rate goes with v^degree, together with losses at the rate `loss`
// (1/s, of either sign) and dv/dt = condensation v.
std::unique_ptr<ExactSolution> scaledInTime(std::unique_ptr<ExactSolution> alone, double degree, bool pairs,
                                            double loss, double condensation);

// Constant kernel and binary uniform breakage at a rate in proportion to the volume, from an exponential distribution,
// which stays one.
std::unique_ptr<ExactSolution> exponentialForever(const PopulationModel& model, const InitialPopulation& initial);

// No interaction between particles: growth, nucleation, deposition, dilution. Null for what is left out.
std::unique_ptr<ExactSolution> transported(const PopulationModel& model, const InitialPopulation& initial);

// Everything whose equations of the moments close. Null where they do not.
std::unique_ptr<ExactSolution> closedMoments(const PopulationModel& model, const InitialPopulation& initial);

}  // namespace lampblack::particles::exact
