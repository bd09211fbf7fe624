// Limited second-order upwind interpolation to a face: between the neighbours' values for what has bounds, and one that
// keeps smooth extrema for velocities.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/modules.hpp"
#include "flow/discretisation/upwind.hpp"

namespace lampblack::flow {

// Face value between the upwind value `up` and the downwind value `down`. `gradient` is that of the upwind cell along
// the direction up -> down, by the parabola of Gradient. Between the values of both sides' neighbours whatever the
// distances are, so that steps of half a cell's volume make no new extrema.
//
// van Leer's limiter (1974), the harmonic mean of the slopes ahead and behind, on a graded mesh with the weights by
// which the arithmetic mean is the parabola's slope (as Fritsch and Butland 1984 have them for interpolation).
inline double limitedFaceValue(double up, double down, double gradient, const Upwind& at) {
  const double ahead = (down - up) / at.ahead;
  const double behind = gradient + (gradient - ahead) * at.behind / at.ahead;
  const bool isMonotone = ahead * behind > 0.0;
  const double sum = at.ahead * ahead + at.behind * behind;
  // Without a branch, so that a loop over species goes through vectors.
  const double slope = (at.ahead + at.behind) * ahead * behind / (isMonotone ? sum : 1.0);
  const double largest = std::min(std::abs(down - up), std::abs(behind) * at.behind);
  const double step = std::copysign(std::min(std::abs(slope) * at.toFace, largest), slope);
  return up + (isMonotone ? step : 0.0);
}

// For velocities, which may pass their neighbours': where the field is smooth the value along the parabola's own slope,
// at crests and troughs too, where the above is the upwind value. In the spirit of Colella and Sekora (2008) a field is
// smooth where the curvatures of the upwind and the downwind cell have one sign and like sizes: the smaller of them,
// the downwind one with some margin, is the share of the upwind cell's that is believed. `gradient` and
// `gradientBeyond`: those of the upwind and the downwind cell along up -> down.
inline double smoothFaceValue(double up, double down, double gradient, double gradientBeyond, const Upwind& at) {
  constexpr double margin = 1.25;
  const double limited = limitedFaceValue(up, down, gradient, at);
  // Curvatures times half of the distance, of the parabolas through either cell's value and slope and the other value.
  const double ahead = (down - up) / at.ahead;
  const double own = ahead - gradient, beyond = gradientBeyond - ahead;
  if (!(own * beyond > 0.0)) return limited;
  const double share = std::min(1.0, margin * beyond / own);
  return limited + share * (up + gradient * at.toFace - limited);
}

// For velocities of flows whose vortices are a few cells wide: nearly central. A third linear interpolation between the
// cells and two thirds the mean of what both extrapolate to the face, which on even cells makes the convection of
// fourth order, and of the difference of the two extrapolations, which a smooth flow does not have, as much as takes
// from the shortest waves what a central scheme would leave to pile up.
inline double centralFaceValue(double up, double down, double gradient, double gradientBeyond, const Upwind& at) {
  constexpr double damping = 0.1;
  const double ofUp = up + gradient * at.toFace;
  const double ofDown = down - gradientBeyond * (at.ahead - at.toFace);
  const double linear = up + (down - up) * at.toFace / at.ahead;
  return linear / 3.0 + (ofUp + ofDown) / 3.0 + 0.5 * damping * (ofUp - ofDown);
}

// What a value at the place where the step meets the face differs by from that at the face's centre, `slope` being the
// upwind cell's along Mesh::offset: as much of it as the limiter has left of the step along `gradient`.
inline double limitedOffset(double value, double up, double gradient, double slope, const Upwind& at) {
  const double whole = gradient * at.toFace, limited = value - up;
  if (!(whole * limited > 0.0)) return 0.0;
  return slope * std::min(1.0, limited / whole);
}

// A face value on cells without order, where nothing may lie straight behind: within the values of the upwind cell `up`
// and of the cells around it, and no further from its own than they reach on the other side, so that what leaves a cell
// in a step of half of its volume leaves no new extreme.
inline double boundedFaceValue(double value, double up, double smallest, double largest) {
  const double below = up - smallest, above = largest - up;
  return std::clamp(value, up - std::min(below, above), up + std::min(below, above));
}

}  // namespace lampblack::flow
