// Implicit steps of one time towards the steady state of a turbulent flow.
#include "flow/steady/implicit_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/state_backup.hpp"
#include "flow/steady/steady_iteration.hpp"
#include "stirred_channel.hpp"

namespace lampblack::test {
namespace {

struct Stepped : StirredChannel {
  FlowResidual residual{box->context, *state, VelocityScheme::Limited, operators};
  GasUpdate gas{box->context, *state, operators, GasUpdate::Takes::NineTenths};
  CarriedUpdate carried{box->context, *state, residual, operators};
};

// All that iterations go on from.
auto partsOf(StirredChannel& c, SteadyIteration& iteration) {
  return [&](StateArchive& archive) {
    c.state->saveOrLoad(archive);
    if (archive.loading()) c.state->updateHalo(c.box->halo);
    for (Operator* op : c.operators) op->setDiffusivities(*c.state);
    c.state->updateHalo(c.box->halo);
    iteration.saveOrLoad(*c.state, archive);
  };
}

// Newton's method in a step of given time ends where what changes over the time is what is left at its end.
TEST(ImplicitSteps, TakeTheRatesOfTheirEnd) {
  Stepped channel;
  Box& b = *channel.box;
  State& state = *channel.state;
  NewtonKrylov newton(b.context, state, channel.residual, channel.gas, 60);
  const auto n = static_cast<std::size_t>(state.species);
  const std::size_t oxygen = Gas::hydrogen().mechanism.speciesIndex("O2");
  const std::size_t nitrogen = Gas::hydrogen().mechanism.speciesIndex("N2");
  const double time = 3e-5;  // s, a quarter of a cell's
  std::vector<double> inertia(at(b.mesh.owned));
  for (std::size_t c = 0; c < inertia.size(); ++c) inertia[c] = state.density[c] * b.mesh.volume[c] / time;
  for (int c = 0; c < b.mesh.owned; ++c) {
    const double wave = std::sin(300.0 * b.mesh.centre[c][1] + 600.0 * b.mesh.centre[c][0]);
    state.temperature[at(c)] *= 1.0 + 0.2 * wave;
    state.Y[at(c) * n + oxygen] -= 0.05 * (1.0 + wave);
    state.Y[at(c) * n + nitrogen] += 0.05 * (1.0 + wave);
    followGas(b.context, state, c);
  }
  state.updateHalo(b.halo);
  const State start = state;
  channel.residual.evaluate(state);
  NewtonKrylov::Left first, left;
  for (int pass = 0; pass < 4; ++pass) {
    const NewtonKrylov::Result result = newton.advance(state, inertia, 1e-6, &start);
    if (pass == 0) first = result.before;
    channel.residual.evaluate(state);
    left = newton.leftInTime(state, start);
  }
  report(fmt::format("left {:.3g} of {:.3g}", left.sum, first.sum));
  EXPECT_LT(left.sum, 1e-5 * first.sum);
  EXPECT_LT(left.root, 1e-5 * first.root);
  const std::vector<double>& momentum = channel.residual.rates().momentum;
  std::vector<double> gas(n + 1);
  // The rate (row) of a cell, and what it has changed by, over the time.
  const auto compare = [&](const char* what, const auto& rate, const auto& change) {
    const double most = largest(b.mesh, [&](int c) { return std::abs(rate(c)); });
    EXPECT_GT(most, 0.0) << what;
    // All of what is left is 1e-5 of what there was.
    EXPECT_LT(largest(b.mesh, [&](int c) { return std::abs(inertia[at(c)] * change(c) - rate(c)); }), 1e-3 * most)
        << what;
  };
  compare(
      "velocity", [&](int c) { return momentum[at(2 * c + 1)]; },
      [&](int c) { return state.velocity[at(2 * c + 1)] - start.velocity[at(2 * c + 1)]; });
  const auto ofGas = [&](int c, std::size_t row) {
    channel.gas.findLeft(state, channel.residual, at(c), gas.data());
    return gas[row];
  };
  compare(
      "temperature", [&](int c) { return GasUpdate::kelvins * ofGas(c, n); },
      [&](int c) { return state.temperature[at(c)] - start.temperature[at(c)]; });
  compare(
      "oxygen", [&](int c) { return ofGas(c, oxygen); },
      [&](int c) { return state.Y[at(c) * n + oxygen] - start.Y[at(c) * n + oxygen]; });
}

// The first is as long as gas stays in the smallest cell, and they grow; where they lead is the steady state that
// iterations find.
TEST(ImplicitSteps, LeadToTheSteadyState) {
  Stepped channel;
  Box& b = *channel.box;
  State& state = *channel.state;
  State sought = state;
  SteadyIteration iteration(b.context, sought, {}, channel.operators);
  for (int i = 0; i < 100; ++i)
    if (iteration.iterate(sought).measure < 1e-10) break;
  EXPECT_LT(iteration.last().measure, 1e-10);
  ImplicitStep step(b.context, state, channel.residual, channel.gas, channel.carried, channel.operators);
  const std::vector<double> even(at(b.mesh.owned), 1.0);
  double past = 0.0, least = 1e300;
  const double stays = 0.0025 / StirredChannel::speed;
  int steps = 0;
  for (; steps < 40 && least > 1e-6; ++steps) {
    const ImplicitStep::Result result = step.advance(state, even);
    EXPECT_TRUE(result.taken);
    if (steps == 0) {
      EXPECT_NEAR(result.time, stays, 0.05 * stays);
    }
    past += result.time;
    least = largest(b.mesh, [&](int c) {
      const std::size_t i = at(2 * c);
      return std::max(std::abs(state.velocity[i + 1] - sought.velocity[i + 1]) / StirredChannel::speed,
                      std::abs(state.carried[i] / sought.carried[i] - 1.0));
    });
  }
  report(fmt::format("{} steps, {:.3g} s, off by {:.2g}", steps, past, least));
  EXPECT_LT(least, 1e-6);
  // No more than ten times that.
  EXPECT_NEAR(step.time(), 10.0 * stays, 0.5 * stays);
}

// Cells that have less time change by less.
TEST(ImplicitSteps, AreShorterWhereCellsAreSlow) {
  double changes[2];
  for (const bool isSlow : {false, true}) {
    Stepped channel;
    Box& b = *channel.box;
    State& state = *channel.state;
    const State start = state;
    ImplicitStep step(b.context, state, channel.residual, channel.gas, channel.carried, channel.operators);
    EXPECT_TRUE(step.advance(state, std::vector<double>(at(b.mesh.owned), isSlow ? 0.01 : 1.0)).taken);
    changes[isSlow ? 1 : 0] =
        largest(b.mesh, [&](int c) { return std::abs(state.velocity[at(2 * c + 1)] - start.velocity[at(2 * c + 1)]); });
    const double time = step.time();
    step.shorten();
    EXPECT_EQ(step.time(), 0.4 * time);
  }
  EXPECT_LT(changes[1], 0.1 * changes[0]);
}

// A long step that the limits of a cell's change hold far from its end is not taken, and the next is shorter.
TEST(ImplicitSteps, AreRefusedWhereTheyLeadNowhere) {
  Stepped channel;
  Box& b = *channel.box;
  State& state = *channel.state;
  ImplicitStep step(b.context, state, channel.residual, channel.gas, channel.carried, channel.operators);
  const std::vector<double> even(at(b.mesh.owned), 1.0);
  for (int i = 0; i < 16; ++i) EXPECT_TRUE(step.advance(state, even).taken);
  const double time = step.time();
  // Further than twelve passes of 100 K lead.
  for (int c = 0; c < b.mesh.owned; ++c) {
    state.temperature[at(c)] += 2700.0;
    followGas(b.context, state, c);
  }
  state.updateHalo(b.halo);
  const ImplicitStep::Result result = step.advance(state, even);
  EXPECT_EQ(result.time, time);
  EXPECT_EQ(step.time(), 0.4 * time);
  EXPECT_GT(result.limited, 0);
  EXPECT_FALSE(result.taken);
}

// Newton's method goes on in a step while it gains, twelve times, and ends after two passes that gain less than a
// tenth.
TEST(ImplicitSteps, HavePassesWhileTheyGain) {
  const auto passesOf = [](double first, double share) {
    NewtonPasses passes;
    int count = 1;
    for (double left = first; passes.goOn(left); left *= share) ++count;
    return count;
  };
  EXPECT_EQ(passesOf(0.1, 0.5), 1);
  EXPECT_EQ(passesOf(8.0, 0.85), 12);
  EXPECT_EQ(passesOf(8.0, 0.95), 3);
  EXPECT_EQ(passesOf(8.0, 1.2), 3);
  EXPECT_EQ(passesOf(2.0, 0.5), 5);
  NewtonPasses passes;
  for (const double left : {2.0, 2.1, 1.0, 1.1}) EXPECT_TRUE(passes.goOn(left));
  EXPECT_FALSE(passes.goOn(0.95));
}

// Cells that the limits hold count as the worst of them does, however much less is left of all others.
TEST(ImplicitSteps, AreRefusedWhereFewCellsAreHeldFarFromTheirEnd) {
  for (const bool isHot : {false, true}) {
    Stepped channel;
    Box& b = *channel.box;
    State& state = *channel.state;
    ImplicitStep step(b.context, state, channel.residual, channel.gas, channel.carried, channel.operators);
    const std::vector<double> even(at(b.mesh.owned), 1.0);
    EXPECT_TRUE(step.advance(state, even).taken);
    // Much to do for all cells, which Newton's method does at once, and for a few more than twelve passes of 100 K.
    for (int c = 0; c < b.mesh.owned; ++c) {
      const auto& x = b.mesh.centre[c];
      state.velocity[at(2 * c + 1)] *= 1.0 + 0.5 * std::sin(3000.0 * x[1]);
      if (isHot && std::abs(x[1] - 0.01) < 0.0013 && x[0] < 0.0013) state.temperature[at(c)] += 2000.0;
      followGas(b.context, state, c);
    }
    state.updateHalo(b.halo);
    const std::vector<double> shorter(at(b.mesh.owned), 0.3);
    const ImplicitStep::Result result = step.advance(state, shorter);
    report(fmt::format("limited {} cells, rise {:.3g} K", result.limited, result.largestRise));
    EXPECT_EQ(result.limited > 0, isHot);
    EXPECT_EQ(result.taken, !isHot);
  }
}

// A cell that goes to and fro within the limits does not hold the others; nor do many small sizes the few large ones.
TEST(ImplicitSteps, CountTheWorstCellOnlyWhereCellsAreHeld) {
  const NewtonKrylov::Left before{.sum = 10.0, .root = 2.0}, oneCell{.sum = 1.0, .root = 1.0},
      many{.sum = 5.0, .root = 0.2};
  EXPECT_EQ(ImplicitStep::shareLeft(oneCell, before, true), 0.5);
  EXPECT_EQ(ImplicitStep::shareLeft(oneCell, before, false), 0.1);
  EXPECT_EQ(ImplicitStep::shareLeft(many, before, true), 0.1);
  EXPECT_EQ(ImplicitStep::shareLeft(many, before, false), 0.1);
}

// Where gas that eddies stir reacts, iterations are such steps until little is left, and end where others do.
TEST(ImplicitSteps, AreTheIterationsOfWhatEddiesStir) {
  StirredChannel channel;
  Box& b = *channel.box;
  SteadyIteration iteration(b.context, *channel.state, {.oneTime = true}, channel.operators);
  const SteadyIteration::Outcome first = iteration.iterate(*channel.state);
  EXPECT_TRUE(first.taken);
  EXPECT_GT(first.newtonIterations, 0);
  EXPECT_EQ(first.gasIterations, 0);
  // The next are twice as long each, and what follows them has no less time in a cell.
  for (const double courant : {2.0, 4.0, 8.0})
    EXPECT_NEAR(iteration.iterate(*channel.state).courant / courant, 1.0, 0.1);
  double measure = first.measure;
  for (int i = 0; i < 60 && measure > 1e-10; ++i) measure = iteration.iterate(*channel.state).measure;
  EXPECT_LE(measure, 1e-10);
}

// Where the flow rests the gas alone goes on, twice in a row; then all else does again.
TEST(ImplicitSteps, AreFollowedByTheGasAloneWhereTheFlowRests) {
  StirredChannel channel;
  State& state = *channel.state;
  SteadyIteration iteration(channel.box->context, state, {.oneTime = true}, channel.operators);
  for (int i = 0; i < 60 && iteration.last().measure >= 1e-6 * (i > 0); ++i) iteration.iterate(state);
  for (const bool isAlone : {true, true, false, true, true, false}) {
    for (int c = 0; c < channel.box->mesh.owned && isAlone; ++c) {
      state.temperature[at(c)] += 1e-8 * std::sin(3000.0 * channel.box->mesh.centre[at(c)][1]);
      followGas(channel.box->context, state, c);
    }
    state.updateHalo(channel.box->halo);
    const State before = state;
    const SteadyIteration::Outcome outcome = iteration.iterate(state, {.combined = false, .newtons = false});
    EXPECT_TRUE(outcome.taken);
    EXPECT_EQ(outcome.newtonIterations > 0, !isAlone);
    EXPECT_EQ(outcome.gasIterations > 0, isAlone);
    EXPECT_EQ(outcome.flowIterations, 0);
    EXPECT_EQ(state.velocity == before.velocity && state.massFlux == before.massFlux, isAlone);
    // Of the eddies per mass, which a new density leaves as they are but for round-off.
    EXPECT_EQ(largest(channel.box->mesh,
                      [&](int c) {
                        return std::abs(state.carried[at(2 * c)] / state.density[at(c)] * before.density[at(c)] /
                                            before.carried[at(2 * c)] -
                                        1.0);
                      }) < 1e-14,
              isAlone);
  }
  // How often it was alone is of what is saved.
  const SteadyIteration::Allowed alone{.combined = false, .newtons = false};
  iteration.iterate(state, alone);
  StirredChannel other;
  SteadyIteration again(other.box->context, *other.state, {.oneTime = true}, other.operators);
  StateBackup kept(channel.box->mesh.owned, channel.box->mesh.faces);
  kept.save(partsOf(channel, iteration));
  kept.restore(partsOf(other, again));
  for (const bool isAlone : {true, false}) EXPECT_EQ(again.iterate(*other.state, alone).newtonIterations == 0, isAlone);
}

// Iterations of a search by such steps leave a tenth of what they take away, others nothing.
TEST(ImplicitSteps, AreBesideIterationsThatLeaveATenthOfASpecies) {
  const Gas& gas = Gas::hydrogen();
  const std::size_t hydrogen = gas.mechanism.speciesIndex("H2"), nitrogen = gas.mechanism.speciesIndex("N2");
  for (const bool oneTime : {false, true}) {
    StirredChannel channel;
    State& state = *channel.state;
    const auto n = static_cast<std::size_t>(state.species);
    for (int c = 0; c < channel.box->mesh.owned; ++c) {  // which cold air drives out
      state.Y[at(c) * n + hydrogen] += 0.01;
      state.Y[at(c) * n + nitrogen] -= 0.01;
      followGas(channel.box->context, state, c);
    }
    state.updateHalo(channel.box->halo);
    SteadyIteration iteration(channel.box->context, state, {.firstCourant = 1e4, .inTime = 1e300, .oneTime = oneTime},
                              channel.operators);
    const SteadyIteration::Outcome outcome = iteration.iterate(state, {.combined = false, .newtons = false});
    EXPECT_EQ(outcome.limited > 0, oneTime);
  }
}

// Fails as often as it is told.
class Broken : public Operator {
 public:
  [[nodiscard]] const char* name() const override { return "broken"; }
  void advance(State&, double, double) override {}
  void setDiffusivities(State&) override {
    if (fails-- > 0) throw NumericsError("broken");
  }
  int fails = 0;
};

// A step that ends with an error is tried again, shorter, six times; then the state is what it was.
TEST(ImplicitSteps, AreTriedAgainShorterAfterErrors) {
  StirredChannel channel;
  State& state = *channel.state;
  Broken broken;
  channel.operators.push_back(&broken);
  SteadyIteration iteration(channel.box->context, state, {.oneTime = true}, channel.operators);
  const double measure = iteration.iterate(state).measure;
  const State start = state;
  broken.fails = 6;
  const SteadyIteration::Outcome failed = iteration.iterate(state);
  EXPECT_FALSE(failed.taken);
  EXPECT_EQ(failed.why, "broken");
  EXPECT_EQ(failed.measure, measure);
  EXPECT_EQ(state.velocity, start.velocity);
  broken.fails = 0;
  EXPECT_TRUE(iteration.iterate(state).taken);
  // Twice the first, six times shorter, and 1.5 times longer again.
  const double time = 2.0 * std::pow(0.4, 6) * 1.5;
  EXPECT_NEAR(iteration.iterate(state).courant / time, 1.0, 0.1);
}

// A time that was refused is of what is saved: the next steps grow towards it more slowly.
TEST(ImplicitSteps, GoOnBelowTheTimeThatWasRefused) {
  Stepped channel, other;
  const auto stepOf = [](Stepped& c) {
    return ImplicitStep(c.box->context, *c.state, c.residual, c.gas, c.carried, c.operators);
  };
  ImplicitStep one = stepOf(channel), two = stepOf(other);
  const std::vector<double> even(at(channel.box->mesh.owned), 1.0);
  EXPECT_TRUE(one.advance(*channel.state, even).taken);
  one.shorten();
  const double time = one.time();
  StateBackup kept(channel.box->mesh.owned, channel.box->mesh.faces);
  kept.save([&](StateArchive& archive) { one.saveOrLoad(archive); });
  kept.restore([&](StateArchive& archive) { two.saveOrLoad(archive); });
  EXPECT_TRUE(two.advance(*other.state, even).taken);
  EXPECT_NEAR(two.time(), 1.5 * time, 1e-12 * time);
}

// The time of the next step, and the one that was refused, are of what is saved.
TEST(ImplicitSteps, GoOnFromWhatWasSavedWithTheSameBits) {
  StirredChannel channel, other;
  const SteadyIteration::Options options{.oneTime = true};
  SteadyIteration one(channel.box->context, *channel.state, options, channel.operators);
  SteadyIteration two(other.box->context, *other.state, options, other.operators);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(one.iterate(*channel.state).taken);
  StateBackup kept(channel.box->mesh.owned, channel.box->mesh.faces);
  kept.save(partsOf(channel, one));
  kept.restore(partsOf(other, two));
  for (int i = 0; i < 2; ++i) {
    const SteadyIteration::Outcome a = one.iterate(*channel.state), b = two.iterate(*other.state);
    EXPECT_GT(a.newtonIterations, 0);
    EXPECT_EQ(a.measure, b.measure);
    EXPECT_EQ(a.newtonIterations, b.newtonIterations);
  }
  EXPECT_EQ(channel.state->velocity, other.state->velocity);
  EXPECT_EQ(channel.state->carried, other.state->carried);
}

}  // namespace
}  // namespace lampblack::test
