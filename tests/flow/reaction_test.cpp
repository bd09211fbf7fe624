// Chemistry in the cells of a flow: what it conserves, that sharing changes nothing, how it fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "flow/models/constant_pressure_cells.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/budget.hpp"
#include "flow/stepping/time_step.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class Reacting : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  std::vector<double> premixed = gas.massFractions("H2: 0.3, O2: 0.15, N2: 0.55, OH: 0.002, H: 0.001");
  // Igniting gas in the right half, cold air in the left one.
  Box::Local halfHot(const Vector3& x) const {
    return x[0] > 0.004 ? Box::Local{{0.0, 0.4}, 1000.0 + 2e4 * x[1], premixed} : Box::Local{{0.0, 0.4}, 300.0, air};
  }
  std::vector<Side> sides() const {
    Side right = opening(BoundaryKind::Inlet, 1, false, 0.4, 1100.0, premixed);
    right.patch.name = right.condition.name = "right";
    right.patch.from = 0.004;
    return {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true), right,
            opening(BoundaryKind::Inlet, 1, false, 0.4, 300.0, air),
            opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)};
  }
  Box box{Geometry::Planar, {uniformAxis(0.008, 8), uniformAxis(0.006, 6)}, sides()};

  static ReactionOperator::Options options(bool share) {
    ReactionOperator::Options o;
    o.shareWork = share;
    return o;
  }
  // mol of an element in a kg of a cell's gas.
  double elementIn(const State& state, int cell, std::size_t element) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < gas.mechanism.numSpecies(); ++k)
      sum += state.Y[at(cell) * gas.mechanism.numSpecies() + k] * gas.mechanism.atoms(k, element) /
             gas.mechanism.molecularWeights()[k];
    return sum;
  }
};

TEST_F(Reacting, ElementsAndEnthalpyOfEveryCellAreConserved) {
  State state = box.state([&](const auto& x) { return halfHot(x); });
  const State start = state;
  ReactionOperator chemistry(box.context, options(true));
  chemistry.advance(state, 0.0, 1e-4);
  double hottest = 0.0;
  for (int c = 0; c < box.mesh.owned; ++c) {
    for (std::size_t e = 0; e < gas.mechanism.numElements(); ++e)
      // The linear invariants of BDF and Newton's iteration with an exact null space: round-off of some 1e3 internal
      // operations a step, 100 steps, as a random walk: 1e-13.
      EXPECT_NEAR(elementIn(state, c, e), elementIn(start, c, e), 1e-12 * (elementIn(start, c, e) + 1.0));
    const std::span<const double> Y(&state.Y[at(c) * gas.mechanism.numSpecies()], gas.mechanism.numSpecies());
    // One round-off of the largest contribution to h (formation of H, 2e8 J/kg at Y = 1e-2) and of cp T.
    EXPECT_NEAR(gas.thermo.enthalpyMass(state.temperature[at(c)], Y), start.enthalpy[at(c)], 64.0 * epsilon * 3e6);
    EXPECT_EQ(state.enthalpy[at(c)], start.enthalpy[at(c)]);
    hottest = std::max(hottest, state.temperature[at(c)]);
  }
  EXPECT_GT(maxOverRanks(hottest), 1500.0);  // it did burn
}

TEST_F(Reacting, ColdCellsAreSkipped) {
  State state = box.state([&](const auto& x) { return halfHot(x); });
  const State start = state;
  ReactionOperator chemistry(box.context, options(true));
  chemistry.advance(state, 0.0, 1e-4);
  const auto diagnostics = chemistry.takeDiagnostics();
  EXPECT_EQ(diagnostics.skippedCells, 24.0);
  EXPECT_EQ(diagnostics.integratedCells, 24.0);
  EXPECT_GT(diagnostics.solverSteps, 24.0);
  EXPECT_EQ(chemistry.takeDiagnostics().imbalance.stages(), 0);
  for (int c = 0; c < box.mesh.owned; ++c)
    if (box.mesh.centre[at(c)][0] < 0.004) {
      EXPECT_NEAR(state.temperature[at(c)], 300.0, 1e-6);
    }
}

