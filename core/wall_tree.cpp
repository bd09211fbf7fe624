#include "core/wall_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lampblack {
namespace {

constexpr double noDistance = std::numeric_limits<double>::infinity();

double distanceToSegment(const Vector3& place, const Vector3& a, const Vector3& b) {
  const Vector3 along = difference(b, a), from = difference(place, a);
  const double share = std::clamp(dot(from, along) / dot(along, along), 0.0, 1.0);
  return length(difference(from, scaled(along, share)));
}

double distanceToTriangle(const Vector3& place, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = cross(difference(b, a), difference(c, a));
  const double area = length(normal);
  const auto isLeftOf = [&](const Vector3& from, const Vector3& to) {
    return dot(cross(difference(to, from), difference(place, from)), normal) >= 0.0;
  };
  if (area > 0.0 && isLeftOf(a, b) && isLeftOf(b, c) && isLeftOf(c, a))
    return std::abs(dot(difference(place, a), normal)) / area;
  return std::min({distanceToSegment(place, a, b), distanceToSegment(place, b, c), distanceToSegment(place, c, a)});
}

// The sum of the lowest and the highest of a face's corners along an axis: twice its middle.
double middleAlong(const WallFace& face, std::size_t axis) {
  const auto along = [axis](const Vector3& corner) { return corner[axis]; };
  const auto [lowest, highest] = std::ranges::minmax_element(face.all(), {}, along);
  return (*lowest)[axis] + (*highest)[axis];
}

}  // namespace

double distanceToFace(const Vector3& place, std::span<const Vector3> corners) {
  if (corners.size() == 2) return distanceToSegment(place, corners[0], corners[1]);
  if (corners.size() == 3) return distanceToTriangle(place, corners[0], corners[1], corners[2]);
  Vector3 middle{};
  for (const Vector3& corner : corners) middle = sum(middle, corner);
  middle = scaled(middle, 1.0 / static_cast<double>(corners.size()));
  double nearest = noDistance;
  for (std::size_t i = 0; i < corners.size(); ++i)
    nearest = std::min(nearest, distanceToTriangle(place, corners[i], corners[(i + 1) % corners.size()], middle));
  return nearest;
}

double WallTree::Box::distance(const Vector3& place) const {
  if (lower[0] > upper[0]) return noDistance;
  Vector3 beyond{};
  for (std::size_t i = 0; i < 3; ++i) beyond[i] = std::max({lower[i] - place[i], 0.0, place[i] - upper[i]});
  // A little less, so that round-off hides no face.
  return length(beyond) * (1.0 - 1e-12);
}

WallTree::WallTree(std::vector<WallFace> faces) : faces_(std::move(faces)) {
  add(0, faces_.size());
}

WallTree::Box WallTree::box() const {
  return nodes_.front().box;
}

std::size_t WallTree::add(std::size_t first, std::size_t last) {
  constexpr std::size_t fewest = 4;
  const std::size_t node = nodes_.size();
  Box box{{noDistance, noDistance, noDistance}, {-noDistance, -noDistance, -noDistance}};
  for (std::size_t f = first; f < last; ++f)
    for (const Vector3& corner : faces_[f].all())
      for (std::size_t i = 0; i < 3; ++i) {
        box.lower[i] = std::min(box.lower[i], corner[i]);
        box.upper[i] = std::max(box.upper[i], corner[i]);
      }
  nodes_.push_back({box, first, last, 0, 0});
  if (last - first <= fewest) return node;
  const Vector3 extent = difference(box.upper, box.lower);
  const auto longest = static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
  const auto at = [this](std::size_t face) { return faces_.begin() + static_cast<std::ptrdiff_t>(face); };
  const std::size_t half = first + (last - first) / 2;
  std::nth_element(at(first), at(half), at(last), [longest](const WallFace& a, const WallFace& b) {
    return middleAlong(a, longest) < middleAlong(b, longest);
  });
  const std::size_t left = add(first, half), right = add(half, last);
  nodes_[node].left = left;
  nodes_[node].right = right;
  return node;
}

double WallTree::nearest(const Vector3& place, double bound) const {
  if (nodes_.front().box.distance(place) < bound) search(0, place, bound);
  return bound;
}

void WallTree::search(std::size_t number, const Vector3& place, double& bound) const {
  const Node& node = nodes_[number];
  if (node.right == 0) {
    for (std::size_t f = node.first; f < node.last; ++f)
      bound = std::min(bound, distanceToFace(place, faces_[f].all()));
    return;
  }
  std::array<std::pair<double, std::size_t>, 2> below{
      {{nodes_[node.left].box.distance(place), node.left}, {nodes_[node.right].box.distance(place), node.right}}};
  std::ranges::sort(below);
  for (const auto& [distance, next] : below)
    if (distance < bound) search(next, place, bound);
}

}  // namespace lampblack
