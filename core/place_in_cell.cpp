#include "core/place_in_cell.hpp"

#include <algorithm>
#include <limits>

namespace lampblack {
namespace {

// A triangle or tetrahedron, one of whose corners is the cell's centre: the weights of the others.
std::array<double, 3> weightsIn(int dimension, const Vector3& place, const std::array<Vector3, 3>& edge) {
  if (dimension == 2) {
    const double area = edge[0][0] * edge[1][1] - edge[0][1] * edge[1][0];
    return {(place[0] * edge[1][1] - place[1] * edge[1][0]) / area,
            (edge[0][0] * place[1] - edge[0][1] * place[0]) / area, 0.0};
  }
  const double volume = dot(edge[0], cross(edge[1], edge[2]));
  return {dot(place, cross(edge[1], edge[2])) / volume, dot(edge[0], cross(place, edge[2])) / volume,
          dot(edge[0], cross(edge[1], place)) / volume};
}

// Looks for the part of a cell in which a place lies deepest.
class DeepestPart {
 public:
  DeepestPart(const Mesh& mesh, int cell, const Vector3& place)
      : mesh_(mesh), cell_(cell), place_(difference(place, mesh.centre[cell])) {}

  PlaceInCell find() {
    for (const CellSide& side : sidesOf(mesh_.shape[cell_])) {
      if (mesh_.dimension == 2)
        tryTriangle(side);
      else
        trySide(side);
    }
    return best_;
  }

 private:
  [[nodiscard]] int vertexOf(const CellSide& side, int i) const {
    return mesh_.corner[mesh_.cornerStart[cell_] + side.corner[i % side.corners]];
  }
  [[nodiscard]] Vector3 edgeTo(int vertex) const { return difference(mesh_.vertex[vertex], mesh_.centre[cell_]); }

  // Whether weights of the corners and of the centre beat the best; if so, they are it.
  bool isDeeper(const std::array<double, 3>& w, int count) {
    double centre = 1.0;
    for (int i = 0; i < count; ++i) centre -= w[i];
    double least = centre;
    for (int i = 0; i < count; ++i) least = std::min(least, w[i]);
    if (!(least > depth_)) return false;
    depth_ = least;
    best_.cell = cell_;
    best_.centreWeight = centre;
    return true;
  }

  void tryTriangle(const CellSide& side) {
    const int a = vertexOf(side, 0), b = vertexOf(side, 1);
    const auto w = weightsIn(2, place_, {edgeTo(a), edgeTo(b), Vector3{}});
    if (!isDeeper(w, 2)) return;
    best_.corners = 2;
    best_.vertex = {a, b};
    best_.weight = {w[0], w[1]};
  }

  // Tetrahedra from the cell's centre and the mean of the side's corners to its edges.
  void trySide(const CellSide& side) {
    Vector3 middle{};
    for (int i = 0; i < side.corners; ++i) middle = sum(middle, scaled(edgeTo(vertexOf(side, i)), 1.0 / side.corners));
    for (int i = 0; i < side.corners; ++i) {
      const auto w = weightsIn(3, place_, {middle, edgeTo(vertexOf(side, i)), edgeTo(vertexOf(side, i + 1))});
      if (!isDeeper(w, 3)) continue;
      best_.corners = side.corners;
      for (int k = 0; k < side.corners; ++k) {
        best_.vertex[k] = vertexOf(side, k);
        best_.weight[k] = w[0] / side.corners;
      }
      best_.weight[i] += w[1];
      best_.weight[(i + 1) % side.corners] += w[2];
    }
  }

  const Mesh& mesh_;
  int cell_;
  Vector3 place_;  // from the centre
  double depth_ = -std::numeric_limits<double>::infinity();
  PlaceInCell best_;
};

}  // namespace

PlaceInCell placeInCell(const Mesh& mesh, int cell, const Vector3& place) {
  return DeepestPart(mesh, cell, place).find();
}

CellExit exitOf(const Mesh& mesh, int cell, const Vector3& from, const Vector3& to) {
  constexpr double parallel = 1e-12;  // pieces along a face do not leave through it
  const Vector3 piece = difference(to, from);
  CellExit exit;
  for (int i = mesh.faceStart[cell]; i < mesh.faceStart[cell + 1]; ++i) {
    const int face = mesh.faceOfCell[i];
    const Vector3 outwards = scaled(mesh.normal[face], mesh.low[face] == cell ? 1.0 : -1.0);
    const double speed = dot(piece, outwards);
    if (!(speed > parallel * length(piece))) continue;
    const double share = std::max(0.0, dot(difference(mesh.faceCentreOf(cell, face), from), outwards) / speed);
    if (share < exit.share) exit = {face, share};
  }
  return exit;
}

}  // namespace lampblack
