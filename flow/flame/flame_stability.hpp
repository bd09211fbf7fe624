// Whether a steady flame is one that lasts. Between the turning points of a branch (extinction, ignition) lie solutions
// of the steady equations that the least disturbance leaves: one real mode of the unsteady equations
//   M dx/dt = -F(x),   J = dF/dx,   disturbances ~ exp(lambda t):  det(J + lambda M) = 0
// has passed through lambda = 0 at the turn (Kubicek and Marek, Computational Methods in Bifurcation Theory and
// Dissipative Structures, 1983). The number of real lambda > s is odd where det(J + s M) has another sign than it has
// for s beyond every lambda. Nothing is to be known of the order or the signs of the equations; algebraic ones (mass
// flux, pressure gradient, the anchor of a free flame) are welcome.
//
// That is for slow modes, of which one is new next to a turning point. Farther away several may grow, also oscillating
// ones (hydrogen at high pressure has two): linear time steps amplify the one that grows fastest.
//
// What neither sees: oscillations that grow slower than they turn, and pairs of modes slower than 170/s.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "flow/flame/flame_equations.hpp"

namespace lampblack {

// The disturbance that grows.
struct GrowingMode {
  double rate = 0;                // 1/s
  std::vector<double> direction;  // of all unknowns; its largest change of temperature is +1 K
};

// Of a steady solution on the grid of `equations`, by the Newton matrix (transport coefficients as it has them).
// Empty: no growing mode was found. Overwrites the factors. Collective. NumericsError where the matrix is singular.
[[nodiscard]] std::optional<GrowingMode> growingMode(FlameEquations& equations, std::span<const double> x);

}  // namespace lampblack
