// The branch of steady states of a small counterflow flame, round the load at which it goes out.
#include "flow/steady/flow_branch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "flow/models/reaction_operator.hpp"
#include "flow/steady/residual_norms.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr double passage = 2e-3;  // s, that residuals are told for
constexpr double speed = 3.0;     // m/s, of a load of one

// Hydrogen against air in the plane, one cell wide.
class BranchOfCounterflow : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  const std::vector<double> fuel = gas.massFractions("H2: 0.25, N2: 0.75"),
                            air = gas.massFractions("O2: 0.21, N2: 0.79"),
                            burnt = gas.massFractions("H2O: 0.2, N2: 0.8, OH: 0.004, H: 0.004");
  Box box{Geometry::Planar,
          {uniformAxis(0.004, 1), gradedAxis(0.0, {{0.0025, 4, 0.4}, {0.006, 16, 1.0}, {0.008, 4, 2.5}})},
          {side(BoundaryKind::Symmetry, 0, false), opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, air),
           opening(BoundaryKind::Inlet, 1, false, speed, 300.0, fuel),
           opening(BoundaryKind::Inlet, 1, true, speed, 300.0, air)}};
  State state = box.state([&](const auto& place) {
    const double y = place[1];
    const Vector3 u{speed * place[0] / 0.004, speed * (1.0 - y / 0.004), 0.0};
    if (y > 0.003 && y < 0.0055) return Box::Local{u, 1500.0, burnt};
    return Box::Local{u, 300.0, y < 0.004 ? fuel : air};
  });
  TransportOperator transport{box.context, state};
  ReactionOperator chemistry{box.context, {}};
  std::vector<Operator*> operators{&transport, &chemistry};

  // Iterates from the state as it is; the largest residual that is left.
  double settle(double enough, int most = 300) {
    SteadyIteration iteration(box.context, state, {}, operators);
    double left = 1.0;
    for (int i = 0; i < most && left > enough; ++i) {
      iteration.iterate(state);
      left = 0.0;
      for (const auto& norm : residualNorms(box.context, state, iteration.residual(), passage / box.context.load))
        left = std::max(left, norm.value);
    }
    return left;
  }
  double hottest() {
    return largest(box.mesh, [&](int c) { return state.temperature[at(c)]; });
  }
};

TEST_F(BranchOfCounterflow, GoesRoundTheLoadAtWhichTheFlameGoesOut) {
  constexpr double residual = 1e-6;
  transport.initialise(state, 1e-6);
  ASSERT_LE(settle(residual), residual);
  const State first = state;
  FlowBranch branch(box.context, state, VelocityScheme::Limited, operators, passage,
                    {.load = {}, .firstStep = 0.15, .turningPoints = 1, .residual = residual});
  std::optional<State> second;
  branch.follow([&](const FlowBranch::Point& point) {
    report(fmt::format("load {:.5f}, {:.2f} K, {} iterations", point.load, point.peakTemperature, point.iterations));
    EXPECT_EQ(point.load, box.context.load);
    EXPECT_LE(point.residual, residual);
    if (branch.points().size() == 3) second = state;
    return false;
  });
  EXPECT_TRUE(branch.isComplete()) << branch.reason();
  ASSERT_EQ(branch.turningPoints().size(), 1U);
  const TurningPoint& turn = branch.turningPoints()[0];
  EXPECT_TRUE(turn.highest);
  const std::vector<FlowBranch::Point>& points = branch.points();
  ASSERT_GT(points.size(), 3U);
  EXPECT_EQ(points[0].load, 1.0);
  EXPECT_NEAR(points[1].load, 1.15, 1e-12);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LT(points[i].peakTemperature, points[i - 1].peakTemperature) << i;
    EXPECT_GT(points[i].arcLength, points[i - 1].arcLength) << i;
    EXPECT_LE(points[i].load, turn.load * 1.001) << i;
  }
  EXPECT_LT(points.back().load, points[points.size() - 2].load) << "beyond the turning point";

  // What is found with the load as an unknown is what is found at that load.
  ASSERT_TRUE(second);
  state = first;
  LoadControl(box.context, state).scale(state, points[2].load);
  EXPECT_LE(settle(residual), residual);
  EXPECT_NEAR(hottest(), points[2].peakTemperature, 0.01);
  // A little beyond the largest load nothing burns.
  state = first;
  box.context.load = 1.0;
  LoadControl(box.context, state).scale(state, 1.05 * turn.load);
  settle(residual, 60);
  EXPECT_LT(hottest(), 800.0);
}

