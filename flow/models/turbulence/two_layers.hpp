// A k-epsilon model that resolves the layers beside walls. Where Re_y = k^(1/2) d/nu is below 200 the lengths of
// dissipation and of eddies are algebraic (Wolfshtein 1969, with the constants of Chen and Patel, AIAA J. 26, 1988,
// 641):
//
//   epsilon = k^(3/2)/l_e, nu_t = C_mu k^(1/2) l_m, l = c_l d (1 - exp(-Re_y/A)), c_l = kappa C_mu^(-3/4),
//   A_e = 2 c_l, A_m = 70.
//
// At the wall itself epsilon is 2 nu k/d^2. Beyond, the model is what it is; its share goes from 0.01 to 0.99 between
// Re_y 160 and 240. Equations: docs/theory/turbulence.md.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/boundaries/wall_law.hpp"
#include "flow/models/turbulence/turbulence_model.hpp"

namespace lampblack::flow {

namespace twolayers {

inline constexpr double innerReynolds = 200.0, eddyDamping = 70.0;

struct Lengths {
  double outer = 1.0;   // the share of the model's own equations, 0 to 1
  double eddies = 0.0;  // m, l_m
  double decay = 0.0;   // 1/s, k^(1/2)/l_e: epsilon over k
};
// `energy`: m^2/s^2, k; `viscosity`: m^2/s, kinematic; `distance`: m, infinite where there are no walls.
[[nodiscard]] inline Lengths lengths(double energy, double viscosity, double distance) {
  const double speed = std::sqrt(std::max(energy, 1e-30)), reynolds = speed * distance / viscosity;
  constexpr double most = 3.0 * innerReynolds;
  if (!(reynolds < most)) return {};
  const double slope = walllaw::kappa / std::pow(walllaw::cMu, 0.75);
  const double width = 0.2 * innerReynolds / std::atanh(0.98);
  Lengths of;
  of.outer = 0.5 * (1.0 + std::tanh((reynolds - innerReynolds) / width));
  of.eddies = -slope * distance * std::expm1(-reynolds / eddyDamping);
  of.decay = -speed / (slope * distance * std::expm1(-0.5 * reynolds / slope));
  return of;
}

}  // namespace twolayers

// `Outer`: the model beyond, whose variables are k and epsilon.
template <class Outer>
struct TwoLayers {
  static constexpr bool needsWallDistance = true, needsStrainGradient = false;
  static constexpr SecondVariable second = Outer::second;
  static constexpr double wallBeta = Outer::wallBeta;
  Outer outer;

  [[nodiscard]] std::string name() const { return outer.name(); }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return outer.variables(); }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const { return outer.freeStream(stream); }
  [[nodiscard]] static double dissipation(std::span<const double> variables) { return Outer::dissipation(variables); }

  // Rates of both layers by their shares; in that of the inner one, whose eddies and k know nothing of it, epsilon is
  // held by a rate much faster than it decays.
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    TurbulentRates rates = outer.at(cell);
    const double k = std::max(cell.values[0], 0.0);
    const twolayers::Lengths of = twolayers::lengths(k, cell.viscosity, cell.distance);
    const double inner = 1.0 - of.outer;
    if (!(inner > 0.0)) return rates;
    const double eddies = walllaw::cMu * std::sqrt(k) * of.eddies;
    rates.eddyViscosity = of.outer * rates.eddyViscosity + inner * eddies;
    rates.diffusivity = {cell.viscosity + rates.eddyViscosity / Outer::sigmaK,
                         cell.viscosity + rates.eddyViscosity / Outer::sigmaEpsilon};
    for (const std::size_t v : {0, 1}) {
      rates.source[v] *= of.outer;
      rates.sink[v] *= of.outer;
    }
    rates.source[0] += inner * eddies * cell.strain * cell.strain;
    rates.sink[0] += inner * of.decay;
    rates.add(0, inner * (eddies * cell.buoyancy - 2.0 / 3.0 * k * cell.dilatation), k);
    rates.source[1] += inner * walllaw::holdsFaster * of.decay * of.decay * k;
    rates.sink[1] += inner * walllaw::holdsFaster * of.decay;
    return rates;
  }
};

}  // namespace lampblack::flow
