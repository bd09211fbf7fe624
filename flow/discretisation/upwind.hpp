// What an upwind scheme sees of an interior face: the cell upwind of it, the one downwind, and the distances between
// them and to what lies behind.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

struct Upwind {
  int up = 0, down = 0;  // cells
  double ahead = 0.0;    // m, up -> down
  double behind = 0.0;   // m, from the place behind `up` to it: its neighbour on the other side, or the boundary
  double toFace = 0.0;   // m, from `up` to where the step to `down` meets the face
  Vector3 direction{};   // up -> down, of length one
};

// The part of a cell's gradient along a direction.
inline double slopeAlong(const Vector3& direction, const double* gradient, int dimension) {
  double slope = 0.0;
  for (int i = 0; i < dimension; ++i) slope += direction[i] * gradient[i];
  return slope;
}

// The same for all faces of a mesh and a field whose boundaries are known as Gradient is told.
class UpwindGeometry {
 public:
  // Collective. `known`: a flag a boundary face, or none for Value everywhere.
  UpwindGeometry(const FlowContext& context, std::span<const BoundaryData> known);

  // Upwind of `flux`, of any quantity with the sign of the direction low to high.
  [[nodiscard]] Upwind of(int face, double flux) const {
    const Mesh& m = mesh_;
    const double w = m.lowWeight[face];
    const double spacing = m.spacing(face);
    if (flux >= 0.0)
      return {m.low[face],
              m.high[face],
              spacing,
              distanceBehind(2 * face),
              (1.0 - w) * spacing,
              scaled(m.step[face], 1.0 / spacing)};
    return {m.high[face], m.low[face],
            spacing,      distanceBehind(2 * face + 1),
            w * spacing,  scaled(m.step[face], -1.0 / spacing)};
  }

 private:
  [[nodiscard]] double distanceBehind(int side) const {
    const int behind = behind_[side];
    return behind < 0 ? own_[-1 - behind] : mesh_.spacing(behind);
  }

  const Mesh& mesh_;
  // Of each interior face's low and high cell: the face behind it whose distance counts, or -1 - the place in own_ of a
  // distance that is no face's, or of a halo cell, whose faces are not all here. The face itself where the cell has
  // none on the other side.
  std::vector<int> behind_;
  std::vector<double> own_;  // m
};

}  // namespace lampblack::flow
