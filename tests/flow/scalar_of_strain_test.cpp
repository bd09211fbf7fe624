// A further equation is one struct and one row.
#include <gtest/gtest.h>

#include <cmath>

#include "flow/equations/flow_residual.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flow_fixture.hpp"

namespace lampblack::test {
namespace {

// An equation of its own, whose diffusivity and implicit sink go by the strain of the flow: D = b S and a S c. All that
// a further equation has to bring.
struct StrainedToy : Operator {
  static constexpr double spread = 2e-7, burnt = 3.0;  // b, m^2; a
  const FlowContext& context;
  TransportOperator& transport;
  StrainedToy(const FlowContext& of, TransportOperator& by) : context(of), transport(by) {}

  static ScalarBlock block(double low, double high) {
    return {"strained", {{.name = "c", .unit = "1/m^3", .description = "", .boundaries = {{low, true}, {high, true}}}}};
  }
  [[nodiscard]] const char* name() const override { return "strained"; }
  void advance(State&, double, double) override {}
  [[nodiscard]] static double strain(const VelocityGradient& gradient, int cell) {
    return std::abs(gradient.of(cell, 0)[1] + gradient.of(cell, 1)[0]);
  }
  void endSweep(State& state) override {
    addRates(state, state.balance);
    const VelocityGradient& gradient = transport.velocityGradient(state);
    for (int c = 0; c < context.mesh.owned; ++c) state.carriedDiffusivity[at(c)] = spread * strain(gradient, c);
    context.halo.update(state.carriedDiffusivity, 1);
  }
  void addRates(const State& state, State::Balance& rates) override {
    const VelocityGradient& gradient = transport.velocityGradient(state);
    for (int c = 0; c < context.mesh.owned; ++c) rates.carriedSink[at(c)] += burnt * strain(gradient, c);
  }
};

// Between a wall that moves and one that does not: c'' = a/b c whatever the strain, between values at the walls. A step
// of a thousand times the sink's time is no hindrance, and the rates of the end state are none.
TEST(ScalarBlocks, AnEquationOfTheStrainIsOneStructAndOneRow) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> N2 = gas.massFractions("N2: 1");
  const double h = 1e-3, speed = 0.5, low = 4.0, high = 1.0;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    Side still = side(BoundaryKind::Wall, 1, false), moving = side(BoundaryKind::Wall, 1, true);
    still.condition.slip = moving.condition.slip = false;
    moving.condition.tangential = speed;
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {uniformAxis(h, 3), uniformAxis(h, 10 << level), {}};
    spec.periodic[0] = true;
    spec.patches = {still.patch, moving.patch};
    Box box(spec, {still.condition, moving.condition});
    State state = box.stateWith({StrainedToy::block(low, high)}, [&](const Vector3& x) {
      return Box::Local{{speed * x[1] / h, 0.0}, 300.0, N2};
    });
    TransportOperator transport(box.context, state);
    StrainedToy toy(box.context, transport);
    const double dt = 0.3;
    EXPECT_GT(dt * StrainedToy::burnt * speed / h, 400.0);
    transport.initialise(state, dt);
    toy.endSweep(state);
    for (int i = 0; i < 4; ++i) {
      transport.advance(state, i * dt, dt);
      transport.endSweep(state);
      toy.endSweep(state);
    }
    const double root = std::sqrt(StrainedToy::burnt / StrainedToy::spread);
    error[level] = largest(box.mesh, [&](int c) {
      const double y = box.mesh.centre[at(c)][1];
      const double exact = (low * std::sinh(root * (h - y)) + high * std::sinh(root * y)) / std::sinh(root * h);
      return std::abs(state.carried[at(c)] / state.density[at(c)] - exact);
    });
    FlowResidual residual(box.context, state, VelocityScheme::Limited, {&toy});
    const FlowResidual::Rates& rates = residual.evaluate(state);
    const double taken = StrainedToy::burnt * speed / h * state.density[0] * low * h * h / 10;
    EXPECT_LT(largest(box.mesh, [&](int c) { return std::abs(rates.carried[at(c)]); }), 1e-4 * taken);
  }
  report(fmt::format("a toy of the strain: errors {:.2e} {:.2e}", error[0], error[1]));
  EXPECT_LT(error[1], 0.02);
  EXPECT_GT(error[0] / error[1], 3.4);
}

}  // namespace
}  // namespace lampblack::test
