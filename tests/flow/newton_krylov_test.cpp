// Newton's method for gas and flow together.
#include "flow/steady/newton_krylov.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "core/state_backup.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/steady/steady_iteration.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "stirred_channel.hpp"
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

void bringToRest(StirredChannel& channel) {
  SteadyIteration iteration(channel.box->context, *channel.state, {}, channel.operators);
  double measure = 1.0;
  int count = 0, newtons = 0;
  for (; count < 100 && measure > 1e-11; ++count) {
    const SteadyIteration::Outcome outcome = iteration.iterate(*channel.state);
    measure = outcome.measure;
    newtons += outcome.newtonIterations > 0 && !outcome.newtonTakenBack;
  }
  report(fmt::format("{} iterations, {} of Newton's, left {:.2g}", count, newtons, measure));
  EXPECT_LE(measure, 1e-11);
  EXPECT_GE(newtons, 3);
}

// The variables of turbulence are unknowns as velocities are.
TEST(NewtonSteps, LeaveTheSquareWhereEddiesStir) {
  StirredChannel channel;
  Box& b = *channel.box;
  State& found = *channel.state;
  bringToRest(channel);
  FlowResidual residual(b.context, found, VelocityScheme::Limited, channel.operators);
  GasUpdate gas(b.context, found, channel.operators);
  CarriedUpdate carried(b.context, found, residual, channel.operators);
  NewtonKrylov newton(b.context, found, residual, gas, 60, &carried, channel.operators);
  const std::vector<double> none(at(b.mesh.owned), 0.0);
  const auto left = [&](double size) {
    State state = found;
    for (int c = 0; c < b.mesh.owned; ++c) {
      const double wave = size * std::sin(300.0 * b.mesh.centre[c][1] + 600.0 * b.mesh.centre[c][0]);
      for (int i = 0; i < 2; ++i) state.velocity[at(2 * c + i)] *= 1.0 + wave;
      for (int i = 0; i < 2; ++i) state.carried[at(2 * c + i)] *= 1.0 - wave;
    }
    for (Operator* op : channel.operators) op->setDiffusivities(state);
    state.updateHalo(b.halo);
    residual.evaluate(state);
    const NewtonKrylov::Result result = newton.advance(state, none, 1e-8);
    report(fmt::format("{} iterations, to {:.2g}", result.iterations, result.reached));
    EXPECT_LE(result.iterations, 40);
    return largest(b.mesh, [&](int c) {
      double off = std::abs(state.velocity[at(2 * c + 1)] / found.velocity[at(2 * c + 1)] - 1.0);
      for (int i = 0; i < 2; ++i)
        off = std::max(off, std::abs(state.carried[at(2 * c + i)] / found.carried[at(2 * c + i)] - 1.0));
      return off;
    });
  };
  const double whole = left(4e-4), half = left(2e-4);
  report(fmt::format("off by {:.3g} and {:.3g}", whole, half));
  EXPECT_GT(whole / half, 3.0);
  EXPECT_LT(whole, 1e-4);
  // In next to no time each cell by what is left in it alone.
  State state = found;
  for (double& amount : state.carried) amount *= 1.01;
  for (Operator* op : channel.operators) op->setDiffusivities(state);
  state.updateHalo(b.halo);
  residual.evaluate(state);
  const double inertia = 1e6;  // kg/s
  const State before = state;
  const std::vector<double> rates = residual.rates().carried, mass = residual.rates().mass;
  EXPECT_EQ(newton.advance(state, std::vector<double>(at(b.mesh.owned), inertia), 1e-8).held, 0);
  // The linear system leaves 1e-8 of all that was left, which in a cell with little left may be more than that.
  for (std::size_t s = 0; s < 2; ++s) {
    const auto expected = [&](int c) {
      const std::size_t i = 2 * at(c) + s;
      return (rates[i] - before.carried[i] / before.density[at(c)] * mass[at(c)]) / inertia;
    };
    const double most = largest(b.mesh, [&](int c) { return std::abs(expected(c)); });
    EXPECT_GT(most, 0.0);
    for (int c = 0; c < b.mesh.owned; ++c) {
      const std::size_t i = 2 * at(c) + s;
      EXPECT_NEAR((state.carried[i] - before.carried[i]) / before.density[at(c)], expected(c), 1e-3 * most);
    }
  }
}

