#include "particles/population/sectional/self_preserving.hpp"

#include <cmath>

#include "core/errors.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/sectional/sectional_solver.hpp"

namespace lampblack::particles {

std::vector<double> reducedDistribution(const PopulationSolver& solver, std::span<const double> edges) {
  const auto moments = solver.moments();
  const double mean = moments[1] / moments[0];
  std::vector<double> volumes(edges.begin(), edges.end());
  for (double& v : volumes) v *= mean;
  std::vector<double> psi = solver.numberInBins(volumes);
  for (std::size_t b = 0; b < psi.size(); ++b) psi[b] /= moments[0] * (edges[b + 1] - edges[b]);
  return psi;
}

CarrierGas continuumLimit(CarrierGas gas) {
  gas.pressure = 1e20;
  return gas;
}

SelfPreservingDistribution selfPreserving(const CollisionKernelOptions& kernel, double density,
                                          const InitialPopulation& initial, const SectionalOptions& options,
                                          double decades) {
  if (kernel.type == CollisionKernelType::transition || kernel.type == CollisionKernelType::transitionFuchs ||
      kernel.efficiencyDiameter > 0) {
    throw InputError("a kernel that depends on a length has no self-preserving distribution");
  }
  if (!(decades >= 2)) throw InputError("the number has to fall by two decades at least");
  PopulationModel model;
  model.coagulation = kernel;
  model.density = density;
  SectionalSolver solver(model, initial, options);
  const double number = solver.moments()[0], volume = solver.moments()[1] / number;
  // Longer and longer: number falls like a power of time.
  const auto particle = kernelProperties(CollisionKernel(kernel), Sphere(density), {volume});
  double end = 0.5 / (CollisionKernel(kernel).value(particle, particle) * number);
  double before = 0;
  while (solver.moments()[0] > number * std::pow(10.0, -decades)) {
    solver.advance(end);
    end *= 2;
    if (solver.moments()[0] > number * std::pow(10.0, 1 - decades)) before = solver.geometricDeviation();
  }
  SelfPreservingDistribution result;
  result.geometricDeviation = solver.geometricDeviation();
  result.change = result.geometricDeviation - before;
  result.time = solver.time();
  const auto moments = solver.moments();
  const double mean = moments[1] / moments[0];
  // Between the harmonic means with the neighbouring pivots.
  const double spacing = solver.volumes()[2] / solver.volumes()[1], width = 2 * (spacing - 1) / (spacing + 1);
  for (std::size_t k = 1; k < solver.volumes().size(); ++k) {
    const double eta = solver.volumes()[k] / mean;
    result.volumes.push_back(eta);
    result.psi.push_back(solver.numbers()[k] / (moments[0] * width * eta));
  }
  return result;
}

}  // namespace lampblack::particles
