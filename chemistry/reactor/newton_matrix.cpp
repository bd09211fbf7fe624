#include "chemistry/reactor/newton_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::chemistry {

namespace {

constexpr double kTemperatureUnit = 1e3;  // K, of the unknown of the full matrix

}  // namespace

// Species, then the border: temperature and the product's unknown.
Elimination borderedElimination(const SparsePattern& pattern) {
  const std::size_t n = pattern.size, T = n, s = n + 1;
  std::vector<MatrixEntry> entries{{T, s}};
  for (std::size_t j = 0; j < n; ++j) {
    for (auto e = pattern.columnStart[j]; e < pattern.columnStart[j + 1]; ++e)
      entries.push_back({static_cast<std::size_t>(pattern.row[e]), j});
    for (const MatrixEntry entry : {MatrixEntry{T, j}, {j, T}, {s, j}, {j, s}}) entries.push_back(entry);
  }
  return {n + 2, entries, 2};
}

NewtonMatrix::NewtonMatrix(const ReactorSystem& system)
    : size_(system.size()),
      pattern_(system.pattern()),
      inverseWeights_(system.inverseWeights().begin(), system.inverseWeights().end()),
      sparse_(borderedElimination(pattern_)),
      values_(sparse_.storageSize(), 0.0),
      diagonal_(size_ + 1, 1.0),
      rightHandSide_(size_ + 1),
      rowScale_(size_, 1.0) {
  const std::size_t n = size_ - 1, T = n, s = n + 1;
  for (std::size_t j = 0; j < n; ++j) {
    for (auto e = pattern_.columnStart[j]; e < pattern_.columnStart[j + 1]; ++e)
      speciesAt_.push_back(sparse_.position(static_cast<std::size_t>(pattern_.row[e]), j));
    rowAt_.push_back(sparse_.position(T, j));
    values_[sparse_.position(s, j)] = inverseWeights_[j];
  }
  for (std::size_t i = 0; i <= n; ++i) {
    columnAt_.push_back(sparse_.position(i, T));
    productAt_.push_back(sparse_.position(i, s));
  }
}

bool NewtonMatrix::evaluate(ReactorSystem& system, const double* y, double* f) {
  if (!system.sparseJacobian(y, f, jacobian_)) return false;
  for (std::size_t e = 0; e < speciesAt_.size(); ++e) values_[speciesAt_[e]] = jacobian_.species[e];
  for (std::size_t j = 0; j + 1 < size_; ++j) values_[rowAt_[j]] = jacobian_.temperatureRow[j];
  for (std::size_t i = 0; i < size_; ++i) {
    values_[columnAt_[i]] = jacobian_.temperatureColumn[i];
    values_[productAt_[i]] = jacobian_.product[i];
  }
  return true;
}

bool NewtonMatrix::factorise(double gamma) {
  diagonal_[size_] = gamma;
  usesDense_ = !sparse_.factorise(values_, gamma, diagonal_);
  if (!usesDense_) return true;
  ++pivoted_;
  loadDense(gamma);
  return dense_->factorise();
}

void NewtonMatrix::loadDense(double gamma) {
  if (!dense_) dense_.emplace(size_);
  const std::size_t n = size_ - 1;
  for (std::size_t j = 0; j < n; ++j) {
    double* column = dense_->column(j);
    for (std::size_t i = 0; i <= n; ++i) column[i] = -gamma * jacobian_.product[i] * inverseWeights_[j];
    for (auto e = pattern_.columnStart[j]; e < pattern_.columnStart[j + 1]; ++e)
      column[pattern_.row[e]] -= gamma * jacobian_.species[e];
    column[n] -= gamma * jacobian_.temperatureRow[j];
    column[j] += 1.0;
  }
  double* last = dense_->column(n);
  for (std::size_t i = 0; i <= n; ++i) last[i] = -gamma * jacobian_.temperatureColumn[i];
  last[n] += 1.0;
  for (std::size_t i = 0; i <= n; ++i) last[i] *= kTemperatureUnit;
  // Rows of one size: with temperatures among mass fractions the largest of a column says nothing else about pivots.
  for (std::size_t i = 0; i <= n; ++i) {
    double largest = 0;
    for (std::size_t j = 0; j <= n; ++j) largest = std::max(largest, std::abs(dense_->column(j)[i]));
    rowScale_[i] = largest > 0 ? 1.0 / largest : 1.0;
    for (std::size_t j = 0; j <= n; ++j) dense_->column(j)[i] *= rowScale_[i];
  }
}

void NewtonMatrix::solve(double* b) {
  if (usesDense_) {
    for (std::size_t i = 0; i < size_; ++i) b[i] *= rowScale_[i];
    dense_->solve(b);
    b[size_ - 1] *= kTemperatureUnit;
    return;
  }
  std::copy_n(b, size_, rightHandSide_.begin());
  rightHandSide_[size_] = 0;
  sparse_.solve(rightHandSide_.data());
  std::copy_n(rightHandSide_.begin(), size_, b);
}

}  // namespace lampblack::chemistry
