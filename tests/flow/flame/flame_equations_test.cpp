// The Newton matrix of a flame against differences of its residual, and what the discrete equations conserve.
#include "flow/flame/flame_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/flow/flame/flame_fixture.hpp"

namespace lampblack {
namespace {

// Largest difference between the matrix (as it solves) and differences of the residual, over rows and columns. With
// A = dF/dx as factorised, A^-1 (F(x + e) - F(x)) / e is the unit vector of the unknown that was changed.
double worstColumn(FlameEquations& equations, const FlameProfile& start, std::span<const std::size_t> components) {
  const std::size_t size = equations.size(), w = start.layout.width();
  std::vector<double> x = start.x, up(size), down(size), scale(size);
  EXPECT_TRUE(equations.factorise(x, 0));
  equations.scales(x, scale);
  double worst = 0;
  for (std::size_t point : {std::size_t{0}, std::size_t{1}, start.points() / 2, start.points() - 1}) {
    for (std::size_t c : components) {
      const std::size_t u = point * w + c;
      const double step = 1e-3 * scale[u] + 1e-7 * std::abs(x[u]);
      const double kept = x[u];
      x[u] = kept + step;
      equations.residual(x, up);
      x[u] = kept - step;
      equations.residual(x, down);
      x[u] = kept;
      for (std::size_t i = 0; i < size; ++i) up[i] = (up[i] - down[i]) / (2 * step);
      equations.solve(up);
      up[u] -= 1;
      for (std::size_t i = 0; i < size; ++i) worst = std::max(worst, std::abs(up[i]) * scale[u] / scale[i]);
    }
  }
  return worst;
}

std::vector<std::size_t> everyComponent(const FlameLayout& layout) {
  std::vector<std::size_t> all(layout.width());
  for (std::size_t c = 0; c < all.size(); ++c) all[c] = c;
  return all;
}

// With Lewis numbers of a gas whose coefficients do not depend on the state the matrix is exact; of real gases the
// coefficients are frozen, and only what does not touch them is.
TEST(FlameEquations, NewtonMatrixMatchesDifferencesOfTheResidual) {
  for (const FlameType type : {FlameType::Free, FlameType::Burner, FlameType::Wall, FlameType::Counterflow}) {
    const FlameProblem problem = hydrogenProblem(type);
    FlameEquations equations(MPI_COMM_SELF, hydrogenMechanism(), problem);
    const FlameProfile start = roughFlame(problem, 12);
    equations.setGrid(start.z);
    equations.setAnchor(6, start.temperature(6));
    std::vector<std::size_t> exact{FlameLayout::massFlux, FlameLayout::spread};
    EXPECT_LT(worstColumn(equations, start, exact), 1e-4) << static_cast<int>(type);
    EXPECT_LT(worstColumn(equations, start, everyComponent(start.layout)), 0.5) << static_cast<int>(type);
  }
}

}  // namespace
}  // namespace lampblack
