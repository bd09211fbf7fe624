#include "flow/steady/lighting.hpp"

#include <algorithm>
#include <vector>

#include "core/errors.hpp"
#include "flow/burnt_mixture.hpp"

namespace lampblack::flow {
namespace {

constexpr double hottestLit = 2200.0;  // K

}  // namespace

std::int64_t lightMixture(const FlowContext& context, State& state) {
  const auto n = static_cast<std::size_t>(state.species);
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
      state.density[c] = context.thermo.density(T, state.thermodynamicPressure, Y);
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, &lit, 1, MPI_INT64_T, MPI_SUM, context.mesh.comm);
  state.updateHalo(context.halo);
  return lit;
}

}  // namespace lampblack::flow
