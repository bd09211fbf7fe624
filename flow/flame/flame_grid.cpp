#include "flow/flame/flame_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

// That are left where a profile is flat: it says nothing of the grid that it needs when it changes.
constexpr std::size_t fewestPoints = 5;

void check(const GridOptions& o) {
  // Halving an interval that is less than twice its neighbour leaves one that is smaller than the neighbour: with a
  // ratio below 2 the grid could grow without end.
  if (!(o.ratio >= 2)) throw InputError("grid: ratio has to be at least 2, not " + std::to_string(o.ratio));
  if (!(o.slope > 0 && o.slope <= 1))
    throw InputError("grid: slope has to be in (0, 1], not " + std::to_string(o.slope));
  if (!(o.curve > 0 && o.curve <= 1))
    throw InputError("grid: curve has to be in (0, 1], not " + std::to_string(o.curve));
  if (!(o.prune >= 0 && o.prune < std::min(o.slope, o.curve)) && o.prune != 0)
    throw InputError("grid: prune has to be below slope and curve, not " + std::to_string(o.prune));
}

// A component that counts, and how far its values and slopes range.
struct Component {
  std::vector<double> value;
  double range = 0, slopeRange = 0;
};

enum Kind : std::size_t { Spread, Temperature, Species, Scalars, numKinds };

Kind kindOf(const FlameLayout& layout, std::size_t component) {
  if (component == FlameLayout::spread) return Spread;
  if (component == FlameLayout::temperature) return Temperature;
  return component < layout.firstScalar() ? Species : Scalars;
}

class Refinement {
 public:
  Refinement(const FlameProfile& profile, const GridOptions& options, std::span<const bool> active)
      : options_(options), z_(profile.z) {
    const FlameLayout& layout = profile.layout;
    std::array<double, numKinds> largest{};
    for (std::size_t i = 0; i < points(); ++i)
      for (std::size_t c = FlameLayout::spread; c < layout.width(); ++c) {
        double& most = largest[kindOf(layout, c)];
        most = std::max(most, std::abs(profile.at(i, c)));
      }
    for (std::size_t c = FlameLayout::spread; c < layout.width(); ++c)
      if (active[c]) consider(profile, c, options.negligible * largest[kindOf(layout, c)]);
  }

  // Intervals that are to be halved.
  [[nodiscard]] std::vector<std::uint8_t> splits() const {
    std::vector<std::uint8_t> split(points() - 1, 0);
    const auto halve = [&](std::size_t i) { split[i] = static_cast<std::uint8_t>(split[i] || spacing(i) >= least()); };
    for (const Component& c : components_) {
      for (std::size_t i = 0; i + 1 < points(); ++i)
        if (std::abs(c.value[i + 1] - c.value[i]) > options_.slope * c.range) halve(i);
      for (std::size_t i = 1; i + 1 < points(); ++i)
        if (bend(c, i - 1, i, i + 1) > options_.curve * c.slopeRange && spacing(i - 1) >= least() &&
            spacing(i) >= least()) {
          halve(i - 1);
          halve(i);
        }
    }
    return split;
  }

  // Whether the profile is as good without point i; its four neighbours stay.
  [[nodiscard]] bool superfluous(std::size_t i) const {
    const double joined = z_[i + 1] - z_[i - 1];
    if (i >= 2 && joined > options_.ratio * spacing(i - 2)) return false;
    if (i + 2 < points() && joined > options_.ratio * spacing(i + 1)) return false;
    return std::ranges::all_of(components_, [&](const Component& c) { return flat(c, i); });
  }

 private:
  void consider(const FlameProfile& profile, std::size_t component, double negligible) {
    Component c;
    for (std::size_t i = 0; i < points(); ++i) c.value.push_back(profile.at(i, component));
    const auto [low, high] = std::ranges::minmax(c.value);
    c.range = high - low;
    if (c.range <= std::max(negligible, std::numeric_limits<double>::min())) return;
    double lowSlope = std::numeric_limits<double>::infinity();
    double highSlope = -lowSlope;
    for (std::size_t i = 0; i + 1 < points(); ++i) {
      const double s = slope(c, i, i + 1);
      lowSlope = std::min(lowSlope, s);
      highSlope = std::max(highSlope, s);
    }
    // A line that is nearly straight may bend.
    const double nearly = 0.01 * std::max(std::abs(lowSlope), std::abs(highSlope));
    c.slopeRange = std::max(highSlope - lowSlope, nearly);
    components_.push_back(std::move(c));
  }

