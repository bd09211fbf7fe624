#include "core/sorted_numbers.hpp"

#include <algorithm>

namespace lampblack {

std::vector<std::int64_t> sortedOnce(std::span<const std::int64_t> numbers) {
  // Piece by piece first: most numbers stand near their repetitions, so that there is less to hold and to sort.
  constexpr std::size_t piece = std::size_t{1} << 16U;
  std::vector<std::int64_t> result;
  const auto sortFrom = [&](std::size_t first) {
    const auto begin = result.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, result.end());
    result.erase(std::unique(begin, result.end()), result.end());
  };
  for (std::size_t i = 0; i < numbers.size(); i += piece) {
    const auto some = numbers.subspan(i, std::min(piece, numbers.size() - i));
    const std::size_t before = result.size();
    result.insert(result.end(), some.begin(), some.end());
    sortFrom(before);
  }
  sortFrom(0);
  result.shrink_to_fit();
  return result;
}

std::size_t indexIn(const std::vector<std::int64_t>& sorted, std::int64_t number) {
  return static_cast<std::size_t>(std::ranges::lower_bound(sorted, number) - sorted.begin());
}

}  // namespace lampblack
