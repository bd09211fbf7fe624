// Cells that take the reactions of others: which are references on any number of ranks, what is conserved, which error
// is told.
#include "flow/models/reference_map.hpp"

#include <gtest/gtest.h>

#include <map>

#include "combustion_fixture.hpp"
#include "flow/models/reaction_operator.hpp"

namespace lampblack::test {
namespace {

using Map = ReferenceMap::Options;

// Every rank has cells of every bin, numbers in no order.
TEST(ReferenceCells, AreTheSmallestNumbersOfAllRanks) {
  const int ranks = worldSize(), mine = worldRank();
  constexpr int many = 60;
  const auto binOf = [](std::int64_t number) {
    return ReferenceMap::Bin{number % 7, -(number % 3), number == 59 ? 1 : 0};
  };
  std::map<ReferenceMap::Bin, std::int64_t> smallest;
  for (std::int64_t number = many - 1; number >= 0; --number) smallest[binOf(number)] = number;
  std::vector<ReferenceCells::Cell> cells;
  for (std::int64_t i = 0; i < many; ++i) {
    const std::int64_t number = (i * 37 + 11) % many;
    if (number / 2 % ranks == mine) cells.push_back({number, binOf(number)});
  }
  const ReferenceCells references(MPI_COMM_WORLD, cells);
  int given = 0;
  std::vector<char> isTaken(cells.size(), 0);
  references.spread(
      2,
      [&](std::size_t i, std::span<double> row) {
        ++given;
        row[0] = static_cast<double>(cells[i].number);
        row[1] = -row[0];
      },
      [&](std::size_t i, std::span<const double> row) {
        isTaken[i] = 1;
        ASSERT_EQ(row.size(), 2U);
        EXPECT_EQ(row[0], static_cast<double>(smallest.at(cells[i].bin)));
        EXPECT_EQ(row[1], -row[0]);
      });
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(references.isReference(i), cells[i].number == smallest.at(cells[i].bin));
    EXPECT_NE(references.isReference(i), isTaken[i] == 1);
  }
  EXPECT_EQ(sumOverRanks(given), static_cast<double>(smallest.size()));
}

TEST(ReferenceCells, NoCellsAreFine) {
  const ReferenceCells none(MPI_COMM_WORLD, {});
  none.spread(
      3, [](std::size_t, std::span<double>) { ADD_FAILURE(); },
      [](std::size_t, std::span<const double>) { ADD_FAILURE(); });
}

class Mapped : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::size_t n = gas.mechanism.numSpecies();
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79"), fuel = gas.massFractions("H2: 1");
  std::vector<double> burning = gas.massFractions("H2: 0.3, O2: 0.15, N2: 0.55, OH: 0.002, H: 0.001");
  static constexpr double dt = 2e-6;

  // Cells of two kinds of gas in turn, a little hotter and leaner or not from one to the next.
  Box::Local gasAt(const Vector3& x, double contrast) const {
    const double place = contrast * (std::sin(3.0 * x[0] / 0.012) + x[1] / 0.12);
    const bool isHot = static_cast<int>(x[0] * 1000.0) % 2 == 0;
    Box::Local local{{}, (isHot ? 1150.0 : 1020.0) + 1.5 * place, burning};
    for (std::size_t k = 0; k < n; ++k) local.Y[k] += 2e-3 * place * (air[k] - local.Y[k]);
    return local;
  }
  State stateIn(Box& box, double contrast = 1.0) {
    return box.state([&](const Vector3& x) { return gasAt(x, contrast); });
  }
  // The same on all ranks or on this one alone.
  Box boxOn(MPI_Comm comm) const {
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {uniformAxis(0.012, 12), uniformAxis(0.006, 2)};
    std::vector<BoundaryCondition> conditions;
    for (const int axis : {0, 1})
      for (const bool atMax : {false, true}) {
        const Side one = side(BoundaryKind::Symmetry, axis, atMax);
        spec.patches.push_back(one.patch);
        conditions.push_back(one.condition);
      }
    return {spec, conditions, {}, comm};
  }
  Box box = boxOn(MPI_COMM_WORLD);

