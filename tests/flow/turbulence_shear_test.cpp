// What a turbulence operator finds of the flow in a cell, and how rates become sinks.
#include <gtest/gtest.h>

#include "flow/models/turbulence/turbulence_model.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"
#include "tests/every_module.hpp"
#include "turbulence_fixture.hpp"

namespace lampblack::test {
namespace {

// What the operator finds of a cell and makes of rates: a sink steeper than in proportion, and a source that grows by
// itself and falls with the other variable.
struct Probe : TwoVariables {
  static constexpr double ofShape = 50.0;
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const double a = cell.values[0], b = cell.values[1];
    return {.eddyViscosity = cell.stretching,
            .diffusivity = {cell.strain, cell.vorticity + b},
            .source = {cell.strain + ofShape * cell.strainShape, cell.vorticity + 5.0 * b - 40.0 * a},
            .sink = {a * a, 0.0}};
  }
};

// Of a linear flow, plane and about an axis: u = (A x + C y, B x + E y).
TEST(Turbulence, LinearFlowsHaveTheirShearAndRatesTheirTangents) {
  const double A = 30.0, B = 90.0, E = -20.0, a = 2.0, b = TwoVariables::secondValue;
  for (const bool isRound : {false, true}) {
    SCOPED_TRACE(isRound);
    const double C = isRound ? 0.0 : -40.0, hoop = isRound ? A : 0.0, dilatation = A + E + hoop;
    TurbulentSquare square(std::make_shared<PointwiseModel<Probe>>(),
                           isRound ? Geometry::Axisymmetric : Geometry::Planar);
    const Mesh& mesh = square.box.mesh;
    State state = square.state([&](const Vector3& x) { return Vector3{A * x[0] + C * x[1], B * x[0] + E * x[1]}; });
    TurbulenceOperator turbulence = square.turbulence(state);
    turbulence.setStart(state, {ofMolecules, ofMolecules, a});
    State::Balance rates = state.balance;
    turbulence.addRates(state, rates);
    // Of other variables, without what velocities tell being found anew: the net rates are those of all anew.
    State varied = state;
    for (double& value : varied.carried) value *= 1.1;
    State::Balance alone = state.balance, anew = state.balance;
    turbulence.addRatesOfCarried(varied, alone);
    turbulence.addRates(varied, anew);
    for (std::size_t i = 0; i < anew.carried.size(); ++i) {
      const double net = anew.netOfCarried(i, varied.carried);
      EXPECT_NEAR(alone.netOfCarried(i, varied.carried), net, 1e-9 * (1.0 + std::abs(net)));
    }
    turbulence.addRates(state, rates = state.balance);
    std::vector<double> slopes(4 * at(mesh.owned));
    turbulence.addSlopes(state, {{}, slopes});
    turbulence.advance(state, 0.0, 0.0);
    // From eddies that are not the state's own, with a halo of what is long past.
    constexpr double past = 7.0;
    State relaxed = state;
    std::ranges::fill(relaxed.eddyViscosity, past);
    State own = relaxed;
    turbulence.advance(relaxed, 0.0, 1e6);
    for (int c = mesh.owned; c < mesh.cells; ++c) {
      own.velocity[at(2 * c)] = own.carried[at(2 * c)] = past;
      own.velocity[at(2 * c + 1)] = own.carried[at(2 * c + 1)] = past;
    }
    turbulence.setDiffusivities(own);
    const double strain =
        std::sqrt(2.0 * (A * A + E * E + hoop * hoop) + (B + C) * (B + C) - 2.0 / 3.0 * dilatation * dilatation);
    // Without a trace the sum of cubes is three times the determinant.
    const double third = dilatation / 3.0;
    const double cubes = 3.0 * (hoop - third) * ((A - third) * (E - third) - 0.25 * (B + C) * (B + C));
    const double shape = cubes / std::pow(0.5 * strain * strain, 1.5), source = strain + Probe::ofShape * shape;
    square.forCellsWellInside([&](std::size_t c, const Vector3&) {
      const double density = state.density[c];
      EXPECT_NEAR(rates.carried[2 * c] / (density * (source + 2.0 * a * a * a)), 1.0, 1e-5);
      EXPECT_NEAR(rates.carriedSink[2 * c] / (3.0 * a * a), 1.0, 1e-5);
      EXPECT_NEAR(rates.carried[2 * c] / density - rates.carriedSink[2 * c] * a, source - a * a * a, 1e-8);
      EXPECT_NEAR(rates.carried[2 * c + 1] / (density * (std::abs(B - C) + 5.0 * b - 40.0 * a)), 1.0, 1e-9);
      EXPECT_EQ(rates.carriedSink[2 * c + 1], 0.0);
      // Of both variables by both, what grows by itself, too.
      const double* slope = &slopes[4 * c];
      EXPECT_NEAR(slope[0] / (-3.0 * a * a), 1.0, 1e-5);
      EXPECT_NEAR(slope[1] / -40.0, 1.0, 1e-6);
      EXPECT_NEAR(slope[2], 0.0, 1e-6);
      EXPECT_NEAR(slope[3] / 5.0, 1.0, 1e-6);
      EXPECT_NEAR(state.eddyViscosity[c] / density, 0.25 * B * B * hoop, 1e-6);
      EXPECT_NEAR(own.eddyViscosity[c] / density, 0.25 * B * B * hoop, 1e-6);
      EXPECT_NEAR(relaxed.eddyViscosity[c], 0.8 * past + 0.2 * own.eddyViscosity[c], 1e-8 * B * B * (1.0 + hoop));
      EXPECT_NEAR(own.carriedDiffusivity[2 * c] / strain, 1.0, 1e-9);
      EXPECT_NEAR(own.carriedDiffusivity[2 * c + 1] / (std::abs(B - C) + b), 1.0, 1e-9);
    });
  }
}

// What the operator finds of the strain beside a cell.
struct StrainProbe : TwoVariables {
  static constexpr bool needsStrainGradient = true;
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    return {.eddyViscosity = cell.strain,
            .diffusivity = {cell.strainSlope[0], cell.strainSlope[1]},
            .source = {cell.strainBend, 0.0}};
  }
};

