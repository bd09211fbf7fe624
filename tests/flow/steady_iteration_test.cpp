// Iterations towards the steady state: what they end in is what steps in time end in, of a flow, of a flame and of what
// is carried and made in it; the same on any number of ranks.
#include "flow/steady/steady_iteration.hpp"

#include <gtest/gtest.h>

#include "flow/models/radiation_operator.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/steady/block_system.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Something that hot gas makes of itself and that decays: made * T, less itself by its lifetime.
class HotDust : public Operator {
 public:
  explicit HotDust(const Mesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] const char* name() const override { return "dust"; }
  void advance(State&, double, double) override {}
  void endSweep(State& state) override { addRates(state, state.balance); }
  void addRates(const State& state, State::Balance& rates) override {
    for (int c = 0; c < mesh_.owned; ++c)
      rates.carried[at(c)] += made * state.temperature[at(c)] - state.carried[at(c)] / lifetime;
  }
  [[nodiscard]] bool actsOnCarried() const override { return true; }
  void addSlopes(const State&, const Slopes& slopes) override {
    if (slopes.carried.empty()) return;
    for (int c = 0; c < mesh_.owned; ++c) slopes.carried[at(c)] -= 1.0 / lifetime;
  }

 private:
  static constexpr double made = 0.1, lifetime = 0.01;
  const Mesh& mesh_;
};

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

class SteadyIterations : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  std::vector<double> lean = gas.massFractions("H2: 0.25, O2: 0.15, N2: 0.6");

  std::vector<double> burnt = gas.massFractions("H2O: 0.25, O2: 0.025, N2: 0.6");

  // A channel, wider by the wall, along which gas comes in.
  [[nodiscard]] Box channel(const std::vector<double>& Y, double temperature, double speed,
                            MPI_Comm comm = MPI_COMM_WORLD) const {
    Side wall = side(BoundaryKind::Wall, 0, true);
    wall.condition.slip = false;
    const std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), wall,
                                  opening(BoundaryKind::Inlet, 1, false, speed, temperature, Y),
                                  opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)};
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {gradedAxis(0.0, {{0.006, 6, 2.0}}), uniformAxis(0.012, 14), {}};
    std::vector<BoundaryCondition> conditions;
    for (const Side& s : sides) {
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
    return {spec, conditions, {}, comm};
  }
};

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

const std::vector<CarriedScalar> dust{{"dust", "1/m3", "", 0.55}};

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

// Whole steps would go to and fro for ever; cells that take less come to rest.
TEST_F(SteadyIterations, TakeLessWhereSourcesBend) {
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
TEST_F(SteadyIterations, LeaveEvenWhatMassThatGathersBrings) {
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
TEST_F(SteadyIterations, ReachWhatIsEmpty) {
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
TEST_F(SteadyIterations, LetGrowWhatGrowsFast) {
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
  for (int pass = 0; pass < 12; ++pass) {
    update.advance(state, residual, inertia);
    residual.evaluateCarried(state);
  }
  const double left = largest(b.mesh, [&](int c) { return std::abs(state.carried[at(c)] / GrowingDust::goal - 1.0); });
  report(fmt::format("lacks {:.2g}", left));
  EXPECT_LT(left, 0.01);
}

// Sources that are straight need no shares: one pass leaves what the linear system does.
TEST_F(SteadyIterations, TakeAllWhereSourcesAreStraight) {
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
  update.advance(state, residual, std::vector<double>(at(b.mesh.owned), 0.0));
  residual.evaluateCarried(state);
  report(fmt::format("left {:.2g} of what there was", left() / before));
  EXPECT_LT(left(), 0.15 * before);
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