  ReactionOperator::Options with(const Map& map, bool shareWork = true) const {
    ReactionOperator::Options options;
    options.shareWork = shareWork;
    options.map.emplace(map, MixtureFraction(gas.mechanism, fuel, air));
    return options;
  }
  static Map wide(double checked = 0.0) { return {0.05, 50.0, 0.2, checked}; }
  double elementIn(const State& state, int cell, std::size_t element) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k)
      sum += state.Y[at(cell) * n + k] * gas.mechanism.atoms(k, element) / gas.mechanism.molecularWeights()[k];
    return sum;
  }
  // Some steps, with what the balance says in place of transport.
  static void march(State& state, ReactionOperator& chemistry, int steps) {
    for (int step = 0; step < steps; ++step) {
      state.keepStart();
      for (std::size_t i = 0; i < state.balance.reactions.size(); ++i)
        state.Y[i] += dt * state.balance.reactions[i] / state.density[i / at(state.species)];
      state.balance.clear();
      chemistry.advance(state, step * dt, dt);
      chemistry.endStep(state);
      chemistry.endSweep(state);
    }
  }
};

TEST_F(Mapped, TwoKindsOfGasHaveTwoReferences) {
  State state = stateIn(box);
  ReactionOperator chemistry(box.context, with(wide()));
  chemistry.advance(state, 0.0, dt);
  const auto found = chemistry.takeDiagnostics();
  EXPECT_EQ(found.map.cells, 24.0);
  EXPECT_EQ(found.map.mapped, 22.0);
  EXPECT_EQ(found.map.refused, 0.0);
  EXPECT_EQ(found.integratedCells, 2.0);
}

// On all ranks, with work sharing and without, and on one: the same bits.
TEST_F(Mapped, RanksChangeNoBit) {
  Box alone = boxOn(MPI_COMM_SELF);
  State expected = stateIn(alone);
  ReactionOperator serial(alone.context, with(wide(0.3)));
  march(expected, serial, 3);
  for (const bool shareWork : {true, false}) {
    State state = stateIn(box);
    ReactionOperator chemistry(box.context, with(wide(0.3), shareWork));
    march(state, chemistry, 3);
    for (int c = 0; c < box.mesh.owned; ++c) {
      const int same = alone.mesh.findOwned(box.mesh.naturalCell[at(c)]);
      EXPECT_EQ(state.temperature[at(c)], expected.temperature[at(same)]);
      EXPECT_TRUE(std::equal(&state.Y[at(c) * n], &state.Y[at(c) * n] + n, &expected.Y[at(same) * n]));
    }
    const MapTally here = chemistry.takeDiagnostics().map, there = serial.takeDiagnostics().map;
    if (!shareWork) continue;
    EXPECT_EQ(here.mapped, there.mapped);
    EXPECT_EQ(here.checked, there.checked);
    EXPECT_GT(here.checked, 5.0);
    EXPECT_EQ(here.temperatureError, there.temperatureError);
    EXPECT_EQ(here.fractionError, there.fractionError);
  }
}

// What is integrated to tell the error changes nothing, and cells that are alone in their bins are as without a map.
TEST_F(Mapped, ChecksAndNarrowBinsChangeNoBit) {
  State plain = stateIn(box), alone = plain, checked = plain, unchecked = plain;
  ReactionOperator without(box.context, {}), narrow(box.context, with({1e-9, 1e-3, 1e-9, 1.0})),
      all(box.context, with(wide(1.0))), none(box.context, with(wide(0.0)));
  march(plain, without, 2);
  march(alone, narrow, 2);
  march(checked, all, 2);
  march(unchecked, none, 2);
  EXPECT_EQ(alone.Y, plain.Y);
  EXPECT_EQ(alone.temperature, plain.temperature);
  EXPECT_EQ(checked.Y, unchecked.Y);
  EXPECT_EQ(checked.temperature, unchecked.temperature);
  EXPECT_GT(maxOverRanks(plain.Y != unchecked.Y), 0.0);
}

