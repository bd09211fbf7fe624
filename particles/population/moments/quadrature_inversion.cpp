#include "particles/population/moments/quadrature_inversion.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack::particles {
namespace {

constexpr std::size_t most = MomentQuadrature::most;

// Coefficients of the recurrence of the orthogonal polynomials: the Jacobi matrix has a on its diagonal and the roots
// of b beside it. `count` of them are sound.
struct Recurrence {
  std::array<double, most> a{}, b{};
  std::size_t count = 1;
};

// The squared norm of the k-th polynomial is the product of b_1 to b_k. It comes out of a difference of terms as large
// as m_2k: below 1e-13 of that it is noise, and the population has k sizes.
bool sound(double norm, double largest) {
  return norm > 1e-13 * largest;
}

// Wheeler (1974), after Sack and Donovan (1972), with the plain moments.
Recurrence byWheeler(std::span<const double> m) {
  Recurrence result;
  const std::size_t length = m.size(), nodes = length / 2;
  std::array<double, 2 * most> before{}, now{}, next{};
  std::copy(m.begin(), m.end(), now.begin());
  result.a[0] = m[1] / m[0];
  for (std::size_t k = 1; k < nodes; ++k) {
    for (std::size_t l = k; l < length - k; ++l) {
      next[l] = now[l + 1] - result.a[k - 1] * now[l] - (k > 1 ? result.b[k - 1] * before[l] : 0.0);
    }
    if (!sound(next[k], m[2 * k])) return result;
    result.a[k] = next[k + 1] / next[k] - now[k] / now[k - 1];
    result.b[k] = next[k] / now[k - 1];
    before = now;
    now = next;
    ++result.count;
  }
  return result;
}

// The product-difference algorithm (Gordon 1968): the continued fraction of the moments.
Recurrence byProductDifference(std::span<const double> m) {
  Recurrence result;
  const std::size_t length = m.size(), nodes = length / 2;
  // Columns of Gordon's triangle, one shorter each; head[j] is the first element of column j.
  std::array<double, 2 * most + 1> before{}, now{}, next{};
  std::array<double, 2 * most + 1> head{};
  before[0] = 1;
  for (std::size_t i = 0; i < length; ++i) now[i] = (i % 2 == 0 ? 1 : -1) * m[i];
  head[0] = 1;
  head[1] = now[0];
  std::array<double, 2 * most + 1> alpha{};  // alpha[1] = 0, then alpha[2] ... alpha[2 nodes]
  for (std::size_t j = 2; j <= length; ++j) {
    for (std::size_t i = 0; i + j <= length; ++i) next[i] = now[0] * before[i + 1] - before[0] * now[i + 1];
    head[j] = next[0];
    alpha[j] = head[j] / (head[j - 1] * head[j - 2]);
    before = now;
    now = next;
    if (!(alpha[j] > 0)) break;
  }
  result.a[0] = alpha[2];
  double norm = 1;
  for (std::size_t k = 1; k < nodes; ++k) {
    const double b = alpha[2 * k + 1] * alpha[2 * k], a = alpha[2 * k + 2] + alpha[2 * k + 1];
    norm *= b;
    if (!(b > 0) || !std::isfinite(a) || !sound(norm, m[2 * k])) return result;
    result.b[k] = b;
    result.a[k] = a;
    ++result.count;
  }
  return result;
}

// Eigenvalues of the Jacobi matrix and the first components of its eigenvectors, by cyclic Jacobi rotations (Golub and
// Welsch 1969 for what they mean).
MomentQuadrature fromRecurrence(const Recurrence& r, std::size_t count) {
  std::array<std::array<double, most>, most> A{};
  std::array<double, most> first{1};
  for (std::size_t k = 0; k < count; ++k) {
    A[k][k] = r.a[k];
    if (k > 0) A[k][k - 1] = A[k - 1][k] = std::sqrt(r.b[k]);
  }
  for (int sweep = 0; sweep < 30; ++sweep) {
    double rest = 0, scale = 0;
    for (std::size_t i = 0; i < count; ++i) {
      scale = std::max(scale, std::abs(A[i][i]));
      for (std::size_t j = 0; j < i; ++j) rest = std::max(rest, std::abs(A[i][j]));
    }
    if (rest <= 1e-18 * scale) break;
    for (std::size_t p = 0; p + 1 < count; ++p) {
      for (std::size_t q = p + 1; q < count; ++q) {
        if (A[p][q] == 0) continue;
        const double theta = (A[q][q] - A[p][p]) / (2 * A[p][q]);
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
        const double c = 1 / std::hypot(t, 1.0), s = t * c;
        for (std::size_t k = 0; k < count; ++k) {
          const double x = A[k][p], y = A[k][q];
          A[k][p] = c * x - s * y;
          A[k][q] = s * x + c * y;
        }
        for (std::size_t k = 0; k < count; ++k) {
          const double x = A[p][k], y = A[q][k];
          A[p][k] = c * x - s * y;
          A[q][k] = s * x + c * y;
        }
        A[p][q] = A[q][p] = 0;
        const double x = first[p], y = first[q];
        first[p] = c * x - s * y;
        first[q] = s * x + c * y;
      }
    }
  }
  MomentQuadrature result;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t k = result.count++;
    for (; k > 0 && result.nodes[k - 1] > A[i][i]; --k) {
      result.nodes[k] = result.nodes[k - 1];
      result.weights[k] = result.weights[k - 1];
    }
    result.nodes[k] = A[i][i];
    result.weights[k] = first[i] * first[i];
  }
  return result;
}

}  // namespace

MomentQuadrature momentQuadrature(std::span<const double> moments, QuadratureInversion inversion) {
  if (!(moments[0] > 0) || !(moments[1] > 0)) return {};
  // In units of the number and the mean.
  const double mean = moments[1] / moments[0];
  std::array<double, 2 * most> m{};
  double unit = moments[0];
  for (std::size_t k = 0; k < moments.size(); ++k, unit *= mean) m[k] = moments[k] / unit;
  const auto scaled = std::span<const double>(m).first(moments.size());
  const Recurrence recurrence =
      inversion == QuadratureInversion::wheeler ? byWheeler(scaled) : byProductDifference(scaled);
  MomentQuadrature result;
  for (std::size_t count = recurrence.count; count > 0; --count) {
    result = fromRecurrence(recurrence, count);
    if (result.nodes[0] > 0) break;
  }
  for (std::size_t k = 0; k < result.count; ++k) {
    result.nodes[k] *= mean;
    result.weights[k] *= moments[0];
  }
  return result;
}

}  // namespace lampblack::particles
