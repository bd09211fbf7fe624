// The adaptive grid of a flame: where points are missing, where there are too many, and a profile on another grid.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "flow/flame/flame_profile.hpp"

namespace lampblack {

struct GridOptions {
  double ratio = 3;     // of neighbouring spacings, at most
  double slope = 0.06;  // change of an unknown between neighbours, over its range
  double curve = 0.12;  // change of its slope, over the range of slopes
  double prune = 0;     // a point goes where all of these are below it; 0: never
  std::size_t maximumPoints = 2000;
  double smallestSpacing = 1e-8;  // m
  // Unknowns whose range is below this part of the largest of their kind do not count.
  double negligible = 1e-5;
};

struct GridChange {
  std::vector<double> z;  // the new grid
  std::size_t inserted = 0, removed = 0;
  [[nodiscard]] bool changed() const { return inserted + removed > 0; }
};

// Where the profile needs points. `active`: components that count (by layout; the mass flux never does). Points that
// have to stay are in `keep` (the anchor of a free flame). NumericsError where the criteria need more than
// maximumPoints.
[[nodiscard]] GridChange refineGrid(const FlameProfile& profile, const GridOptions& options,
                                    std::span<const bool> active, std::span<const std::size_t> keep);

// The profile at other points, within (or constant beyond) those it has: monotone cubic in z for what lives at points
// (Fritsch and Carlson 1980), linear for the mass flux, which lives on faces. Sums of mass fractions stay one.
[[nodiscard]] FlameProfile onGrid(const FlameProfile& profile, std::span<const double> z);

}  // namespace lampblack
