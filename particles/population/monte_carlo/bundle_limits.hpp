// Meetings drawn in bundles. A large particle that stands for few meets the small ones that most of the number is made
// of very often, and each meeting changes it by next to nothing. The event of such a collector i with a small particle
// j then stands for g_i meetings and happens 1/g_i times as often. g_i is so small that the g_i small ones are no more
// than a given share of the volume of i, and that they take no more than half of what j stands for. Number and mass
// have the right mean, each event keeps mass; the growth of the second moment by these meetings is too large by at most
// half that share (docs/theory/ensembles_in_cells.md).
//
// Small are those up to a volume that stand for many. Both limits are those, of a few, with which the fewest events are
// to be expected.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cube_root.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {

class BundleLimits {
 public:
  // `share`: of a collector's volume that it may take up at once; zero: there are no bundles. O(N).
  void find(double share, std::span<const double> volumes, std::span<const double> weights);

  [[nodiscard]] bool isSmall(double volume, double weight) const {
    return volume <= largestSmall_ && weight >= leastWeight_;
  }
  // How many small ones a particle takes up at once.
  [[nodiscard]] double bundle(double volume, double weight) const {
    if (!(largestSmall_ > 0)) return 1.0;
    return std::max(1.0, std::floor(std::min(share_ * volume / largestSmall_, 0.5 * leastWeight_ / weight)));
  }

 private:
  // Up to which parts of the number particles are tried as the small ones.
  static constexpr std::array<double, 4> triedParts{0.4, 0.6, 0.75, 0.9};
  // Of what the mean small particle stands for. Particles that stand for less than this would lose half of it to a few
  // collectors, and are not many meetings.
  static constexpr double leastPart = 0.05;
  // Of the events without bundles that are left: with more, the larger sums and products cost what is saved.
  static constexpr double worthwhile = 0.8;
  static constexpr int classesPerOctave = 4;  // of volume, within which the order does not matter here

  struct Class {
    double number = 0, squares = 0, largest = 0;  // sums of weights and of their squares; m3
  };

  double share_ = 0;
  double largestSmall_ = 0;  // m3, 0: there are no small ones
  double leastWeight_ = 0;   // 1/m3, of a small one
  std::vector<double> areas_;
  std::vector<Class> classes_;
};

inline void BundleLimits::find(double share, std::span<const double> volumes, std::span<const double> weights) {
  share_ = share;
  largestSmall_ = leastWeight_ = 0;
  if (!(share > 0) || volumes.empty()) return;
  // By the exponent and the first bits behind it.
  static_assert(classesPerOctave == 4);
  const auto bits = [](double volume) { return std::bit_cast<std::uint64_t>(volume) >> 50U; };
  const auto [least, most] = std::ranges::minmax(volumes);
  classes_.assign(bits(most) - bits(least) + 1, {});
  areas_.resize(volumes.size());
  double number = 0, all = 0;
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    const double d = cubeRoot(volumes[k]);
    areas_[k] = d * d;  // collision rates with small ones go with it, about
    all += areas_[k];
    number += weights[k];
    Class& own = classes_[bits(volumes[k]) - bits(least)];
    own.number += weights[k];
    own.squares += weights[k] * weights[k];
    own.largest = std::max(own.largest, volumes[k]);
  }
  double upTo = 0, squares = 0, largest = 0, fewest = worthwhile;
  std::size_t next = 0;
  for (const double part : triedParts) {
    for (; next < classes_.size() && upTo < part * number; ++next) {
      upTo += classes_[next].number;
      squares += classes_[next].squares;
      largest = std::max(largest, classes_[next].largest);
    }
    if (!(upTo > 0)) return;
    const double leastWeight = leastPart * squares / upTo;
    const double perSmall = share / largest, half = 0.5 * leastWeight;
    double bundled = 0;
    for (std::size_t k = 0; k < volumes.size(); ++k)
      bundled += areas_[k] / std::max(1.0, std::min(perSmall * volumes[k], half / weights[k]));
    const double expected = 1 - upTo / number * (1 - bundled / all);
    if (!(expected < fewest)) continue;
    fewest = expected;
    largestSmall_ = largest;
    leastWeight_ = leastWeight;
  }
}

}  // namespace lampblack::particles
