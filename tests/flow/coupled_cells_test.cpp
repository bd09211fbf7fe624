// Cells whose reactions outrun a step: how fast reactions grow, and steps of cells and their neighbours together.
#include "flow/models/coupled_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "chemistry/reactor/growth_rate.hpp"
#include "core/errors.hpp"
#include "flow/models/constant_pressure_cells.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/budget.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// The chain branching of hydrogen: radicals grow as the exponential of the rate until they are no longer few.
TEST(GrowthRates, AreThoseOfTheRadicals) {
  Gas& gas = Gas::hydrogen();
  std::vector<double> Y = gas.massFractions("H2: 2, O2: 1, N2: 3.76");
  const double T = 1300.0, p = 101325.0;
  ConstantPressureReactor reactor(gas.mechanism);
  const std::size_t H = gas.mechanism.speciesIndex("H");
  Y[H] = 1e-9;
  ConstantPressureReactor::Cell cell{T, p, Y, {}};
  reactor.advance(cell, 1e-5);  // the mode that grows fastest is all there is
  const double before = Y[H];
  GrowthRate growth(gas.mechanism, -1e-10);
  const double rate = growth.of(cell.temperature, p, Y, 1e-4);
  reactor.advance(cell, 2e-6);
  EXPECT_NEAR(rate, std::log(Y[H] / before) / 2e-6, 0.01 * rate);
  // By whatever step it is asked for; where a step is too short to feel it there is none.
  EXPECT_GT(rate, 1e4);
  EXPECT_NEAR(growth.of(cell.temperature, p, Y, 3.0 / rate), growth.of(cell.temperature, p, Y, 30.0 / rate),
              1e-3 * rate);
  EXPECT_EQ(growth.of(cell.temperature, p, Y, 0.3 / rate), 0.0);
}

TEST(GrowthRates, OfWhatDecaysAreNone) {
  Gas& gas = Gas::hydrogen();
  GrowthRate growth(gas.mechanism, -1e-10);
  EXPECT_EQ(growth.of(2400.0, 101325.0, gas.massFractions("H2O: 0.3, N2: 0.65, OH: 0.02, H: 0.02, O2: 0.01"), 1e-4),
            0.0);
  EXPECT_EQ(growth.of(300.0, 101325.0, gas.massFractions("H2: 2, O2: 1, N2: 3.76"), 1e-3), 0.0);
}

// Cells one by one.
CoupledCells::React reactEach() {
  return [](std::span<CoupledCells::Reacting> own, double part) {
    ConstantPressureCells reactor(Gas::hydrogen().mechanism, Gas::hydrogen().thermo, {});
    for (CoupledCells::Reacting& one : own) {
      const CellReactor::Cell cell{one.gas, one.Y, one.source};
      CellReactor::Result result;
      reactor.advance({&cell, 1}, part, {&result, 1});
      one.gas.temperature = result.temperature;
      one.gas.firstStep = result.firstStep;
    }
  };
}

// A cell that nothing flows into is a reactor: what it makes is the mean over the step, in however many parts.
TEST(CoupledCell, AloneIsAReactor) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> start = gas.massFractions("H2: 0.2, O2: 0.15, N2: 0.6, H: 0.002, OH: 0.002");
  const double T = 1100.0, mass = 3e-9, dt = 2e-5;
  CoupledCells cells(start.size());
  CoupledCells::Cell cell{7, mass, 101325.0, T, gas.thermo.enthalpyMass(T, start), T, 0.0, 0.0, start, start, {}, {}};
  cell.brought.assign(start.size(), 0.0);
  cell.reacts = cell.brought;
  cell.heat = mass * 5e9;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) cells.add(cell);
  cells.gather(MPI_COMM_WORLD);
  ConstantPressureReactor reactor(gas.mechanism);
  int advanced = 0;
  const auto react = [&](std::span<CoupledCells::Reacting> own, double part) {
    advanced += static_cast<int>(own.size());
    reactEach()(own, part);
  };
  cells.advance(MPI_COMM_WORLD, react, gas.thermo, dt, 4);
  EXPECT_EQ(advanced, rank == 0 ? 4 : 0) << "each rank its own";
  std::vector<double> Y = start;
  ConstantPressureReactor::Cell whole{T, 101325.0, Y, {}, 0.0, 5e9};
  reactor.advance(whole, dt);
  double change = 0.0;
  for (std::size_t k = 0; k < Y.size(); ++k) {
    change = std::max(change, std::abs(Y[k] - start[k]));
    EXPECT_NEAR(cells.made(7)[k] * dt / mass, Y[k] - start[k], 1e-6) << k;
  }
  EXPECT_GT(change, 0.01);
}

