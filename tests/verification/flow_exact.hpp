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
#include "flow/stepping/transport_operator.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

using std::numbers::pi;
using Place = Vector3;

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

  // Vortices between planes of symmetry, `length` wide, which viscosity takes away (Taylor and Green 1937).
  struct Vortices {
    double speed, k, decay, density;  // m/s, 1/m, 1/s of the velocity, kg/m3
    [[nodiscard]] double u(const Place& x, double t) const {
      return speed * std::sin(k * x[0]) * std::cos(k * x[1]) * std::exp(-decay * t);
    }
    [[nodiscard]] double v(const Place& x, double t) const {
      return -speed * std::cos(k * x[0]) * std::sin(k * x[1]) * std::exp(-decay * t);
    }
    [[nodiscard]] double p(const Place& x, double t) const {
      return 0.25 * density * speed * speed * (std::cos(2.0 * k * x[0]) + std::cos(2.0 * k * x[1])) *
             std::exp(-2.0 * decay * t);
    }
  };
  Vortices vortices(double reynolds, double length) {
    const double k = pi / length;
    return {reynolds * viscosity() / length, k, 2.0 * k * k * viscosity(), density};
  }

  // Of velocities, over a velocity of the flow: mean over the domain, and in the worst of all cells.
  struct Errors {
    std::array<double, 2> mean{}, largest{};
  };
  // The flow of Kovasznay (1948) on vertices in units of a wave's length, after so many steps of a quarter of the
  // smallest cell.
  Errors kovasznay(Axes vertices, int steps, std::optional<Split> split = {});
  // The same with 12, 24, 48 cells a wave: the last orders of u and v, of the mean and the largest errors, are above
  // `least`. `axes`: vertices for so many cells a wave; the steps it takes to the steady state are in proportion.
  void expectKovasznay(const std::string& what, const std::function<Axes(int)>& axes, int stepsOfACell,
                       const std::array<double, 4>& least, std::optional<Split> split = {});
};

inline double meanError(const Box& box, const std::function<double(int)>& error) {
  return integral(box.mesh, [&](int c) { return std::abs(error(c)); }) / integral(box.mesh, [](int) { return 1.0; });
}

// Meshes of which each has cells of half the width of the one before.
inline std::size_t levels() {
  return fewOrMany<std::size_t>(2, 3);
}

// The order between the last two meshes is above `least`. Where the finest mesh is left out, what is of higher order
// counts more: `least` is then smaller by `allowance`.
inline void expectOrders(const std::string& what, const std::array<double, 3>& error, double least,
                         double allowance = 0.2) {
  std::string errors, orders;
  for (std::size_t level = 0; level < levels(); ++level) {
    errors += fmt::format(" {:.2e}", error[level]);
    if (level > 0) orders += fmt::format(" {:.2f}", std::log2(error[level - 1] / error[level]));
  }
  report(fmt::format("{}:{}, orders{}", what, errors, orders));
  EXPECT_GT(std::log2(error[levels() - 2] / error[levels() - 1]), least - (isLongRun() ? 0.0 : allowance)) << what;
}

// Advances until no velocity changes by more than `steady` in a step; returns the last change.
inline double settle(Box& box, State& state, double dt, int steps, double steady) {
  TransportOperator transport(box.context, state);
  transport.initialise(state, dt);
  double change = 1e300;
  for (int i = 0; i < steps && change > steady; ++i) {
    const std::vector<double> before = state.velocity;
    transport.advance(state, 0.0, dt);
    change = largest(box.mesh, [&](int c) {
      return std::max(std::abs(state.velocity[at(2 * c)] - before[at(2 * c)]),
                      std::abs(state.velocity[at(2 * c + 1)] - before[at(2 * c + 1)]));
    });
  }
  return change;
}

// Behind a grid, Reynolds number 40: u = 1 - exp(lx) cos 2 pi y, v = l/(2 pi) exp(lx) sin 2 pi y, and a pressure that
// depends on x alone, so that an outlet at a place x is exact. Next to y = 0 the gas comes in through the outlet of a
// domain that begins at x = -0.5, where part of it leaves through the inlet.
inline FlowExact::Errors FlowExact::kovasznay(Axes vertices, int steps, std::optional<Split> split) {
  const double reynolds = 40.0, length = 1e-3;
  const double speed = reynolds * viscosity() / length;
  const double l = reynolds / 2.0 - std::sqrt(reynolds * reynolds / 4.0 + 4.0 * pi * pi);
  const auto u = [&](const Place& x, double) {
    return speed * (1.0 - std::exp(l * (x[0] / length - 0.5)) * std::cos(2.0 * pi * x[1] / length));
  };
  const auto v = [&](const Place& x, double) {
    return speed * l / (2.0 * pi) * std::exp(l * (x[0] / length - 0.5)) * std::sin(2.0 * pi * x[1] / length);
  };
  double smallest = length;
  for (std::vector<double>& axis : vertices) {
    for (double& x : axis) x *= length;
    for (std::size_t i = 1; i < axis.size(); ++i) smallest = std::min(smallest, axis[i] - axis[i - 1]);
  }
  // An outlet's triangles leave as they are, of first order: there the exact flow is drawn out.
  const bool hasOutlet = !split || split->cells == Cells::Quadrilaterals;
  const Side end = hasOutlet ? opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, n2)
                             : stream(
                                   0, true, [&](const Place& x, double t) { return -u(x, t); }, v);
  Box box(Geometry::Planar, std::move(vertices),
          {stream(0, false, u, v), end, side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)},
          gas, split);
  bringToLife(box);
  State state = box.state([&](const Place& x) { return Box::Local{{u(x, 0), v(x, 0)}, 300.0, n2}; });
  const double dt = (split ? 0.08 : 0.25) * smallest / speed;
  settle(box, state, dt, steps, 1e-7 * speed);
  Errors errors;
  for (int component = 0; component < 2; ++component) {
    const auto error = [&](int c) {
      const Place& x = box.mesh.centre[at(c)];
      return (state.velocity[at(2 * c + component)] - (component == 0 ? u(x, 0.0) : v(x, 0.0))) / speed;
    };
    errors.mean[at(component)] = meanError(box, error);
    errors.largest[at(component)] = largest(box.mesh, [&](int c) { return std::abs(error(c)); });
  }
  return errors;
}

inline void FlowExact::expectKovasznay(const std::string& what, const std::function<Axes(int)>& axes, int stepsOfACell,
                                       const std::array<double, 4>& least, std::optional<Split> split) {
  constexpr double coarse = 0.35;  // a wave has 12 and 24 cells
  std::array<double, 3> errorU{}, errorV{}, largestU{}, largestV{};
  for (std::size_t level = 0; level < levels(); ++level) {
    const int cells = 12 << level;
    const Errors found = kovasznay(axes(cells), stepsOfACell * cells, split);
    errorU[level] = found.mean[0];
    errorV[level] = found.mean[1];
    largestU[level] = found.largest[0];
    largestV[level] = found.largest[1];
  }
  expectOrders(what + ", u", errorU, least[0], coarse);
  expectOrders(what + ", v", errorV, least[1], coarse);
  expectOrders(what + ", largest error of u", largestU, least[2], coarse);
  expectOrders(what + ", largest error of v", largestV, least[3], coarse);
}

}  // namespace lampblack::test
