// How much is left of all equations, by which iterations go on.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "flow/steady/steadiness.hpp"
#include "flow/steady/steady_iteration.hpp"

namespace lampblack::flow {

double SteadyIteration::through(const State& state) const {
  double sum = 0.0;
  for (int face = 0; face < context_.mesh.faces; ++face)
    if (context_.mesh.low[face] < context_.mesh.owned) sum += std::abs(state.massFlux[face]);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  return std::max(sum, 1e-300);
}

double SteadyIteration::ofCarried(const State& state, double through) const {
  const FlowResidual::Rates& rates = residual_.rates();
  const std::size_t n = state.scalars.size();
  std::vector<double> sums(2 * n, 0.0), most(n, 0.0);
  for (std::size_t s = 0; s < n; ++s) most[s] = LeastScales::carried * state.scalars[s].negligible;
  for (std::size_t c = 0; c < static_cast<std::size_t>(context_.mesh.owned); ++c)
    for (std::size_t s = 0; s < n; ++s) {
      const std::size_t i = c * n + s;
      const double perMass = state.carried[i] / state.density[c];
      if (!state.scalars[s].isTransported) continue;
      sums[s] += std::abs(rates.carried[i] - perMass * rates.mass[c]);
      sums[n + s] += context_.mesh.volume[c] * std::max(rates.made.netOfCarried(i, state.carried), 0.0);
      most[s] = std::max(most[s], std::abs(perMass));
    }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(2 * n), MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  MPI_Allreduce(MPI_IN_PLACE, most.data(), static_cast<int>(n), MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
  double sum = 0.0;
  for (std::size_t s = 0; s < n; ++s)
    if (const double size = through * most[s] + sums[n + s]; size > 0.0) sum += sums[s] / size;
  return n > 0 ? sum / static_cast<double>(n) : 0.0;
}

double SteadyIteration::measure(const State& state) const {
  const Mesh& m = context_.mesh;
  const FlowResidual::Rates& rates = residual_.rates();
  const auto n = static_cast<std::size_t>(state.species), d = static_cast<std::size_t>(state.dimension);
  enum { Mass, Fluxes, Momentum, Heat, Species, Equations };
  std::array<double, Equations> sums{};
  std::array<double, 3> ends{0.0, -1e300, -1e300};
  for (int face = 0; face < m.faces; ++face)
    if (m.low[face] < m.owned) sums[Fluxes] += std::abs(rates.massFlux[face]);
  std::vector<double> enthalpies(n);
  for (int cell = 0; cell < m.owned; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    sums[Mass] += std::abs(rates.mass[c]);
    double speed = 0.0;
    for (std::size_t i = 0; i < d; ++i) {
      sums[Momentum] += std::abs(rates.momentum[c * d + i]);
      speed += std::abs(state.velocity[c * d + i]);
    }
    context_.thermo.speciesEnthalpies(state.temperature[c], enthalpies);
    double heat = rates.enthalpy[c] - state.enthalpy[c] * rates.mass[c];
    for (std::size_t k = 0; k < n; ++k) {
      const double left = rates.species[c * n + k] - state.Y[c * n + k] * rates.mass[c];
      heat -= enthalpies[k] * left;
      sums[Species] += std::abs(left);
    }
    sums[Heat] += std::abs(heat) / residual_.properties().heatCapacity[c];
    ends = {std::max(ends[0], speed), std::max(ends[1], state.temperature[c]),
            std::max(ends[2], -state.temperature[c])};
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), Equations, MPI_DOUBLE, MPI_SUM, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), 3, MPI_DOUBLE, MPI_MAX, m.comm);
  const double through = this->through(state);
  return ofCarried(state, through) + (sums[Mass] + sums[Fluxes] + sums[Momentum] / std::max(ends[0], 1e-300) +
                                      sums[Heat] / std::max(ends[1] + ends[2], 1e-3 * ends[1]) + sums[Species]) /
                                         through;
}

}  // namespace lampblack::flow
