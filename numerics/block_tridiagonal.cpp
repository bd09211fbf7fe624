#include "numerics/block_tridiagonal.hpp"

#include <algorithm>

#include "numerics/block_tridiagonal_data.hpp"
#include "numerics/dense_blocks.hpp"

namespace lampblack::numerics {

BlockTridiagonal::BlockTridiagonal(MPI_Comm comm, std::size_t points, std::size_t width, std::size_t border,
                                   NeighbourTerms terms) {
  if (points == 0 || width == 0) throw std::logic_error("BlockTridiagonal: empty");
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  data_ = std::make_unique<Data>(comm, rank, ranks, points, width, border, terms);
}
BlockTridiagonal::~BlockTridiagonal() = default;
BlockTridiagonal::BlockTridiagonal(BlockTridiagonal&&) noexcept = default;
BlockTridiagonal& BlockTridiagonal::operator=(BlockTridiagonal&&) noexcept = default;

std::size_t BlockTridiagonal::points() const {
  return data_->points;
}
std::size_t BlockTridiagonal::width() const {
  return data_->n;
}
std::size_t BlockTridiagonal::border() const {
  return data_->border;
}
std::size_t BlockTridiagonal::ownedBegin() const {
  return data_->begin();
}
std::size_t BlockTridiagonal::ownedEnd() const {
  return data_->end();
}
std::size_t BlockTridiagonal::singularPoint() const {
  return data_->singular;
}

void BlockTridiagonal::clear() {
  auto& d = *data_;
  if (d.untouched) return;
  for (auto& end : d.ends) end.clear();
  for (auto* block : {&d.middleLower, &d.middleDiagonal, &d.middleUpper, &d.middleColumns, &d.middleRows, &d.corner})
    std::fill(block->begin(), block->end(), 0.0);
  d.untouched = d.set = true;
  d.factorised = false;
}

NeighbourBlock BlockTridiagonal::lower(std::size_t row) {
  if (row == 0) throw std::logic_error("BlockTridiagonal: no block left of the first row");
  return data_->lower(row);
}

double* BlockTridiagonal::diagonal(std::size_t row) {
  return data_->diagonal(row);
}

NeighbourBlock BlockTridiagonal::upper(std::size_t row) {
  if (row + 1 == points()) throw std::logic_error("BlockTridiagonal: no block right of the last row");
  return data_->upper(row);
}

double* BlockTridiagonal::borderColumns(std::size_t row) {
  return data_->columns(row);
}
double* BlockTridiagonal::borderRows(std::size_t column) {
  return data_->rows(column);
}

double* BlockTridiagonal::corner() {
  if (!data_->set) throw std::logic_error("BlockTridiagonal: the blocks have become factors");
  data_->untouched = false;
  return data_->corner.data();
}

void BlockTridiagonal::multiply(std::span<const double> x, std::span<double> y) const {
  auto& d = *data_;
  if (!d.set) throw std::logic_error("BlockTridiagonal: multiply after factorise");
  if (x.size() != size() || y.size() != size()) throw std::logic_error("BlockTridiagonal: wrong size of a vector");
  const std::size_t n = d.n;
  const double* z = x.data() + d.points * n;
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t i = d.begin(); i < d.end(); ++i) {
    double* row = y.data() + i * n;
    const double* at = x.data() + i * n;
    if (i > 0) d.lower(i).addTimes(1, at - n, row);
    addProduct(n, n, 1, d.diagonal(i), at, row);
    if (i + 1 < d.points) d.upper(i).addTimes(1, at + n, row);
    addProduct(n, d.border, 1, d.columns(i), z, row);
    addProduct(d.border, n, 1, d.rows(i), at, y.data() + d.points * n);
  }
  if (d.owns[left]) addProduct(d.border, d.border, 1, d.corner.data(), z, y.data() + d.points * n);
  MPI_Allreduce(MPI_IN_PLACE, y.data(), static_cast<int>(y.size()), MPI_DOUBLE, MPI_SUM, d.comm);
}

}  // namespace lampblack::numerics
