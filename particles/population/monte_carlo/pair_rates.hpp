// Rates of pairs of a PairPopulation, one or several at a time: rows are loaded whole and turned into columns, so that
// what is computed is compiled to vector instructions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/pair_population.hpp"

namespace lampblack::particles {

inline constexpr std::size_t pairsTogether = 8;
using PlacesOfPairs = std::array<std::uint32_t, pairsTogether>;

// By a form of the kernel (PairKernel::visit()).
template <class Row, class Form>
class PairRates {
 public:
  PairRates(const Row* rows, const Form& form) : rows_(rows), form_(form) {}
  [[nodiscard]] double operator()(std::size_t i, std::size_t j) const {  // m3/s
    return static_cast<double>(form_(rows_[i].terms, rows_[j].terms));
  }
  // To the same bits. Not inlined: among other code GCC does not vectorise it.
  [[gnu::noinline]] void operator()(const PlacesOfPairs& i, const PlacesOfPairs& j,
                                    std::array<double, pairsTogether>& rates) const {
    const Columns a = columns(i), b = columns(j);
    for (std::size_t k = 0; k < pairsTogether; ++k)
      rates[k] = static_cast<double>(form_(PairKernel::Terms{a.size[k], a.mobility[k], a.inverseMass[k]},
                                           PairKernel::Terms{b.size[k], b.mobility[k], b.inverseMass[k]}));
  }

 private:
  // GCC and Clang: shuffled and stored whole.
  using Four = float __attribute__((vector_size(16)));
  using Eight = float __attribute__((vector_size(32)));
  struct Columns {
    alignas(Eight) std::array<float, pairsTogether> size, mobility, inverseMass;
  };
  [[nodiscard]] Four row(std::uint32_t k) const {
    static_assert(offsetof(Row, terms) + sizeof(Four) <= sizeof(Row) && sizeof(PairKernel::Terms) == 12);
    Four four;
    std::memcpy(&four, reinterpret_cast<const char*>(&rows_[k]) + offsetof(Row, terms), sizeof four);
    return four;
  }
  [[nodiscard]] Columns columns(const PlacesOfPairs& at) const {
    Four size[2], mobility[2], inverse[2];
    for (std::size_t half = 0; half < 2; ++half) {
      const Four a = row(at[4 * half]), b = row(at[4 * half + 1]);
      const Four c = row(at[4 * half + 2]), d = row(at[4 * half + 3]);
      const Four low = __builtin_shufflevector(a, b, 0, 4, 1, 5), lower = __builtin_shufflevector(c, d, 0, 4, 1, 5);
      const Four high = __builtin_shufflevector(a, b, 2, 6, 3, 7), higher = __builtin_shufflevector(c, d, 2, 6, 3, 7);
      size[half] = __builtin_shufflevector(low, lower, 0, 1, 4, 5);
      mobility[half] = __builtin_shufflevector(low, lower, 2, 3, 6, 7);
      inverse[half] = __builtin_shufflevector(high, higher, 0, 1, 4, 5);
    }
    Columns all;
    store(size, all.size);
    store(mobility, all.mobility);
    store(inverse, all.inverseMass);
    return all;
  }
  static void store(const Four* halves, std::array<float, pairsTogether>& to) {
    const Eight all = __builtin_shufflevector(halves[0], halves[1], 0, 1, 2, 3, 4, 5, 6, 7);
    std::memcpy(to.data(), &all, sizeof all);
  }

  const Row* rows_;
  Form form_;
};

// Of a kernel without a form.
template <class Type>
class PairRatesAsked {
 public:
  explicit PairRatesAsked(const PairPopulation<Type>& population) : population_(population) {}
  [[nodiscard]] double operator()(std::size_t i, std::size_t j) const { return population_.rateOf(i, j); }
  void operator()(const PlacesOfPairs& i, const PlacesOfPairs& j, std::array<double, pairsTogether>& rates) const {
    for (std::size_t k = 0; k < pairsTogether; ++k) rates[k] = population_.rateOf(i[k], j[k]);
  }

 private:
  const PairPopulation<Type>& population_;
};

}  // namespace lampblack::particles
