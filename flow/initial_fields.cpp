#include "flow/initial_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"

namespace lampblack::flow {

void setInitialFields(const FlowContext& context, const InitialFields& fields, State& state) {
  const Mesh& m = context.mesh;
  const auto n = static_cast<std::size_t>(state.species);
  std::vector<double> Y(n);
  if (fields.thermodynamicPressure) state.thermodynamicPressure = *fields.thermodynamicPressure;
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.cells); ++c) try {
      const auto d = static_cast<std::size_t>(m.dimension);
      for (std::size_t i = 0; i < d; ++i)
        if (fields.velocity[i]) state.velocity[d * c + i] = fields.velocity[i](m.centre[c], 0.0);
      if (fields.swirl) state.swirl[c] = fields.swirl(m.centre[c], 0.0);
      for (std::size_t s = 0; s < fields.carried.size(); ++s)
        state.carried[c * state.scalars.size() + s] = fields.carried[s](m.centre[c], 0.0);
      Y.assign(&state.Y[c * n], &state.Y[c * n] + n);
      double T = state.temperature[c];
      fields.gas.apply(m.centre[c], 0.0, context.thermo, T, Y);
      std::copy(Y.begin(), Y.end(), &state.Y[c * n]);
      state.temperature[c] = T;
      state.enthalpy[c] = context.thermo.enthalpyMass(T, Y);
      state.density[c] = context.thermo.density(T, state.thermodynamicPressure, Y);
    } catch (const InputError& error) {
      throw InputError(fmt::format("initial: the start at {}: {}", placeText(m.centre[c], m.dimension), error.what()));
    }
}

}  // namespace lampblack::flow
