// The law of the wall, by which a k-epsilon model meets walls without resolving the layers beside them (Launder and
// Spalding 1974): of the centre of the cell beside a wall, with the friction velocity u* = C_mu^(1/4) k^(1/2) of the
// turbulent energy there and y* = u* y/nu; for models of two equations also of both layers at once, so that cells may
// be of any thickness. Heat and species by the function of Jayatilleke (1969).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/modules.hpp"
#include "flow/state.hpp"

namespace lampblack::flow::walllaw {

inline constexpr double cMu = 0.09, kappa = 0.41, smoothness = 9.8;
// y* where the layer ruled by viscosity and the logarithmic one meet: the larger root of y* = ln(9.8 y*)/0.41.
inline constexpr double meeting = 11.5301;

// m/s, of m^2/s^2.
[[nodiscard]] inline double frictionVelocity(double energy) {
  return std::sqrt(std::sqrt(cMu) * std::max(energy, 0.0));
}

[[nodiscard]] inline bool isLogarithmic(double yStar) {
  return yStar > meeting;
}

// The velocity over tau_w/(rho u*).
[[nodiscard]] inline double velocity(double yStar) {
  return isLogarithmic(yStar) ? std::log(smoothness * yStar) / kappa : yStar;
}

// By how much the viscous layer resists heat more than momentum, over Pr_t; `ratio`: Pr over Pr_t.
[[nodiscard]] inline double sublayerResistance(double ratio) {
  return 9.24 * (std::pow(ratio, 0.75) - 1.0) * (1.0 + 0.28 * std::exp(-0.007 * ratio));
}

// The same of heat or a species: its difference to the wall over flux/(rho u*) (of heat, over c_p); of Prandtl or
// Schmidt numbers. The lesser of the two layers' resistances, which are two curves that cross beyond the minimum of
// their difference.
[[nodiscard]] inline double scalar(double yStar, double number, double turbulentNumber) {
  const double viscous = number * yStar;
  if (yStar < turbulentNumber / (kappa * number)) return viscous;
  const double logarithmic =
      turbulentNumber * (std::log(smoothness * yStar) / kappa + sublayerResistance(number / turbulentNumber));
  return logarithmic > 0.0 ? std::min(viscous, logarithmic) : viscous;
}

// By how much faster than k decays epsilon is held where lengths or both layers at once give it: it is off by a share
// of one over that. In thin cells a rate of 10 000 times that of the decay would make a residual of round-off.
inline constexpr double holdsFaster = 1e2;

// y* up to which no eddies bring anything to the wall that a drift of a hundredth of u* would not: those of van
// Driest's mixing length, (0.41 y*^2/26)^2 nu there, over y*. Of a drift twice as fast it is a quarter more.
inline constexpr double still = 3.4;

// Of the resistance of scalar() what lies in the eddies, beyond that.
[[nodiscard]] inline double eddyPart(double yStar, double number, double turbulentNumber) {
  return std::max(scalar(yStar, number, turbulentNumber) - number * still, 0.0);
}

// Pa s, rho u* y of a cell whose centre is at a distance from the wall (m), of a state that has the law's energy.
[[nodiscard]] inline double exchange(const State& state, std::size_t cell, double distance) {
  const double energy =
      state.carried[cell * state.scalars.size() + static_cast<std::size_t>(state.wallEnergy)] / state.density[cell];
  return state.density[cell] * frictionVelocity(energy) * distance;
}

// How far a cell is in the logarithmic layer, 0 to 1: a smooth step in the logarithm of y* between half an octave below
// and above the meeting, so that k has a steady state where its y* is near it: the two layers' rates are not the same
// there.
[[nodiscard]] inline double logarithmicShare(double yStar) {
  constexpr double width = 0.5 * std::numbers::ln2;
  const double at = std::clamp(0.5 + 0.5 * std::log(std::max(yStar, 1e-30) / meeting) / width, 0.0, 1.0);
  return at * at * (3.0 - 2.0 * at);
}

// Both layers at once, at any y* (Menter and others 2003): of the friction that each would have the root of the fourth
// powers' sum, u+ = (1/y*^4 + 1/u_log^4)^(-1/4).
struct Blend {
  double friction = 1.0;  // over that of the viscous layer alone, y*/u+
  double slope = 1.0;     // du+/dy*
};
[[nodiscard]] inline Blend blended(double yStar) {
  constexpr double least = 3.0;  // below, the logarithm stays: it has no say there
  const double logarithm = std::log(smoothness * std::max(yStar, least)) / kappa;
  const double ratio = yStar / logarithm, sum = 1.0 + std::pow(ratio, 4);
  const double ofLogarithm = yStar > least ? ratio / (kappa * logarithm) * std::pow(ratio, 3) : 0.0;
  return {std::pow(sum, 0.25), (1.0 + ofLogarithm) / std::pow(sum, 1.25)};
}

// What the law makes of the cell: m^2/s^3, production and dissipation of k.
struct Layer {
  double production = 0.0, dissipation = 0.0;
  double frequency = 0.0, strain = 0.0;  // 1/s, omega and the shear; of the blended law alone
};
// `velocity`: m/s, along the wall; `viscosity`: m^2/s, kinematic; `distance`: m.
[[nodiscard]] inline Layer layer(double energy, double velocity, double viscosity, double distance) {
  const double friction = frictionVelocity(energy), yStar = friction * distance / viscosity;
  const double share = logarithmicShare(yStar), viscous = 2.0 * viscosity * energy / (distance * distance);
  if (share == 0.0) return {0.0, viscous};
  const double shear = friction * velocity / walllaw::velocity(yStar);  // m^2/s^2, tau_w/rho
  const double perLength = friction / (kappa * distance);
  return {share * shear * perLength, share * friction * friction * perLength + (1.0 - share) * viscous};
}

// The same by both layers, for models of two equations: omega is 6 nu/(beta y^2) of the viscous layer and
// k^(1/2)/(C_mu^(1/4) kappa y) of the logarithmic one, the root of their squares' sum; epsilon is C_mu k omega. What
// the viscosity does not take of the friction the eddies do, at the law's shear.
[[nodiscard]] inline Layer blendedLayer(double energy, double velocity, double viscosity, double distance,
                                        double beta) {
  const double friction = frictionVelocity(energy);
  const Blend blend = blended(friction * distance / viscosity);
  const double strain = blend.friction * blend.slope * velocity / distance;
  const double shear = blend.friction * viscosity * velocity / distance;  // m^2/s^2, tau_w/rho
  const double frequency =
      std::hypot(6.0 * viscosity / (beta * distance * distance), friction / (std::sqrt(cMu) * kappa * distance));
  return {(1.0 - blend.slope) * shear * strain, cMu * std::max(energy, 0.0) * frequency, frequency, strain};
}

}  // namespace lampblack::flow::walllaw