// Strain that grows sevenfold from cell to cell has the slope of its logarithm, exactly; beside a wall that the gas
// sticks to with the strain at the wall.
TEST(Turbulence, StrainHasTheSlopeOfItsLogarithm) {
  const double a = 2000.0, b = -700.0, h = 0.001;
  std::vector<Side> sides = TurbulentSquare::walls(Geometry::Planar);
  sides[1].condition.slip = false;
  TurbulentSquare square(std::make_shared<PointwiseModel<StrainProbe>>(), Geometry::Planar, sides);
  const Mesh& mesh = square.box.mesh;
  State state = square.state([&](const Vector3& x) { return Vector3{0.0, std::exp(a * x[0] + b * x[1])}; });
  TurbulenceOperator turbulence = square.turbulence(state);
  turbulence.setStart(state, {ofMolecules, ofMolecules, 2.0});
  State::Balance rates = state.balance;
  turbulence.addRates(state, rates);
  turbulence.setDiffusivities(state);
  int beside = 0;
  square.forCellsWellInside([&](std::size_t c, const Vector3& x) {
    const auto isNear = [&](double along) { return std::abs(along - 0.5 * TurbulentSquare::length) < 1.5 * h; };
    if (!isNear(x[0]) || !isNear(x[1])) return;
    EXPECT_NEAR(state.carriedDiffusivity[2 * c], a, 1e-8 * a);
    EXPECT_NEAR(state.carriedDiffusivity[2 * c + 1], b, 1e-8 * a);
    EXPECT_NEAR(rates.carried[2 * c] / state.density[c], a * a + b * b, 1e-7 * a * a);
  });
  state.updateHalo(square.box.halo);
  for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
    const auto cell = at(mesh.low[at(face)]);
    if (mesh.patch[at(face - mesh.interiorFaces)] != 1) continue;
    const auto before = std::ranges::find_if(mesh.centre, [&](const Vector3& x) {
      const Vector3& own = mesh.centre[cell];
      return std::abs(x[0] + h - own[0]) + std::abs(x[1] - own[1]) < 1e-6;
    });
    ASSERT_NE(before, mesh.centre.end());
    const auto logOf = [&](std::size_t c) { return std::log(state.eddyViscosity[c] / state.density[c]); };
    const double own = logOf(cell),
                 atWall = std::log(turbulence.atWall(face, state).shear / TurbulentSquare::viscosity);
    const double inward = (own - logOf(at(before - mesh.centre.begin()))) / h, outward = (atWall - own) / (0.5 * h);
    EXPECT_NEAR(state.carriedDiffusivity[2 * cell], (inward + 2.0 * outward) / 3.0, 1e-8 * a);
    ++beside;
  }
  EXPECT_EQ(sumOverRanks(beside), 7.0);
}

// Strain in proportion to x, whose logarithm bends: lap S/S, nearly nothing, by the differences of the logarithm.
TEST(Turbulence, StrainBendsAsItsLogarithmDoes) {
  const double a = 4e4, h = 0.001;
  TurbulentSquare square(std::make_shared<PointwiseModel<StrainProbe>>());
  State state = square.state([&](const Vector3& x) { return Vector3{0.0, 0.5 * a * x[0] * x[0]}; });
  TurbulenceOperator turbulence = square.turbulence(state);
  turbulence.setStart(state, {ofMolecules, ofMolecules, 2.0});
  State::Balance rates = state.balance;
  turbulence.addRates(state, rates);
  square.forCellsWellInside([&](std::size_t c, const Vector3& x) {
    const auto isFar = [&](double along) { return std::abs(along - 0.5 * TurbulentSquare::length) > 1.5 * h; };
    if (isFar(x[0]) || isFar(x[1])) return;
    const double before = std::log(1.0 - h / x[0]), after = std::log(1.0 + h / x[0]),
                 slope = 0.5 * (after - before) / h;
    const double bend = (after + before) / (h * h) + slope * slope;
    EXPECT_NEAR(rates.carried[2 * c] / state.density[c], bend, 1e-6 * slope * slope);
  });
}

