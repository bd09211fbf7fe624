// The solver of implicit diffusion of many fields, against elimination of the dense matrix.
#include "flow/discretisation/implicit_diffusion.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"
#include "tests/gather.hpp"

namespace lampblack::test {
namespace {

constexpr int fields = 3;

class Diffusion : public testing::Test {
 protected:
  Box box{Geometry::Axisymmetric,
          {gradedAxis(0.0, {{1.0, 5, 2.0}}), gradedAxis(0.0, {{2.0, 4, 0.5}})},
          {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
           side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Outlet, 1, true)}};
  const Mesh& m = box.mesh;

  // Coefficients that differ from cell to cell and by six orders of magnitude from field to field.
  static double stiffness(int k) { return std::pow(1000.0, k - 1); }
  [[nodiscard]] double diagonalOf(std::int64_t natural, int k) const {
    return 1.0 + 0.1 * static_cast<double>(natural % 7) + 0.5 * k;
  }
  [[nodiscard]] double conductanceOf(int face, int k) const {
    return stiffness(k) * (1.0 + m.faceCentre[at(face)][0]) * m.area[at(face)] / m.distance[at(face)];
  }
  static double sourceOf(std::int64_t natural, int k) { return std::sin(static_cast<double>(natural + 1) * (k + 1)); }

  std::vector<double> solve(double tolerance) {
    std::vector<double> diagonal;
    std::vector<double> source;
    std::vector<double> conductance;
    for (int c = 0; c < m.owned; ++c)
      for (int k = 0; k < fields; ++k) {
        diagonal.push_back(diagonalOf(m.naturalCell[at(c)], k));
        source.push_back(sourceOf(m.naturalCell[at(c)], k));
      }
    for (int face = 0; face < m.interiorFaces; ++face)
      for (int k = 0; k < fields; ++k) conductance.push_back(conductanceOf(face, k));
    std::vector<double> x(at(fields * m.cells), 0.0);
    ImplicitDiffusion solver(m, box.halo);
    result = solver.solve(fields, diagonal, conductance, source, x, tolerance);
    return x;
  }
  ImplicitDiffusion::Result result;
};

// x of the dense system by Gaussian elimination (diagonally dominant: no pivots needed).
std::vector<double> eliminate(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const double f = a[j][i] / a[i][i];
      for (std::size_t k = i; k < n; ++k) a[j][k] -= f * a[i][k];
      b[j] -= f * b[i];
    }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  return b;
}

TEST_F(Diffusion, AgreesWithDenseEliminationForEveryField) {
  constexpr double tolerance = 1e-12;
  const std::vector<double> x = gatherNatural(m, solve(tolerance), fields);
  const auto cells = static_cast<std::size_t>(m.totalCells);
  for (int k = 0; k < fields; ++k) {
    // Every rank builds the whole matrix: each face counts once, on the rank that owns its low cell.
    std::vector<double> flat(cells * cells, 0.0);
    for (int face = 0; face < m.interiorFaces; ++face) {
      if (m.low[at(face)] >= m.owned) continue;
      const auto i = static_cast<std::size_t>(m.naturalCell[at(m.low[at(face)])]);
      const auto j = static_cast<std::size_t>(m.naturalCell[at(m.high[at(face)])]);
      const double g = conductanceOf(face, k);
      flat[i * cells + i] += g;
      flat[j * cells + j] += g;
      flat[i * cells + j] -= g;
      flat[j * cells + i] -= g;
    }
    MPI_Allreduce(MPI_IN_PLACE, flat.data(), static_cast<int>(flat.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    std::vector<std::vector<double>> matrix(cells);
    std::vector<double> source(cells);
    double sourceNorm = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
      matrix[i].assign(flat.begin() + static_cast<std::ptrdiff_t>(i * cells),
                       flat.begin() + static_cast<std::ptrdiff_t>((i + 1) * cells));
      matrix[i][i] += diagonalOf(static_cast<std::int64_t>(i), k);
      source[i] = sourceOf(static_cast<std::int64_t>(i), k);
      sourceNorm += source[i] * source[i];
    }
    const std::vector<double> exact = eliminate(matrix, source);
    // The smallest eigenvalue is at least the smallest diagonal, 1: the error is at most the residual. Elimination adds
    // round-off times the largest entry, about 1e5.
    for (std::size_t i = 0; i < cells; ++i)
      EXPECT_NEAR(x[i * fields + at(k)], exact[i], tolerance * std::sqrt(sourceNorm) + 1e5 * 4.0 * epsilon)
          << "field " << k << ", cell " << i;
  }
}

// Of more fields than go together, with sinks, and boundaries that hold the change: what the equations say is left.
TEST_F(Diffusion, ChangesHaveTheRatesOfTheirEquations) {
  constexpr int many = 11;
  const auto through = [&](int face, int k) {
    return std::pow(2.0, k - 5) * (1.0 + m.faceCentre[at(face)][1]) * m.area[at(face)] / m.distance[at(face)];
  };
  const auto conductance = [&](int face, std::span<const int> of, double* g) {
    for (std::size_t i = 0; i < of.size(); ++i) g[i] = through(face, of[i]);
  };
  std::vector<double> inertia, sinks, change(at(many * m.cells)), rates;
  for (int c = 0; c < m.owned; ++c) {
    inertia.push_back(diagonalOf(m.naturalCell[at(c)], 0));
    for (int k = 0; k < many; ++k) {
      sinks.push_back(0.3 * k);
      rates.push_back(sourceOf(m.naturalCell[at(c)], k));
    }
  }
  std::ranges::copy(rates, change.begin());
  ImplicitDiffusion(m, box.halo).changes(many, inertia, conductance, change, 1e-10, 100000, sinks);
  for (int c = 0; c < m.owned; ++c)
    for (int k = 0; k < many; ++k) {
      const double own = change[at(c * many + k)];
      double rate = (inertia[at(c)] + sinks[at(c * many + k)]) * own;
      for (int i = m.faceStart[at(c)]; i < m.faceStart[at(c + 1)]; ++i) {
        const int face = m.faceOfCell[at(i)], beyond = m.low[at(face)] == c ? m.high[at(face)] : m.low[at(face)];
        rate += through(face, k) * (own - (beyond >= 0 ? change[at(beyond * many + k)] : 0.0));
      }
      EXPECT_NEAR(rate, rates[at(c * many + k)], 1e-5);  // conductances of single precision
    }
}

TEST_F(Diffusion, FillsTheHaloOfTheSolution) {
  std::vector<double> x = solve(1e-10);
  std::vector<double> again = x;
  box.halo.update(again, fields);
  EXPECT_EQ(x, again);
}

TEST_F(Diffusion, TooFewIterationsAreAnError) {
  std::vector<double> diagonal(at(fields * m.owned), 1.0);
  std::vector<double> source(at(fields * m.owned));
  for (int c = 0; c < m.owned; ++c)
    for (int k = 0; k < fields; ++k) source[at(fields * c + k)] = sourceOf(m.naturalCell[at(c)], k);
  const std::vector<double> conductance(at(fields * m.interiorFaces), 100.0);
  std::vector<double> x(at(fields * m.cells), 0.0);
  ImplicitDiffusion solver(m, box.halo);
  EXPECT_THROW(solver.solve(fields, diagonal, conductance, source, x, 1e-12, 2), NumericsError);
}

}  // namespace
}  // namespace lampblack::test
