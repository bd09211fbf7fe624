// Newton's method for gas and flow together with what the flow carries: turbulence and particles.
#include <gtest/gtest.h>

#include <cmath>

#include "flow/steady/newton_krylov.hpp"
#include "flow/steady/steady_iteration.hpp"
#include "flow_fixture.hpp"
#include "stirred_channel.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

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

}  // namespace
}  // namespace lampblack::test
