// Cell gradients by a parabola through the neighbouring values along each axis: second order on graded meshes.
#pragma once

#include <span>
#include <vector>

#include "core/mesh.hpp"
#include "core/rooms.hpp"

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

  // Gradient of `components` values a cell (halo filled) in the owned cells: gradient[(cell * components + k) * 2 +
  // axis]. `boundary` holds the value at each boundary face (components a face), read where `known` says Value. `known`
  // has a flag a boundary face, or a flag a component of each, or none for Value everywhere.
  void compute(std::span<const double> values, std::span<const double> boundary, int components,
               std::span<double> gradient, std::span<const BoundaryData> known = {}) const;

  // The same along one axis in one owned cell: slope[k]; `known` has a flag a boundary face.
  void along(int axis, int cell, std::span<const double> values, std::span<const double> boundary, int components,
             std::span<double> slope, std::span<const BoundaryData> known = {}) const;

  // Distance at which a boundary's value counts that lies `distance` from the cell's centre: a field without slope has
  // the cell's own value at the mirrored place. Zero: it does not count.
  static double reach(double distance, BoundaryData data) {
    return data == BoundaryData::Value ? distance : data == BoundaryData::ZeroSlope ? 2.0 * distance : 0.0;
  }

 private:
  struct Field {
    std::span<const double> values, boundary;
    int components;
    std::span<const BoundaryData> known;
  };
  void addAlong(int axis, int cell, const Field& field, int first, int count, double* out, int stride) const;

  const Mesh& mesh_;
};

}  // namespace lampblack::flow
