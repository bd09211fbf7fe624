// How well shaped a mesh is: what its cells and faces are at worst, and where. Fluxes and gradients by two cells are
// exact for linear fields where faces stand across the steps between cells and are met in their middle; each deviation
// costs accuracy, and sudden growth costs an order of it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh.hpp"

namespace lampblack {

struct MeshQuality {
  // The worst of all, and where: the same on any number of ranks, of several equal ones that of the smallest permanent
  // number.
  struct Worst {
    double value = 0.0;
    std::int64_t number = -1;  // permanent, of the cell or face; -1: there is none
    Vector3 place{};           // m, centre of the cell or face
  };

  // Collective, with four reductions.
  explicit MeshQuality(const Mesh& mesh);

  int dimension = 2;
  std::int64_t totalFaces = 0;
  std::int64_t facesBeyond = 0;         // Mesh::facesBeyond
  std::array<std::int64_t, 6> cells{};  // by CellShape
  Worst smallest, largest;              // cells, m^3; in a plane, also an axisymmetric one, m^2
  Worst growth;                         // of faces: size of the larger of its cells over that of the other, 1 or more
  Worst angle;                          // of faces, degrees: between the normal and the step, 0 or more
  double meanAngle = 0.0;               // of all faces, degrees
  Worst skewness;  // of faces: how far the step misses the centre, over the face's size (m, root of m^2)
  // Of cells: longest edge times largest side (in a plane the longest edge again) over the size; over what that is for
  // the regular cell of the shape. Of a box longest over shortest edge.
  Worst aspect;

  // For people: one line where every face is met by its step in the middle and at a right angle, otherwise two.
  [[nodiscard]] std::vector<std::string> lines() const;
  // What a user should know: a sentence each for what is bad, or nothing.
  [[nodiscard]] std::vector<std::string> warnings() const;
  // From where on a warning is due. Angles: from Mesh::mostOblique.
  static constexpr double mostGrowth = 10.0, mostSkewness = 1.0, mostAspect = 1000.0;
};

}  // namespace lampblack