  [[nodiscard]] std::size_t points() const { return z_.size(); }
  [[nodiscard]] double spacing(std::size_t i) const { return z_[i + 1] - z_[i]; }
  [[nodiscard]] double least() const { return 2 * options_.smallestSpacing; }
  [[nodiscard]] double slope(const Component& c, std::size_t a, std::size_t b) const {
    return (c.value[b] - c.value[a]) / (z_[b] - z_[a]);
  }
  [[nodiscard]] double bend(const Component& c, std::size_t a, std::size_t b, std::size_t d) const {
    return std::abs(slope(c, b, d) - slope(c, a, b));
  }
  [[nodiscard]] bool flat(const Component& c, std::size_t i) const {
    const double change = options_.prune * c.range;
    if (std::abs(c.value[i] - c.value[i - 1]) >= change || std::abs(c.value[i + 1] - c.value[i]) >= change ||
        bend(c, i - 1, i, i + 1) >= options_.prune * c.slopeRange)
      return false;
    if (std::abs(c.value[i + 1] - c.value[i - 1]) > options_.slope * c.range) return false;
    const double mostBend = options_.curve * c.slopeRange;
    if (i >= 2 && bend(c, i - 2, i - 1, i + 1) > mostBend) return false;
    return i + 2 >= points() || bend(c, i - 1, i + 1, i + 2) <= mostBend;
  }

  const GridOptions& options_;
  const std::vector<double>& z_;
  std::vector<Component> components_;
};

// Halves intervals until none is more than `ratio` times its neighbour. Never makes one smaller than the smallest.
void smooth(std::vector<double>& z, double ratio, std::size_t most) {
  for (bool changed = true; changed && z.size() <= most;) {
    changed = false;
    std::vector<double> next{z.front()};
    for (std::size_t i = 0; i + 1 < z.size(); ++i) {
      // Rounding of z must not make two equal intervals differ.
      const double here = (z[i + 1] - z[i]) * (1 - 1e-9);
      const bool split =
          (i > 0 && here > ratio * (z[i] - z[i - 1])) || (i + 2 < z.size() && here > ratio * (z[i + 2] - z[i + 1]));
      if (split) next.push_back(0.5 * (z[i] + z[i + 1]));
      next.push_back(z[i + 1]);
      changed = changed || split;
    }
    z = std::move(next);
  }
}

}  // namespace

GridChange refineGrid(const FlameProfile& profile, const GridOptions& options, std::span<const bool> active,
                      std::span<const std::size_t> keep) {
  check(options);
  const std::size_t n = profile.points();
  const Refinement refinement(profile, options, active);
  const auto split = refinement.splits();

  GridChange change;
  std::size_t free = 1;  // the first point that may go
  const std::size_t mostRemoved = n > fewestPoints ? n - fewestPoints : 0;
  for (std::size_t i = 0; i < n; ++i) {
    // Two points to either side stay as they are.
    const bool calm = i >= free && i + 1 < n && !split[i - 1] && !split[i] && (i < 2 || !split[i - 2]) &&
                      (i + 2 >= n || !split[i + 1]);
    if (options.prune > 0 && calm && change.removed < mostRemoved && std::ranges::find(keep, i) == keep.end() &&
        refinement.superfluous(i)) {
      free = i + 3;
      ++change.removed;
      continue;
    }
    change.z.push_back(profile.z[i]);
    if (i + 1 < n && split[i]) change.z.push_back(0.5 * (profile.z[i] + profile.z[i + 1]));
  }
  smooth(change.z, options.ratio, options.maximumPoints);
  change.inserted = change.z.size() + change.removed - n;
  if (change.z.size() > options.maximumPoints)
    throw NumericsError("grid: its criteria (slope " + std::to_string(options.slope) + ", curve " +
                        std::to_string(options.curve) + ", ratio " + std::to_string(options.ratio) +
                        ") need more than the " + std::to_string(options.maximumPoints) + " points allowed");
  return change;
}

}  // namespace lampblack::flow
