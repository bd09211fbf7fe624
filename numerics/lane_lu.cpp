#include "numerics/lane_lu.hpp"

#include <algorithm>
#include <stdexcept>

namespace lampblack::numerics {

LaneLu::LaneLu(const Elimination& elimination, std::size_t lanes)
    : lanes_(lanes), inner_(elimination.inner), place_(elimination.place) {
  const auto& order = elimination.unknown;
  for (const std::size_t unknown : order) unknown_.push_back(static_cast<std::uint32_t>(unknown * lanes));
  const auto add = [&](Rows& rows, const Elimination::Pattern& pattern, std::size_t i, std::size_t first,
                       std::size_t last) {
    rows.begin.push_back(static_cast<std::uint32_t>(rows.list.size()));
    for (std::size_t j = first; j < last; ++j)
      if (pattern[order[i]][order[j]] != 0) rows.list.push_back(static_cast<std::uint32_t>(j * lanes));
  };
  const std::size_t n = order.size();
  for (std::size_t i = 0; i < n; ++i) {
    add(matrix_, elimination.matrix, i, 0, n);
    add(lower_, elimination.factors, i, 0, i);
    add(upper_, elimination.factors, i, i + 1, n);
  }
  for (Rows* rows : {&matrix_, &lower_, &upper_}) rows->begin.push_back(static_cast<std::uint32_t>(rows->list.size()));
}

LaneLuView LaneLu::view() const {
  return {size(),
          inner_,
          matrix_.begin.data(),
          lower_.begin.data(),
          upper_.begin.data(),
          matrix_.list.data(),
          lower_.list.data(),
          upper_.list.data(),
          unknown_.data()};
}

std::uint32_t LaneLu::position(std::size_t row, std::size_t column) const {
  const auto first = matrix_.list.begin() + matrix_.begin[place_[row]];
  const auto last = matrix_.list.begin() + matrix_.begin[place_[row] + 1];
  const auto at = std::lower_bound(first, last, static_cast<std::uint32_t>(place_[column] * lanes_));
  if (at == last || *at != place_[column] * lanes_) throw std::logic_error("LaneLu: an entry outside the pattern");
  return static_cast<std::uint32_t>((at - matrix_.list.begin()) * static_cast<std::ptrdiff_t>(lanes_));
}

}  // namespace lampblack::numerics
