// Iterations towards the steady state: what they end in is what steps in time end in, of a flow, of a flame and of what
// is carried and made in it; the same on any number of ranks.
#include "flow/steady/steady_iteration.hpp"

#include <gtest/gtest.h>

#include "flow/models/radiation_operator.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/steady/block_system.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "steady_channel.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

using SteadyIterations = SteadyChannel;

struct OperatorsOfFlow {
  OperatorsOfFlow(Box& box, const State& state)
      : transport(box.context, state),
        chemistry(box.context, {}),
        radiation(box.context, 298.0, nullptr),
        dust(box.mesh) {}
  std::vector<Operator*> all() { return {&transport, &chemistry, &radiation, &dust}; }
  void begin(State& state) {
    state.updateHalo(halo());
    for (Operator* op : all()) op->endStep(state);
    for (Operator* op : all()) op->endSweep(state);
  }
  void take(State& state, double time, double dt) {
    for (Operator* op : all()) op->advance(state, time, dt);
    for (Operator* op : all()) op->endStep(state);
    for (Operator* op : all()) op->endSweep(state);
  }
  [[nodiscard]] HaloExchange& halo() const { return *halo_; }
  HaloExchange* halo_ = nullptr;
  TransportOperator transport;
  ReactionOperator chemistry;
  RadiationOperator radiation;
  HotDust dust;
};

// Of each field, the largest difference of two states over the field's range.
std::vector<double> differences(const Box& b, const State& one, const State& other) {
  std::vector<double> all;
  const auto compare = [&](const std::vector<double>& x, const std::vector<double>& y, int components) {
    double most = 0.0, high = -1e300, low = 1e300;
    for (std::size_t i = 0; i < at(b.mesh.owned * components); ++i) {
      most = std::max(most, std::abs(x[i] - y[i]));
      high = std::max(high, x[i]);
      low = std::min(low, x[i]);
    }
    MPI_Comm comm = b.mesh.comm;
    for (double* value : {&most, &high}) MPI_Allreduce(MPI_IN_PLACE, value, 1, MPI_DOUBLE, MPI_MAX, comm);
    MPI_Allreduce(MPI_IN_PLACE, &low, 1, MPI_DOUBLE, MPI_MIN, comm);
    all.push_back(most / std::max(high - low, 1e-3 * high));
  };
  compare(one.velocity, other.velocity, 2);
  compare(one.pressure, other.pressure, 1);
  compare(one.temperature, other.temperature, 1);
  compare(one.Y, other.Y, one.species);
  compare(one.carried, other.carried, 1);
  return all;
}

TEST_F(SteadyIterations, EndWhereStepsDo) {
  Box b = channel(air, 400.0, 0.5);
  const auto start = [&] {
    State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 350.0, air}; }, dust);
    for (double& D : state.carriedDiffusivity) D = 1e-5;
    return state;
  };
  State marched = start(), iterated = start();
  OperatorsOfFlow steps(b, marched), beside(b, iterated);
  steps.halo_ = beside.halo_ = &b.halo;
  const double dt = 5e-4;
  steps.transport.initialise(marched, dt);
  steps.begin(marched);
  for (int i = 0; i < 500; ++i) steps.take(marched, i * dt, dt);
  beside.transport.initialise(iterated, dt);
  beside.begin(iterated);
  std::ranges::fill(iterated.carried, -1.0);  // as steps leave traces of
  SteadyIteration iteration(b.context, iterated, {}, beside.all());
  iteration.iterate(iterated);
  EXPECT_GE(-largest(b.mesh, [&](int c) { return -iterated.carried[at(c)]; }), 0.0);
  int count = 0, untilMillionths = 0;
  double measure = 1.0;
  double leastCourant = 0.0;  // of the next: where nothing is in the way it is never what holds the residual
  for (; count < 400 && measure > 2e-10; ++count) {
    const SteadyIteration::Outcome outcome = iteration.iterate(iterated);
    EXPECT_GE(outcome.courant, leastCourant) << count;
    const bool isQuiet = count > 0 && outcome.taken && outcome.limited == 0 && outcome.measure <= measure;
    leastCourant = isQuiet ? std::min(1.0999 * outcome.courant, SteadyIteration::Options{}.mostCourant) : 0.0;
    measure = outcome.measure;
    if (measure > 5e-6) untilMillionths = count + 1;
  }
  report(fmt::format("{} iterations, {} to 5e-6, left {:.2g}", count, untilMillionths, measure));
  EXPECT_LE(measure, 2e-10);
  EXPECT_LT(untilMillionths, 40);
  EXPECT_LT(count, 50);
  std::string text;
  for (const double difference : differences(b, iterated, marched)) {
    text += fmt::format(" {:.2g}", difference);
    EXPECT_LT(difference, 1e-6);
  }
  report("differs:" + text);

  // What is left of what is carried is the same by itself.
  FlowResidual residual(b.context, iterated, VelocityScheme::Limited, beside.all());
  residual.evaluate(iterated);
  for (std::size_t i = 0; i < iterated.carried.size(); ++i)
    iterated.carried[i] *= 1.0 + 0.5 * std::sin(500.0 * b.mesh.centre[i][1]);
  const FlowResidual::Rates alone = residual.evaluateCarried(iterated), &all = residual.evaluate(iterated);
  double most = 0.0;
  for (const double rate : all.carried) most = std::max(most, std::abs(rate));
  for (std::size_t c = 0; c < all.carried.size(); ++c) {
    EXPECT_NEAR(alone.carried[c], all.carried[c], 1e-13 * most);
    EXPECT_EQ(alone.enthalpy[c], all.enthalpy[c]);
  }
}

