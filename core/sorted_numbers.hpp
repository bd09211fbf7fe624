// Numbers in increasing order, each once, and where one of them stands.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lampblack {

std::vector<std::int64_t> sortedOnce(std::span<const std::int64_t> numbers);

// Index of the first that is not less than `number`.
std::size_t indexIn(const std::vector<std::int64_t>& sorted, std::int64_t number);

// The same for the corners of one cell after another: each is looked for first where that corner of the last cell
// stood, and just behind it.
class CornerFinder {
 public:
  explicit CornerFinder(const std::vector<std::int64_t>& sorted) : sorted_(sorted) {}
  std::size_t indexOf(std::size_t corner, std::int64_t number) {
    std::size_t& last = last_[corner];
    for (std::size_t i = last; i < last + 2 && i < sorted_.size(); ++i)
      if (sorted_[i] == number) return last = i;
    return last = indexIn(sorted_, number);
  }

 private:
  const std::vector<std::int64_t>& sorted_;
  std::array<std::size_t, 8> last_{};
};

}  // namespace lampblack