// What is carried is left a tenth of at least, and the cells where that holds it back are counted.
TEST(NewtonSteps, CountTheCellsThatAreHeld) {
  StirredChannel channel;
  Box& b = *channel.box;
  State& found = *channel.state;
  bringToRest(channel);
  FlowResidual residual(b.context, found, VelocityScheme::Limited, channel.operators);
  GasUpdate gas(b.context, found, channel.operators);
  CarriedUpdate carried(b.context, found, residual, channel.operators);
  NewtonKrylov newton(b.context, found, residual, gas, 60, &carried, channel.operators);
  for (const double off : {1e-4, 40.0}) {
    State state = found;
    for (int c = 0; c < b.mesh.owned; ++c)
      if (b.mesh.naturalCell[at(c)] % 7 == 3) state.carried[at(2 * c)] *= 1.0 + off;
    for (Operator* op : channel.operators) op->setDiffusivities(state);
    state.updateHalo(b.halo);
    residual.evaluate(state);
    const State before = state;
    const NewtonKrylov::Result result = newton.advance(state, std::vector<double>(at(b.mesh.owned), 0.0), 1e-4);
    const double held = integral(b.mesh, [&](int c) {
      for (std::size_t s = 0; s < 2; ++s) {
        const double was = before.carried[2 * at(c) + s] / before.density[at(c)];
        const double is = state.carried[2 * at(c) + s] / state.density[at(c)];
        const double most = 10.0 * was + 1e-4 * carried.scales()[s];
        if (std::abs(is - 0.1 * was) < 1e-12 * was || std::abs(is - most) < 1e-12 * most) return 1.0 / b.mesh.volume[c];
      }
      return 0.0;
    });
    report(fmt::format("{} cells held", result.held));
    EXPECT_NEAR(static_cast<double>(result.held), held, 1e-6);
    EXPECT_EQ(result.held > 0, off > 1.0);
  }
}

// So is what else is carried: particles, of which there are far more than of anything else by number.
TEST(NewtonSteps, LeaveTheSquareOfParticlesBesideEddies) {
  StirredChannel channel(true);
  Box& b = *channel.box;
  State& found = *channel.state;
  bringToRest(channel);
  FlowResidual residual(b.context, found, VelocityScheme::Limited, channel.operators);
  GasUpdate gas(b.context, found, channel.operators);
  CarriedUpdate carried(b.context, found, residual, channel.operators);
  NewtonKrylov newton(b.context, found, residual, gas, 60, &carried, channel.operators);
  const std::vector<double> none(at(b.mesh.owned), 0.0);
  const std::size_t all = found.scalars.size(), dust = at(found.block("dust").first);
  const auto left = [&](double size, double ofVelocity, int mostIterations) {
    State state = found;
    for (int c = 0; c < b.mesh.owned; ++c) {
      const double wave = size * std::sin(300.0 * b.mesh.centre[c][1] + 600.0 * b.mesh.centre[c][0]);
      for (int i = 0; i < 2; ++i) state.velocity[at(2 * c + i)] *= 1.0 + ofVelocity * wave;
      state.carried[at(c) * all + dust] *= 1.0 - wave;
    }
    for (Operator* op : channel.operators) op->setDiffusivities(state);
    state.updateHalo(b.halo);
    residual.evaluate(state);
    const NewtonKrylov::Result result = newton.advance(state, none, 1e-8);
    report(fmt::format("{} iterations, to {:.2g}", result.iterations, result.reached));
    EXPECT_LE(result.iterations, mostIterations);
    return largest(b.mesh, [&](int c) {
      const std::size_t i = at(c) * all + dust;
      return std::abs(state.carried[i] / found.carried[i] - 1.0);
    });
  };
  // Of a share e of the particles n alone. Transport, -A n, is linear, so that a step leaves x of
  // (A + 2 k n (1 - e)) x = k (e n)^2; as A n = born - k n^2 and no cell has more than sqrt(born/k), that is below
  // e^2 n/(2 (1 - e)), wherever A has the signs of upwind convection and diffusion.
  const double size = 0.01, still = left(size, 0.0, 20), stillHalf = left(0.5 * size, 0.0, 20);
  report(fmt::format("particles alone: off by {:.3g} and {:.3g}", still, stillHalf));
  EXPECT_GT(still / stillHalf, 3.6);
  EXPECT_LT(still, 0.5 * size * size / (1.0 - size));
  // With the flow, whose eddies have no such bound: the square alone.
  const double whole = left(size, 0.1, 50), half = left(0.5 * size, 0.1, 50);
  report(fmt::format("with the flow: off by {:.3g} and {:.3g}", whole, half));
  EXPECT_GT(whole / half, 3.0);
  EXPECT_LT(whole, 0.1 * size);
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
