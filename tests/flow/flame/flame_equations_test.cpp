// The Newton matrix of a flame against differences of its residual, and what the discrete equations conserve.
#include "flow/flame/flame_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "numerics/dense_blocks.hpp"
#include "tests/flow/flame/flame_fixture.hpp"

namespace lampblack::flow {
namespace {

std::vector<double> denseInverse(std::vector<double> a, std::size_t size) {
  std::vector<int> pivots(size);
  std::vector<double> result(size * size);
  for (std::size_t i = 0; i < size; ++i) result[i * size + i] = 1;
  DenseBlocks dense;
  EXPECT_TRUE(dense.factorise(size, a.data(), pivots.data()));
  dense.solve(size, a.data(), pivots.data(), size, result.data());
  return result;
}

// Largest difference between the entries of the matrix and differences of the residual, over the size of the row; both
// scaled by what counts as a change of 1 of each unknown. The matrix is recovered from its inverse, scaled alike.
struct Worst {
  double difference = 0;
  std::string row, column;
};

Worst compare(FlameEquations& equations, const FlameProfile& start) {
  const std::size_t size = equations.size();
  std::vector<double> x = start.x, up(size), down(size), scale(size);
  equations.residual(x, up);
  equations.freezeTransport(true);
  EXPECT_TRUE(equations.factorise(x, 0));
  equations.scales(x, scale);
  std::vector<double> differences(size * size), rowSize(size);
  for (std::size_t c = 0; c < size; ++c) {
    const double step = 1e-3 * scale[c] + 1e-7 * std::abs(x[c]), kept = x[c];
    x[c] = kept + step;
    equations.residual(x, up);
    x[c] = kept - step;
    equations.residual(x, down);
    x[c] = kept;
    for (std::size_t r = 0; r < size; ++r) {
      differences[c * size + r] = (up[r] - down[r]) / (2 * step) * scale[c];
      rowSize[r] = std::max(rowSize[r], std::abs(differences[c * size + r]));
    }
  }
  std::vector<double> inverse(size * size);
  for (std::size_t r = 0; r < size; ++r) {
    double* column = &inverse[r * size];
    column[r] = rowSize[r];
    equations.solve({column, size});
    for (std::size_t c = 0; c < size; ++c) column[c] /= scale[c];
  }
  const std::vector<double> matrix = denseInverse(inverse, size);
  Worst worst;
  for (std::size_t c = 0; c < size; ++c)
    for (std::size_t r = 0; r < size; ++r) {
      const double d = std::abs(differences[c * size + r] / rowSize[r] - matrix[c * size + r]);
      if (d > worst.difference) worst = {d, equations.nameOf(r), equations.nameOf(c)};
    }
  return worst;
}

void expectExactMatrix(const FlameProblem& problem, const std::string& what) {
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem);
  const FlameProfile start = roughFlame(problem, 12);
  equations.setGrid(start.z);
  equations.setAnchor(6, start.temperature(6));
  const Worst worst = compare(equations, start);
  EXPECT_LT(worst.difference, 1e-5) << what << ": " << worst.row << " by " << worst.column;
}

// Of the stream from the right, whose strain rate is given: Seshadri and Williams 1978.
TEST(FlameEquations, ThePressureGradientOfPotentialFlowIsThatOfTheRightStream) {
  FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  problem.nozzles = FlameNozzles::Potential;
  problem.strainRate = 150;
  problem.stagnationPlane = 0.5 * problem.length;
  problem.right->temperature = 700;
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem);
  FlameProfile profile = roughFlame(problem, 12);
  const Thermo thermo(*hydrogenMechanism());
  const double density = thermo.density(700, problem.pressure, problem.right->Y);
  ASSERT_GT(std::abs(density / thermo.density(300, problem.pressure, problem.left.Y) - 1), 0.1);
  profile.global(pressureGradient) = -density * 150 * 150;
  equations.setGrid(profile.z);
  std::vector<double> F(equations.size());
  equations.residual(profile.x, F);
  EXPECT_NEAR(F[F.size() - numFlameGlobals + pressureGradient], 0, 1e-9 * density * 150 * 150);
}

TEST(FlameEquations, NewtonMatrixMatchesDifferencesOfTheResidual) {
  for (const FlameType type : {FlameType::Free, FlameType::Burner, FlameType::Wall, FlameType::Counterflow})
    expectExactMatrix(hydrogenProblem(type), "type " + std::to_string(static_cast<int>(type)));
}

TEST(FlameEquations, NewtonMatrixIsExactForEveryModelOfTransport) {
  for (const auto model : {TransportModel::Diffusion::MixtureAveraged, TransportModel::Diffusion::Multicomponent,
                           TransportModel::Diffusion::UnityLewis, TransportModel::Diffusion::ConstantLewis}) {
    FlameProblem problem = hydrogenProblem(FlameType::Burner);
    problem.transport.diffusion = model;
    problem.transport.soret = model != TransportModel::Diffusion::UnityLewis;
    problem.transport.lewisNumbers.assign(hydrogenMechanism()->numSpecies(), 0.8);
    expectExactMatrix(problem, "transport " + std::to_string(static_cast<int>(model)));
  }
}

TEST(FlameEquations, NewtonMatrixIsExactInPotentialFlowAndAtGivenTemperature) {
  for (const FlameType type : {FlameType::Wall, FlameType::Counterflow}) {
    FlameProblem problem = hydrogenProblem(type);
    problem.nozzles = FlameNozzles::Potential;
    problem.strainRate = 120;
    problem.stagnationPlane = 0.009;
    expectExactMatrix(problem, "potential flow");
  }
  FlameProblem problem = hydrogenProblem(FlameType::Burner);
  problem.given = GivenTemperature{{0, 0.01, 0.02}, {300, 1500, 1400}};
  expectExactMatrix(problem, "given temperature");
}

}  // namespace
}  // namespace lampblack::flow
