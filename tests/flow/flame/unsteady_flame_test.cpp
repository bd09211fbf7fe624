// Flames in time: against exact solutions and against steady flames.
#include "flow/flame/unsteady_flame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_equations.hpp"
#include "tests/flow/flame/steady_hydrogen.hpp"

namespace lampblack::flow {
namespace {

TEST(UnsteadyFlame, ASteadyFlameStays) {
  const FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  FlameProfile flame = steadyHydrogen(problem);
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem);
  equations.setGrid(flame.z);
  const std::vector<double> before = flame.x;
  std::vector<double> scale(before.size());
  equations.scales(before, scale);
  UnsteadyOptions options;
  options.end = 0.1;  // ten times the time of the flow, 1/V
  const UnsteadyReport report = integrateInTime(equations, flame.x, options);
  EXPECT_LT(report.steps, 100u);
  // The flame was converged to 1e-3 of the scales; Newton's method in a step to 0.1 of them.
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(flame.x[i], before[i], 0.5 * scale[i]) << equations.nameOf(i);
}

// Largest error of a small hot spot in nitrogen that flows by, on n points: with constant properties a Gaussian that
// moves with the flow and spreads by conduction, its variance growing by 2 alpha t.
double errorOfHotSpot(std::size_t n) {
  FlameProblem problem = hydrogenProblem(FlameType::Burner);
  problem.left = hydrogenStream("N2: 1", 300, 0.25);
  FlameProfile gas{{hydrogenMechanism()->numSpecies(), 0}, {}, {}};
  for (std::size_t i = 0; i < n; ++i)
    gas.z.push_back(problem.length * static_cast<double>(i) / static_cast<double>(n - 1));
  gas.x.assign(gas.size(), 0.0);
  const double amplitude = 0.03, centre = 0.005, width = 0.001;
  for (std::size_t i = 0; i < n; ++i) {
    gas.at(i, FlameLayout::massFlux) = problem.left.massFlux;
    gas.at(i, FlameLayout::temperature) = 300 + amplitude * std::exp(-0.5 * std::pow((gas.z[i] - centre) / width, 2));
    for (std::size_t k = 0; k < problem.left.Y.size(); ++k)
      gas.at(i, FlameLayout::firstSpecies + k) = problem.left.Y[k];
  }
  gas.global(leftMassFlux) = problem.left.massFlux;
  gas.global(load) = 1;
  FlameTolerances tolerances;
  tolerances.relative = 1e-8;
  tolerances.temperature = 1e-6;  // with 300 K: a scale of 4e-6 K
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem, nullptr, tolerances);
  equations.setGrid(gas.z);
  UnsteadyOptions options;
  options.end = 0.02;
  options.firstStep = 1e-5;
  options.accuracy = 0.002;
  options.order = 4;
  integrateInTime(equations, gas.x, options);

  // Properties of nitrogen at 300 K and 101325 Pa.
  const auto mechanism = hydrogenMechanism();
  const Thermo thermo(*mechanism);
  const double rho = 101325 * 28.0134e-3 / (8.314462618 * 300);
  const double cp = thermo.cpMass(300, problem.left.Y);
  const double conductivity = Transport(*mechanism).speciesConductivity(300, mechanism->speciesIndex("N2"));
  const double alpha = conductivity / (rho * cp), u = problem.left.massFlux / rho;
  const double variance = width * width + 2 * alpha * options.end;
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double away = gas.z[i] - centre - u * options.end;
    const double exact = amplitude * width / std::sqrt(variance) * std::exp(-0.5 * away * away / variance);
    worst = std::max(worst, std::abs(gas.temperature(i) - 300 - exact));
  }
  return worst / amplitude;
}

TEST(UnsteadyFlame, AHotSpotSpreadsAsHeatConductsAndMovesWithTheFlow) {
  // Spacings of 0.1 and 0.05 mm are central differences: second order. What does not fall is the spot's own influence
  // on the gas, 0.03 K of 300 K, and the error in time, about 60 steps of 1e-8 K.
  const double coarse = errorOfHotSpot(201), fine = errorOfHotSpot(401);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR((coarse - 1e-4) / (fine - 1e-4), 4, 1);
}

