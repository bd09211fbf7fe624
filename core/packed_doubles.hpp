// Complete states as rows of doubles: what travels between ranks and is written to checkpoints.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "core/errors.hpp"

namespace lampblack {

// Structs of nothing but doubles.
template <class T>
concept Doubles = std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0 && alignof(T) <= alignof(double);

template <Doubles T>
void packDoubles(std::vector<double>& state, const T& value) {
  const auto values = std::bit_cast<std::array<double, sizeof(T) / sizeof(double)>>(value);
  state.insert(state.end(), values.begin(), values.end());
}

// In place of the first values.
template <Doubles T>
void setFront(std::vector<double>& state, const T& value) {
  std::ranges::copy(std::bit_cast<std::array<double, sizeof(T) / sizeof(double)>>(value), state.begin());
}

// So many more values behind those that are there, to be filled. Rows asked for before may have moved.
inline std::span<double> addRow(std::vector<double>& state, std::size_t count) {
  state.resize(state.size() + count);
  return std::span(state).last(count);
}
inline void addRow(std::vector<double>& state, std::span<const double> row) {
  state.insert(state.end(), row.begin(), row.end());
}

// Reads them back in order. InputError where there are no more.
class PackedDoubles {
 public:
  explicit PackedDoubles(std::span<const double> state) : rest_(state) {}

  template <Doubles T = double>
  T next() {
    std::array<double, sizeof(T) / sizeof(double)> values;
    if (rest_.size() < values.size()) throw InputError("the saved state ends too early");
    std::copy_n(rest_.begin(), values.size(), values.begin());
    rest_ = rest_.subspan(values.size());
    return std::bit_cast<T>(values);
  }
  // The next values, where they are.
  std::span<const double> nextRow(std::size_t count) {
    if (rest_.size() < count) throw InputError("the saved state ends too early");
    const std::span<const double> row = rest_.first(count);
    rest_ = rest_.subspan(count);
    return row;
  }
  // How many of something follow, of one double each at least.
  std::size_t nextCount() {
    const double count = next();
    if (!(count >= 0) || count != std::floor(count) || count > static_cast<double>(rest_.size()))
      throw InputError("the saved state is damaged: it holds less than it says");
    return static_cast<std::size_t>(count);
  }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  std::span<const double> rest_;
};

}  // namespace lampblack
