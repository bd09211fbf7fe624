// Many cells advanced together against one by one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "chemistry/reactor/reactor.hpp"
#include "chemistry/reactor/reactor_failure.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/kinetics_rate_types.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::hydrogen;
using lampblack::test::RateTypes;
using lampblack::test::Table;
using Cell = ConstantPressureReactor::Cell;
using Result = ConstantPressureReactor::Result;

constexpr double kAtm = constants::oneAtmosphere;

// Cells and what they point to.
struct Cells {
  std::vector<std::vector<double>> Y, sources;
  std::vector<Cell> list;

  Cells() = default;
  Cells(const Cells& other) : Y(other.Y), sources(other.sources), list(other.list) { connect(); }
  Cells& operator=(const Cells&) = delete;

  void add(double T, std::vector<double> massFractions, std::vector<double> source = {}, double initialStep = 0) {
    Y.push_back(std::move(massFractions));
    sources.push_back(std::move(source));
    list.push_back({T, kAtm, {}, {}, initialStep});
    connect();
  }
  void connect() {
    for (std::size_t i = 0; i < list.size(); ++i) {
      list[i].Y = Y[i];
      list[i].source = sources[i];
    }
  }
};

// The states of the ethylene flame: near its steady state (what transport brings balances the reactions to one part in
// a thousand), and without transport.
Cells flame() {
  const Table table("counterflow_c2h4_states.csv");
  ReactorSystem system(ethylene());
  const std::size_t n = ethylene().numSpecies();
  Cells cells;
  for (std::size_t row = 0; row < 30; ++row) {
    std::vector<double> Y(n);
    const double T = table.number(row, "T");
    Thermo(ethylene()).moleToMass(table.moleFractions(row, ethylene()), Y);
    std::vector<double> y = Y, source(n + 1);
    y.push_back(T);
    system.setConditions(kAtm, {});
    system.chemicalRates(y.data(), source.data());
    source.pop_back();
    for (double& s : source) s *= -0.999;
    cells.add(T, Y, source, row % 2 == 0 ? 0.0 : 3e-6);
    cells.add(T, Y, {});
  }
  return cells;
}

// Both ways keep the tolerance; they take the same steps but where a cell needs more than one alone may take.
TEST(ReactorBatch, AgreesWithOneByOne) {
  const double dt = 1e-5, relative = 1e-6;
  Cells together = flame(), apart(together);
  ConstantPressureReactor reactor(ethylene(), {relative, 1e-12, 20000, 1e-10, 10});
  std::vector<Result> results(together.list.size());
  reactor.advance(together.list, dt, results);
  int inLanes = 0, handedOver = 0;
  for (std::size_t i = 0; i < apart.list.size(); ++i) {
    const auto alone = reactor.advance(apart.list[i], dt);
    EXPECT_EQ(results[i].skipped, alone.skipped) << i;
    handedOver += results[i].handedOver;
    const bool isSame = !alone.handedOver && !alone.skipped;
    inLanes += isSame;
    // Round-off, or two integrations within some tolerances of each other.
    const double tolerance = alone.handedOver ? 100 : 1e-4;
    EXPECT_NEAR(together.list[i].temperature, apart.list[i].temperature, tolerance * relative * 3000) << i;
    for (std::size_t k = 0; k < together.Y[i].size(); ++k)
      EXPECT_NEAR(together.Y[i][k], apart.Y[i][k], tolerance * (relative * std::abs(apart.Y[i][k]) + 1e-12)) << i;
    if (!isSame) continue;
    EXPECT_EQ(results[i].steps, alone.steps) << i;
    EXPECT_NEAR(together.list[i].initialStep, apart.list[i].initialStep, 1e-4 * apart.list[i].initialStep) << i;
  }
  EXPECT_GT(inLanes, 20);
  EXPECT_LT(handedOver, 30);
}

TEST(ReactorBatch, CellsDoNotFeelWhoIsWithThem) {
  Cells together = flame(), apart(together);
  ConstantPressureReactor reactor(ethylene()), other(ethylene());
  std::vector<Result> results(together.list.size()), own(1);
  reactor.advance(together.list, 1e-5, results);
  for (std::size_t i = apart.list.size(); i-- > 0;) {
    other.advance({&apart.list[i], 1}, 1e-5, own);
    EXPECT_EQ(apart.Y[i], together.Y[i]);
    EXPECT_EQ(apart.list[i].temperature, together.list[i].temperature);
    EXPECT_EQ(apart.list[i].initialStep, together.list[i].initialStep);
    EXPECT_EQ(own[0].steps, results[i].steps);
    EXPECT_EQ(own[0].handedOver, results[i].handedOver);
  }
}

