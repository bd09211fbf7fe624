#include "core/least_squares.hpp"

#include <algorithm>
#include <cmath>

namespace lampblack {
namespace {

using Matrix = std::array<Vector3, 3>;

// Below it an eigenvalue of the sum of squares, of which `diagonal` is the diagonal, is the round-off of its terms: at
// most a few epsilon times the sum of |v_i| |v_j| sqrt(a_ii a_jj) (Cauchy and Schwarz). A thin cell along the axes has
// none of that across it, however long it is.
double roundOffAlong(const Vector3& direction, const Vector3& diagonal) {
  double size = 0.0;
  for (std::size_t i = 0; i < 3; ++i) size += std::abs(direction[i]) * std::sqrt(diagonal[i]);
  return 1e-13 * size * size;
}

// Symmetric; by Jacobi's rotations (Golub and Van Loan 2013, section 8.5). Directions of next to no weight are left
// out: those of round-off, and those in which the values lie less than a thousand-millionth of the longest distance
// apart, which is what places are off by.
Matrix pseudoInverse(Matrix a) {
  const Vector3 diagonal{a[0][0], a[1][1], a[2][2]};
  Matrix vectors{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  for (int sweep = 0; sweep < 30; ++sweep) {
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0.0) continue;
        const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
        for (std::size_t i = 0; i < 3; ++i) {
          const double x = a[i][p], y = a[i][q];
          a[i][p] = c * x - s * y;
          a[i][q] = s * x + c * y;
          const double u = vectors[i][p], v = vectors[i][q];
          vectors[i][p] = c * u - s * v;
          vectors[i][q] = s * u + c * v;
        }
        for (std::size_t i = 0; i < 3; ++i) {
          const double x = a[p][i], y = a[q][i];
          a[p][i] = c * x - s * y;
          a[q][i] = s * x + c * y;
        }
        a[p][q] = a[q][p] = 0.0;
      }
  }
  const double largest = std::max({a[0][0], a[1][1], a[2][2]});
  Matrix inverse{};
  for (std::size_t e = 0; e < 3; ++e) {
    const Vector3 direction{vectors[0][e], vectors[1][e], vectors[2][e]};
    if (!(a[e][e] > std::max(1e-18 * largest, roundOffAlong(direction, diagonal)))) continue;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) inverse[i][j] += vectors[i][e] * vectors[j][e] / a[e][e];
  }
  return inverse;
}

Matrix inverseOf(const Matrix& m, int dimension) {
  const double trace = m[0][0] + m[1][1] + m[2][2];
  constexpr double nothing = 1e-10;
  if (dimension == 2) {
    const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    if (determinant > nothing * trace * trace)
      return {{{m[1][1] / determinant, -m[0][1] / determinant, 0.0},
               {-m[1][0] / determinant, m[0][0] / determinant, 0.0},
               {}}};
  } else {
    const Vector3 a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
    const double determinant = dot(m[0], a);
    if (determinant > nothing * trace * trace * trace) {
      Matrix inverse;
      for (std::size_t i = 0; i < 3; ++i) inverse[i] = {a[i] / determinant, b[i] / determinant, c[i] / determinant};
      return inverse;
    }
  }
  return pseudoInverse(m);
}

void addSquare(const Vector3& d, double share, Matrix& sum) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum[i][j] += share * d[i] * d[j];
}

}  // namespace

void LeastSquares::finish(int dimension) {
  Matrix extent{}, weighted{};
  for (std::size_t i = 0; i < count_; ++i) addSquare(differences_[i], 1.0, extent);
  metric_ = inverseOf(extent, dimension);
  for (std::size_t i = 0; i < count_; ++i) addSquare(differences_[i], share(differences_[i]), weighted);
  inverse_ = inverseOf(weighted, dimension);
}

}  // namespace lampblack