// Two cells in a row, the gas flows from the cold one through the hot one, which gives heat and radicals back.
TEST(CoupledCell, WithAnotherIsTheSameOnAnyRank) {
  Gas& gas = Gas::hydrogen();
  const std::size_t n = gas.mechanism.numSpecies();
  const auto madeOf = [&](int rankOfSecond) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    CoupledCells cells(n);
    for (const int number : {3, 8}) {
      if (rank != (number == 3 ? 0 : rankOfSecond)) continue;
      CoupledCells::Cell cell;
      cell.number = number;
      cell.mass = 3e-9;
      cell.pressure = 101325.0;
      cell.temperature = cell.referenceTemperature = number == 3 ? 700.0 : 1300.0;
      cell.Y = cell.reference =
          gas.massFractions(number == 3 ? "H2: 0.3, O2: 0.15, N2: 0.6" : "H2: 0.2, O2: 0.1, N2: 0.6, H: 0.01");
      cell.enthalpy = cell.referenceEnthalpy = gas.thermo.enthalpyMass(cell.temperature, cell.Y);
      cell.brought.assign(n, 0.0);
      cell.reacts = cell.brought;
      cells.add(cell);
    }
    if (rank == 0) cells.add(CoupledCells::Link{4, 3, 8, 2e-5, 1e-2, std::vector<double>(n, 4e-5)});
    cells.gather(MPI_COMM_WORLD);
    cells.advance(MPI_COMM_WORLD, reactEach(), gas.thermo, 4e-5, 5);
    std::vector<double> made;
    for (const int number : {3, 8}) made.insert(made.end(), cells.made(number).begin(), cells.made(number).end());
    return made;
  };
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const std::vector<double> together = madeOf(0);
  EXPECT_EQ(madeOf(ranks - 1), together);
  // Hydrogen atoms that come from the hot cell make HO2 in the cold one, and mass is made nowhere.
  EXPECT_GT(together[gas.mechanism.speciesIndex("HO2")], 1e-9);
  double net = 0.0, all = 0.0;
  for (const double rate : together) {
    net += rate;
    all += std::abs(rate);
  }
  EXPECT_LT(std::abs(net), 1e-12 * all);
}

