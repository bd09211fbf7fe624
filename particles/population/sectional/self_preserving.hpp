// The self-preserving distribution: the shape that coagulation with a homogeneous kernel gives a population in the
// end, whatever its start, when volumes are measured by the mean volume (Friedlander and Wang 1966; Lai, Friedlander,
// Pich and Hidy 1972).
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/population_solver.hpp"
#include "particles/population/sectional/sectional_options.hpp"

namespace lampblack::particles {

// psi = n M_1 / M_0^2 as the mean over each bin of eta = v M_0 / M_1 between the increasing `edges`. Of any solver with
// a distribution, so that Monte Carlo and sections can be laid over each other. The integrals of psi and eta psi are 1.
[[nodiscard]] std::vector<double> reducedDistribution(const PopulationSolver& solver, std::span<const double> edges);

struct SelfPreservingDistribution {
  double geometricDeviation;         // of the diameter by number
  double change;                     // of that over the last factor of ten in number
  double time;                       // s
  std::vector<double> volumes, psi;  // eta of the pivots; psi, each pivot's number over the width of its section
};

// Coagulates `initial` by sections until its number has fallen by `decades` powers of ten, at least two. The kernel has
// to be homogeneous: one of the limits, not the transition between them. Throws what the solver throws, and InputError
// where the kernel is not.
[[nodiscard]] SelfPreservingDistribution selfPreserving(const CollisionKernelOptions& kernel, double density,
                                                        const InitialPopulation& initial,
                                                        const SectionalOptions& options, double decades);

// Gas in which Brownian particles are in the continuum whatever their size: a mean free path of zero in all but name.
[[nodiscard]] CarrierGas continuumLimit(CarrierGas gas);

}  // namespace lampblack::particles
