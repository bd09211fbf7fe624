// Means over blocks of time that follow each other, of something that fluctuates: whether it has become stationary, how
// far the mean of the blocks may be off, and how long the blocks would have to be to know nothing of each other.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "core/modules.hpp"

namespace lampblack::coupling {

// Fewer blocks have no interval: with four degrees of freedom Student's t is 2.8 already.
inline constexpr std::size_t leastBlocks = 5;
// Fewer blocks do not tell whether there is a trend.
inline constexpr std::size_t leastToBeStationary = 10;

// What Student's t with so many degrees of freedom, one at least, does not exceed to either side in the part `within`
// of all cases: with it an interval to both sides has 95 %.
[[nodiscard]] double studentQuantile(std::size_t freedom, double within = 0.95);

// The 95 % interval of the mean of so many blocks.
class BlockInterval {
 public:
  // Nothing below leastBlocks.
  [[nodiscard]] static std::optional<BlockInterval> of(std::size_t blocks);
  // Half its width, from the sum of the squares of the blocks' deviations from their mean.
  [[nodiscard]] double half(double squares) const { return perRoot_ * std::sqrt(std::max(0.0, squares)); }

 private:
  explicit BlockInterval(double perRoot) : perRoot_(perRoot) {}
  double perRoot_;
};

struct BlockMean {
  double mean = 0.0, squares = 0.0;  // of the deviations from the mean
};
[[nodiscard]] BlockMean meanOf(std::span<const double> blocks);

// Whether the last blocks, half of all and leastToBeStationary at least, have no trend: neither they nor their later
// half (that which has a peak in its middle has no slope). There is a trend where a line by least squares has a slope,
// or the pairs that grow say so (Kendall 1938) (a line sees little of a growth by powers), at 95 %; but for one by
// which the mean changes by less than the share `drift` from the first to the last. Means that are zero are of
// something that has not begun.
[[nodiscard]] bool isStationary(std::span<const double> blocks, double drift);

// Correlation of each block with the next, from minus one to one; zero of fewer than three.
[[nodiscard]] double lagOneCorrelation(std::span<const double> blocks);
// Whether it is more than blocks that know nothing of each other have in 95 of a hundred cases, and more than a fifth.
[[nodiscard]] bool areCorrelated(std::span<const double> blocks);
// In blocks: after what time a fluctuation has decayed to 1/e, where it does so exponentially and blocks have this
// correlation (of means over time, not of single values).
[[nodiscard]] double correlationTime(double lagOne);
// Blocks of so many correlation times are correlated by 0.06.
inline constexpr double longBlock = 10.0;

}  // namespace lampblack::coupling
