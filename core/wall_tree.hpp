// Faces of walls, distances from them, and which of many is nearest to a place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vector3.hpp"

namespace lampblack {

// A boundary face by its corners, in order around it: two in a plane, three or four in space. Or one of its images
// across periodic sides.
struct WallFace {
  std::int64_t number = -1;  // permanent
  int corners = 0;
  std::array<Vector3, 4> corner{};  // m
  bool operator==(const WallFace&) const = default;
  [[nodiscard]] std::span<const Vector3> all() const { return {corner.data(), static_cast<std::size_t>(corners)}; }
};

// Distance (m) of a place from a segment (two corners) or a polygon in space (three or four corners, in order around
// it; four that are not in a plane are the four triangles around their mean, as in measureSide()).
double distanceToFace(const Vector3& place, std::span<const Vector3> corners);

// Some of the faces as a tree of boxes, each around those of the boxes below it.
class WallTree {
 public:
  explicit WallTree(std::vector<WallFace> faces);

  // Distance (m) of a place from the nearest face, or `bound` where none is nearer than that.
  [[nodiscard]] double nearest(const Vector3& place, double bound) const;

  struct Box {
    Vector3 lower, upper;  // m; of nothing the lower is above the upper
    // m, of a place from the box; infinite where it is around nothing.
    [[nodiscard]] double distance(const Vector3& place) const;
  };
  // Around all faces.
  [[nodiscard]] Box box() const;

 private:
  struct Node {
    Box box;
    std::size_t first = 0, last = 0;  // faces
    std::size_t left = 0, right = 0;  // nodes below; both 0: none
  };
  std::size_t add(std::size_t first, std::size_t last);
  void search(std::size_t node, const Vector3& place, double& bound) const;

  std::vector<WallFace> faces_;
  std::vector<Node> nodes_;  // the first is the root
};

}  // namespace lampblack
