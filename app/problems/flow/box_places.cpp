#include "app/problems/flow/box_places.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::app::flowcase {
namespace {

// The first of the two points between which a value lies.
std::size_t before(const std::vector<double>& points, double value) {
  const auto after = std::ranges::upper_bound(points, value) - points.begin();
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, std::ssize(points) - 2));
}

}  // namespace

BoxPlaces::BoxPlaces(const MeshSpec& mesh) : columns_(mesh.vertices[0]) {
  const std::vector<double>& y = mesh.vertices[1];
  for (const double x : columns_) {
    low_.push_back(mesh.map({x, y.front(), 0.0})[1]);
    high_.push_back(mesh.map({x, y.back(), 0.0})[1]);
  }
  for (const double height : y) rows_.push_back((height - y.front()) / (y.back() - y.front()));
}

BoxPlaces::BoxPlaces(const std::vector<double>& vertices) {
  const std::size_t all = vertices.size() / 3;
  const auto x = [&](std::size_t v) { return vertices[3 * v]; };
  const auto y = [&](std::size_t v) { return vertices[3 * v + 1]; };
  for (std::size_t v = 0; v < all && (v == 0 || x(v) > x(v - 1)); ++v) columns_.push_back(x(v));
  const std::size_t n = columns_.size();
  if (n < 2 || all < 2 * n || all % n != 0) throw InputError("its vertices are not those of a box");
  for (std::size_t i = 0; i < n; ++i) {
    low_.push_back(y(i));
    high_.push_back(y(all - n + i));
  }
  for (std::size_t v = 0; v < all; v += n) rows_.push_back((y(v) - low_[0]) / (high_[0] - low_[0]));
}

std::array<double, 2> BoxPlaces::heights(double x) const {
  const std::size_t i = before(columns_, x);
  const double share = (x - columns_[i]) / (columns_[i + 1] - columns_[i]);
  return {low_[i] + share * (low_[i + 1] - low_[i]), high_[i] + share * (high_[i + 1] - high_[i])};
}

std::array<double, 2> BoxPlaces::of(double x, double y) const {
  const auto [low, high] = heights(x);
  return {x, (y - low) / (high - low)};
}

std::array<double, 2> BoxPlaces::middle(double x, double y) const {
  const std::size_t i = before(columns_, x), j = before(rows_, of(x, y)[1]);
  return {0.5 * (columns_[i] + columns_[i + 1]), 0.5 * (rows_[j] + rows_[j + 1])};
}

double BoxPlaces::apart(const BoxPlaces& other) const {
  double most = 0.0;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i] < other.columns_.front() || columns_[i] > other.columns_.back()) continue;
    const auto [low, high] = other.heights(columns_[i]);
    most = std::max({most, std::abs(low_[i] - low), std::abs(high_[i] - high)});
  }
  return most;
}

double BoxPlaces::rise() const {
  const auto riseOf = [](const std::vector<double>& heights) {
    const auto [least, most] = std::ranges::minmax(heights);
    return most - least;
  };
  return std::max(riseOf(low_), riseOf(high_));
}

}  // namespace lampblack::app::flowcase
