// What iterations do in cells whose gas reacts by itself faster than it is carried away.
#include "flow/steady/gas_update.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "flow/steady/steady_iteration.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Nitrogen turns into argon: a little by itself, and the faster the more argon there is, until there is enough. Without
// any the linear system knows of the growth alone, and leads to where it would be nothing: to less than no argon.
class Igniting : public Operator {
 public:
  Igniting(const Mesh& mesh, std::size_t argon, std::size_t nitrogen)
      : mesh_(mesh), argon_(argon), nitrogen_(nitrogen) {}
  [[nodiscard]] const char* name() const override { return "igniting"; }
  void advance(State&, double, double) override {}
  void addRates(const State& state, State::Balance& rates) override {
    const auto n = static_cast<std::size_t>(state.species);
    for (std::size_t c = 0; c < at(mesh_.owned); ++c) {
      const double Y = state.Y[c * n + argon_], rate = state.density[c] * (seed + growth * Y * (1.0 - Y / goal));
      rates.reactions[c * n + argon_] += rate;
      rates.reactions[c * n + nitrogen_] -= rate;
    }
  }
  void addSlopes(const State& state, const Slopes& slopes) override {
    if (slopes.gas.empty()) return;
    const auto n = static_cast<std::size_t>(state.species), width = n + 1;
    for (std::size_t c = 0; c < at(mesh_.owned); ++c) {
      const double slope = state.density[c] * growth * (1.0 - 2.0 * state.Y[c * n + argon_] / goal);
      double* column = &slopes.gas[c * width * width + argon_ * width];
      column[argon_] += slope;
      column[nitrogen_] -= slope;
    }
  }
  static constexpr double goal = 1e-3, seed = 1e-2, growth = 1e7;  // 1, 1/s, 1/s

 private:
  const Mesh& mesh_;
  std::size_t argon_, nitrogen_;
};

// Argon is made at a steady rate and burns with OH, of which ten times as much flows in as there is: linearised, less
// than no argon is left, though nothing grows by itself.
class BurningTrace : public Operator {
 public:
  BurningTrace(const Mesh& mesh, const Mechanism& mechanism)
      : mesh_(mesh),
        argon_(mechanism.speciesIndex("AR")),
        nitrogen_(mechanism.speciesIndex("N2")),
        hydroxyl_(mechanism.speciesIndex("OH")) {}
  [[nodiscard]] const char* name() const override { return "trace"; }
  void advance(State&, double, double) override {}
  void addRates(const State& state, State::Balance& rates) override {
    const auto n = static_cast<std::size_t>(state.species);
    for (std::size_t c = 0; c < at(mesh_.owned); ++c) {
      const double *Y = &state.Y[c * n], rate = state.density[c] * (made - burns * Y[argon_] * Y[hydroxyl_]);
      rates.reactions[c * n + argon_] += rate;
      rates.reactions[c * n + nitrogen_] -= rate;
    }
  }
  void addSlopes(const State& state, const Slopes& slopes) override {
    if (slopes.gas.empty()) return;
    const auto n = static_cast<std::size_t>(state.species), width = n + 1;
    for (std::size_t c = 0; c < at(mesh_.owned); ++c) {
      double* gas = &slopes.gas[c * width * width];
      for (const auto& [by, other] : {std::pair{argon_, hydroxyl_}, std::pair{hydroxyl_, argon_}}) {
        const double slope = state.density[c] * burns * state.Y[c * n + other];
        gas[by * width + argon_] -= slope;
        gas[by * width + nitrogen_] += slope;
      }
    }
  }
  static constexpr double made = 1e-3, burns = 1e8;  // 1/s; at rest with OH of 1e-4 and argon of 1e-7

 private:
  const Mesh& mesh_;
  std::size_t argon_, nitrogen_, hydroxyl_;
};