TEST_F(Mapped, ElementsMassAndEnthalpyAreKept) {
  State state = stateIn(box);
  const State start = state;
  ReactionOperator chemistry(box.context, with(wide()));
  chemistry.advance(state, 0.0, 5e-6);
  double changed = 0.0;
  for (int c = 0; c < box.mesh.owned; ++c) {
    for (std::size_t e = 0; e < gas.mechanism.numElements(); ++e)
      // As of cells that react by themselves (reaction_test.cpp), in a step that is shorter.
      EXPECT_NEAR(elementIn(state, c, e), elementIn(start, c, e), 1e-12 * (elementIn(start, c, e) + 1.0));
    const std::span<const double> Y(&state.Y[at(c) * n], n);
    double sum = 0.0;
    for (const double y : Y) sum += y;
    EXPECT_NEAR(sum, 1.0, 1e-13);
    EXPECT_NEAR(gas.thermo.enthalpyMass(state.temperature[at(c)], Y), start.enthalpy[at(c)], 64.0 * epsilon * 3e6);
    for (std::size_t k = 0; k < n; ++k)
      changed = std::max(changed, std::abs(state.Y[at(c) * n + k] - start.Y[at(c) * n + k]));
  }
  EXPECT_GT(maxOverRanks(changed), 1e-4);
}

// The error of every cell, as a run without the map has it.
TEST_F(Mapped, TheErrorToldIsThatAgainstOwnReactions) {
  State exact = stateIn(box), state = exact;
  const State start = exact;
  ReactionOperator own(box.context, {}), chemistry(box.context, with(wide(1.0)));
  own.advance(exact, 0.0, dt);
  chemistry.advance(state, 0.0, dt);
  const MapTally told = chemistry.takeDiagnostics().map;
  EXPECT_EQ(told.checked, 22.0);
  std::vector<double> enthalpies(n);
  double temperature = 0.0, fraction = 0.0, heat = 0.0, error = 0.0;
  for (int c = 0; c < box.mesh.owned; ++c) {
    temperature = std::max(temperature, std::abs(state.temperature[at(c)] - exact.temperature[at(c)]));
    gas.thermo.speciesEnthalpies(exact.temperature[at(c)], enthalpies);
    double change = 0.0, off = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = at(c) * n + k;
      fraction = std::max(fraction, std::abs(state.Y[i] - exact.Y[i]));
      change += enthalpies[k] * (exact.Y[i] - start.Y[i]);
      off += enthalpies[k] * (state.Y[i] - exact.Y[i]);
    }
    error += std::abs(off);
    if (state.Y != exact.Y || off != 0.0) heat += off != 0.0 ? std::abs(change) : 0.0;
  }
  EXPECT_GT(told.temperatureError, 1e-4);
  EXPECT_DOUBLE_EQ(told.temperatureError, maxOverRanks(temperature));
  EXPECT_NEAR(told.fractionError, maxOverRanks(fraction), 4.0 * epsilon);
  EXPECT_NEAR(told.heatError, sumOverRanks(error), 1e-6 * told.heatError);
  EXPECT_NEAR(told.heat, sumOverRanks(heat), 1e-6 * told.heat);
}

// Cells of one gas have no error, nor after steps that begin with the rates of the last.
TEST_F(Mapped, CellsOfOneGasHaveNoError) {
  State exact = stateIn(box, 0.0), state = exact;
  ReactionOperator own(box.context, {}), chemistry(box.context, with(wide(1.0)));
  march(exact, own, 3);
  march(state, chemistry, 3);
  const MapTally told = chemistry.takeDiagnostics().map;
  EXPECT_EQ(told.mapped, 66.0);
  EXPECT_EQ(told.checked, 66.0);
  EXPECT_LT(told.temperatureError, 1e-10);
  EXPECT_LT(told.fractionError, 1e-14);
  for (int c = 0; c < box.mesh.owned; ++c) EXPECT_NEAR(state.temperature[at(c)], exact.temperature[at(c)], 1e-10);
}

