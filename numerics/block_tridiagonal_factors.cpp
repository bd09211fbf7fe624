#include <algorithm>

#include "numerics/block_tridiagonal_data.hpp"

namespace lampblack::numerics {

namespace {

constexpr int innermostTag = 71, innermostSumTag = 72;

// What the right end hands to the middle: X and Y of its innermost row, rows X, and its part of the corner.
struct Innermost {
  std::size_t X = 0, Y, rowsX, corner, size;

  Innermost(std::size_t n, std::size_t border)
      : Y(n * n), rowsX(Y + n * border), corner(rowsX + n * border), size(corner + border * border) {}
};

void copyBlock(std::size_t m, std::size_t n, const double* from, double* to, std::size_t ld) {
  for (std::size_t j = 0; j < n; ++j) std::copy_n(from + j * m, m, to + j * ld);
}

// Fills the parts that an end's innermost row determines; those of an end without rows are zero.
void packInnermost(BlockSweep& end, std::size_t n, std::size_t border, DenseBlocks& dense,
                   std::vector<double>& values) {
  if (end.size() == 0) return;
  const Innermost at(n, border);
  const std::size_t k = end.size() - 1;
  std::copy_n(end.innermost(), n * n, values.data());
  std::copy_n(end.columns(k), n * border, values.data() + at.Y);
  dense.subtractProduct(border, n, n, end.rows(k), border, end.innermost(), n, values.data() + at.rowsX, border);
}

}  // namespace

bool BlockTridiagonal::Data::factoriseCore(const std::vector<double>& ofLeft, const std::vector<double>& fromRight) {
  const Innermost at(n, border);
  const std::size_t ld = n + border;
  double* columns = core.data() + n * ld;
  copyBlock(n, n, middleDiagonal.data(), core.data(), ld);
  copyBlock(n, border, middleColumns.data(), columns, ld);
  copyBlock(border, n, middleRows.data(), core.data() + n, ld);
  copyBlock(border, border, corner.data(), columns + n, ld);
  const auto add = [&](std::size_t m, std::size_t count, const double* from, double factor, double* to) {
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t i = 0; i < m; ++i) to[j * ld + i] += factor * from[j * m + i];
  };
  for (const auto* side : {&ofLeft, &fromRight}) {
    const bool isLeft = side == &ofLeft;
    if (isLeft ? middle == 0 : middle + 1 == points) continue;
    const NeighbourBlock outward = ofMiddle(isLeft ? middleLower : middleUpper);
    outward.subtractProduct(dense, n, side->data() + at.X, core.data(), ld);
    outward.subtractProduct(dense, border, side->data() + at.Y, columns, ld);
    add(border, n, side->data() + at.rowsX, 1, core.data() + n);
    add(border, border, side->data() + at.corner, -1, columns + n);
  }
  if (!rowScales(ld, ld, core.data(), coreScale.data())) return false;
  multiplyRows(ld, ld, coreScale.data(), core.data());
  return dense.factorise(ld, core.data(), corePivots.data());
}

