#include "numerics/arnoldi.hpp"

// The second needs the first.
// clang-format off
#include <petscsys.h>
#include <petscblaslapack.h>
// clang-format on

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/errors.hpp"

namespace lampblack::numerics {
namespace {

double sumOfProducts(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void add(double factor, std::span<const double> from, std::span<double> to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * from[i];
}

void scale(std::span<double> v, double factor) {
  for (double& value : v) value *= factor;
}

}  // namespace

Arnoldi::Arnoldi(std::function<void(std::vector<double>&)> apply, std::vector<double> start, Product product)
    : apply_(std::move(apply)), product_(product ? std::move(product) : Product(sumOfProducts)) {
  const double length = std::sqrt(product_(start, start));
  if (!(length > 0)) throw std::logic_error("Arnoldi: a start of length zero");
  scale(start, 1 / length);
  basis_.push_back(std::move(start));
}

bool Arnoldi::extend() {
  if (basis_.size() == dimension()) return false;
  std::vector<double> v = basis_.back();
  apply_(v);
  const double before = std::sqrt(product_(v, v));
  std::vector<double> column(basis_.size() + 1, 0.0);
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t j = 0; j < basis_.size(); ++j) {
      const double part = product_(basis_[j], v);
      add(-part, basis_[j], v);
      column[j] += part;
    }
  const double left = std::sqrt(product_(v, v));
  if (!std::isfinite(left)) throw NumericsError("the eigenvectors of a matrix are not finite");
  column.back() = left;
  columns_.push_back(std::move(column));
  if (left <= 1e-14 * before) return false;
  scale(v, 1 / left);
  basis_.push_back(std::move(v));
  return true;
}

std::vector<RitzPair> Arnoldi::pairs() const {
  const auto n = static_cast<PetscBLASInt>(dimension());
  const std::size_t m = dimension();
  std::vector<double> H(m * m, 0.0), re(m), im(m), vectors(m * m), work(8 * m);
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < std::min(m, j + 2); ++i) H[j * m + i] = columns_[j][i];
  const PetscBLASInt room = static_cast<PetscBLASInt>(work.size()), one = 1;
  PetscBLASInt info = 0;
  double none = 0;
  LAPACKgeev_("N", "V", &n, H.data(), &n, re.data(), im.data(), &none, &one, vectors.data(), &n, work.data(), &room,
              &info);
  if (info != 0) throw NumericsError("the eigenvalues of a small matrix do not converge");
  std::vector<RitzPair> result(m);
  for (std::size_t j = 0; j < m; ++j) {
    RitzPair& pair = result[j];
    pair.value = {re[j], im[j]};
    pair.y.resize(m);
    // LAPACK keeps the real and the imaginary part of a conjugate pair in two columns.
    const std::size_t column = im[j] < 0 ? j - 1 : j;
    const double turn = im[j] == 0 ? 0 : im[j] > 0 ? 1 : -1;
    for (std::size_t i = 0; i < m; ++i)
      pair.y[i] = {vectors[column * m + i], turn == 0 ? 0 : turn * vectors[(column + 1) * m + i]};
    pair.residual = columns_.back().back() * std::abs(pair.y.back());
  }
  return result;
}

std::vector<double> Arnoldi::vector(const RitzPair& pair) const {
  std::vector<double> v(basis_.front().size(), 0.0);
  for (std::size_t j = 0; j < pair.y.size(); ++j) add(pair.y[j].real(), basis_[j], v);
  return v;
}

}  // namespace lampblack::numerics
