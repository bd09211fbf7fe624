// A box of cells along two or three axes, graded, with parts left out (steps, lips, bluff bodies) and bent by a formula
// where one is given. Each rank makes its own share.
#pragma once

#include <mpi.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/mesh_block.hpp"

namespace lampblack {

enum class Geometry { Planar, Axisymmetric };

// A part of the box's surface: the faces of one side whose centre lies in [from, to] along the first of the other axes
// (m); or the surface of a part that is left out.
struct BoundaryPatch {
  std::string name;
  int axis = 0;        // 0, 1 or 2: the axis the side is normal to
  bool atMax = false;  // side at the low or high end of that axis
  double from = -1e300;
  double to = 1e300;
  int leftOut = -1;  // of the part with this index in MeshSpec::leftOut, in place of a side
};

struct MeshSpec {
  Geometry geometry = Geometry::Planar;
  std::array<std::vector<double>, 3> vertices;  // m, increasing along each axis; none along the third: a plane
  std::vector<BoundaryPatch> patches;           // first match wins; a face without a patch is an InputError
  // Along an axis: what leaves at one end comes in at the other. Such an axis has three cells or more and no patches.
  std::array<bool, 3> periodic{false, false, false};
  // Cells whose centre lies between two corners (m) are left out.
  struct LeftOut {
    std::array<double, 3> lower{}, upper{};  // the first belongs to the part, the second does not
  };
  std::vector<LeftOut> leftOut;
  // Where a vertex of the box comes to lie; empty: where it is. Patches and parts left out go by the box.
  std::function<std::array<double, 3>(const std::array<double, 3>&)> map;

  [[nodiscard]] int dimension() const { return vertices[2].empty() ? 2 : 3; }
  // Whether a cell with this centre is left out.
  [[nodiscard]] bool isLeftOut(const std::array<double, 3>& centre) const;
};

// Collective. Cells are numbered along the first axis first: i + n0 (j + n1 k) where nothing is left out. InputError,
// on all ranks, when an axis has no cells, a radius is negative, vertices do not increase or nothing is left.
MeshBlock boxBlock(MPI_Comm comm, const MeshSpec& spec);

}  // namespace lampblack