// Argon and OH burn each other to nitrogen at once: where there is one there is nearly nothing of the other.
class BurningEachOther : public Operator {
 public:
  BurningEachOther(const Mesh& mesh, const Mechanism& mechanism)
      : mesh_(mesh),
        burnt_{mechanism.speciesIndex("AR"), mechanism.speciesIndex("OH")},
        nitrogen_(mechanism.speciesIndex("N2")) {}
  [[nodiscard]] const char* name() const override { return "each other"; }
  void advance(State&, double, double) override {}
  [[nodiscard]] double rate(const State& state, std::size_t c) const {  // kg/m^3/s, of either
    const double* Y = &state.Y[c * static_cast<std::size_t>(state.species)];
    return state.density[c] * burns * Y[burnt_[0]] * Y[burnt_[1]];
  }
  void addRates(const State& state, State::Balance& rates) override {
    const auto n = static_cast<std::size_t>(state.species);
    for (std::size_t c = 0; c < at(mesh_.owned); ++c) {
      for (const std::size_t k : burnt_) rates.reactions[c * n + k] -= rate(state, c);
      rates.reactions[c * n + nitrogen_] += 2.0 * rate(state, c);
    }
  }
  void addSlopes(const State& state, const Slopes& slopes) override {
    if (slopes.gas.empty()) return;
    const auto n = static_cast<std::size_t>(state.species), width = n + 1;
    for (std::size_t c = 0; c < at(mesh_.owned); ++c)
      for (const std::size_t by : burnt_) {
        const std::size_t other = by == burnt_[0] ? burnt_[1] : burnt_[0];
        const double slope = state.density[c] * burns * state.Y[c * n + other];
        double* column = &slopes.gas[c * width * width + by * width];
        for (const std::size_t k : burnt_) column[k] -= slope;
        column[nitrogen_] += 2.0 * slope;
      }
  }
  static constexpr double burns = 1e14;  // 1/s

 private:
  const Mesh& mesh_;
  std::array<std::size_t, 2> burnt_;
  std::size_t nitrogen_;
};

// A slot of 6 by 12 mm through which a gas flows.
struct Slot {
  explicit Slot(const std::vector<double>& inflow) {
    spec.geometry = Geometry::Planar;
    spec.vertices = {uniformAxis(0.006, 2), uniformAxis(0.012, 6), {}};
    for (const Side& s : {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
                          opening(BoundaryKind::Inlet, 1, false, 0.5, 300.0, inflow),
                          opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, inflow)}) {
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
  }
  MeshSpec spec;
  std::vector<BoundaryCondition> conditions;
};

TEST(GasUpdates, LetIgniteWhatIgnites) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const std::size_t argon = gas.mechanism.speciesIndex("AR"), nitrogen = gas.mechanism.speciesIndex("N2");
  const Slot slot(air);
  Box b(slot.spec, slot.conditions, {}, MPI_COMM_WORLD);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, air}; });
  TransportOperator transport(b.context, state);
  Igniting igniting(b.mesh, argon, nitrogen);
  transport.initialise(state, 1e-4);
  SteadyIteration iteration(b.context, state, {}, {&transport, &igniting});
  SteadyIteration::Outcome outcome;
  for (int i = 0; i < 100; ++i) outcome = iteration.iterate(state);
  const double lacks =
      largest(b.mesh, [&](int c) { return std::abs(state.Y[at(c * state.species) + argon] / Igniting::goal - 1.0); });
  report(fmt::format("lacks {:.2g}, left {:.2g}", lacks, outcome.measure));
  EXPECT_LT(lacks, 1e-3);
  EXPECT_EQ(outcome.limited, 0) << "cells go on as fast as others once they have ignited";
}

TEST(GasUpdates, HoldNoCellWhoseTraceIsOnlyBurnt) {
  Gas& gas = Gas::hydrogen();
  const std::size_t argon = gas.mechanism.speciesIndex("AR"), hydroxyl = gas.mechanism.speciesIndex("OH");
  const auto mixture = [&](double ofHydroxyl, double ofArgon) {
    std::vector<double> Y = gas.massFractions("O2: 0.21, N2: 0.79");
    Y[hydroxyl] = ofHydroxyl;
    Y[argon] = ofArgon;
    Y[gas.mechanism.speciesIndex("N2")] -= ofHydroxyl + ofArgon;
    return Y;
  };
  const Slot slot(mixture(1e-3, 0.0));
  Box b(slot.spec, slot.conditions, {}, MPI_COMM_WORLD);
  // A thousandth short of what it would be at rest: there will be more of it, says the cell's own equation.
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, mixture(1e-4, 0.999e-7)}; });
  TransportOperator transport(b.context, state);
  BurningTrace trace(b.mesh, gas.mechanism);
  transport.initialise(state, 1e-6);
  SteadyIteration iteration(b.context, state, {}, {&transport, &trace});
  const SteadyIteration::Outcome outcome = iteration.iterate(state);
  EXPECT_TRUE(outcome.taken) << outcome.why;
  EXPECT_EQ(outcome.limited, 0);
  EXPECT_LT(largest(b.mesh, [&](int c) { return state.Y[at(c * state.species) + argon]; }), 1.1e-7);
  EXPECT_GT(largest(b.mesh, [&](int c) { return state.Y[at(c * state.species) + hydroxyl]; }), 2e-4);
}