// The Newton matrix of a time step, with the rates' part in continuity, against a difference of the equations in some
// direction: from rates of zero, where nothing is left out.
TEST(UnsteadyFlame, NewtonMatrixOfATimeStepMatchesADifference) {
  const FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  const FlameProfile flame = roughFlame(problem, 12);
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem);
  equations.setGrid(flame.z);
  const std::size_t n = flame.x.size();
  std::vector<double> scale(n), direction(n), up(n), down(n), weights(n);
  equations.scales(flame.x, scale);
  for (std::size_t i = 0; i < n; ++i) direction[i] = scale[i] * std::sin(1.0 + 2.7 * static_cast<double>(i));
  const double shift = 1e5;
  equations.residual(flame.x, up);
  equations.freezeTransport(true);
  const auto difference = [&](double step, std::vector<double>& F) {
    std::vector<double> x = flame.x, rate(n);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += step * direction[i];
      rate[i] = shift * step * direction[i];
    }
    equations.residual(x, F);
    equations.timeWeights(x, weights);
    for (std::size_t i = 0; i < n; ++i) F[i] += weights[i] * rate[i];
    equations.storage(x, rate, F);
  };
  const double step = 1e-2;
  difference(step, up);
  difference(-step, down);
  std::vector<double> solution(n);
  for (std::size_t i = 0; i < n; ++i) solution[i] = (up[i] - down[i]) / (2 * step);
  std::vector<double> steady = solution;
  ASSERT_TRUE(equations.factoriseUnsteady(flame.x, shift));
  equations.solve(solution);
  ASSERT_TRUE(equations.factorise(flame.x, shift));
  equations.solve(steady);
  // Errors of spreading come back in the pressure gradient, times the shift: rho dV/dt + Lambda = .., rho about 0.3.
  const std::size_t gradient = n - numFlameGlobals + pressureGradient;
  const double inertia = 0.3 * shift * scale[FlameLayout::spread] / scale[gradient];
  double worst = 0, without = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double unit = scale[i] * (i == gradient ? inertia : 1);
    worst = std::max(worst, std::abs(solution[i] - direction[i]) / unit);
    without = std::max(without, std::abs(steady[i] - direction[i]) / unit);
  }
  // Rounding of the stiff sources, 1e-16 of terms that cancel, over a step of 1e-2 scales; a part that is missing in
  // the matrix shows as below.
  EXPECT_LT(worst, 1e-3);
  EXPECT_GT(without, 0.1);  // the matrix of pseudo-transient steps, which have no such part
}

// A strain that swings far more slowly than the flame answers: at any time the flame is the steady one of that strain.
TEST(UnsteadyFlame, UnderSlowlySwingingStrainItIsSteadyAtAnyTime) {
  const FlameProblem problem = hydrogenProblem(FlameType::Counterflow);
  FlameProfile flame = steadyHydrogen(problem);
  FlameEquations equations(MPI_COMM_WORLD, hydrogenMechanism(), problem);
  equations.setGrid(flame.z);
  UnsteadyOptions options;
  const double period = 50;
  options.end = 0.75 * period;
  options.load = [=](double t) { return 1 + 0.4 * std::sin(2 * std::numbers::pi * t / period); };
  options.outputTimes = {0.25 * period, 0.75 * period};
  std::vector<double> peaks;
  FlameProfile now = flame;
  integrateInTime(equations, flame.x, options, [&](double, std::span<const double> x) {
    now.x.assign(x.begin(), x.end());
    peaks.push_back(now.peakTemperature());
  });
  ASSERT_EQ(peaks.size(), 2u);
  for (const std::size_t i : {0u, 1u}) {
    equations.setLoad(i == 0 ? 1.4 : 0.6);
    now.x = flame.x;
    // Twice: the blend of convection belongs to the profile a solution starts from.
    for (int pass = 0; pass < 2; ++pass) {
      equations.setGrid(now.z);
      const NewtonReport steady = NewtonSolver().steady(equations, now.x);
      ASSERT_TRUE(steady.converged) << steady.reason;
    }
    EXPECT_NEAR(peaks[i], now.peakTemperature(), 0.5);
  }
  EXPECT_GT(peaks[1] - peaks[0], 10);  // the strain matters
}

}  // namespace
}  // namespace lampblack::flow