// From a front that is not resolved, where the linear system asks for less than nothing.
TEST_F(SteadyIterations, LeaveNoSpeciesBelowItsLimit) {
  Box b = channel(lean, 300.0, 0.8);
  State state = b.state([&](const auto& x) {
    return x[1] > 0.002 ? Box::Local{{0.0, 0.8}, 2200.0, burnt} : Box::Local{{0.0, 0.8}, 300.0, lean};
  });
  TransportOperator transport(b.context, state);
  ReactionOperator chemistry(b.context, {});
  transport.initialise(state, 1e-6);
  SteadyIteration iteration(b.context, state, {.accelerated = 0.0}, {&transport, &chemistry});
  for (int i = 0; i < 10; ++i) {
    iteration.iterate(state);
    const double least = -largest(b.mesh, [&](int c) {
      const double* Y = &state.Y[at(c * state.species)];
      return -*std::min_element(Y, Y + state.species);
    });
    EXPECT_GE(least, 1.01 * leastOfSpecies) << i;
  }
}

// An iteration that may not be combined with others is the one that never is.
TEST_F(SteadyIterations, AreCombinedOnlyWhereTheyMay) {
  const auto after = [&](double accelerated, bool mayAccelerate) {
    Box b = channel(lean, 300.0, 0.8);
    State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 320.0, lean}; });
    TransportOperator transport(b.context, state);
    transport.initialise(state, 1e-4);
    SteadyIteration iteration(b.context, state, {.accelerated = accelerated, .newton = false}, {&transport});
    for (int i = 0; i < 6; ++i) iteration.iterate(state, {mayAccelerate, mayAccelerate});
    return state.temperature;
  };
  const std::vector<double> plain = after(0.0, true);
  EXPECT_EQ(after(1e9, false), plain);
  EXPECT_NE(after(1e9, true), plain);
}

// Newton's method where it may be used, also where combinations may not.
TEST_F(SteadyIterations, AreNewtonsOnlyWhereTheyMay) {
  const auto vectors = [&](bool combined, bool newtons) {
    Box b = channel(lean, 300.0, 0.8);
    State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 320.0, lean}; });
    TransportOperator transport(b.context, state);
    transport.initialise(state, 1e-4);
    SteadyIteration iteration(b.context, state, {.accelerated = 1e9}, {&transport});
    int found = 0;
    for (int i = 0; i < 4; ++i)
      found += iteration.iterate(state, {.combined = combined, .newtons = newtons}).newtonIterations;
    return found;
  };
  EXPECT_GT(vectors(false, true), 0);
  EXPECT_EQ(vectors(true, false), 0);
}

// The flame that iterations find is one that steps leave as it is; on one rank it is the same.
TEST_F(SteadyIterations, FindAFlame) {
  const auto find = [&](MPI_Comm comm, auto look) {
    Box b = channel(lean, 300.0, 0.8, comm);
    State state = b.state(
        [&](const auto& x) {
          return x[1] > 0.002 ? Box::Local{{0.0, 0.8}, 2200.0, burnt} : Box::Local{{0.0, 0.8}, 300.0, lean};
        },
        dust);
    for (double& D : state.carriedDiffusivity) D = 1e-5;
    OperatorsOfFlow operators(b, state);
    operators.halo_ = &b.halo;
    operators.transport.initialise(state, 1e-6);
    operators.begin(state);
    for (int i = 0; i < 40; ++i) operators.take(state, i * 1e-5, 1e-5);
    SteadyIteration iteration(b.context, state, {}, operators.all());
    int count = 0;
    double measure = 1.0;
    for (; count < 200 && measure > 1e-10; ++count) measure = iteration.iterate(state).measure;
    if (comm == MPI_COMM_WORLD) report(fmt::format("{} iterations, left {:.2g}", count, measure));
    EXPECT_LE(measure, 1e-10);
    const double share = comm == MPI_COMM_SELF ? 1.0 / sumOverRanks(1.0) : 1.0;
    const std::vector<double> found{share * integral(b.mesh, [&](int c) { return state.temperature[at(c)]; }),
                                    share * integral(b.mesh, [&](int c) { return state.carried[at(c)]; })};
    look(b, state, operators);
    return found;
  };
  const std::vector<double> alone = find(MPI_COMM_SELF, [](Box&, State&, OperatorsOfFlow&) {});
  const std::vector<double> together = find(MPI_COMM_WORLD, [&](Box& b, State& state, OperatorsOfFlow& operators) {
    EXPECT_GT(largest(b.mesh, [&](int c) { return state.temperature[at(c)]; }), 1300.0);
    const State found = state;
    operators.begin(state);
    for (int i = 0; i < 500; ++i) operators.take(state, i * 1e-4, 1e-4);
    std::string text;
    for (const double difference : differences(b, state, found)) {
      text += fmt::format(" {:.2g}", difference);
      EXPECT_LT(difference, 1e-6);
    }
    report("what 500 steps change:" + text);
  });
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_NEAR(alone[i] / together[i], 1.0, 1e-8);
}

}  // namespace
}  // namespace lampblack::test