// The same bits with and without sharing and, by comparison with one reactor that advances each cell alone, on any
// number of ranks.
TEST_F(Reacting, SharingWorkChangesNoBit) {
  State shared = box.state([&](const auto& x) { return halfHot(x); });
  State own = shared;
  const State start = shared;
  ReactionOperator withSharing(box.context, options(true));
  ReactionOperator without(box.context, options(false));
  const double dt = 2e-7;
  // In place of a transport stage, which keeps the start, adds what the balance says and clears it.
  const auto addBalance = [&](State& state) {
    state.keepStart();
    for (std::size_t i = 0; i < state.balance.reactions.size(); ++i)
      state.Y[i] += dt * state.balance.reactions[i] / state.density[i / at(state.species)];
    state.balance.clear();
  };
  for (int i = 0; i < 3; ++i) {
    for (const auto& [chemistry, state] : {std::pair{&withSharing, &shared}, {&without, &own}}) {
      addBalance(*state);
      chemistry->advance(*state, i * dt, dt);
      chemistry->endStep(*state);
      chemistry->endSweep(*state);
    }
  }
  EXPECT_EQ(shared.Y, own.Y);
  EXPECT_EQ(shared.temperature, own.temperature);
  const auto diagnostics = withSharing.takeDiagnostics();
  EXPECT_LT(diagnostics.handedOverCells, diagnostics.integratedCells);  // some went through vector lanes

  State once = start;
  ReactionOperator(box.context, options(true)).advance(once, 0.0, dt);
  const std::size_t n = gas.mechanism.numSpecies();
  for (int c = 0; c < box.mesh.owned; ++c) {
    ConstantPressureReactor reactor(gas.mechanism);
    std::vector<double> Y(start.Y.begin() + static_cast<std::ptrdiff_t>(at(c) * n),
                          start.Y.begin() + static_cast<std::ptrdiff_t>(at(c + 1) * n));
    const double T = gas.thermo.temperatureFromEnthalpy(start.enthalpy[at(c)], Y, start.temperature[at(c)]);
    ConstantPressureReactor::Cell cell{T, start.thermodynamicPressure, Y, {}, 0.0};
    ConstantPressureReactor::Result result;
    reactor.advance({&cell, 1}, dt, {&result, 1});
    EXPECT_EQ(once.temperature[at(c)], cell.temperature);
    EXPECT_TRUE(std::equal(Y.begin(), Y.end(), &once.Y[at(c) * n]));
  }
}

// Sweeps of a step.
class ReactingSweeps : public Reacting, public testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(Sweeps, ReactingSweeps, testing::Values(1, 2));

TEST_P(ReactingSweeps, BudgetsCloseWithTransport) {
  State state = box.state([&](const auto& x) { return halfHot(x); });
  TransportOperator transport(box.context, state, {0.5, GetParam()});
  ReactionOperator chemistry(box.context, options(true));
  transport.initialise(state, 1e-5);
  Budget budget(box.context, massAndElements(gas.mechanism, {}), state);
  const double h0 = integral(box.mesh, [&](int c) { return state.density[at(c)] * state.enthalpy[at(c)]; });
  double heat = 0.0;
  double gross = 0.0;
  const int steps = 300 / GetParam();
  for (int i = 0; i < steps; ++i) {
    const double dt = std::min(2e-5, convectiveTimeStep(box.mesh, state, 0.4));
    for (int sweep = 0; sweep < GetParam(); ++sweep) {
      transport.advance(state, 0.0, dt);
      chemistry.advance(state, 0.0, dt);
      if (sweep + 1 == GetParam()) chemistry.endStep(state);
      transport.endSweep(state);
      chemistry.endSweep(state);
    }
    budget.addStep(transport.boundaryAmounts());
    heat += sumOverRanks(transport.boundaryAmounts().enthalpyIn - transport.boundaryAmounts().enthalpyOut);
    gross += sumOverRanks(transport.boundaryAmounts().enthalpyIn + transport.boundaryAmounts().enthalpyOut);
    double net = 0.0;
    double scale = 0.0;
    for (int c = 0; c < box.mesh.owned; ++c) {
      double sum = 0.0;
      for (int k = 0; k < state.species; ++k) {
        sum += state.balance.reactions[at(c * state.species + k)];
        scale = std::max(scale, std::abs(state.balance.reactions[at(c * state.species + k)]));
      }
      net = std::max(net, std::abs(sum));
    }
    // The rate is a difference of mass fractions over the step, a round-off of epsilon rho/dt a species; its net mass
    // may not add up over the steps.
    EXPECT_LE(net, 10.0 * epsilon * 1.2 / dt);
    EXPECT_GT(maxOverRanks(scale), 0.0);
  }
  // As in the element test, 1e-12 of the mass for each of up to two chemistry stages a step.
  for (const auto& line : budget.lines(state)) EXPECT_LE(line.error, 2e-12 * steps) << line.name;
  const double h1 = integral(box.mesh, [&](int c) { return state.density[at(c)] * state.enthalpy[at(c)]; });
  const double scale =
      integral(box.mesh, [&](int c) { return state.density[at(c)] * std::abs(state.enthalpy[at(c)]); });
  EXPECT_NEAR(h1 - h0, heat, 5.0 * steps * epsilon * (2.0 * scale + gross));
  EXPECT_GT(largest(box.mesh, [&](int c) { return state.temperature[at(c)]; }), 1500.0);
}

