// Eight doubles from anywhere in memory that are computed with at once, and their sums. Where registers are narrower
// the compiler takes several.
#pragma once

#include <cstddef>
#include <cstring>

#include "core/modules.hpp"

// GCC warns that such values pass differently between functions compiled for different processors; these pass between
// functions of one program only, all compiled alike.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace lampblack::numerics {

constexpr std::size_t laneCount = 8;

// GCC and Clang: +, -, *, / work by element, a scalar operand counts for all.
using Lanes = double __attribute__((vector_size(laneCount * sizeof(double))));

// n rounded up to whole lanes.
constexpr std::size_t paddedToLanes(std::size_t n) {
  return (n + laneCount - 1) / laneCount * laneCount;
}

// Eight values from, and to, any place in memory.
inline Lanes loadLanes(const double* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void storeLanes(double* to, const Lanes& v) {
  std::memcpy(to, &v, sizeof v);
}

inline double sumOfLanes(const Lanes& v) {
  return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
}

// The sums of eight.
inline Lanes sumsOfLanes(const Lanes* v) {
  Lanes fours[4], twos[2];
  for (std::size_t i = 0; i < 4; ++i)
    fours[i] = __builtin_shufflevector(v[2 * i], v[2 * i + 1], 0, 8, 2, 10, 4, 12, 6, 14) +
               __builtin_shufflevector(v[2 * i], v[2 * i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  for (std::size_t i = 0; i < 2; ++i)
    twos[i] = __builtin_shufflevector(fours[2 * i], fours[2 * i + 1], 0, 1, 8, 9, 4, 5, 12, 13) +
              __builtin_shufflevector(fours[2 * i], fours[2 * i + 1], 2, 3, 10, 11, 6, 7, 14, 15);
  return __builtin_shufflevector(twos[0], twos[1], 0, 1, 2, 3, 8, 9, 10, 11) +
         __builtin_shufflevector(twos[0], twos[1], 4, 5, 6, 7, 12, 13, 14, 15);
}

// sum_i a_i
inline double sumOf(const double* a, std::size_t n) {
  Lanes sums{};
  std::size_t i = 0;
  for (; i + laneCount <= n; i += laneCount) sums += loadLanes(a + i);
  double sum = sumOfLanes(sums);
  for (; i < n; ++i) sum += a[i];
  return sum;
}

}  // namespace lampblack::numerics
