#include "numerics/sparse_lu.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numerics/block.hpp"

namespace lampblack::numerics {

namespace {

// Subtracts from each of the changed columns the multipliers l, N blocks, times the column's entry in row k. The
// multipliers stay in registers.
template <std::size_t N>
void updateFixed(double* matrix, const double* l, const std::uint32_t* blocks, const std::uint32_t* changed,
                 const std::uint32_t* changedEnd, std::size_t k) {
  Block multipliers[N];
  for (std::size_t b = 0; b < N; ++b) multipliers[b] = blockAt(l + b * kBlockWidth);
  for (; changed != changedEnd; ++changed) {
    double* column = matrix + *changed;
    const double a = column[k];
    for (std::size_t b = 0; b < N; ++b) blockAt(column + blocks[b]) -= a * multipliers[b];
  }
}

void updateAny(double* matrix, const double* l, const std::uint32_t* blocks, std::size_t numBlocks,
               const std::uint32_t* changed, const std::uint32_t* changedEnd, std::size_t k) {
  for (; changed != changedEnd; ++changed) {
    double* column = matrix + *changed;
    const double a = column[k];
    for (std::size_t b = 0; b < numBlocks; ++b) blockAt(column + blocks[b]) -= a * blockAt(l + b * kBlockWidth);
  }
}

}  // namespace

SparseLu::SparseLu(const Elimination& elimination)
    : n_(elimination.unknown.size()),
      ld_(wholeBlocks(n_)),
      inner_(elimination.inner),
      unknown_(elimination.unknown),
      place_(elimination.place) {
  setLists(elimination.factors);
  inPattern_.assign(storageSize(), 0);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j)
      if (elimination.matrix[i][j] != 0) inPattern_[place_[i] + ld_ * place_[j]] = 1;
  matrix_.assign(storageSize(), 0.0);
  l_.assign(lower_.size() * kBlockWidth, 0.0);
  diagonalUpper_.assign(ld_ * kBlockWidth, 0.0);
  inverseDiagonal_.assign(ld_, 0.0);
  innerRows_.assign(ld_, 0.0);
  std::fill_n(innerRows_.begin(), inner_, 1.0);
  growth_.assign(2 * kBlockWidth, 0.0);
  x_.assign(ld_, 0.0);
}