// Hydrogen and air that burn on a burner, a row of cells.
class FlameOnABurner : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  const std::vector<double> fresh = gas.massFractions("H2: 0.25, O2: 0.15, N2: 0.6");
  const std::vector<double> burnt = gas.massFractions("H2O: 0.25, O2: 0.025, N2: 0.6");
  Side inlet() const {
    Side side = opening(BoundaryKind::Inlet, 0, false, 0.6, 300.0, fresh);
    side.condition.fixedComposition = true;
    return side;
  }
  Box box{Geometry::Planar,
          {uniformAxis(4e-3, 20), uniformAxis(1e-3, 1)},
          {inlet(), opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, burnt), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)}};

  struct Outcome {
    double change = 0.0;     // K, largest in a step of the last ten
    double hottest = 0.0;    // K
    double coupled = 0.0;    // cells in all steps
    double imbalance = 0.0;  // of mass and elements, over what came in
    double growth = 0.0;
    double advanced = 0.0;  // cells, by the reactor, of a step and sweep of all cells
  };
  // The flame that has come to stand in short steps, and so many long ones behind.
  Outcome burn(bool isCoupled, int sweeps, double longStep, int steps) {
    State state = box.state([&](const Vector3& x) {
      const double share = std::clamp((x[0] - 0.4e-3) / 0.4e-3, 0.0, 1.0);
      Box::Local local{{0.6, 0.0}, 300.0 + 1900.0 * share, fresh};
      for (std::size_t k = 0; k < fresh.size(); ++k) local.Y[k] += share * (burnt[k] - fresh[k]);
      return local;
    });
    TransportOperator transport(box.context, state, {.courant = 0.5, .sweeps = sweeps});
    ReactionOperator chemistry(box.context, {});
    if (isCoupled) transport.coupleWith(chemistry);
    transport.initialise(state, 1e-6);
    Budget budget(box.context, massAndElements(gas.mechanism, {}), state);
    transport.watchBoundary([&](const auto& amounts) { budget.addStep(amounts); });
    Outcome outcome;
    double time = 0.0;
    const int shortSteps = 400;
    for (int step = 0; step < shortSteps + steps; ++step) {
      const double dt = step < shortSteps ? std::min(4e-6, 1e-6 + 1e-8 * step) : longStep;
      const std::vector<double> before = state.temperature;
      for (int sweep = 0; sweep < sweeps; ++sweep) {
        transport.advance(state, time, dt);
        chemistry.advance(state, time, dt);
        if (sweep + 1 < sweeps) transport.endSweep(state);
      }
      chemistry.endStep(state);
      transport.endSweep(state);
      time += dt;
      if (step >= shortSteps + steps - 10)
        outcome.change =
            std::max(outcome.change,
                     largest(box.mesh, [&](int c) { return std::abs(state.temperature[at(c)] - before[at(c)]); }));
    }
    outcome.hottest = largest(box.mesh, [&](int c) { return state.temperature[at(c)]; });
    const std::vector<double> row = chemistry.historyValues(state);
    outcome.advanced = (row.at(1) + row.at(2)) / (20.0 * (shortSteps + steps) * sweeps);
    outcome.coupled = row.at(6);
    outcome.growth = row.at(7);
    for (const Budget::Line& line : budget.lines(state)) outcome.imbalance = std::max(outcome.imbalance, line.error);
    return outcome;
  }
};

TEST_F(FlameOnABurner, StandsInLongSteps) {
  const Outcome stands = burn(true, 1, 4e-5, 100);
  EXPECT_GT(stands.growth, 2.0);
  EXPECT_GE(stands.coupled, 100.0);
  EXPECT_GT(stands.advanced, 1.0) << "coupled cells count in each part";
  EXPECT_LT(stands.change, 0.1);
  EXPECT_LT(stands.imbalance, 1e-13);
  // Steady is what does not depend on the step.
  const Outcome inShorter = burn(true, 1, 2e-5, 300);
  EXPECT_GT(inShorter.growth, 1.0);
  EXPECT_LT(inShorter.change, 0.1);
  EXPECT_NEAR(inShorter.hottest, stands.hottest, 0.2);
  const Outcome inSweeps = burn(true, 2, 4e-5, 160);
  EXPECT_GE(inSweeps.coupled, 100.0);
  EXPECT_LT(inSweeps.change, 0.1);
  EXPECT_NEAR(inSweeps.hottest, stands.hottest, 0.2);
  EXPECT_LT(inSweeps.imbalance, 1e-13);
}

TEST_F(FlameOnABurner, RingsInLongStepsOfEachCellAlone) {
  EXPECT_GT(burn(false, 1, 2e-5, 60).change, 100.0);
  EXPECT_THROW(burn(false, 1, 4e-5, 60), NumericsError);
}

TEST_F(FlameOnABurner, IsTheSameToTheLastBitWhereNothingOutrunsAStep) {
  const Outcome coupled = burn(true, 1, 1.4e-5, 10), alone = burn(false, 1, 1.4e-5, 10);
  EXPECT_GT(coupled.growth, 0.9) << "nearly";
  EXPECT_LT(coupled.growth, 1.0);
  EXPECT_EQ(coupled.coupled, 0.0);
  EXPECT_EQ(coupled.hottest, alone.hottest);
  EXPECT_EQ(coupled.change, alone.change);
}

}  // namespace
}  // namespace lampblack::test
