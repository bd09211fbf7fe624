// Newton's method for gas and flow together.
#include "flow/steady/newton_krylov.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/state_backup.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/steady/steady_iteration.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Warm gas that rises in a channel with a wall, into which other gas flows.
struct WarmChannel {
  explicit WarmChannel(double height = 0.012) {
    Gas& gas = Gas::hydrogen();
    air = gas.massFractions("O2: 0.21, N2: 0.79");
    const std::vector<double> moist = gas.massFractions("O2: 0.2, N2: 0.7, H2O: 0.1");
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = false;
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {uniformAxis(0.006, 4), uniformAxis(height, 6), {}};
    std::vector<BoundaryCondition> conditions;
    for (const Side& s :
         {side(BoundaryKind::Symmetry, 0, false), wall, opening(BoundaryKind::Inlet, 1, false, 0.3, 400.0, moist),
          opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)}) {
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
    box.emplace(spec, conditions, std::nullopt, MPI_COMM_WORLD);
    box->context.gravity = {0.0, -9.81, 0.0};
    state.emplace(box->state([&](const auto&) { return Box::Local{{0.0, 0.3}, 350.0, air}; }));
    transport.emplace(box->context, *state);
    transport->initialise(*state, 1e-4);
  }
  std::vector<double> air;
  std::optional<Box> box;
  std::optional<State> state;
  std::optional<TransportOperator> transport;
};

// Beside the steady state, what a step leaves is of the square of the disturbance that it began with.
TEST(NewtonSteps, LeaveTheSquare) {
  WarmChannel channel;
  Box& b = *channel.box;
  State& found = *channel.state;
  const std::vector<Operator*> operators{&*channel.transport};
  SteadyIteration iteration(b.context, found, {}, operators);
  double measure = 1.0;
  int count = 0, newtons = 0;
  for (; count < 100 && measure > 1e-12; ++count) {
    const SteadyIteration::Outcome outcome = iteration.iterate(found);
    measure = outcome.measure;
    newtons += outcome.newtonIterations > 0;
  }
  report(fmt::format("{} iterations, {} of Newton's, left {:.2g}", count, newtons, measure));
  EXPECT_LE(measure, 1e-12);
  EXPECT_GE(newtons, 3);
  FlowResidual residual(b.context, found, VelocityScheme::Limited, operators);
  GasUpdate gas(b.context, found, operators);
  NewtonKrylov newton(b.context, found, residual, gas, 60);
  const std::vector<double> none(at(b.mesh.owned), 0.0);
  const auto left = [&](double size) {
    State state = found;
    for (int c = 0; c < b.mesh.owned; ++c) {
      const double wave = size * std::sin(400.0 * b.mesh.centre[c][1] + 200.0 * b.mesh.centre[c][0]);
      state.temperature[at(c)] *= 1.0 + wave;
      for (int i = 0; i < 2; ++i) state.velocity[at(2 * c + i)] *= 1.0 + wave;
      followGas(b.context, state, c);
    }
    state.updateHalo(b.halo);
    residual.evaluate(state);
    const NewtonKrylov::Result result = newton.advance(state, none, 1e-8);
    report(fmt::format("{} iterations, to {:.2g}", result.iterations, result.reached));
    EXPECT_LE(result.iterations, 32);
    return largest(b.mesh, [&](int c) { return std::abs(state.temperature[at(c)] - found.temperature[at(c)]); });
  };
  const double whole = left(4e-3), half = left(2e-3);
  report(fmt::format("off by {:.3g} and {:.3g} K", whole, half));
  EXPECT_GT(whole / half, 3.0);
  EXPECT_LT(whole, 0.02);
}

// Cells 150 times as long as high answer to what is conducted across them a thousand times faster than to the flow.
TEST(NewtonSteps, BringThinCellsToRest) {
  WarmChannel channel(6e-5);
  SteadyIteration iteration(channel.box->context, *channel.state, {}, {&*channel.transport});
  double measure = 1.0;
  int count = 0;
  for (; count < 200 && measure > 1e-11; ++count) measure = iteration.iterate(*channel.state).measure;
  report(fmt::format("{} iterations, left {:.2g}", count, measure));
  EXPECT_LE(measure, 1e-11);
  EXPECT_LE(count, 75);
}

// Heat that comes and goes each time that one asks: differences of the residual tell nothing.
class Restless : public Operator {
 public:
  explicit Restless(const Mesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] const char* name() const override { return "restless"; }
  void advance(State&, double, double) override {}
  void addRates(const State&, State::Balance& rates) override {
    sign_ = -sign_;
    for (int c = 0; c < mesh_.owned; ++c) rates.enthalpy[at(c)] += sign_ * 5.0;  // W/m3
  }

 private:
  const Mesh& mesh_;
  double sign_ = 1.0;
};

TEST(NewtonSteps, AreToldWhereTheyAreTakenBack) {
  WarmChannel channel;
  Restless restless(channel.box->mesh);
  const std::vector<Operator*> operators{&*channel.transport, &restless};
  SteadyIteration iteration(channel.box->context, *channel.state, {}, operators);
  int takenBack = 0, count = 0;
  for (; count < 80 && takenBack == 0; ++count) {
    const SteadyIteration::Outcome outcome = iteration.iterate(*channel.state);
    takenBack += outcome.newtonTakenBack;
    EXPECT_EQ(iteration.last().newtonTakenBack, outcome.newtonTakenBack);
    EXPECT_GE(outcome.newtonIterations, outcome.newtonTakenBack ? 1 : 0);
  }
  report(fmt::format("taken back in iteration {}", count));
  EXPECT_EQ(takenBack, 1);
}

TEST(NewtonSteps, GoOnFromWhatWasSavedWithTheSameBits) {
  WarmChannel channel, other;
  const auto begin = [](WarmChannel& c) {
    return std::make_unique<SteadyIteration>(c.box->context, *c.state, SteadyIteration::Options{},
                                             std::vector<Operator*>{&*c.transport});
  };
  const std::unique_ptr<SteadyIteration> one = begin(channel), two = begin(other);
  for (int newtons = 0, count = 0; newtons < 2 && count < 100; ++count)
    newtons += one->iterate(*channel.state).newtonIterations > 0;
  const auto partsOf = [](WarmChannel& c, SteadyIteration& iteration) {
    return [&](StateArchive& archive) {
      c.state->saveOrLoad(archive);
      if (archive.loading()) c.state->updateHalo(c.box->halo);
      iteration.saveOrLoad(*c.state, archive);
    };
  };
  StateBackup kept(channel.box->mesh.owned, channel.box->mesh.faces);
  kept.save(partsOf(channel, *one));
  kept.restore(partsOf(other, *two));
  int newtons = 0;
  for (int i = 0; i < 2; ++i) {
    const SteadyIteration::Outcome a = one->iterate(*channel.state), b = two->iterate(*other.state);
    EXPECT_EQ(a.measure, b.measure);
    EXPECT_EQ(a.courant, b.courant);
    EXPECT_EQ(a.newtonIterations, b.newtonIterations);
    newtons += a.newtonIterations > 0;
  }
  EXPECT_GE(newtons, 1);
  EXPECT_EQ(channel.state->temperature, other.state->temperature);
  EXPECT_EQ(channel.state->massFlux, other.state->massFlux);
  EXPECT_EQ(channel.state->pressure, other.state->pressure);
}

}  // namespace
}  // namespace lampblack::test