// Only what changes by much within a step is limited, and only in that step.
TEST_F(Reacting, RatesOfASlowGasAreTakenAsTheyAre) {
  const auto mixture = gas.massFractions("H2: 0.1, N2: 0.899, OH: 0.001");
  State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 1000.0, mixture}; });
  ReactionOperator chemistry(box.context, options(true));
  const auto limitedInAStepOf = [&](double dt) {
    state.keepStart();
    for (std::size_t i = 0; i < state.balance.reactions.size(); ++i)  // in place of transport
      state.Y[i] += dt * state.balance.reactions[i] / state.density[i / at(state.species)];
    state.balance.clear();
    chemistry.advance(state, 0.0, dt);
    chemistry.endStep(state);
    chemistry.endSweep(state);
    return chemistry.takeDiagnostics().limitedCells;
  };
  EXPECT_EQ(limitedInAStepOf(3e-6), 48.0);  // hydroxyl has gone
  for (int step = 0; step < 3; ++step) EXPECT_EQ(limitedInAStepOf(1e-10), 0.0);
}

// Hydroxyl is everywhere, hot hydrogen on the left, where it is gone within a step. The next step's transport, which
// takes the last one's rates for its own, would find it as far below zero there as it was above, and let that diffuse.
TEST_F(Reacting, WhatVanishesInAStepLeavesNoHole) {
  Box small{Geometry::Planar,
            {uniformAxis(1.6e-3, 8), uniformAxis(3e-4, 6)},
            {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
             side(BoundaryKind::Symmetry, 1, false),
             opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, gas.massFractions("N2: 1"))}};
  const auto with = gas.massFractions("H2: 0.1, N2: 0.899, OH: 0.001"), without = gas.massFractions("N2: 1, OH: 0.001");
  State state = small.state([&](const auto& x) {
    return Box::Local{{0.0, 0.0}, 1000.0, x[0] < 8e-4 ? with : without};
  });
  TransportOperator transport(small.context, state);
  ReactionOperator chemistry(small.context, options(true));
  const double dt = 3e-6;
  transport.initialise(state, dt);
  chemistry.endStep(state);
  Budget budget(small.context, massAndElements(gas.mechanism, {}), state);
  const std::size_t n = gas.mechanism.numSpecies(), hydroxyl = gas.mechanism.speciesIndex("OH");
  const double started = with[hydroxyl];
  double smallest = 0.0, limited = 0.0, heat = 0.0;
  for (int step = 0; step < 6; ++step) {
    transport.advance(state, step * dt, dt);
    chemistry.advance(state, step * dt, dt);
    if (step == 0)
      chemistry.fields(state, [&](const Quantity& field, std::span<const double> values) {
        if (field.name == "heat_release") heat = std::max(heat, *std::ranges::max_element(values));
      });
    chemistry.endStep(state);
    chemistry.fields(state, [&](const Quantity& field, std::span<const double> values) {
      if (step == 0 && field.name == "heat_release") {
        EXPECT_EQ(*std::ranges::max_element(values), heat);
      }
    });
    transport.endSweep(state);
    chemistry.endSweep(state);
    budget.addStep(transport.boundaryAmounts());
    limited += chemistry.takeDiagnostics().limitedCells;
    for (int c = 0; c < small.mesh.owned; ++c) smallest = std::min(smallest, state.Y[at(c) * n + hydroxyl]);
  }
  EXPECT_GT(limited, 0.0);
  EXPECT_GT(maxOverRanks(heat), 0.0);
  EXPECT_GT(minOverRanks(smallest), -1e-9 * started);  // with all of the rates: -1e-6
  for (const auto& line : budget.lines(state)) EXPECT_LE(line.error, 1e-11) << line.name;
}

// The first step that a cell asks for is the one it gets.
TEST_F(Reacting, CellsBeginWithTheirFirstStep) {
  ConstantPressureCells reactor(gas.mechanism, gas.thermo, {});
  std::vector<double> one = premixed, other = premixed, none(premixed.size(), 0.0);
  const double enthalpy = gas.thermo.enthalpyMass(1100.0, premixed);
  const std::vector<CellReactor::Cell> cells{{{enthalpy, 0.0, 1100.0, 101325.0, 0.0}, one, none},
                                             {{enthalpy, 0.0, 1100.0, 101325.0, 1e-9}, other, none}};
  std::vector<CellReactor::Result> results(2);
  reactor.advance(cells, 1e-6, results);
  EXPECT_NE(results[0].steps, results[1].steps);
  EXPECT_NEAR(results[0].temperature, results[1].temperature, 1e-2);
}

