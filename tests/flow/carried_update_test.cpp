// What is carried, by the linear system of its equations: what sources that bend, traces and fast growth make of it.
#include "flow/steady/carried_update.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "steady_channel.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

using CarriedUpdates = SteadyChannel;

// Something of which there is an amount that its sources go to from either side, at a rate that does not tell from how
// far: a whole step by its derivative leads as far to the other side, and back.
class SaturatedDust : public Operator {
 public:
  explicit SaturatedDust(const Mesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] const char* name() const override { return "dust"; }
  void advance(State&, double, double) override {}
  void addRates(const State& state, State::Balance& rates) override {
    for (int c = 0; c < mesh_.owned; ++c)
      rates.carried[at(c)] += fastest * std::tanh((goal - state.carried[at(c)]) / width);
  }
  [[nodiscard]] bool actsOnCarried() const override { return true; }
  void addSlopes(const State& state, const Slopes& slopes) override {
    if (slopes.carried.empty()) return;
    for (int c = 0; c < mesh_.owned; ++c) {
      const double cosine = std::cosh((goal - state.carried[at(c)]) / width);
      slopes.carried[at(c)] -= fastest / width / (cosine * cosine);
    }
  }
  static constexpr double goal = 1.0, width = 0.1, fastest = 1e4;  // 1/m3, 1/m3, 1/m3/s

 private:
  const Mesh& mesh_;
};

// Small ones that come at a rate, and large ones that pairs of them become; both vanish.
class PairingDust : public Operator {
 public:
  explicit PairingDust(const Mesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] const char* name() const override { return "dust"; }
  void advance(State&, double, double) override {}
  void addRates(const State& state, State::Balance& rates) override {
    for (int c = 0; c < mesh_.owned; ++c) {
      const double small = state.carried[2 * at(c)], large = state.carried[2 * at(c) + 1];
      rates.carried[2 * at(c)] += lost * (goal - small);
      rates.carried[2 * at(c) + 1] += lost * (small * small / goal - large);
    }
  }
  [[nodiscard]] bool actsOnCarried() const override { return true; }
  void addSlopes(const State& state, const Slopes& slopes) override {
    if (slopes.carried.empty()) return;
    for (int c = 0; c < mesh_.owned; ++c) {
      double* J = &slopes.carried[4 * at(c)];
      J[0] -= lost;
      J[1] += 2.0 * lost * state.carried[2 * at(c)] / goal;
      J[3] -= lost;
    }
  }
  static constexpr double goal = 1.0, lost = 1e6;  // 1/m3, 1/s

 private:
  const Mesh& mesh_;
};

// Grows by itself, far faster than the flow carries it, until there is enough.
class GrowingDust : public Operator {
 public:
  explicit GrowingDust(const Mesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] const char* name() const override { return "dust"; }
  void advance(State&, double, double) override {}
  void addRates(const State& state, State::Balance& rates) override {
    for (int c = 0; c < mesh_.owned; ++c)
      rates.carried[at(c)] += growth * state.carried[at(c)] * (1.0 - state.carried[at(c)] / goal);
  }
  [[nodiscard]] bool actsOnCarried() const override { return true; }
  void addSlopes(const State& state, const Slopes& slopes) override {
    if (slopes.carried.empty()) return;
    for (int c = 0; c < mesh_.owned; ++c) slopes.carried[at(c)] += growth * (1.0 - 2.0 * state.carried[at(c)] / goal);
  }
  static constexpr double goal = 1.0, growth = 1e6;  // 1/m3, 1/s

 private:
  const Mesh& mesh_;
};

// Whole steps would go to and fro for ever; cells that take less come to rest.
TEST_F(CarriedUpdates, TakeLessWhereSourcesBend) {
  Box b = channel(air, 300.0, 0.5);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, air}; }, dust);
  TransportOperator transport(b.context, state);
  SaturatedDust saturated(b.mesh);
  std::ranges::fill(state.carried, 3.0 * SaturatedDust::goal);
  state.updateHalo(b.halo);
  transport.initialise(state, 1e-4);
  const std::vector<Operator*> operators{&transport, &saturated};
  FlowResidual residual(b.context, state, VelocityScheme::Limited, operators);
  residual.evaluate(state);
  CarriedUpdate update(b.context, state, residual, operators);
  std::vector<double> inertia(at(b.mesh.owned), 0.0);
  for (int face = 0; face < b.mesh.faces; ++face)
    for (const int cell : {b.mesh.low[face], b.mesh.high[face]})
      if (cell >= 0 && cell < b.mesh.owned) inertia[at(cell)] += 0.5 * std::abs(state.massFlux[face]);
  for (int pass = 0; pass < 60; ++pass) {
    update.advance(state, residual, inertia);
    residual.evaluateCarried(state);
  }
  const double left = largest(b.mesh, [&](int c) {
    return std::abs(residual.rates().carried[at(c)]) / (b.mesh.volume[c] * SaturatedDust::fastest);
  });
  report(fmt::format("left {:.2g} of the sources", left));
  EXPECT_LT(left, 1e-6);
  const auto present = [&](int c) { return state.carried[at(c)]; };
  EXPECT_LT(largest(b.mesh, present), 1.000001 * SaturatedDust::goal);
  // Gas without any comes in.
  EXPECT_GT(-largest(b.mesh, [&](int c) { return -present(c); }), 0.5 * SaturatedDust::goal);
}