// Gas with argon, in the place of which gas with twice as much OH comes to rest. A linear step would leave less than no
// argon. `first`: what is left of it by the first pass, of what there was.
void changePlaces(double there, GasUpdate::Takes takes, int passes, const std::function<void(double first)>& look) {
  Gas& gas = Gas::hydrogen();
  const std::size_t argon = gas.mechanism.speciesIndex("AR"), hydroxyl = gas.mechanism.speciesIndex("OH");
  const double comes = 2.0 * there;
  const auto mixture = [&](double ofHydroxyl, double ofArgon) {
    std::vector<double> Y = gas.massFractions("O2: 0.21, N2: 0.79");
    Y[hydroxyl] = ofHydroxyl;
    Y[argon] = ofArgon;
    Y[gas.mechanism.speciesIndex("N2")] -= ofHydroxyl + ofArgon;
    return Y;
  };
  const Slot slot(mixture(comes, 0.0));
  Box b(slot.spec, slot.conditions, {}, MPI_COMM_WORLD);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.5}, 300.0, mixture(1e-16, there)}; });
  TransportOperator transport(b.context, state);
  BurningEachOther burning(b.mesh, gas.mechanism);
  transport.initialise(state, 1e-6);
  const std::vector<Operator*> operators{&transport, &burning};
  FlowResidual residual(b.context, state, VelocityScheme::Limited, operators);
  GasUpdate update(b.context, state, operators, takes);
  const std::vector<double> inertia(at(b.mesh.owned), 0.0);
  const auto furthest = [&](std::size_t species, double from) {
    return largest(b.mesh, [&](int c) { return std::abs(state.Y[at(c * state.species) + species] / from - 1.0); });
  };
  for (int pass = 0; pass < passes; ++pass) {
    residual.evaluate(state);
    const GasUpdate::Result result = update.advance(state, residual, inertia);
    if (pass > 0) continue;
    for (int c = 0; c < b.mesh.owned; ++c) look(state.Y[at(c * state.species) + argon] / there);
    EXPECT_EQ(result.limited, takes == GasUpdate::Takes::NineTenths && there > traceOfSpecies ? 12 : 0);
  }
  if (passes == 1) return;
  report(fmt::format("OH is off by {:.2g}", furthest(hydroxyl, comes)));
  EXPECT_LT(furthest(hydroxyl, comes), 1e-3);
}

TEST(GasUpdates, LeaveATenthOfATrace) {
  changePlaces(1e-7, GasUpdate::Takes::All, 15, [](double first) { EXPECT_NEAR(first, 0.1, 1e-7); });
}

// Of more than a trace all is taken, or, where not all may be, nine tenths, of the cell's other changes as large a
// share.
TEST(GasUpdates, LeaveATenthOfMoreWhereAsked) {
  changePlaces(1e-3, GasUpdate::Takes::All, 1, [](double first) { EXPECT_LT(first, 1e-3); });
  changePlaces(1e-3, GasUpdate::Takes::NineTenths, 20, [](double first) { EXPECT_NEAR(first, 0.1, 1e-3); });
}

// Air of one temperature, whose velocities differ so that mass is left in the cells: the gas itself has nothing to
// change, and is known to rest until one cell's temperature or composition says otherwise.
TEST(GasUpdates, KnowGasThatRests) {
  Gas& gas = Gas::hydrogen();
  const std::size_t argon = gas.mechanism.speciesIndex("AR"), nitrogen = gas.mechanism.speciesIndex("N2");
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const Slot slot(air);
  Box b(slot.spec, slot.conditions, {}, MPI_COMM_WORLD);
  State state = b.state([&](const auto& x) { return Box::Local{{0.0, 0.5 + 20.0 * x[1]}, 300.0, air}; });
  TransportOperator transport(b.context, state);
  transport.initialise(state, 1e-6);
  const std::vector<Operator*> operators{&transport};
  FlowResidual residual(b.context, state, VelocityScheme::Limited, operators);
  GasUpdate update(b.context, state, operators);
  const std::vector<double> through(at(b.mesh.owned), 1e-3);
  const auto isAtRest = [&](const State& gasOf) {
    residual.evaluate(gasOf);
    return update.isAtRest(gasOf, residual, through);
  };
  EXPECT_TRUE(isAtRest(state));
  for (const double share : update.shares()) EXPECT_EQ(share, 1.0);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  State warmer = state, mixed = state;
  if (rank == 0) {  // the last cell of one rank tells all
    const std::size_t last = at(b.mesh.owned - 1), n = at(state.species);
    warmer.temperature[last] += 1e-3;
    warmer.enthalpy[last] += 1.0;
    mixed.Y[last * n + argon] += 1e-6;
    mixed.Y[last * n + nitrogen] -= 1e-6;
  }
  warmer.updateHalo(b.context.halo);
  mixed.updateHalo(b.context.halo);
  EXPECT_FALSE(isAtRest(warmer));
  EXPECT_FALSE(isAtRest(mixed));
}

}  // namespace
}  // namespace lampblack::test