// Another way to advance a cell: a stirred reactor that takes in air, whose gas does not react.
class StirredCells final : public CellReactor {
 public:
  StirredCells(std::vector<double> inflow, double residenceTime)
      : inflow_(std::move(inflow)), residenceTime_(residenceTime) {}
  [[nodiscard]] std::size_t cellsTogether() const override { return 3; }
  void advance(std::span<const Cell> cells, double dt, std::span<Result> results) override {
    ASSERT_LE(cells.size(), cellsTogether());
    const double stays = std::exp(-dt / residenceTime_);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (std::size_t k = 0; k < inflow_.size(); ++k)
        cells[i].Y[k] = inflow_[k] + stays * (cells[i].Y[k] - inflow_[k]) + dt * cells[i].source[k];
      const double at = cells[i].gas.temperature;
      results[i] = {at + 1e-3 * dt * cells[i].gas.heating,
                    cells[i].gas.firstStep + dt,
                    2.0,
                    5.0,
                    1.0,
                    at < 301.0 ? 1.0 : 0.0,
                    at < 301.0 ? 0.0 : 1.0};
    }
  }
  void rates(std::span<const Asked> cells) override {
    ASSERT_LE(cells.size(), cellsTogether());
    for (const auto& [_, Y, rates] : cells)
      for (std::size_t k = 0; k < inflow_.size(); ++k) rates.values[k] = (inflow_[k] - Y[k]) / residenceTime_;
  }

 private:
  std::vector<double> inflow_;
  double residenceTime_;
};

TEST_F(Reacting, CellsAreAdvancedByAnyReactor) {
  State state = box.state([&](const auto& x) { return halfHot(x); });
  const double dt = 1e-4, residenceTime = 3e-4;
  state.keepStart();
  for (double& enthalpy : state.enthalpy) enthalpy += 1e3;  // in place of transport
  const State start = state;
  ReactionOperator chemistry(box.context, options(true), std::make_unique<StirredCells>(air, residenceTime));
  chemistry.advance(state, 0.0, dt);
  const std::size_t n = gas.mechanism.numSpecies();
  const double stays = std::exp(-dt / residenceTime);
  for (int c = 0; c < box.mesh.owned; ++c) {
    EXPECT_NEAR(state.temperature[at(c)], start.temperature[at(c)] + 1.0, 1e-9);
    for (std::size_t k = 0; k < n; ++k) {
      const double Y = air[k] + stays * (start.Y[at(c) * n + k] - air[k]);
      EXPECT_NEAR(state.Y[at(c) * n + k], Y, 4.0 * epsilon);
      EXPECT_NEAR(state.balance.reactions[at(c) * n + k], start.density[at(c)] * (Y - start.Y[at(c) * n + k]) / dt,
                  1e-9);
    }
  }
  CellCost cost(box.mesh.owned);
  chemistry.addCost(box.mesh, cost);
  for (const double one : cost.shared) EXPECT_EQ(one, 2.0);
  const auto found = chemistry.takeDiagnostics();
  EXPECT_EQ(found.solverSteps, 48.0 * 5.0);
  EXPECT_EQ(found.retries, 48.0);
  EXPECT_EQ(found.skippedCells, 24.0);
  EXPECT_EQ(found.integratedCells, 24.0);
  EXPECT_EQ(found.handedOverCells, 24.0);

  // Cells that go together with their neighbours are advanced by it too, each from where its part begins.
  std::vector<double> Y = premixed, source(n, 50.0);
  std::vector<CoupledCells::Reacting> together;
  if (box.mesh.owned > 2)
    together.push_back({box.mesh.naturalCell[2], {1e5, 1e7, 700.0, 101325.0, 2e-6}, 0.0, Y, source});
  chemistry.react(together, 0.0, dt);
  for (const CoupledCells::Reacting& cell : together) {
    EXPECT_DOUBLE_EQ(cell.gas.temperature, 701.0);
    EXPECT_EQ(cell.gas.firstStep, 2e-6 + dt);
    EXPECT_EQ(cell.cost, 2.0);
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_NEAR(Y[k], air[k] + stays * (premixed[k] - air[k]) + dt * 50.0, 4.0 * epsilon);
  }
}

TEST_F(Reacting, FailureNamesTheCellOnAllRanks) {
  State state = box.state([&](const auto& x) { return halfHot(x); });
  auto tight = options(true);
  tight.reactor.maxSteps = 1;
  ReactionOperator chemistry(box.context, tight);
  std::string message;
  try {
    chemistry.advance(state, 0.125, 1e-3);
    ADD_FAILURE() << "one step should not suffice";
  } catch (const NumericsError& error) {
    message = error.what();
  }
  for (const char* part : {"at (0.00", ") m", "at time 0.125 s", "T = 1", "p = 101325 Pa", "H2: 0.", "N2: 0."})
    EXPECT_THAT(message, testing::HasSubstr(part));
}

}  // namespace
}  // namespace lampblack::test
