// Whether a steady flame is one that lasts. Between the turning points of a branch (extinction, ignition) lie solutions
// of the steady equations that the least disturbance leaves: a mode of the unsteady equations
//   M dx/dt = -F(x),   J = dF/dx,   disturbances ~ exp(lambda t):  (J + lambda M) v = 0
// grows. Arnoldi's method on (J + s M)^-1 M, whose eigenvalues are 1/(s - lambda), finds the modes nearest to s:
//  - s = 0, with the factors of the steady Newton matrix: a mode that is new next to a turning point is slow, and
//  1/lambda
//    then large and of the other sign than those of modes that decay;
//  - s = 3e4 1/s: fast modes, of which several may grow (hydrogen at high pressure has two).
// Besides, the number of real lambda in (0, s) is odd where det J and det(J + s M) have different signs (Kubicek and
// Marek 1983): a single mode is not missed,
// whatever Arnoldi's method has seen. Nothing is to be known of the order or the signs of the equations; algebraic ones
// (mass flux, pressure gradient, the anchor of a free flame) are welcome.
//
// Mass fractions keep their sum of one: the equation of their sum knows nothing of the rest, and disturbances without a
// sum stay so. Others are the equations' own error at a wall, where nothing flows, and are projected away.
//
// What is not counted: oscillations that turn more than 1.7 times as fast as they grow; pairs of modes that are slower
// than 1000/s but faster than ten times the slowest decay of the flame (its strain, or flow over length); and what is
// faster than 1.8e5/s.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_equations.hpp"

namespace lampblack::flow {

// The disturbance that grows.
struct GrowingMode {
  double rate = 0;                // 1/s
  std::vector<double> direction;  // of all unknowns; its largest change of temperature is +1 K
};

// Of a steady solution on the grid of `equations`, by the Newton matrix (transport coefficients as it has them): the
// mode that grows fastest. Empty: none was found. The factors at hand are taken for those of the steady matrix where
// they are of a steady one and `atHand`; they are overwritten. Collective. NumericsError where the matrix is singular.
[[nodiscard]] std::optional<GrowingMode> growingMode(FlameEquations& equations, std::span<const double> x,
                                                     bool atHand = false);

// By the signs of determinants alone, bisected: about ten factorisations. Empty where an even number of real modes
// grows more slowly than 3e4 1/s, or where what grows is the sum of the mass fractions.
[[nodiscard]] std::optional<GrowingMode> singleGrowingMode(FlameEquations& equations, std::span<const double> x);

}  // namespace lampblack::flow
