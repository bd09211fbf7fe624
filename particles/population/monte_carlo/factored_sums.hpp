// Sums from which entries of a flat array are drawn. Each entry has a few values (the p and q of a kernel's terms,
// rates of single processes) and a few factors (its weight, say); the sum over all entries of each value times each
// factor is kept, and that over each block of neighbouring places. An entry is drawn by a walk over the sums of the
// blocks and another within one block, and changing one touches one block: O(N / block + block) for N entries.
//
// Sums change by differences. renew() makes them from the entries, so that rounding errors do not pile up; a walk that
// such an error leads past the last entry says so.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

template <std::size_t mostValues, std::size_t factors>
class FactoredSums {
 public:
  // Neighbouring places with one sum: about the root of the number of entries in a cell.
  static constexpr std::size_t block = 32;
  using Values = std::array<double, mostValues>;
  using Factors = std::array<double, factors>;

  // Of `values` values an entry, no more than mostValues.
  explicit FactoredSums(std::size_t values) : used_(values), width_(values * factors) {}

  [[nodiscard]] std::size_t size() const { return factors_.size(); }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = factors_.capacity() * sizeof(Factors) + blocks_.capacity() * sizeof(double);
    for (const std::vector<double>& column : values_) sum += column.capacity() * sizeof(double);
    return sum;
  }

  // To fill anew: what entries have is undefined until place() was called for each, sums until renew() was called.
  void resize(std::size_t size) {
    for (std::size_t v = 0; v < used_; ++v) values_[v].resize(size);
    factors_.resize(size);
  }
  void place(std::size_t at, const Values& values, const Factors& multipliers) {
    for (std::size_t v = 0; v < used_; ++v) values_[v][at] = values[v];
    factors_[at] = multipliers;
  }
  void renew() {
    blocks_.assign((size() + block - 1) / block * width_, 0.0);
    totals_.fill(0.0);
    for (std::size_t b = 0; b * block < size(); ++b) {
      double* sums = &blocks_[b * width_];
      const std::size_t end = std::min((b + 1) * block, size());
      for (std::size_t v = 0; v < used_; ++v) {
        Factors sum{};
        for (std::size_t at = b * block; at < end; ++at)
          for (std::size_t f = 0; f < factors; ++f) sum[f] += values_[v][at] * factors_[at][f];
        for (std::size_t f = 0; f < factors; ++f) {
          sums[v * factors + f] = sum[f];
          totals_[v * factors + f] += sum[f];
        }
      }
    }
  }

  [[nodiscard]] double value(std::size_t v, std::size_t at) const { return values_[v][at]; }
  [[nodiscard]] const Factors& factorsOf(std::size_t at) const { return factors_[at]; }
  [[nodiscard]] double total(std::size_t v, std::size_t f) const { return totals_[v * factors + f]; }

  void append(const Values& values, const Factors& multipliers) {
    const std::size_t at = size();
    if (at % block == 0) blocks_.resize(blocks_.size() + width_, 0.0);
    for (std::size_t v = 0; v < used_; ++v) values_[v].push_back(values[v]);
    factors_.push_back(multipliers);
    add(at, multipliers);
  }
  void set(std::size_t at, const Values& values, const Factors& multipliers) {
    remove(at);
    place(at, values, multipliers);
    add(at, multipliers);
  }
  void setFactors(std::size_t at, const Factors& multipliers) {
    Factors by;
    for (std::size_t f = 0; f < factors; ++f) by[f] = multipliers[f] - factors_[at][f];
    factors_[at] = multipliers;
    add(at, by);
  }
  // The last entry takes the place of this one.
  void replaceByLast(std::size_t at) {
    const std::size_t last = size() - 1;
    remove(at);
    if (at != last) {
      remove(last);
      for (std::size_t v = 0; v < used_; ++v) values_[v][at] = values_[v][last];
      factors_[at] = factors_[last];
      add(at, factors_[at]);
    }
    for (std::size_t v = 0; v < used_; ++v) values_[v].pop_back();
    factors_.pop_back();
    if (last % block == 0) blocks_.resize(blocks_.size() - width_);
  }

  // The entry in whose part of the sum `x` falls; size() for a rounding error.
  [[nodiscard]] std::size_t find(std::size_t v, std::size_t f, double x) const {
    const double* sums = blocks_.data() + v * factors + f;
    const std::size_t blocks = blocks_.size() / width_;
    std::size_t b = 0;
    for (; b < blocks && x >= sums[b * width_]; ++b) x -= sums[b * width_];
    if (b == blocks) return size();
    const double* values = values_[v].data();
    const std::size_t end = std::min((b + 1) * block, size());
    for (std::size_t at = b * block; at < end; ++at) {
      const double own = values[at] * factors_[at][f];
      if (x < own) return at;
      x -= own;
    }
    return size();
  }

 private:
  void add(std::size_t at, const Factors& multipliers) {
    double* sums = &blocks_[at / block * width_];
    for (std::size_t v = 0; v < used_; ++v) {
      const double value = values_[v][at];
      for (std::size_t f = 0; f < factors; ++f) {
        const double by = value * multipliers[f];
        sums[v * factors + f] += by;
        totals_[v * factors + f] += by;
      }
    }
  }
  void remove(std::size_t at) {
    Factors negative;
    for (std::size_t f = 0; f < factors; ++f) negative[f] = -factors_[at][f];
    add(at, negative);
  }

  std::size_t used_, width_;
  std::array<std::vector<double>, mostValues> values_;
  std::vector<Factors> factors_;
  std::vector<double> blocks_;  // of each block, each value's sums with all factors
  std::array<double, mostValues * factors> totals_{};
};

}  // namespace lampblack::particles