// A cell that has nothing of what the reference's reactions use up reacts by itself.
TEST_F(Mapped, ACellThatWouldFallBelowZeroReactsByItself) {
  const std::size_t hydroxyl = gas.mechanism.speciesIndex("OH");
  const auto lacking = [&](const Vector3& x) {
    Box::Local local = gasAt(x, 1.0);
    if (x[0] > 0.006 && x[1] > 0.003) {
      local.Y[gas.mechanism.speciesIndex("N2")] += local.Y[hydroxyl];
      local.Y[hydroxyl] = 0.0;
    }
    return local;
  };
  State state = box.state(lacking), exact = state;
  ReactionOperator chemistry(box.context, with(wide())), own(box.context, {});
  chemistry.advance(state, 0.0, dt);
  own.advance(exact, 0.0, dt);
  const MapTally map = chemistry.takeDiagnostics().map;
  EXPECT_EQ(map.refused, 6.0);
  EXPECT_EQ(map.mapped, 16.0);
  for (int c = 0; c < box.mesh.owned; ++c) {
    EXPECT_GE(state.Y[at(c) * n + hydroxyl], -1e-10);
    const Vector3& x = box.mesh.centre[at(c)];
    if (x[0] > 0.006 && x[1] > 0.003) {
      EXPECT_EQ(state.temperature[at(c)], exact.temperature[at(c)]);
    }
  }
}

// Where mixing lets less of the reactions go, less of the reference's are taken.
TEST_F(Mapped, RatesGoByTheReactingShare) {
  GivenMixing mixing(box.mesh, [](const Vector3& x) { return CellMixing{x[1] > 0.003 ? 0.25 : 0.5, 0.0}; });
  State state = stateIn(box, 0.0);
  ReactionOperator chemistry(box.context, with(wide()));
  chemistry.mixBy(mixing);
  chemistry.advance(state, 0.0, dt);
  const std::size_t water = gas.mechanism.speciesIndex("H2O");
  // Of the hotter gas, by rows, the least and the most of all cells.
  std::array<double, 2> least{1e30, 1e30}, most{0.0, 0.0};
  for (int c = 0; c < box.mesh.owned; ++c) {
    if (static_cast<int>(box.mesh.centre[at(c)][0] * 1000.0) % 2 != 0) continue;
    const auto row = at(box.mesh.centre[at(c)][1] > 0.003);
    const double made = state.balance.reactions[at(c) * n + water];
    least[row] = std::min(least[row], made);
    most[row] = std::max(most[row], made);
  }
  for (const std::size_t row : {0U, 1U}) {
    least[row] = minOverRanks(least[row]);
    most[row] = maxOverRanks(most[row]);
    EXPECT_NEAR(least[row] / most[row], 1.0, 1e-12);
  }
  EXPECT_NEAR(most[1] / most[0], 0.5, 1e-12);
}

// Bins begin where no usual value is: round-off does not part what is alike.
TEST_F(Mapped, PureStreamsLieWithinTheirBins) {
  const ReferenceMap map(Map{}, MixtureFraction(gas.mechanism, fuel, air));
  const auto binOf = [&](double share, double temperature) {
    std::vector<double> Y = air;
    for (std::size_t k = 0; k < n; ++k) Y[k] += share * (fuel[k] - air[k]);
    return map.binOf(temperature, 1.2, Y);
  };
  EXPECT_EQ(binOf(1e-12, 300.0), binOf(-1e-12, 300.0 - 1e-9));
  EXPECT_EQ(binOf(1.0 + 1e-12, 294.0), binOf(1.0 - 1e-12, 294.0 - 1e-9));
  EXPECT_NE(binOf(0.0, 300.0), binOf(1.1e-3, 300.0));
  EXPECT_NE(binOf(0.0, 300.0), binOf(0.0, 302.1));
  EXPECT_NE(map.binOf(300.0, 0.15, air), map.binOf(300.0, 0.15 * 1.011, air));
}

// The sample is another one each step, and as large as asked.
TEST_F(Mapped, StepsCheckOtherCells) {
  Map options;
  options.checked = 0.1;
  const ReferenceMap map(options, MixtureFraction(gas.mechanism, fuel, air));
  int first = 0, second = 0, both = 0;
  for (std::int64_t number = 0; number < 10000; ++number) {
    const bool now = map.isChecked(number, 1e-3), then = map.isChecked(number, 1.001e-3);
    first += now;
    second += then;
    both += now && then;
  }
  // Binomial: 1000 +- 30, 100 +- 10; five of these.
  EXPECT_NEAR(first, 1000, 150);
  EXPECT_NEAR(second, 1000, 150);
  EXPECT_NEAR(both, 100, 50);
}

}  // namespace
}  // namespace lampblack::test