// What is followed in pressure, or in what comes in, is what is found where that is given from the beginning.
TEST_F(BranchOfCounterflow, FollowsPressureAndWhatComesIn) {
  constexpr double residual = 1e-6;
  transport.initialise(state, 1e-6);
  ASSERT_LE(settle(residual), residual);
  const State first = state;
  const std::size_t hydrogen = gas.mechanism.speciesIndex("H2"), inlet = 2;
  struct Row {
    Load load;
    std::function<void(State&, double load)> give;
  };
  const auto atPatch = [&](std::size_t patch) -> BoundaryCondition& { return box.context.boundaries[patch]; };
  const std::vector<Row> rows{
      {{.of = Load::Of::Pressure}, [&](State& s, double load) { s.thermodynamicPressure *= load; }},
      {{.of = Load::Of::Temperature, .boundary = inlet + 1},
       [&](State&, double load) { atPatch(inlet + 1).temperature = 300.0 * load; }},
      {{.of = Load::Of::MoleFraction, .boundary = inlet, .species = hydrogen},
       [&](State&, double load) {
         atPatch(inlet).Y = gas.massFractions(fmt::format("H2: {:.17g}, N2: {:.17g}", 0.25 * load, 1.0 - 0.25 * load));
       }},
      {{.of = Load::Of::Velocity, .boundary = inlet}, [&](State&, double load) { atPatch(inlet).speed *= load; }}};
  const std::vector<BoundaryCondition> given = box.context.boundaries;
  for (const Row& row : rows) {
    SCOPED_TRACE(static_cast<int>(row.load.of));
    state = first;
    FlowBranch branch(box.context, state, VelocityScheme::Limited, operators, passage,
                      {.load = row.load, .firstStep = 0.05, .highestLoad = 1.08, .points = 6, .residual = residual});
    branch.follow([](const FlowBranch::Point&) { return false; });
    ASSERT_GT(branch.points().size(), 2U) << branch.reason();
    const FlowBranch::Point last = branch.points().back();
    EXPECT_GT(last.load, 1.08);
    branch.unload();
    EXPECT_EQ(box.context.load, 1.0);
    for (std::size_t b = 0; b < given.size(); ++b) {
      EXPECT_EQ(box.context.boundaries[b].temperature, given[b].temperature);
      for (std::size_t k = 0; k < given[b].Y.size(); ++k)
        EXPECT_NEAR(box.context.boundaries[b].Y[k], given[b].Y[k], 1e-15);
    }
    EXPECT_EQ(state.thermodynamicPressure, first.thermodynamicPressure);
    state = first;
    row.give(state, last.load);
    for (std::size_t c = 0; c < state.density.size(); ++c)
      state.density[c] *= state.thermodynamicPressure / first.thermodynamicPressure;
    EXPECT_LE(settle(residual), residual);
    report(fmt::format("load {:.4f}: {:.3f} K, by itself {:.3f} K, at 1 {:.2f} K", last.load, last.peakTemperature,
                       hottest(), branch.points()[0].peakTemperature));
    EXPECT_NEAR(hottest(), last.peakTemperature, 0.01);
    EXPECT_GT(std::abs(hottest() - branch.points()[0].peakTemperature), 1.0);
    box.context.boundaries = given;
  }
}

// In one change of the gas, as far as no cell is limited.
TEST_F(BranchOfCounterflow, ChangesTheLoadSoThatItsConditionHolds) {
  transport.initialise(state, 1e-6);
  ASSERT_LE(settle(1e-3), 1e-3);
  FlowResidual residual(box.context, state, VelocityScheme::Limited, operators);
  residual.evaluate(state);
  std::vector<double> inertia(at(box.mesh.owned), 0.0), from(inertia.size()), along(inertia.size());
  for (int face = 0; face < box.mesh.faces; ++face)
    for (const int cell : {box.mesh.low[face], box.mesh.high[face]})
      if (cell >= 0 && cell < box.mesh.owned) inertia[at(cell)] += std::abs(state.massFlux[face]);
  for (std::size_t c = 0; c < from.size(); ++c) {
    along[c] = 300.0 - state.temperature[c];
    from[c] = state.temperature[c] * (1.0 - 2e-3 * std::sin(2000.0 * box.mesh.centre[c][1]));
  }
  LoadControl control(box.context, state);
  control.require(from, along, 2.0);
  EXPECT_GT(std::abs(control.left(state)), 0.1);
  GasUpdate gasUpdate(box.context, state, operators);
  FlowResidual beside(box.context, state, VelocityScheme::Limited, operators);
  const GasUpdate::Result result = gasUpdate.advance(state, residual, inertia, {{control, beside}});
  EXPECT_EQ(result.limited, 0);
  EXPECT_LT(std::abs(result.loadChange), 0.099);
  EXPECT_GT(result.loadChange, 0.0) << "a larger load cools";
  EXPECT_NEAR(control.left(state), 0.0, 1e-9);
  // What the load does to the flow: all in proportion.
  const State before = state;
  control.scale(state, 1.25);
  EXPECT_EQ(box.context.load, 1.25);
  for (std::size_t i = 0; i < state.velocity.size(); ++i) EXPECT_EQ(state.velocity[i], 1.25 * before.velocity[i]);
  for (std::size_t i = 0; i < state.massFlux.size(); ++i) EXPECT_EQ(state.massFlux[i], 1.25 * before.massFlux[i]);
  EXPECT_NEAR(state.pressure[0], 1.5625 * before.pressure[0], 1e-12 * std::abs(before.pressure[0]));
}

TEST_F(BranchOfCounterflow, EndsWhereItIsToldTo) {
  transport.initialise(state, 1e-6);
  ASSERT_LE(settle(1e-5), 1e-5);
  FlowBranch branch(box.context, state, VelocityScheme::Limited, operators, passage,
                    {.load = {}, .towardsHigherLoad = false, .firstStep = 0.25, .lowestLoad = 0.9, .residual = 1e-5});
  branch.follow([](const FlowBranch::Point&) { return false; });
  EXPECT_EQ(branch.reason(), "the end of the range of the load");
  ASSERT_EQ(branch.points().size(), 2U);
  EXPECT_NEAR(branch.points()[1].load, 0.8, 1e-12);
  EXPECT_GT(branch.points()[1].peakTemperature, branch.points()[0].peakTemperature);
}

}  // namespace
}  // namespace lampblack::test
