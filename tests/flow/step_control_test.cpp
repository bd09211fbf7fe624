// Time steps by their error.
#include "flow/step_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class StepControls : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  Box box{Geometry::Planar,
          {uniformAxis(1.0, 4), uniformAxis(1.0, 3)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)}};
  State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 500.0, air}; });
  // The cell of this natural number, if it is here.
  void change(std::int64_t natural, double kelvin, double fraction) {
    const int c = box.mesh.findOwned(natural);
    if (c < 0) return;
    state.temperature[at(c)] += kelvin;
    state.Y[at(c) * air.size()] += fraction;
  }
};

TEST_F(StepControls, TheLastCorrectionIsTheError) {
  StepControl control(box.context, 1e-3, 3);
  EXPECT_EQ(control.largestStep(state), std::numeric_limits<double>::infinity()) << "nothing known yet";
  change(2, 100.0, 0.0);
  control.advance(state, 0.0, 2e-5);
  change(5, 50.0, 0.0);
  control.advance(state, 0.0, 2e-5);
  change(7, 2.0, 0.0);
  change(9, 0.0, 3e-3);
  control.advance(state, 0.0, 2e-5);
  EXPECT_NEAR(control.historyValues(state).at(0), std::max(2.0 / 502.0, 3e-3), 1e-15);
  EXPECT_NEAR(control.largestStep(state), 2e-5 * 0.9 * std::cbrt(1e-3 / (2.0 / 502.0)), 1e-18);
  for (int sweep = 0; sweep < 3; ++sweep) {
    if (sweep == 2) change(9, 0.0, 0.5);
    control.advance(state, 0.0, 1e-5);
  }
  EXPECT_NEAR(control.historyValues(state).at(0), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(control.largestStep(state), 0.2e-5) << "not less than a fifth at once";
  for (int sweep = 0; sweep < 3; ++sweep) control.advance(state, 0.0, 1e-5);
  EXPECT_EQ(control.historyValues(state).at(0), 0.0) << "of the last step alone";
}

TEST_F(StepControls, NeedsTwoSweeps) {
  EXPECT_THROW(StepControl(box.context, 1e-3, 1), std::logic_error);
}

}  // namespace
}  // namespace lampblack::test