// Nor does what is even per mass change where more mass comes to a cell than leaves it.
TEST_F(CarriedUpdates, LeaveEvenWhatMassThatGathersBrings) {
  Box b(Geometry::Planar, {uniformAxis(0.004, 4), uniformAxis(0.004, 4)},
        {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
         side(BoundaryKind::Wall, 1, true)});
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; }, dust);
  TransportOperator transport(b.context, state);
  for (int c = 0; c < b.mesh.owned; ++c) state.carried[at(c)] = 3.0 * state.density[at(c)];
  state.updateHalo(b.halo);
  transport.initialise(state, 1e-4);
  for (int face = 0; face < b.mesh.interiorFaces; ++face) state.massFlux[at(face)] = 1e-3;
  const std::vector<Operator*> operators{&transport};
  FlowResidual residual(b.context, state, VelocityScheme::Limited, operators);
  residual.evaluate(state);
  CarriedUpdate update(b.context, state, residual, operators);
  update.advance(state, residual, std::vector<double>(at(b.mesh.owned), 1e-2));
  EXPECT_GT(largest(b.mesh, [&](int c) { return std::abs(residual.rates().mass[at(c)]); }), 1e-3);
  const auto off = [&](int c) { return std::abs(state.carried[at(c)] / state.density[at(c)] / 3.0 - 1.0); };
  EXPECT_LT(largest(b.mesh, off), 1e-12);
}

// What there is only traces of does not grow from them, but from what counts as nothing.
TEST_F(CarriedUpdates, ReachWhatIsEmpty) {
  Box b = channel(air, 300.0, 0.5);
  std::vector<CarriedScalar> scalars{{"small", "1/m3", "", 0.0}, {"large", "1/m3", "", 0.0}};
  for (CarriedScalar& scalar : scalars) scalar.negligible = 1e-5 * PairingDust::goal;
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, air}; }, scalars);
  TransportOperator transport(b.context, state);
  PairingDust pairing(b.mesh);
  for (int c = 0; c < b.mesh.owned; ++c) state.carried[2 * at(c) + 1] = c % 3 == 0 ? 1e-30 : 0.0;
  state.updateHalo(b.halo);
  transport.initialise(state, 1e-4);
  const std::vector<Operator*> operators{&transport, &pairing};
  FlowResidual residual(b.context, state, VelocityScheme::Limited, operators);
  residual.evaluate(state);
  CarriedUpdate update(b.context, state, residual, operators);
  const std::vector<double> inertia(at(b.mesh.owned), 0.0);
  for (int pass = 0; pass < 14; ++pass) {
    update.advance(state, residual, inertia);
    residual.evaluateCarried(state);
  }
  const double left =
      largest(b.mesh, [&](int c) { return std::abs(state.carried[2 * at(c) + 1] / PairingDust::goal - 1.0); });
  report(fmt::format("large ones lack {:.2g}", left));
  EXPECT_LT(left, 0.2);  // it goes up by ten times in a pass
}

// The derivative of what grows faster than it is carried away points the other way.
TEST_F(CarriedUpdates, LetGrowWhatGrowsFast) {
  Box b = channel(air, 300.0, 0.5);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, air}; }, dust);
  TransportOperator transport(b.context, state);
  GrowingDust growing(b.mesh);
  std::ranges::fill(state.carried, 0.01 * GrowingDust::goal);
  state.updateHalo(b.halo);
  transport.initialise(state, 1e-4);
  const std::vector<Operator*> operators{&transport, &growing};
  FlowResidual residual(b.context, state, VelocityScheme::Limited, operators);
  residual.evaluate(state);
  CarriedUpdate update(b.context, state, residual, operators);
  const std::vector<double> inertia(at(b.mesh.owned), 0.0);
  std::vector<std::int64_t> held;
  for (int pass = 0; pass < 12; ++pass) {
    held.push_back(update.advance(state, residual, inertia));
    residual.evaluateCarried(state);
  }
  const double left = largest(b.mesh, [&](int c) { return std::abs(state.carried[at(c)] / GrowingDust::goal - 1.0); });
  report(fmt::format("lacks {:.2g}", left));
  EXPECT_LT(left, 0.01);
  EXPECT_EQ(held.front(), b.mesh.totalCells);  // each would be far more than ten times what it was
  EXPECT_EQ(held.back(), 0);
}

// Sources that are straight need no shares: one pass leaves what the linear system does.
TEST_F(CarriedUpdates, TakeAllWhereSourcesAreStraight) {
  Box b = channel(air, 300.0, 0.5);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, air}; }, dust);
  TransportOperator transport(b.context, state);
  HotDust straight(b.mesh);
  std::ranges::fill(state.carried, 1.0);  // three times what is made of it while it lasts
  state.updateHalo(b.halo);
  transport.initialise(state, 1e-4);
  const std::vector<Operator*> operators{&transport, &straight};
  FlowResidual residual(b.context, state, VelocityScheme::Limited, operators);
  const auto left = [&] {
    return integral(b.mesh, [&](int c) { return std::abs(residual.rates().carried[at(c)]) / b.mesh.volume[c]; });
  };
  residual.evaluate(state);
  const double before = left();
  CarriedUpdate update(b.context, state, residual, operators);
  const std::int64_t held = update.advance(state, residual, std::vector<double>(at(b.mesh.owned), 0.0));
  // Where next to nothing is made a tenth is left.
  const double tenths = integral(
      b.mesh, [&](int c) { return std::abs(state.carried[at(c)] - 0.1) < 1e-12 ? 1.0 / b.mesh.volume[at(c)] : 0.0; });
  EXPECT_NEAR(static_cast<double>(held), tenths, 1e-6);
  EXPECT_GT(held, 0);
  residual.evaluateCarried(state);
  report(fmt::format("left {:.2g} of what there was", left() / before));
  EXPECT_LT(left(), 0.15 * before);
}

}  // namespace
}  // namespace lampblack::test