bool BlockTridiagonal::factorise() {
  auto& d = *data_;
  if (!d.set) throw std::logic_error("BlockTridiagonal: factorise called twice");
  d.untouched = d.set = false;
  const Innermost at(d.n, d.border);
  std::array<std::vector<double>, 2> innermost;
  for (auto& values : innermost) values.resize(at.size);
  unsigned long singular = d.points;
  for (const Side side : {left, right}) {
    auto& end = d.ends[side];
    const std::size_t failed = end.factorise(innermost[side].data() + at.corner);
    if (failed < end.size()) {
      singular = std::min<unsigned long>(singular, side == left ? failed : d.points - 1 - failed);
    } else {
      packInnermost(end, d.n, d.border, d.dense, innermost[side]);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &singular, 1, MPI_UNSIGNED_LONG, MPI_MIN, d.comm);
  if (singular == d.points) {
    auto& message = innermost[right];
    const int length = static_cast<int>(message.size());
    if (!d.owns[left] && d.owns[right]) MPI_Send(message.data(), length, MPI_DOUBLE, 0, innermostTag, d.comm);
    if (d.owns[left] && !d.owns[right])
      MPI_Recv(message.data(), length, MPI_DOUBLE, 1, innermostTag, d.comm, MPI_STATUS_IGNORE);
    if (d.owns[left] && !d.factoriseCore(innermost[left], message)) singular = d.middle;
    MPI_Bcast(&singular, 1, MPI_UNSIGNED_LONG, 0, d.comm);
  }
  d.singular = singular;
  d.factorised = singular == d.points;
  if (d.factorised) {
    // Rows were scaled by positive numbers, and blocks exchanged along with their columns: neither changes the sign.
    d.sign = d.ends[left].determinantSign() * d.ends[right].determinantSign();
    if (d.owns[left]) d.sign *= numerics::determinantSign(d.n + d.border, d.core.data(), d.corePivots.data());
    MPI_Allreduce(MPI_IN_PLACE, &d.sign, 1, MPI_INT, MPI_PROD, d.comm);
  }
  return d.factorised;
}

int BlockTridiagonal::determinantSign() const {
  if (!data_->factorised) throw std::logic_error("BlockTridiagonal: determinant without factors");
  return data_->sign;
}

void BlockTridiagonal::solve(std::span<double> b) {
  auto& d = *data_;
  if (!d.factorised) throw std::logic_error("BlockTridiagonal: solve without factors");
  if (b.size() != size()) throw std::logic_error("BlockTridiagonal: wrong size of a vector");
  const std::size_t n = d.n, border = d.border;
  double* first = b.data();
  double* middle = first + d.middle * n;
  double* last = first + (d.points - 1) * n;
  double* z = first + d.points * n;

  // Ends inwards. The right one hands on y of its innermost point and its sum for the border.
  std::vector<double> leftSum(border), ofLeft(n), innermost(n + border);
  if (d.owns[left]) d.ends[left].forward(first, d.step(), leftSum.data(), ofLeft.data());
  if (d.owns[right]) d.ends[right].forward(last, -d.step(), innermost.data() + n, innermost.data());
  const int length = static_cast<int>(n + border);
  if (!d.owns[left] && d.owns[right]) MPI_Send(innermost.data(), length, MPI_DOUBLE, 0, innermostSumTag, d.comm);
  if (d.owns[left] && !d.owns[right])
    MPI_Recv(innermost.data(), length, MPI_DOUBLE, 1, innermostSumTag, d.comm, MPI_STATUS_IGNORE);

  // The middle with the border.
  std::vector<double> core(n + border);
  if (d.owns[left]) {
    std::copy_n(middle, n, core.data());
    if (d.middle > 0) d.ofMiddle(d.middleLower).addTimes(-1, ofLeft.data(), core.data());
    if (d.middle + 1 < d.points) d.ofMiddle(d.middleUpper).addTimes(-1, innermost.data(), core.data());
    for (std::size_t i = 0; i < border; ++i) core[n + i] = z[i] - leftSum[i] - innermost[n + i];
    multiplyRows(n + border, 1, d.coreScale.data(), core.data());
    d.dense.solve(n + border, d.core.data(), d.corePivots.data(), 1, core.data());
  }
  MPI_Bcast(core.data(), length, MPI_DOUBLE, 0, d.comm);
  std::copy_n(core.data(), n, middle);
  std::copy_n(core.data() + n, border, z);

  // Ends outwards.
  if (d.owns[left]) d.ends[left].backward(first, d.step(), middle, z);
  if (d.owns[right]) d.ends[right].backward(last, -d.step(), middle, z);
  if (d.ranks == 1) return;
  MPI_Bcast(first, static_cast<int>(d.middle * n), MPI_DOUBLE, 0, d.comm);
  MPI_Bcast(middle + n, static_cast<int>((d.points - 1 - d.middle) * n), MPI_DOUBLE, d.rightRank(), d.comm);
}

}  // namespace lampblack::numerics
