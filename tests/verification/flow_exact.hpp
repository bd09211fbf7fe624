// What the tests of the flow against exact solutions at constant density share: nitrogen at 300 K, streams with the
// velocity of a given flow, and orders of accuracy.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "../flow/flow_fixture.hpp"
#include "flow/transport_operator.hpp"
#include "tests/every_room.hpp"

namespace lampblack::test {

using std::numbers::pi;
using Place = std::array<double, 2>;

class FlowExact : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> n2 = gas.massFractions("N2: 1");
  double density = gas.thermo.density(300.0, 101325.0, n2);
  double viscosity() {  // m2/s
    std::vector<double> X(n2.size()), D(n2.size());
    gas.thermo.massToMole(n2, X);
    return gas.transport.mixture(300.0, 101325.0, X, D).viscosity / density;
  }

  // An inlet all along a side, with the velocity of a given flow.
  using Velocity = std::function<double(const Place&, double)>;
  Side stream(int axis, bool atMax, const Velocity& inwards, const Velocity& along) {
    Side s = opening(BoundaryKind::Inlet, axis, atMax, 0.0, 300.0, n2);
    s.condition.varies.speed = inwards;
    s.condition.varies.tangential = along;
    return s;
  }
  static void bringToLife(Box& box) {
    box.context.varying = std::make_shared<BoundaryValues>(box.mesh, box.context.boundaries, box.gas.thermo);
  }
};

inline double meanError(const Box& box, const std::function<double(int)>& error) {
  return integral(box.mesh, [&](int c) { return std::abs(error(c)); }) / integral(box.mesh, [](int) { return 1.0; });
}

inline void expectOrders(const std::string& what, const std::array<double, 3>& error, double least) {
  report(fmt::format("{}: {:.2e} {:.2e} {:.2e}, orders {:.2f} {:.2f}", what, error[0], error[1], error[2],
                     std::log2(error[0] / error[1]), std::log2(error[1] / error[2])));
  EXPECT_GT(std::log2(error[1] / error[2]), least) << what;
}

}  // namespace lampblack::test
