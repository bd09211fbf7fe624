// The equation of omega, which every k-omega model has, for g = omega^(-1/2) (Kalitzin, Gould and Benton, AIAA
// 96-0327): g is zero at a smooth wall and linear beside it, where omega -> 6 nu/(beta y^2) has no value that a mesh
// could hold.
#pragma once

#include <algorithm>
#include <cmath>

#include "flow/models/turbulence/turbulence_model.hpp"

namespace lampblack::flow::turbulence {

inline constexpr std::size_t K = 0, G = 1;  // the variables

inline std::vector<TurbulenceModel::Variable> variablesOfKOmega() {
  return {{"turbulent_kinetic_energy", "m^2/s^2", "k of the turbulence model", 1.0},
          {"omega_root", "s^0.5", "omega^(-1/2) of the turbulence model", 1.0}};
}

inline std::array<double, 2> freeStreamOfKOmega(const FreeStream& stream) {
  return {stream.energy, std::sqrt(stream.eddyViscosity / stream.energy)};
}

// beta* k omega. Where g is zero, at a smooth wall, so is k.
inline double dissipationOfKOmega(double betaStar, std::span<const double> variables) {
  const double g = std::max(variables[G], 1e-12);
  return betaStar * std::max(variables[K], 0.0) / (g * g);
}

struct KOmegaState {
  double k, g, omega;
  double cross;   // 1/s^2, grad k . grad omega / omega
  double square;  // s/m^2, |grad g|^2
  explicit KOmegaState(const TurbulentCell& cell)
      : k(std::max(cell.values[K], 0.0)),
        g(std::max(cell.values[G], 1e-12)),
        omega(1.0 / (g * g)),
        cross(-2.0 * (dot(cell.gradients[K], cell.gradients[G]) + cell.productBeyond) / g),
        square(std::max(dot(cell.gradients[G], cell.gradients[G]) + cell.squareBeyond, 0.0)) {}
};

// `gained`: 1/s^2, what production and cross diffusion add to omega; its diffusivity is that of `rates`.
inline void addOmega(const KOmegaState& state, double beta, double gained, TurbulentRates& rates) {
  const double g = state.g;
  // -beta omega^2 gives beta/(2 g), by its tangent.
  rates.source[G] += beta / g;
  rates.sink[G] += 0.5 * beta / (g * g);
  rates.sink[G] += 3.0 * rates.diffusivity[G] * state.square / (g * g);
  rates.add(G, -0.5 * g * g * g * gained, g);
}

// `produced`: m^2/s^3, by strain; beside it what dilatation and buoyancy do.
inline void addEnergy(const TurbulentCell& cell, const KOmegaState& state, double produced, double betaStar,
                      TurbulentRates& rates) {
  rates.source[K] += produced;
  rates.sink[K] += betaStar * state.omega;
  rates.add(K, -2.0 / 3.0 * state.k * cell.dilatation, state.k);
  rates.add(K, rates.eddyViscosity * cell.buoyancy, state.k);
}

}  // namespace lampblack::flow::turbulence
