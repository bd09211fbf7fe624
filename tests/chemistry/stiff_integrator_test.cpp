// The stiff integrator by itself, on systems with known solutions.
#include "chemistry/reactor/stiff_integrator.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {
namespace {

// y0' = -y0, y1' = y0: y0 falls by decades, their sum stays.
class Decay final : public OdeSystem {
 public:
  explicit Decay(bool moving) : moving_(moving) {}
  std::size_t size() const override { return 2; }
  bool rates(double, const double* y, double* f) override {
    f[0] = -y[0];
    f[1] = y[0];
    return true;
  }
  bool jacobian(double t, const double* y, double* f, double* J, std::size_t ld) override {
    J[0] = -1;
    J[1] = 1;
    J[ld] = J[ld + 1] = 0;
    return rates(t, y, f);
  }
  bool hasMovingScales() const override { return moving_; }
  void toleranceScales(const double* y, double* scales) const override {
    scales[0] = std::abs(y[0]);
    scales[1] = 1;
  }
  std::string describe(double, const double*) const override { return "decay"; }

 private:
  bool moving_;
};

double errorAfterDecades(bool moving) {
  Decay system(moving);
  StiffIntegrator integrator(system, {1e-10, 1e-6, 0, 100000});
  const double end = 20 * std::numbers::ln10;
  integrator.start(0, std::vector{1.0, 0.0}, end);
  while (integrator.time() < end) integrator.step();
  EXPECT_NEAR(integrator.state()[0] + integrator.state()[1], 1, 1e-14);  // Newton keeps linear invariants
  return std::abs(integrator.state()[0] / 1e-20 - 1);
}

TEST(StiffIntegrator, FollowsAnUnknownThroughDecadesWhereTheScalesMove) {
  // A relative tolerance of 1e-6 in every one of some hundred steps.
  EXPECT_LT(errorAfterDecades(true), 1e-3);
  EXPECT_GT(errorAfterDecades(false), 1);  // far below an absolute tolerance of 1e-6 there is nothing but noise
}

TEST(StiffIntegrator, GoesOnBeyondItsEndWithoutANewStart) {
  Decay system(true);
  StiffIntegrator integrator(system, {1e-9, 1e-9, 0, 100000});
  integrator.start(0, std::vector{1.0, 0.0}, 1);
  while (integrator.time() < 1) integrator.step();
  EXPECT_EQ(integrator.time(), 1);
  const long first = integrator.statistics().steps;
  integrator.extend(1.5);
  while (integrator.time() < 1.5) integrator.step();
  EXPECT_EQ(integrator.time(), 1.5);
  EXPECT_NEAR(integrator.state()[0], std::exp(-1.5), 1e-7);
  // A new start would begin with tiny steps of first order again.
  EXPECT_LT(integrator.statistics().steps - first, first / 2);
}

// y' = y^2 with y(1) = 1 is 1/(2 - t): at the pole steps become shorter than the time's last bit.
class Pole final : public OdeSystem {
 public:
  std::size_t size() const override { return 1; }
  bool rates(double, const double* y, double* f) override {
    f[0] = y[0] * y[0];
    return true;
  }
  bool jacobian(double t, const double* y, double* f, double* J, std::size_t) override {
    J[0] = 2 * y[0];
    return rates(t, y, f);
  }
  std::string describe(double t, const double*) const override { return fmt::format("t = {:g} s", t); }
};

TEST(StiffIntegrator, EndsWhereStepsMoveTheTimeNoLonger) {
  Pole system;
  StiffIntegrator integrator(system, {1e-6, 1e-9, 0, 1000000});
  integrator.start(1, std::vector{1.0}, 3);
  std::string message;
  try {
    while (integrator.time() < 3) integrator.step();
  } catch (const NumericsError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, testing::HasSubstr("steps are too small to be added to 1.9999"));
  EXPECT_LT(integrator.statistics().steps, 10000);
}

}  // namespace
}  // namespace lampblack::chemistry
