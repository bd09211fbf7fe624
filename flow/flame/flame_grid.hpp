// The adaptive grid of a flame: where points are missing, where there are too many, and a profile on another grid.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_profile.hpp"

namespace lampblack::flow {

// The criteria are those of PREMIX (Kee, Grcar, Smooke, Miller 1985) and Cantera, with which users compare; all of
// them are fractions of a component's range, of values (slope) or of slopes (curve) over the whole flame.
struct GridOptions {
  double ratio = 3;     // of neighbouring spacings, at most; at least 2
  double slope = 0.06;  // change of an unknown between neighbours, over its range
  double curve = 0.12;  // change of its slope, over the range of slopes
  double prune = 0;     // a point goes where all changes at it are below this part of their range; 0: never
  std::size_t maximumPoints = 2000;
  double smallestSpacing = 1e-8;  // m
  // Unknowns whose range is below this part of the largest value of their kind (temperature, spread, species, scalars)
  // do not count.
  double negligible = 1e-5;
};

struct GridChange {
  std::vector<double> z;  // the new grid
  std::size_t inserted = 0, removed = 0;
  [[nodiscard]] bool changed() const { return inserted + removed > 0; }
};

// Where the profile needs points: midpoints are inserted, and with `prune` points are removed, never two neighbours at
// once and never so that the criteria would ask for them again. `active`: components that count (by layout; the mass
// flux never does). Points that have to stay are in `keep` (the anchor of a free flame). InputError for criteria that
// make no sense; NumericsError where they need more than maximumPoints.
[[nodiscard]] GridChange refineGrid(const FlameProfile& profile, const GridOptions& options,
                                    std::span<const bool> active, std::span<const std::size_t> keep);

// The profile at other points, within (or constant beyond) those it has: monotone cubic in z for what lives at points
// (Fritsch and Carlson 1980), linear for the mass flux, which lives on faces. Mass fractions are scaled so that their
// sum is that of a straight line between the old points, one where those sum to one. `z` rising, two points or more.
[[nodiscard]] FlameProfile onGrid(const FlameProfile& profile, std::span<const double> z);

// The profile of a flame without spreading in a domain that is longer by `left` and `right` (m): constant values on
// points whose spacing grows by half from that at the end. The first point keeps its z, the flame moves by `left`.
[[nodiscard]] FlameProfile widened(const FlameProfile& profile, double left, double right);

}  // namespace lampblack::flow
