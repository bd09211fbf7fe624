#include "coupling/block_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace lampblack::coupling {
namespace {

// Of a function that grows: where it is `value`, to the last bits.
template <typename Function>
double whereIs(double value, double low, double high, const Function& function) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (function(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Student's t between -t and t, as a function of the angle atan(t/sqrt(freedom)) (Abramowitz and Stegun 1964, 26.7.3
// and 26.7.4).
double studentWithin(double angle, std::size_t freedom) {
  const double c = std::cos(angle), s = std::sin(angle);
  const bool odd = freedom % 2 == 1;
  double term = odd ? c : 1.0, sum = 0.0;
  for (std::size_t k = odd ? 3 : 2; k <= freedom; k += 2) {
    sum += term;
    term *= c * c * static_cast<double>(k - 1) / static_cast<double>(k);
  }
  return odd ? 2.0 / constants::pi * (angle + s * sum) : s * sum;
}

struct Line {
  double rise = 0.0, error = 0.0;  // from the first to the last, and its standard error
};

Line lineThrough(std::span<const double> y) {
  const auto n = static_cast<double>(y.size());
  const BlockMean all = meanOf(y);
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double x = static_cast<double>(i) - 0.5 * (n - 1.0);
    xx += x * x;
    xy += x * (y[i] - all.mean);
  }
  const double slope = xy / xx, left = std::max(0.0, all.squares - slope * xy);
  return {(n - 1.0) * slope, (n - 1.0) * std::sqrt(left / (n - 2.0) / xx)};
}

// Pairs that grow less those that fall, over its deviation where there is no trend.
double kendall(std::span<const double> y) {
  const auto n = static_cast<double>(y.size());
  double pairs = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t j = i + 1; j < y.size(); ++j) pairs += y[j] > y[i] ? 1.0 : y[j] < y[i] ? -1.0 : 0.0;
  return pairs / std::sqrt(n * (n - 1.0) * (2.0 * n + 5.0) / 18.0);
}

bool hasTrend(std::span<const double> y, double drift) {
  constexpr double normal = 1.96;  // as studentQuantile of many
  const Line line = lineThrough(y);
  if (std::abs(line.rise) <= drift * meanOf(y).mean) return false;
  return std::abs(line.rise) > studentQuantile(y.size() - 2) * line.error || std::abs(kendall(y)) > normal;
}

}  // namespace

double studentQuantile(std::size_t freedom, double within) {
  freedom = std::min<std::size_t>(freedom, 1000);  // 1.9623 there, 1.9600 of any number
  const double angle =
      whereIs(within, 0.0, 0.5 * constants::pi, [&](double tried) { return studentWithin(tried, freedom); });
  return std::sqrt(static_cast<double>(freedom)) * std::tan(angle);
}

std::optional<BlockInterval> BlockInterval::of(std::size_t blocks) {
  if (blocks < leastBlocks) return {};
  const auto n = static_cast<double>(blocks);
  return BlockInterval(studentQuantile(blocks - 1) / std::sqrt(n * (n - 1.0)));
}

BlockMean meanOf(std::span<const double> blocks) {
  BlockMean result;
  for (const double x : blocks) result.mean += x / static_cast<double>(blocks.size());
  for (const double x : blocks) result.squares += (x - result.mean) * (x - result.mean);
  return result;
}

bool isStationary(std::span<const double> blocks, double drift) {
  if (blocks.size() < leastToBeStationary) return false;
  const std::span<const double> last = blocks.last(std::max(leastToBeStationary, blocks.size() / 2));
  if (std::ranges::any_of(last, [](double x) { return !(x > 0.0); })) return false;
  return !hasTrend(last, drift) && !hasTrend(last.last(last.size() / 2), drift);
}

double lagOneCorrelation(std::span<const double> blocks) {
  if (blocks.size() < 3) return 0.0;
  const BlockMean all = meanOf(blocks);
  if (!(all.squares > 0.0)) return 0.0;
  double products = 0.0;
  for (std::size_t i = 0; i + 1 < blocks.size(); ++i) products += (blocks[i] - all.mean) * (blocks[i + 1] - all.mean);
  return products / all.squares;
}

bool areCorrelated(std::span<const double> blocks) {
  if (blocks.size() < leastBlocks) return false;
  constexpr double normal = 1.645;  // beyond it once in twenty
  const auto n = static_cast<double>(blocks.size());
  // Blocks without correlation are found with -1/n in the mean: their mean is taken from them.
  return lagOneCorrelation(blocks) > std::max(0.2, normal / std::sqrt(n) - 1.0 / n);
}

double correlationTime(double lagOne) {
  if (!(lagOne > 0.0)) return 0.0;
  // Of the length b of a block in correlation times; it falls.
  const auto correlation = [](double b) {
    const double x = std::expm1(-b);
    return x * x / (2.0 * (b + x));
  };
  return 1.0 / whereIs(-std::min(lagOne, 0.99), 0.01, 1e4, [&](double b) { return -correlation(b); });
}

}  // namespace lampblack::coupling