// About an axis with swirl w = r (F + G z + H r), by the tensor written out: no strain of a gas that turns as a whole.
TEST(Turbulence, SwirlHasItsShear) {
  const double a = 2.0, b = TwoVariables::secondValue, ofMantle = 2.0;
  std::vector<Side> sides = TurbulentSquare::walls(Geometry::Axisymmetric);
  sides[1].condition.swirl = ofMantle;
  TurbulentSquare square(std::make_shared<PointwiseModel<Probe>>(), Geometry::Axisymmetric, sides);
  const Mesh& mesh = square.box.mesh;
  for (const auto& [A, B, E, F, G, H] :
       {std::array{0.0, 0.0, 0.0, 500.0, 0.0, 0.0}, {30.0, 90.0, -20.0, 500.0, 2e4, -3e4}}) {
    State state = square.state([&](const Vector3& x) { return Vector3{A * x[0], B * x[0] + E * x[1]}; }, true);
    for (int c = 0; c < mesh.cells; ++c) {
      const Vector3& x = mesh.centre[at(c)];
      state.swirl[at(c)] = x[0] * (F + G * x[1] + H * x[0]);
    }
    TurbulenceOperator turbulence = square.turbulence(state);
    turbulence.setStart(state, {ofMolecules, ofMolecules, a});
    turbulence.addRates(state, state.balance);
    turbulence.setDiffusivities(state);
    for (int face = mesh.interiorFaces; A == 0.0 && face < mesh.faces; ++face) {
      if (mesh.patch[at(face - mesh.interiorFaces)] != 1) continue;
      const double shear =
          TurbulentSquare::viscosity * std::abs(TurbulentSquare::length * F - ofMantle) / mesh.distance[at(face)];
      EXPECT_NEAR(turbulence.atWall(face, state).shear, shear, 1e-12);
    }
    square.forCellsWellInside([&](std::size_t c, const Vector3& x) {
      const double r = x[0], w = r * (F + G * x[1] + H * r), dilatation = 2.0 * A + E;
      // du_i/dx_j of the directions r, z and about the axis.
      const std::array<Vector3, 3> slope{{{A, 0.0, -w / r}, {B, E, 0.0}, {F + G * x[1] + 2.0 * H * r, r * G, A}}};
      double strains = 0.0, turns = 0.0, stretching = 0.0;
      std::array<Vector3, 3> S{}, W{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          S[i][j] = 0.5 * (slope[i][j] + slope[j][i]) - (i == j ? 0.5 * dilatation : 0.0);
          W[i][j] = 0.5 * (slope[i][j] - slope[j][i]);
          turns += 2.0 * W[i][j] * W[i][j];
          strains += 0.5 * (slope[i][j] + slope[j][i]) * (slope[i][j] + slope[j][i]);
        }
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          for (std::size_t k = 0; k < 3; ++k) stretching += W[i][j] * W[j][k] * S[k][i];
      const double strain = std::sqrt(strains - 2.0 / 3.0 * dilatation * dilatation), size = std::sqrt(turns);
      EXPECT_NEAR(state.carriedDiffusivity[2 * c], strain, 1e-9 * size);
      EXPECT_NEAR(state.carriedDiffusivity[2 * c + 1], size + b, 1e-9 * size);
      EXPECT_NEAR(state.eddyViscosity[c] / state.density[c], std::abs(stretching), 1e-9 * size * size * size);
    });
  }
}

// Eddies of heated gas: what gravity and the slope of the density make, and the share of it that makes epsilon.
struct Floating : TwoVariables {
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    return {.diffusivity = {cell.buoyancy, cell.buoyancyShare}};
  }
};

TEST(Turbulence, BuoyancyIsThatOfTheDensityAlongGravity) {
  TurbulentSquare square(std::make_shared<PointwiseModel<Floating>>());
  const Mesh& mesh = square.box.mesh;
  square.box.context.gravity = {0.0, -9.81, 0.0};
  square.box.context.eddies.schmidt = 0.7;
  State state = square.state([](const Vector3&) { return Vector3{3.0, -4.0}; });
  for (int c = 0; c < mesh.cells; ++c)
    state.density[at(c)] = 1.0 + 20.0 * mesh.centre[at(c)][0] + 30.0 * mesh.centre[at(c)][1];
  for (const bool isWanted : {false, true}) {
    TurbulenceOperator turbulence = square.turbulence(state, {.buoyancy = isWanted});
    turbulence.setStart(state, {ofMolecules, ofMolecules, 2.0});
    turbulence.addRates(state, state.balance);
    turbulence.setDiffusivities(state);
    square.forCellsWellInside([&](std::size_t c, const Vector3&) {
      const double made = 9.81 * 30.0 / state.density[c] / 0.7;  // heavier above: made
      EXPECT_NEAR(state.carriedDiffusivity[2 * c], isWanted ? made : 0.0, 1e-9 * made);
      EXPECT_NEAR(state.carriedDiffusivity[2 * c + 1], isWanted ? std::tanh(4.0 / 3.0) : 0.0, 1e-12);
    });
  }
}

}  // namespace
}  // namespace lampblack::test