void SparseLu::setLists(const Elimination::Pattern& pattern) {
  const auto has = [&](std::size_t i, std::size_t j) { return pattern[unknown_[i]][unknown_[j]] != 0; };
  const auto end = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  for (std::size_t k = 0; k < n_; ++k) {
    Column column{end(used_), 0, end(upper_), 0, end(lower_), 0, end(changed_), 0, false};
    for (std::size_t block = 0; block < ld_; block += kBlockWidth) {
      bool upper = false, lower = false;
      for (std::size_t i = block; i < std::min(block + kBlockWidth, n_); ++i) {
        if (!has(i, k)) continue;
        ++numEntries_;
        upper = upper || i < k;
        lower = lower || i > k;
      }
      const auto first = static_cast<std::uint32_t>(block);
      const bool onDiagonal = block == k / kBlockWidth * kBlockWidth;
      if (upper || lower || onDiagonal) used_.push_back(first);
      if (upper && !onDiagonal) upper_.push_back(first);
      if (lower || onDiagonal) lower_.push_back(first);
      if (onDiagonal) column.lowerInDiagonalBlock = lower;
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
  for (const auto& c : columns_)
    sum += std::size_t{c.lowerEnd - c.lower - (c.lowerInDiagonalBlock ? 0U : 1U)} * (c.changedEnd - c.changed);
  return sum;
}

void SparseLu::load(const AlignedVector& values, double factor, std::span<const double> diagonal) {
  const double minus = -factor;
  for (std::size_t k = 0; k < n_; ++k) {
    const double* from = values.data() + k * ld_;
    double* to = matrix_.data() + k * ld_;
    for (std::uint32_t u = columns_[k].used; u < columns_[k].usedEnd; ++u)
      blockAt(to + used_[u]) = minus * blockAt(from + used_[u]);
    to[k] += diagonal[unknown_[k]];
  }
}

// The pivot and the multipliers of column k, whose part of U is complete.
void SparseLu::finishColumn(std::size_t k) {
  const auto& c = columns_[k];
  const double* column = matrix_.data() + k * ld_;
  const double inverse = 1.0 / column[k];
  inverseDiagonal_[k] = inverse;
  const Block place = {0, 1, 2, 3, 4, 5, 6, 7}, none = {};
  const auto here = static_cast<double>(k % kBlockWidth);
  Block& largest = blockAt(growth_.data());
  Block& finite = blockAt(growth_.data() + kBlockWidth);
  for (std::uint32_t b = c.lower; b < c.lowerEnd; ++b) {
    Block l = blockAt(column + lower_[b]) * inverse;
    if (b == c.lower) {
      blockAt(diagonalUpper_.data() + k * kBlockWidth) = place < here ? l : none;
      l = place > here ? l : none;
    }
    blockAt(l_.data() + b * kBlockWidth) = l;
    const Block size = (l < 0 ? -l : l) * blockAt(innerRows_.data() + lower_[b]);
    largest = size > largest ? size : largest;
    finite += 0.0 * l;
  }
}

void SparseLu::updateColumns(std::size_t k) {
  const auto& c = columns_[k];
  const std::size_t first = c.lower + (c.lowerInDiagonalBlock ? 0U : 1U), numBlocks = c.lowerEnd - first;
  const std::uint32_t *blocks = lower_.data() + first, *changed = changed_.data() + c.changed,
                      *changedEnd = changed_.data() + c.changedEnd;
  const double* l = l_.data() + first * kBlockWidth;
  double* matrix = matrix_.data();
  switch (numBlocks) {
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
      return updateAny(matrix, l, blocks, numBlocks, changed, changedEnd, k);
  }
}

bool SparseLu::accept() const {
  for (std::size_t i = 0; i < kBlockWidth; ++i)
    if (!(growth_[i] <= largestMultiplier) || growth_[kBlockWidth + i] != 0) return false;
  for (std::size_t k = 0; k < n_; ++k)
    if (!std::isfinite(inverseDiagonal_[k])) return false;
  return true;
}

bool SparseLu::factorise(const AlignedVector& values, double factor, std::span<const double> diagonal) {
  load(values, factor, diagonal);
  std::fill(growth_.begin(), growth_.end(), 0.0);
  for (std::size_t k = 0; k < n_; ++k) {
    finishColumn(k);
    updateColumns(k);
  }
  return accept();
}

// Eight unknowns at a time: those among them in a register, then what they mean for the later ones.
void SparseLu::solveLower(double* x) const {
  for (std::size_t block = 0; block < n_; block += kBlockWidth) {
    const std::size_t count = std::min(kBlockWidth, n_ - block);
    Block here = blockAt(x + block);
    for (std::size_t i = 0; i < count; ++i)
      here -= here[i] * blockAt(l_.data() + columns_[block + i].lower * kBlockWidth);
    blockAt(x + block) = here;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& c = columns_[block + i];
      const double value = here[i];
      for (std::uint32_t b = c.lower + 1; b < c.lowerEnd; ++b)
        blockAt(x + lower_[b]) -= value * blockAt(l_.data() + b * kBlockWidth);
    }
  }
}

void SparseLu::solveUpper(double* x) const {
  for (std::size_t end = ld_; end > 0; end -= kBlockWidth) {
    const std::size_t block = end - kBlockWidth, count = std::min(kBlockWidth, n_ - block);
    Block here = blockAt(x + block);
    for (std::size_t i = count; i-- > 0;) here -= here[i] * blockAt(diagonalUpper_.data() + (block + i) * kBlockWidth);
    here *= blockAt(inverseDiagonal_.data() + block);
    blockAt(x + block) = here;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& c = columns_[block + i];
      const double* column = matrix_.data() + (block + i) * ld_;
      const double value = here[i];
      for (std::uint32_t b = c.upper; b < c.upperEnd; ++b)
        blockAt(x + upper_[b]) -= value * blockAt(column + upper_[b]);
    }
  }
}

void SparseLu::solve(double* b) {
  for (std::size_t k = 0; k < n_; ++k) x_[k] = b[unknown_[k]];
  solveLower(x_.data());
  solveUpper(x_.data());
  for (std::size_t k = 0; k < n_; ++k) b[unknown_[k]] = x_[k];
}

}  // namespace lampblack::numerics
