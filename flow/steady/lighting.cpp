#include "flow/steady/lighting.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/errors.hpp"
#include "flow/burnt_mixture.hpp"

namespace lampblack::flow {
namespace {

constexpr double hottestLit = 2200.0;  // K
constexpr double coldMixture = 300.0;  // K
// Mass of one gas in another that is looked at: a half, a quarter, to a 128th; hydrogen in air burns most with a 35th.
constexpr int sharesOfMixtures = 7;

// Mass fractions of the mean gas of the domain, and of what boundaries are given. Collective.
std::vector<std::vector<double>> gasesOf(const FlowContext& context, const State& state) {
  const Mesh& m = context.mesh;
  const auto n = static_cast<std::size_t>(state.species);
  std::vector<double> mean(n + 1, 0.0);
  for (int c = 0; c < m.owned; ++c) {
    const double mass = m.volume[c] * state.density[c];
    for (std::size_t k = 0; k < n; ++k) mean[k] += mass * std::max(state.Y[c * n + k], 0.0);
  }
  MPI_Allreduce(MPI_IN_PLACE, mean.data(), static_cast<int>(n), MPI_DOUBLE, MPI_SUM, m.comm);
  mean.pop_back();
  std::vector<std::vector<double>> gases{mean};
  for (const BoundaryCondition& boundary : context.boundaries)
    if (boundary.Y.size() == n) gases.push_back(boundary.Y);
  std::erase_if(gases, [](const auto& Y) { return std::reduce(Y.begin(), Y.end()) <= 0.0; });
  for (std::vector<double>& Y : gases) {
    const double sum = std::reduce(Y.begin(), Y.end());
    for (double& y : Y) y /= sum;
  }
  return gases;
}

}  // namespace

std::int64_t lightMixture(const FlowContext& context, State& state) {
  const auto n = static_cast<std::size_t>(state.species);
  const std::size_t scalars = state.scalars.size();
  std::int64_t lit = 0;
  collectively(context.mesh.comm, [&] {
    BurntMixture burnt(context.mechanism, context.thermo);
    std::vector<double> Y(n);
    for (int c = 0; c < context.mesh.owned; ++c) {
      const double* of = &state.Y[c * n];
      std::transform(of, of + n, Y.begin(), [](double y) { return std::max(y, 0.0); });
      const double T = burnt.burn(state.enthalpy[c], state.thermodynamicPressure, hottestLit, Y);
      if (T < state.temperature[c] + leastRiseOfLighting) continue;
      ++lit;
      std::ranges::copy(Y, &state.Y[c * n]);
      state.temperature[c] = T;
      state.enthalpy[c] = context.thermo.enthalpyMass(T, Y);
      const double before = state.density[c];
      state.density[c] = context.thermo.density(T, state.thermodynamicPressure, Y);
      for (std::size_t s = 0; s < scalars; ++s)
        if (state.scalars[s].isTransported) state.carried[c * scalars + s] *= state.density[c] / before;
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, &lit, 1, MPI_INT64_T, MPI_SUM, context.mesh.comm);
  state.updateHalo(context.halo);
  return lit;
}

bool couldBurn(const FlowContext& context, const State& state) {
  if (context.mechanism.numReactions() == 0) return false;
  const std::vector<std::vector<double>> gases = gasesOf(context, state);
  BurntMixture burnt(context.mechanism, context.thermo);
  std::vector<double> Y(static_cast<std::size_t>(state.species));
  const auto burns = [&](const std::vector<double>& one, const std::vector<double>& other, double share) {
    for (std::size_t k = 0; k < Y.size(); ++k) Y[k] = share * one[k] + (1.0 - share) * other[k];
    const double enthalpy = context.thermo.enthalpyMass(coldMixture, Y);
    return burnt.burn(enthalpy, state.thermodynamicPressure, hottestLit, Y) >= coldMixture + leastRiseOfLighting;
  };
  bool could = false;
  collectively(context.mesh.comm, [&] {
    for (const std::vector<double>& one : gases)
      for (const std::vector<double>& other : gases)
        for (int i = 0; i < sharesOfMixtures && !could; ++i) could = burns(one, other, std::ldexp(0.5, -i));
  });
  return could;
}

}  // namespace lampblack::flow
