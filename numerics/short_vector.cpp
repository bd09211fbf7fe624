#include "numerics/short_vector.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::numerics::sundials {

namespace {

constexpr std::size_t kWidth = 8;

std::size_t lengthOf(N_Vector v) {
  return static_cast<std::size_t>(NV_LENGTH_S(v));
}

// z_i = value(i). A block is finished before it is stored: z may be one of the arguments, as SUNDIALS allows, and the
// compiler still has whole vector registers to work with.
template <class Value>
inline void assign(std::size_t n, double* z, Value&& value) {
  std::size_t i = 0;
  for (; i + kWidth <= n; i += kWidth) {
    double block[kWidth];
    for (std::size_t l = 0; l < kWidth; ++l) block[l] = value(i + l);
    for (std::size_t l = 0; l < kWidth; ++l) z[i + l] = block[l];
  }
  for (; i < n; ++i) z[i] = value(i);
}

void linearSum(double a, N_Vector xv, double b, N_Vector yv, N_Vector zv) {
  const double *x = NV_DATA_S(xv), *y = NV_DATA_S(yv);
  assign(lengthOf(zv), NV_DATA_S(zv), [=](std::size_t i) { return a * x[i] + b * y[i]; });
}

void constant(double c, N_Vector zv) {
  std::fill_n(NV_DATA_S(zv), lengthOf(zv), c);
}

void product(N_Vector xv, N_Vector yv, N_Vector zv) {
  const double *x = NV_DATA_S(xv), *y = NV_DATA_S(yv);
  assign(lengthOf(zv), NV_DATA_S(zv), [=](std::size_t i) { return x[i] * y[i]; });
}

void quotient(N_Vector xv, N_Vector yv, N_Vector zv) {
  const double *x = NV_DATA_S(xv), *y = NV_DATA_S(yv);
  assign(lengthOf(zv), NV_DATA_S(zv), [=](std::size_t i) { return x[i] / y[i]; });
}

void scale(double c, N_Vector xv, N_Vector zv) {
  const double* x = NV_DATA_S(xv);
  assign(lengthOf(zv), NV_DATA_S(zv), [=](std::size_t i) { return c * x[i]; });
}

void magnitude(N_Vector xv, N_Vector zv) {
  const double* x = NV_DATA_S(xv);
  assign(lengthOf(zv), NV_DATA_S(zv), [=](std::size_t i) { return std::abs(x[i]); });
}

void inverse(N_Vector xv, N_Vector zv) {
  const double* x = NV_DATA_S(xv);
  assign(lengthOf(zv), NV_DATA_S(zv), [=](std::size_t i) { return 1.0 / x[i]; });
}

void addConstant(N_Vector xv, double b, N_Vector zv) {
  const double* x = NV_DATA_S(xv);
  assign(lengthOf(zv), NV_DATA_S(zv), [=](std::size_t i) { return x[i] + b; });
}

double weightedSquares(N_Vector xv, N_Vector wv) {
  const std::size_t n = lengthOf(xv);
  const double *x = NV_DATA_S(xv), *w = NV_DATA_S(wv);
  double sums[kWidth] = {};
  std::size_t i = 0;
  for (; i + kWidth <= n; i += kWidth)
    for (std::size_t l = 0; l < kWidth; ++l) {
      const double value = x[i + l] * w[i + l];
      sums[l] += value * value;
    }
  for (std::size_t l = 0; i < n; ++i, ++l) {
    const double value = x[i] * w[i];
    sums[l] += value * value;
  }
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

double weightedNorm(N_Vector x, N_Vector w) {
  return std::sqrt(weightedSquares(x, w) / static_cast<double>(lengthOf(x)));
}

double least(N_Vector xv) {
  const double* x = NV_DATA_S(xv);
  return *std::min_element(x, x + lengthOf(xv));
}

// Z_j = a_j x + Y_j
int scaleAddMany(int count, double* a, N_Vector x, N_Vector* Y, N_Vector* Z) {
  for (int j = 0; j < count; ++j) linearSum(a[j], x, 1.0, Y[j], Z[j]);
  return 0;
}

// z = sum_j c_j X_j; z may be X_0.
int linearCombination(int count, double* c, N_Vector* X, N_Vector z) {
  if (count == 1) {
    scale(c[0], X[0], z);
    return 0;
  }
  linearSum(c[0], X[0], c[1], X[1], z);
  for (int j = 2; j < count; ++j) linearSum(1.0, z, c[j], X[j], z);
  return 0;
}

int scaleMany(int count, double* c, N_Vector* X, N_Vector* Z) {
  for (int j = 0; j < count; ++j) scale(c[j], X[j], Z[j]);
  return 0;
}

}  // namespace

Vector makeShortVector(std::size_t n, SUNContext context) {
  Vector vector(N_VNew_Serial(static_cast<sunindextype>(n), context));
  check(vector.get(), "N_VNew_Serial");
  auto& ops = *vector->ops;
  ops.nvlinearsum = linearSum;
  ops.nvconst = constant;
  ops.nvprod = product;
  ops.nvdiv = quotient;
  ops.nvscale = scale;
  ops.nvabs = magnitude;
  ops.nvinv = inverse;
  ops.nvaddconst = addConstant;
  ops.nvwrmsnorm = weightedNorm;
  ops.nvwsqrsumlocal = weightedSquares;
  ops.nvmin = least;
  ops.nvlinearcombination = linearCombination;
  ops.nvscaleaddmulti = scaleAddMany;
  ops.nvscalevectorarray = scaleMany;
  N_VConst(0.0, vector.get());
  return vector;
}

}  // namespace lampblack::numerics::sundials
