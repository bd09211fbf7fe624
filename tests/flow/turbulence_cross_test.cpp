// The cross term of Wang's model, which moves its variable towards the lower strain: by no more than its neighbours
// say.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flow/models/turbulence/turbulence_model.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"
#include "tests/every_module.hpp"
#include "turbulence_fixture.hpp"

namespace lampblack::test {
namespace {

constexpr double h = 0.001;  // m, of TurbulentSquare's cells

// m^2/s^2: 1.7 nu~ grad ln S . grad nu~ of Wang's model, the net rate near a wall without 0.084 nu~ S.
double crossRate(const TurbulentCell& cell) {
  std::array<TurbulentRates, 1> rates;
  turbulenceModel("wang")->evaluate({&cell, 1}, rates);
  EXPECT_GE(rates[0].sink[0], 0.0);
  return rates[0].source[0] - rates[0].sink[0] * cell.values[0] - 0.084 * cell.values[0] * cell.strain;
}

TEST(TurbulenceCross, IsAtMostTwiceWhatTheSteepestNeighbourSays) {
  const double n = 1.5e-3, full = 1.7 * n * 5000.0 * 0.3;
  TurbulentCell cell{.strain = 10.0, .distance = 1e-3, .viscosity = 1.5e-5, .strainSlope = {3000.0, 4000.0}};
  cell.values[0] = n;
  cell.gradients[0] = {0.18, 0.24};  // along the strain's
  const auto near = [](double found, double exact) { EXPECT_NEAR(found, exact, 1e-12 + 1e-10 * std::abs(exact)); };
  near(crossRate(cell), full);  // neighbours are not known
  cell.knowsNeighbours = true;
  near(crossRate(cell), 0.0);  // none is above
  cell.above = {.value = n + 0.16e-3, .distance = h};
  cell.below = {.value = n, .distance = h};
  near(crossRate(cell), full);  // 0.16 is more than half of 0.3
  cell.above = {.value = n + 0.05e-3, .distance = 0.5 * h};
  near(crossRate(cell), full * 0.2 / 0.3);
  cell.above = {.value = n, .distance = h};
  near(crossRate(cell), 0.0);
  cell.gradients[0] = {-0.18, -0.24};
  near(crossRate(cell), 0.0);  // nothing falls, either
  cell.below.reset();
  near(crossRate(cell), 0.0);
  cell.below = {.value = n - 0.05e-3, .distance = 0.5 * h};
  near(crossRate(cell), -full * 0.2 / 0.3);
  cell.below = {.value = n - 0.16e-3, .distance = h};
  near(crossRate(cell), -full);
}

// Says which neighbours it was told of; of none its own value, no distance away.
struct Bystander {
  static constexpr bool needsWallDistance = false, needsStrainGradient = true;
  [[nodiscard]] std::string name() const { return "bystander"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return {{"n", "1", ""}}; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const { return {stream.energy}; }
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    EXPECT_TRUE(cell.knowsNeighbours);
    const auto of = [&](const std::optional<TurbulentCell::Neighbour>& neighbour) {
      return neighbour.value_or(TurbulentCell::Neighbour{cell.values[0], 0.0});
    };
    return {.eddyViscosity = of(cell.above).value,
            .diffusivity = {of(cell.above).distance + 100.0 * of(cell.below).distance},
            .source = {of(cell.below).value}};
  }
};

std::vector<Side> wallAtTheEnd() {
  std::vector<Side> sides = TurbulentSquare::walls(Geometry::Planar);
  sides[1].condition.slip = false;
  return sides;
}

// On any number of ranks; a wall that holds the variable at zero is a neighbour, one that the gas slips along is not.
TEST(TurbulenceCross, NeighboursAreThoseOfTheSteepestRiseAndFall) {
  TurbulentSquare square(std::make_shared<PointwiseModel<Bystander>>(), Geometry::Planar, wallAtTheEnd());
  State state = square.state([](const Vector3&) { return Vector3{}; });
  TurbulenceOperator turbulence = square.turbulence(state);
  turbulence.setStart(state, {ofMolecules, ofMolecules, 2.0});
  const auto value = [](double x, double y) { return 2.0 + 300.0 * x + 100.0 * y; };
  for (std::size_t c = 0; c < state.density.size(); ++c) {
    const Vector3& x = square.box.mesh.centre[c];
    state.carried[c] = state.density[c] * value(x[0], x[1]);
  }
  State::Balance rates = state.balance;
  turbulence.addRates(state, rates);
  turbulence.setDiffusivities(state);
  const double last = TurbulentSquare::length - h;
  for (std::size_t c = 0; c < at(square.box.mesh.owned); ++c) {
    const double x = square.box.mesh.centre[c][0], y = square.box.mesh.centre[c][1], density = state.density[c];
    const bool isFirst = x<h, isBeside = x> last, isTop = y > last, isBottom = y < h;
    // The rise along x is the steeper one; beside the wall that along y is left, and in the corner none.
    const double above = isBeside ? value(x, isTop ? y : y + h) : value(x + h, y);
    const double below = isBeside ? 0.0 : isFirst ? value(x, isBottom ? y : y - h) : value(x - h, y);
    const double upwards = isBeside && isTop ? 0.0 : h, downwards = isBeside ? 0.5 * h : isFirst && isBottom ? 0.0 : h;
    EXPECT_NEAR(state.eddyViscosity[c] / density, above, 1e-12);
    EXPECT_NEAR((rates.carried[c] - rates.carriedSink[c] * state.carried[c]) / density, below, 1e-12);
    EXPECT_NEAR(state.carriedDiffusivity[c], upwards + 100.0 * downwards, 1e-12);
  }
}

// The step from cell to cell is oblique to the face there: longer than what lies along the face's normal.
TEST(TurbulenceCross, NeighboursOfSkewedCellsAreAsFarAsTheirCentres) {
  TurbulentSquare square(std::make_shared<PointwiseModel<Bystander>>(), Geometry::Planar, wallAtTheEnd(),
                         Split{Cells::Quadrilaterals});
  const Mesh& m = square.box.mesh;
  State state = square.state([](const Vector3&) { return Vector3{}; });
  TurbulenceOperator turbulence = square.turbulence(state);
  turbulence.setStart(state, {ofMolecules, ofMolecules, 2.0});
  const auto value = [](const Vector3& x) { return 2.0 + 300.0 * x[0] + 100.0 * x[1]; };
  for (std::size_t c = 0; c < state.density.size(); ++c) state.carried[c] = state.density[c] * value(m.centre[c]);
  turbulence.setDiffusivities(state);
  std::vector<double> above(at(m.owned)), below(at(m.owned)), up(at(m.owned)), down(at(m.owned));
  double longest = 1.0;  // of a step, over what lies along the normal
  const auto see = [&](int cell, double rise, const Vector3& to, int face) {
    if (cell < 0 || cell >= m.owned) return;
    const double far = length(difference(to, m.centre[at(cell)])), slope = rise / far;
    longest = std::max(longest, far / m.distance[at(face)]);
    if (slope > above[at(cell)]) above[at(cell)] = slope, up[at(cell)] = far;
    if (slope < below[at(cell)]) below[at(cell)] = slope, down[at(cell)] = far;
  };
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[at(face)], high = m.high[at(face)];
    if (high < 0) {
      if (square.box.context.boundaryOf(face).isNoSlipWall())
        see(low, -value(m.centre[at(low)]), m.faceCentre[at(face)], face);
      continue;
    }
    const double rise = value(m.centre[at(high)]) - value(m.centre[at(low)]);
    see(low, rise, m.centre[at(high)], face);
    see(high, -rise, m.centre[at(low)], face);
  }
  for (int c = 0; c < m.owned; ++c)
    EXPECT_NEAR(state.carriedDiffusivity[at(c)], up[at(c)] + 100.0 * down[at(c)], 1e-12);
  EXPECT_GT(largest(m, [&](int) { return longest; }), 1.05);
}

// Gas nearly at rest beside a wall, whose strain grows away from it: the parabola through the wall's zero says that nu~
// grows with it in the first cell, too. There nu~ is largest, and has from the cross term nothing.
TEST(TurbulenceCross, MakesNothingWhereTheVariableIsLargest) {
  TurbulentSquare square(turbulenceModel("wang"), Geometry::Planar, wallAtTheEnd());
  for (int c = 0; c < square.box.mesh.owned; ++c)
    square.box.context.wallDistance.push_back(TurbulentSquare::length - square.box.mesh.centre[at(c)][0]);
  const double a = 1000.0;
  State state = square.state([&](const Vector3& x) {
    const double d = TurbulentSquare::length - x[0];
    return Vector3{0.0, a * d * d};
  });
  TurbulenceOperator turbulence = square.turbulence(state);
  turbulence.setStart(state, {ofMolecules, ofMolecules, 0.0});
  const auto distance = [&](std::size_t c) { return TurbulentSquare::length - square.box.mesh.centre[c][0]; };
  for (std::size_t c = 0; c < state.density.size(); ++c)
    state.carried[c] = state.density[c] * (1.5e-3 - 0.01 * distance(c));
  State::Balance rates = state.balance;
  turbulence.addRates(state, rates);
  int beside = 0, beyond = 0;
  for (std::size_t c = 0; c < at(square.box.mesh.owned); ++c) {
    const double d = distance(c), n = 1.5e-3 - 0.01 * d, along = square.box.mesh.centre[c][1];
    if (along < 2.0 * h || along > TurbulentSquare::length - 2.0 * h) continue;
    const double rate = (rates.carried[c] - rates.carriedSink[c] * state.carried[c]) / state.density[c];
    const double ofStrain = 0.084 * n * 2.0 * a * d;
    if (d < h) {
      ++beside;
      EXPECT_NEAR(rate / ofStrain, 1.0, 1e-6);
    } else if (d < 3.0 * h) {
      ++beyond;
      EXPECT_LT(rate, 0.0);  // nu~ falls towards the higher strain
    }
  }
  EXPECT_EQ(sumOverRanks(beside), 3.0);
  EXPECT_EQ(sumOverRanks(beyond), 6.0);
}

}  // namespace
}  // namespace lampblack::test
