// What a wall takes of what drifts and diffuses to it, of particles that stay there first of all: then there are none
// at its surface. Between the place where an amount c per mass of gas is known, at a distance d, and the wall, the flux
// w c - rho D grad c is constant, so that
//
//   J = w c / (1 - exp(-w/g)) - w c_w / (exp(w/g) - 1) = takenByWall(w, g) c - takenByWall(-w, g) c_w,
//   g = rho A D / d,
//
// with c_w the amount at the surface, of particles zero, and w (kg/s) the mass of gas that would flow to the wall as
// they drift: w c where the drift rules, as the
// layer in which they diffuse is then thinner than the cell, and g c without drift (Scharfetter and Gummel 1969, eq. 8,
// have this flux of drift and diffusion). Derivation and limits: docs/theory/flow.md, "Particles at walls".
#pragma once

#include <algorithm>
#include <cmath>

#include "core/modules.hpp"

namespace lampblack::flow {

// J per c, kg/s: of the drift `w`, above zero towards the wall, and the conductance `g` of diffusion, kg/s, from zero
// on. Never negative; rises with both.
[[nodiscard]] inline double takenByWall(double w, double g) {
  if (!(g > 0.0)) return std::max(w, 0.0);
  const double ratio = w / g;
  if (std::abs(ratio) < 1e-6) return g + 0.5 * w;
  return -w / std::expm1(-ratio);
}

// What eddies between the place where c is known and that layer leave of J, as a factor on both of its parts: `taken`
// is takenByWall() of the layer, kg/s, and the resistance of the eddies in s/kg.
[[nodiscard]] inline double behindEddies(double taken, double resistance) {
  return 1.0 / (1.0 + taken * resistance);
}

// Which share of the change of c over that distance, outside of the layer in which they diffuse, the drift sees: 1
// where it rules, 0 where diffusion does, or where it leads away from the wall.
[[nodiscard]] inline double outsideWallLayer(double w, double g) {
  if (!(w > 0.0)) return 0.0;
  if (!(g > 0.0)) return 1.0;
  const double ratio = w / g;
  if (ratio < 1e-2) return ratio / 6.0;
  return 1.0 / std::tanh(0.5 * ratio) - 2.0 / ratio;
}

// J per the c at the wall itself of a scheme whose last flux, over the same distance, is
// max(w, 0) c_before + min(w, 0) c_wall + g (c_before - c_wall): with this both are the flux J of c_before, and c_wall
// is next to nothing where diffusion rules, and c_before where the drift does.
[[nodiscard]] inline double takenAtWall(double w, double g) {
  if (!(g > 0.0)) return std::max(w, 0.0);
  // Without drift c_wall is zero: no larger ratio of the two values than this tells.
  constexpr double least = 1e-3;
  const double drift = std::copysign(std::max(std::abs(w), least * g), w);
  const double taken = takenByWall(drift, g);
  return taken * (g + std::max(-drift, 0.0)) / (g + std::max(drift, 0.0) - taken);
}

}  // namespace lampblack::flow
