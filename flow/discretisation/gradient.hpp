// Cell gradients by least squares over the cells beyond the faces (core/least_squares.hpp), which on a box is the slope
// of the parabola along each axis: second order on graded boxes, first on cells without order, where it is exact for
// linear fields.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/mesh.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

// What is known of a field at a boundary face.
enum class BoundaryData : char {
  Value,      // its value there
  ZeroSlope,  // that it has no gradient normal to the face: an axis, a plane of symmetry, an adiabatic wall
  Nothing,    // the slope towards the face is that on the cell's other side
};

class Gradient {
 public:
  explicit Gradient(const Mesh& mesh);

  // Gradient of `components` values a cell (halo filled) in the owned cells: gradient[(cell * components + k) *
  // dimension + axis]. `boundary` holds the value at each boundary face (components a face), read where `known` says
  // Value. `known` has a flag a boundary face, or a flag a component of each, or none for Value everywhere.
  void compute(std::span<const double> values, std::span<const double> boundary, int components,
               std::span<double> gradient, std::span<const BoundaryData> known = {}) const;

  // Its part along a direction, of any length, in one owned cell: slope[k]; `known` has a flag a boundary face.
  void along(const Vector3& direction, int cell, std::span<const double> values, std::span<const double> boundary,
             int components, std::span<double> slope, std::span<const BoundaryData> known = {}) const;

  // Of two values a cell, `a` and `b` > 0, with the gradients that compute() gives: by how much grad a . grad b and
  // |grad b|^2 as means over the slopes towards the neighbours, weighted as the differences are in the gradient, exceed
  // those of the gradients themselves. Of second order with and without. The means lean to the side where `a` is
  // steeper, as an upwind scheme for b would, and a neighbour whose `b` is more than `mostRise` of the cell's above it
  // counts in the square as if it were so much: not more than b could be smooth over. `known` has a flag a boundary
  // face.
  struct Beyond {
    double product = 0.0, square = 0.0;
  };
  void beyond(std::span<const double> values, std::span<const double> boundary, std::span<const double> gradient,
              std::span<const BoundaryData> known, double mostRise, std::span<Beyond> out) const;

  // Distance at which a boundary's value counts that lies `distance` from the cell's centre: a field without slope has
  // the cell's own value at the mirrored place. Zero: it does not count.
  static double reach(double distance, BoundaryData data) {
    return data == BoundaryData::Value ? distance : data == BoundaryData::ZeroSlope ? 2.0 * distance : 0.0;
  }

 private:
  using Weights = std::array<Vector3, Mesh::mostSides>;
  // Of each face of an owned cell, for the component whose flags begin at `first`.
  const Vector3* weights(int cell, std::span<const BoundaryData> known, int components, int first) const;
  void find(int cell, std::span<const BoundaryData> ofFaces, Weights& weights) const;

  const Mesh& mesh_;
  // Of each cell at the boundary, in the order of the cells, those that have been asked for, by what is known at its
  // faces.
  struct Kept {
    std::array<BoundaryData, Mesh::mostSides> known;
    Weights weights;
  };
  std::vector<int> row_;  // of kept_, an owned cell
  mutable std::vector<std::vector<Kept>> kept_;
};

// What lies beyond a face of a cell: the values of the other cell, or those at the boundary face (`components` each).
inline const double* valuesBeyond(const Mesh& m, int cell, int face, std::span<const double> values,
                                  std::span<const double> boundary, int components) {
  if (m.high[face] < 0) return boundary.data() + static_cast<std::ptrdiff_t>(face - m.interiorFaces) * components;
  return values.data() + static_cast<std::ptrdiff_t>(m.low[face] == cell ? m.high[face] : m.low[face]) * components;
}

// Of a gradient in the cells (halo filled; `components` a cell), at a face, interpolated, or the cell's own at the
// boundary: the part along `direction`.
inline double faceSlope(const Mesh& m, int face, const Vector3& direction, std::span<const double> gradient,
                        int components = 1, int component = 0) {
  const int d = m.dimension;
  const int low = m.low[face], high = m.high[face] >= 0 ? m.high[face] : low;
  const double w = m.high[face] >= 0 ? m.lowWeight[face] : 1.0;
  const double* ofLow = &gradient[static_cast<std::size_t>(low * components + component) * d];
  const double* ofHigh = &gradient[static_cast<std::size_t>(high * components + component) * d];
  double slope = 0.0;
  for (int i = 0; i < d; ++i) slope += direction[i] * (w * ofLow[i] + (1.0 - w) * ofHigh[i]);
  return slope;
}

// Whether a skewed mesh's interior face has its centre so near the place where the step meets it that slopes lead
// there: within its own size. Thin cells around a bend are missed by many times their height; there the face belongs to
// the layer of both cells, whose values tell its own, and slopes across the layers tell nothing of it. Triangles,
// tetrahedra, prisms and pyramids are of no layers.
inline bool isCentreInReach(const Mesh& m, int face) {
  if (m.betweenOpposite[face] == 0) return true;
  const double size = m.size(face);
  return dot(m.offset[face], m.offset[face]) <= (m.dimension == 3 ? size : size * size);
}

// What a field is more at an interior face's centre than its linear interpolation between the two cells: along
// Mesh::offset, and between cells with opposite sides by its curvature along the step, from both cells' gradients. On
// bent cells the two are alike and opposite: along a layer a field is as good as even, along the bend's chord it is
// not. On tetrahedra the curvature has nothing to cancel, and velocities that have it grow without end.
inline double riseToCentre(const Mesh& m, int face, std::span<const double> gradient, int components = 1,
                           int component = 0) {
  if (!isCentreInReach(m, face)) return 0.0;
  const int d = m.dimension;
  const double w = m.lowWeight[face];
  const double* ofLow = &gradient[static_cast<std::size_t>(m.low[face] * components + component) * d];
  const double* ofHigh = &gradient[static_cast<std::size_t>(m.high[face] * components + component) * d];
  double rise = faceSlope(m, face, m.offset[face], gradient, components, component);
  if (m.betweenOpposite[face] == 0) return rise;
  for (int i = 0; i < d; ++i) rise += 0.5 * w * (1.0 - w) * m.step[face][i] * (ofLow[i] - ofHigh[i]);
  return rise;
}

}  // namespace lampblack::flow
