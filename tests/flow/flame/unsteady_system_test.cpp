// Time integration of small systems with known solutions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "flow/flame/unsteady_flame.hpp"
#include "tests/numerics/small_systems.hpp"

namespace lampblack::flow {
namespace {

// With entries of the rates of change beside the diagonal: storage_i = sum_j coefficients(i, j) * rate_j.
class SmallUnsteadySystem : public test::SmallLoadedSystemOf<UnsteadySystem> {
 public:
  using SmallLoadedSystemOf::SmallLoadedSystemOf;
  void storage(std::span<const double>, std::span<const double> rate, std::span<double> F) override {
    for (std::size_t i = 0; i < size() && !coefficients.empty(); ++i)
      for (std::size_t j = 0; j < size(); ++j) F[i] += coefficients[i * size() + j] * rate[j];
  }
  bool factoriseUnsteady(std::span<const double> x, double shift) override {
    return factoriseWith(x, shift, coefficients);
  }
  std::vector<double> coefficients;
};

UnsteadyOptions until(double end) {
  UnsteadyOptions options;
  options.end = end;
  options.firstStep = 1e-4;
  options.newton.stepTolerance = 1e-3;
  return options;
}

// x0' = -x0, x1 = 2 x0 without a derivative of its own.
SmallUnsteadySystem decay() {
  SmallUnsteadySystem system(
      3,
      [](auto x, auto F) {
        F[0] = x[0];
        F[1] = x[1] - 2 * x[0];
      },
      [](auto, std::vector<double>& J) {
        J[0] = 1;
        J[3] = -2;
        J[4] = 1;
      });
  system.weights[1] = 0;
  return system;
}

TEST(UnsteadySystem, DecaysAsItShouldAndBetterWithSmallerErrors) {
  std::vector<double> errors;
  for (const double accuracy : {10.0, 1.0, 0.1}) {
    SmallUnsteadySystem system = decay();
    UnsteadyOptions options = until(2);
    options.accuracy = accuracy;
    std::vector<double> x = {1, 2, 0};
    const UnsteadyReport report = integrateInTime(system, x, options);
    EXPECT_GT(report.steps, 5u);
    EXPECT_NEAR(x[1], 2 * x[0], 1e-6);
    errors.push_back(std::abs(x[0] - std::exp(-2)));
    // Errors of steps (1e-4 times the accuracy each) add up, and later decay with the solution.
    EXPECT_LT(errors.back(), 1e-4 * accuracy * static_cast<double>(report.steps));
  }
  // Local errors h^3 held at a tenth shorten steps by 10^(1/3) and the error of the end by 10^(2/3) = 4.6.
  EXPECT_LT(errors[1], errors[0] / 2);
  EXPECT_LT(errors[2], errors[1] / 2);
}

TEST(UnsteadySystem, HigherOrdersNeedFewerSteps) {
  std::vector<std::size_t> steps;
  for (const int order : {1, 2, 4}) {
    SmallUnsteadySystem system = decay();
    UnsteadyOptions options = until(2);
    options.order = order;
    options.accuracy = 0.1;
    std::vector<double> x = {1, 2, 0};
    steps.push_back(integrateInTime(system, x, options).steps);
    EXPECT_NEAR(x[0], std::exp(-2), 1e-5 * static_cast<double>(steps.back()));
  }
  EXPECT_LT(2 * steps[1], steps[0]);
  EXPECT_LT(steps[2], steps[1]);
}

TEST(UnsteadySystem, AnInconsistentStartOfAlgebraicUnknownsDoesNotMatter) {
  SmallUnsteadySystem system = decay();
  std::vector<double> x = {1, -500, 0};
  UnsteadyOptions options = until(1);
  options.accuracy = 1;
  const UnsteadyReport report = integrateInTime(system, x, options);
  EXPECT_NEAR(x[0], std::exp(-1), 1e-4 * static_cast<double>(report.steps));
  EXPECT_NEAR(x[1], 2 * x[0], 1e-6);
}

// x' = -k (x - load), load = sin(2 pi t), stiff: x lags by 1/k.
TEST(UnsteadySystem, FollowsALoadThatChangesInTime) {
  const double k = 1e5;
  SmallUnsteadySystem system(
      2, [=](auto x, auto F) { F[0] = k * (x[0] - x[1]); },
      [=](auto, std::vector<double>& J) {
        J[0] = k;
        J[1] = -k;
      });
  UnsteadyOptions options = until(1);
  options.accuracy = 1;
  options.load = [](double t) { return std::sin(2 * std::numbers::pi * t); };
  for (int i = 0; i <= 20; ++i) options.outputTimes.push_back(0.05 * i);
  std::vector<double> x = {0, 0}, times;
  const UnsteadyReport report = integrateInTime(system, x, options, [&](double t, std::span<const double> state) {
    times.push_back(t);
    // The lag 2 pi/k, and the interpolation's error of about that of a step, 1e-4.
    EXPECT_NEAR(state[0], std::sin(2 * std::numbers::pi * t), 1e-3) << t;
  });
  EXPECT_THAT(times, testing::Pointwise(testing::DoubleEq(), options.outputTimes));
  // Not a step of 1/k: 1e5 of them.
  EXPECT_LT(report.steps, 1000u);
  // The system is linear: factors serve many steps.
  EXPECT_LT(report.newton.factorisations, report.steps / 2);
}

// Like the mass flux of a gas that is heated: 0 = y + d(x0)/dt, x0' = -x0 (1 + y/10).
TEST(UnsteadySystem, RatesInAlgebraicEquationsAreInTheNewtonMatrix) {
  SmallUnsteadySystem system(
      3,
      [](auto x, auto F) {
        F[0] = x[0] * (1 + x[1] / 10);
        F[1] = x[1];
      },
      [](auto x, std::vector<double>& J) {
        J[0] = 1 + x[1] / 10;
        J[1] = x[0] / 10;
        J[4] = 1;
      });
  system.weights[1] = 0;
  system.coefficients = {0, 0, 0, 1, 0, 0, 0, 0, 0};
  UnsteadyOptions options = until(1);
  options.accuracy = 0.1;
  std::vector<double> x = {1, 0, 0};
  const UnsteadyReport report = integrateInTime(system, x, options);
  // y = -x' and x' = -x (1 + y/10) give x' = -x / (1 - x/10), so that ln x - x/10 = -1/10 - t.
  EXPECT_NEAR(std::log(x[0]) - x[0] / 10, -1.1, 1e-3);
  EXPECT_NEAR(x[1], x[0] / (1 - x[0] / 10), 1e-2);
  EXPECT_LT(report.newton.steps, 3 * (report.steps + report.rejected));
}

TEST(UnsteadySystem, ASolutionThatBlowsUpEndsWithItsTime) {
  SmallUnsteadySystem system(
      2, [](auto x, auto F) { F[0] = -x[0] * x[0]; }, [](auto x, std::vector<double>& J) { J[0] = -2 * x[0]; });
  std::vector<double> x = {1, 0};  // x = 1/(1 - t)
  system.upper[0] = 1e6;
  try {
    integrateInTime(system, x, until(2));
    FAIL();
  } catch (const NumericsError& error) {
    // An error of 1e-3 in a step where x is near 1 moves the end by as much.
    EXPECT_THAT(error.what(), testing::AnyOf(testing::HasSubstr("t = 0.99"), testing::HasSubstr("t = 1.0")));
    EXPECT_THAT(error.what(), testing::HasSubstr("x0"));
  }
}

TEST(UnsteadySystem, OptionsThatMakeNoSenseAreRefused) {
  SmallUnsteadySystem system = decay();
  std::vector<double> x = {1, 2, 0};
  UnsteadyOptions options = until(-1);
  EXPECT_THROW(integrateInTime(system, x, options), InputError);
  options = until(1);
  options.order = 6;
  EXPECT_THROW(integrateInTime(system, x, options), InputError);
  options = until(1);
  options.outputTimes = {0.5, 2};
  EXPECT_THROW(integrateInTime(system, x, options), InputError);
}

TEST(UnsteadySystem, ErrorsOfOtherKindsPassThrough) {
  SmallUnsteadySystem system(
      2,
      [](auto x, auto F) {
        if (x[0] < 0.5) throw std::logic_error("not for the integrator");
        F[0] = x[0];
      },
      [](auto, std::vector<double>& J) { J[0] = 1; });
  std::vector<double> x = {1, 0};
  EXPECT_THROW(integrateInTime(system, x, until(2)), std::logic_error);
}

}  // namespace
}  // namespace lampblack::flow
