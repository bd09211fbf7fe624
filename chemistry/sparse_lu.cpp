#include "chemistry/sparse_lu.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lampblack {

namespace {

constexpr std::size_t kWidth = 8;  // rows of a block, doubles of a cache line

inline void subtractScaled(double* __restrict y, const double* __restrict x, double a) {
  for (std::size_t i = 0; i < kWidth; ++i) y[i] -= a * x[i];
}

// Subtracts from each of the changed columns the multipliers l in N blocks times the column's entry in row k.
template <std::size_t N>
void updateFixed(double* __restrict matrix, const double* __restrict l, const std::uint32_t* blocks,
                 const std::uint32_t* changed, const std::uint32_t* changedEnd, std::size_t k) {
  for (; changed != changedEnd; ++changed) {
    double* column = matrix + *changed;
    const double a = column[k];
    for (std::size_t b = 0; b < N; ++b) subtractScaled(column + blocks[b], l + b * kWidth, a);
  }
}

}  // namespace

SparseLu::SparseLu(std::size_t n, std::span<const Entry> entries, std::size_t border)
    : n_(n), ld_((n + kWidth - 1) / kWidth * kWidth), inner_(n - border), inverseDiagonal_(n) {
  Pattern pattern(n, std::vector<char>(n, 0));
  for (std::size_t i = 0; i < n; ++i) pattern[i][i] = 1;
  for (const auto& entry : entries) pattern[entry.row][entry.column] = 1;
  const Pattern original = pattern;
  eliminate(pattern);
  setLists(pattern);
  inPattern_.assign(storageSize(), 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (original[i][j] != 0) inPattern_[place_[i] + ld_ * place_[j]] = 1;
  matrix_.assign(storageSize(), 0.0);
  l_.assign(lower_.size() * kWidth, 0.0);
  x_.assign(ld_, 0.0);
}

// The order of elimination, and the pattern with its fill.
void SparseLu::eliminate(Pattern& pattern) {
  std::vector<char> done(n_, 0);
  place_.assign(n_, 0);
  std::vector<std::size_t> rows, columns;
  for (std::size_t step = 0; step < n_; ++step) {
    std::size_t pivot = step, least = SIZE_MAX;  // the border in its own order
    for (std::size_t k = 0; step < inner_ && k < inner_; ++k) {
      if (done[k] != 0) continue;
      std::size_t inRow = 0, inColumn = 0;
      for (std::size_t i = 0; i < n_; ++i) {
        if (done[i] != 0 || i == k) continue;
        inRow += pattern[k][i] != 0;
        inColumn += pattern[i][k] != 0;
      }
      if (inRow * inColumn < least) {
        least = inRow * inColumn;
        pivot = k;
      }
    }
    done[pivot] = 1;
    place_[pivot] = step;
    unknown_.push_back(pivot);
    for (std::size_t i = 0; i < n_; ++i) {
      if (done[i] != 0 || pattern[i][pivot] == 0) continue;
      for (std::size_t j = 0; j < n_; ++j)
        if (done[j] == 0 && pattern[pivot][j] != 0) pattern[i][j] = 1;
    }
  }
}

void SparseLu::setLists(const Pattern& pattern) {
  const auto has = [&](std::size_t i, std::size_t j) { return pattern[unknown_[i]][unknown_[j]] != 0; };
  const auto end = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  for (std::size_t k = 0; k < n_; ++k) {
    Column column{end(used_), 0, end(upper_), 0, end(lower_), 0, end(changed_), 0};
    for (std::size_t block = 0; block < ld_; block += kWidth) {
      bool upper = false, lower = false;
      for (std::size_t i = block; i < std::min(block + kWidth, n_); ++i) {
        if (!has(i, k)) continue;
        ++numEntries_;
        upper = upper || i < k;
        lower = lower || i > k;
      }
      const auto first = static_cast<std::uint32_t>(block);
      if (upper || lower || block == k / kWidth * kWidth) used_.push_back(first);
      if (upper) upper_.push_back(first);
      if (lower) lower_.push_back(first);
    }
    for (std::size_t j = k + 1; j < n_; ++j)
      if (has(k, j)) changed_.push_back(static_cast<std::uint32_t>(j * ld_));
    column.usedEnd = end(used_);
    column.upperEnd = end(upper_);
    column.lowerEnd = end(lower_);
    column.changedEnd = end(changed_);
    columns_.push_back(column);
  }
}

std::size_t SparseLu::position(std::size_t row, std::size_t column) const {
  const std::size_t at = place_[row] + ld_ * place_[column];
  if (inPattern_[at] == 0) throw std::logic_error("SparseLu: an entry outside the pattern");
  return at;
}

std::size_t SparseLu::blockUpdates() const {
  std::size_t sum = 0;
  for (const auto& c : columns_) sum += std::size_t{c.lowerEnd - c.lower} * (c.changedEnd - c.changed);
  return sum;
}

void SparseLu::load(const AlignedVector& values, double factor, std::span<const double> diagonal) {
  for (std::size_t k = 0; k < n_; ++k) {
    const double* __restrict from = values.data() + k * ld_;
    double* __restrict to = matrix_.data() + k * ld_;
    for (std::uint32_t u = columns_[k].used; u < columns_[k].usedEnd; ++u) {
      const std::size_t block = used_[u];
      for (std::size_t i = 0; i < kWidth; ++i) to[block + i] = -factor * from[block + i];
    }
    to[k] += diagonal[unknown_[k]];
  }
}

// The pivot and multipliers of column k; leaves U alone in the matrix.
bool SparseLu::finishColumn(std::size_t k) {
  const auto& c = columns_[k];
  double* __restrict column = matrix_.data() + k * ld_;
  const double inverse = 1.0 / column[k];
  inverseDiagonal_[k] = inverse;
  if (!std::isfinite(inverse)) return false;
  double largest = 0;
  for (std::uint32_t b = c.lower; b < c.lowerEnd; ++b) {
    const std::size_t block = lower_[b];
    double* __restrict l = l_.data() + b * kWidth;
    for (std::size_t i = 0; i < kWidth; ++i) l[i] = column[block + i] * inverse;
    if (block <= k)
      for (std::size_t i = block; i <= k; ++i) l[i - block] = 0;
    for (std::size_t i = 0; i < std::min(kWidth, inner_ - std::min(inner_, block)); ++i)
      largest = std::max(largest, std::abs(l[i]));
  }
  for (std::size_t i = k; i < (k / kWidth + 1) * kWidth; ++i) column[i] = 0;
  return largest <= largestMultiplier;
}

void SparseLu::updateColumns(std::size_t k) {
  const auto& c = columns_[k];
  const std::uint32_t *blocks = lower_.data() + c.lower, *changed = changed_.data() + c.changed,
                      *changedEnd = changed_.data() + c.changedEnd;
  const double* l = l_.data() + c.lower * kWidth;
  double* matrix = matrix_.data();
  const std::size_t count = c.lowerEnd - c.lower;
  switch (count) {
    case 0:
      return;
    case 1:
      return updateFixed<1>(matrix, l, blocks, changed, changedEnd, k);
    case 2:
      return updateFixed<2>(matrix, l, blocks, changed, changedEnd, k);
    case 3:
      return updateFixed<3>(matrix, l, blocks, changed, changedEnd, k);
    case 4:
      return updateFixed<4>(matrix, l, blocks, changed, changedEnd, k);
    default:
      for (; changed != changedEnd; ++changed) {
        double* column = matrix + *changed;
        const double a = column[k];
        for (std::size_t b = 0; b < count; ++b) subtractScaled(column + blocks[b], l + b * kWidth, a);
      }
  }
}

bool SparseLu::factorise(const AlignedVector& values, double factor, std::span<const double> diagonal) {
  load(values, factor, diagonal);
  for (std::size_t k = 0; k < n_; ++k) {
    if (!finishColumn(k)) return false;
    updateColumns(k);
  }
  return true;
}

void SparseLu::solve(double* b) {
  double* __restrict x = x_.data();
  for (std::size_t k = 0; k < n_; ++k) x[k] = b[unknown_[k]];
  for (std::size_t k = 0; k < n_; ++k) {
    const double value = x[k];
    const auto& c = columns_[k];
    for (std::uint32_t i = c.lower; i < c.lowerEnd; ++i) subtractScaled(x + lower_[i], l_.data() + i * kWidth, value);
  }
  for (std::size_t k = n_; k-- > 0;) {
    const double value = x[k] * inverseDiagonal_[k];
    const double* column = matrix_.data() + k * ld_;
    const auto& c = columns_[k];
    for (std::uint32_t i = c.upper; i < c.upperEnd; ++i) subtractScaled(x + upper_[i], column + upper_[i], value);
    x[k] = value;
  }
  for (std::size_t k = 0; k < n_; ++k) b[unknown_[k]] = x[k];
}

}  // namespace lampblack