// Time is shared out by steps: what all cells took together is what the call took, and a cell of many steps has more of
// it.
TEST(ReactorBatch, SecondsAreSharedOutBySteps) {
  Cells cells = flame();
  ConstantPressureReactor reactor(ethylene());
  std::vector<Result> results(cells.list.size());
  reactor.advance(cells.list, 1e-5, results);
  double few = 0, many = 0;
  int ofFew = 0, ofMany = 0;
  for (const auto& result : results) {
    EXPECT_GT(result.seconds, 0);
    if (result.handedOver || result.skipped) continue;
    if (result.steps == 1) {
      few += result.seconds;
      ++ofFew;
    } else if (result.steps > 5) {
      many += result.seconds;
      ++ofMany;
    }
  }
  ASSERT_GT(ofFew, 0);
  ASSERT_GT(ofMany, 0);
  EXPECT_GT(many / ofMany, 2 * few / ofFew);  // six times the steps; the rest of a cell's work is less than one step
}

TEST(ReactorBatch, RatesWithoutLanesGoOneByOne) {
  const auto mechanism = RateTypes::withOnly(RateTypes::pressureLog());
  std::vector<double> Y(mechanism.numSpecies());
  Thermo(mechanism).moleToMass(parseComposition(mechanism, "H: 1, HO2: 1, N2: 10"), Y);
  Cells together;
  together.add(1000, Y);
  together.add(1500, Y);
  Cells apart(together);
  ConstantPressureReactor reactor(mechanism);
  std::vector<Result> results(2);
  reactor.advance(together.list, 1e-6, results);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto alone = reactor.advance(apart.list[i], 1e-6);
    EXPECT_EQ(results[i].steps, alone.steps);
    EXPECT_EQ(apart.Y[i], together.Y[i]);
    EXPECT_EQ(apart.list[i].temperature, together.list[i].temperature);
  }
}

TEST(ReactorBatch, NothingHappensInNoTime) {
  Cells cells = flame(), start(cells);
  ConstantPressureReactor reactor(ethylene());
  std::vector<Result> results(cells.list.size());
  reactor.advance(cells.list, 0.0, results);
  EXPECT_EQ(cells.Y, start.Y);
  results.pop_back();
  EXPECT_THROW(reactor.advance(cells.list, 0.0, results), std::logic_error);
}

// The first of those that fail, with its place and all that is needed to try it again.
TEST(ReactorBatch, AFailureSaysWhichCellItWas) {
  std::vector<double> Y(hydrogen().numSpecies());
  Thermo(hydrogen()).moleToMass(parseComposition(hydrogen(), "H2: 2, O2: 1, N2: 3.76"), Y);
  const auto failure = [&](Cells& cells, const ConstantPressureReactor::Options& options) {
    ConstantPressureReactor reactor(hydrogen(), options);
    std::vector<Result> results(cells.list.size());
    try {
      reactor.advance(cells.list, 1e-3, results);
    } catch (const ReactorFailure& error) {
      return std::pair{error.place(), error.cell()};
    }
    return std::pair{SIZE_MAX, FailedCell{}};
  };
  for (const bool isNoGas : {false, true}) {
    Cells cells;
    cells.add(300, Y);
    cells.add(310, Y);
    cells.add(isNoGas ? -5 : 1300, Y, {}, 1e-4);
    cells.add(isNoGas ? -6 : 1400, Y);
    const auto [place, failed] = failure(cells, {1e-6, 1e-12, 3, 0.0, 1});
    EXPECT_EQ(place, 2u);
    EXPECT_EQ(failed.temperature, isNoGas ? -5 : 1300);
    EXPECT_EQ(failed.firstStep, 1e-4);
    EXPECT_EQ(failed.Y, Y);
    EXPECT_EQ(cells.Y[2], Y);
    EXPECT_EQ(cells.list[2].temperature, isNoGas ? -5 : 1300);
    EXPECT_EQ(cells.list[2].initialStep, 1e-4);
  }
}

}  // namespace
