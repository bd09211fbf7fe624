// What turbulence does to a flow: the shear that its operator finds, how rates become sinks, and what an eddy viscosity
// spreads.
#include "flow/models/turbulence/turbulence_operator.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "flow/models/turbulence/turbulence_model.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr double ofMolecules = 1.5e-5;  // m^2/s

// Eddies of one kinematic viscosity everywhere, or of none.
struct EvenEddies {
  static constexpr bool needsWallDistance = false, needsStrainGradient = true;
  double eddies = 0.0;  // m^2/s
  [[nodiscard]] std::string name() const { return "even"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return {{"even", "m^2/s", "", 1.0}}; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const { return {stream.eddyViscosity}; }
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    return {.eddyViscosity = eddies, .diffusivity = {cell.viscosity}};
  }
};

// What the operator finds of a cell and makes of rates: a sink steeper than in proportion, and a source that grows by
// itself and falls with the other variable.
struct Probe {
  static constexpr double ofShape = 50.0;
  static constexpr bool needsWallDistance = false, needsStrainGradient = false;
  [[nodiscard]] std::string name() const { return "probe"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return {{"a", "1", ""}, {"b", "1", ""}}; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const { return {stream.energy, 3.0}; }
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
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double A = 30.0, B = 90.0, E = -20.0, length = 0.007, a = 2.0, b = 3.0;
  for (const bool isRound : {false, true}) {
    SCOPED_TRACE(isRound);
    const double C = isRound ? 0.0 : -40.0, hoop = isRound ? A : 0.0, dilatation = A + E + hoop;
    std::vector<Side> sides;
    for (const int axis : {0, 1})
      for (const bool isAtMax : {false, true})
        sides.push_back(
            side(isRound && axis == 0 && !isAtMax ? BoundaryKind::Symmetry : BoundaryKind::Wall, axis, isAtMax));
    const auto axis = uniformAxis(length, 7);
    Box box(isRound ? Geometry::Axisymmetric : Geometry::Planar, {axis, axis}, sides, gas);
    const auto model = std::make_shared<PointwiseModel<Probe>>();
    State state =
        box.stateWith({TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
                      [&](const Vector3& x) {
                        return Box::Local{{A * x[0] + C * x[1], B * x[0] + E * x[1]}, 300.0, air};
                      });
    GasProperties properties;
    properties.viscosity.assign(state.density.size(), 1.8e-5);
    TurbulenceOperator turbulence(box.context, state, model, properties);
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
    std::vector<double> slopes(4 * at(box.mesh.owned));
    turbulence.addSlopes(state, {{}, slopes});
    turbulence.advance(state, 0.0, 0.0);
    // From eddies that are not the state's own, with a halo of what is long past.
    constexpr double past = 7.0;
    State relaxed = state;
    std::ranges::fill(relaxed.eddyViscosity, past);
    State own = relaxed;
    turbulence.advance(relaxed, 0.0, 1e6);
    for (int c = box.mesh.owned; c < box.mesh.cells; ++c) {
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
    int inside = 0;
    for (int c = 0; c < box.mesh.owned; ++c) {
      const Vector3& x = box.mesh.centre[at(c)];
      if (std::max(std::abs(x[0] - 0.5 * length), std::abs(x[1] - 0.5 * length)) > 0.3 * length) continue;
      ++inside;
      const double density = state.density[at(c)];
      EXPECT_NEAR(rates.carried[at(2 * c)] / (density * (source + 2.0 * a * a * a)), 1.0, 1e-5);
      EXPECT_NEAR(rates.carriedSink[at(2 * c)] / (3.0 * a * a), 1.0, 1e-5);
      EXPECT_NEAR(rates.carried[at(2 * c)] / density - rates.carriedSink[at(2 * c)] * a, source - a * a * a, 1e-8);
      EXPECT_NEAR(rates.carried[at(2 * c + 1)] / (density * (std::abs(B - C) + 5.0 * b - 40.0 * a)), 1.0, 1e-9);
      EXPECT_EQ(rates.carriedSink[at(2 * c + 1)], 0.0);
      // Of both variables by both, what grows by itself, too.
      const double* slope = &slopes[at(4 * c)];
      EXPECT_NEAR(slope[0] / (-3.0 * a * a), 1.0, 1e-5);
      EXPECT_NEAR(slope[1] / -40.0, 1.0, 1e-6);
      EXPECT_NEAR(slope[2], 0.0, 1e-6);
      EXPECT_NEAR(slope[3] / 5.0, 1.0, 1e-6);
      EXPECT_NEAR(state.eddyViscosity[at(c)] / density, 0.25 * B * B * hoop, 1e-6);
      EXPECT_NEAR(own.eddyViscosity[at(c)] / density, 0.25 * B * B * hoop, 1e-6);
      EXPECT_NEAR(relaxed.eddyViscosity[at(c)], 0.8 * past + 0.2 * own.eddyViscosity[at(c)],
                  1e-8 * B * B * (1.0 + hoop));
      EXPECT_NEAR(own.carriedDiffusivity[at(2 * c)] / strain, 1.0, 1e-9);
      EXPECT_NEAR(own.carriedDiffusivity[at(2 * c + 1)] / (std::abs(B - C) + b), 1.0, 1e-9);
    }
    MPI_Allreduce(MPI_IN_PLACE, &inside, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(inside, 25);
  }
}

// About an axis with swirl w = r (F + G z + H r), by the tensor written out: no strain of a gas that turns as a whole.
TEST(Turbulence, SwirlHasItsShear) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double length = 0.007, a = 2.0, b = 3.0, ofMantle = 2.0;
  std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
                          side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)};
  sides[1].condition.swirl = ofMantle;
  const auto axis = uniformAxis(length, 7);
  Box box(Geometry::Axisymmetric, {axis, axis}, sides, gas);
  const auto model = std::make_shared<PointwiseModel<Probe>>();
  GasProperties properties;
  for (const auto& [A, B, E, F, G, H] :
       {std::array{0.0, 0.0, 0.0, 500.0, 0.0, 0.0}, {30.0, 90.0, -20.0, 500.0, 2e4, -3e4}}) {
    State state = box.stateWith(
        {TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
        [&](const Vector3& x) {
          return Box::Local{{A * x[0], B * x[0] + E * x[1]}, 300.0, air};
        },
        true);
    for (int c = 0; c < box.mesh.cells; ++c) {
      const Vector3& x = box.mesh.centre[at(c)];
      state.swirl[at(c)] = x[0] * (F + G * x[1] + H * x[0]);
    }
    properties.viscosity.assign(state.density.size(), 1.8e-5);
    TurbulenceOperator turbulence(box.context, state, model, properties);
    turbulence.setStart(state, {ofMolecules, ofMolecules, a});
    turbulence.addRates(state, state.balance);
    turbulence.setDiffusivities(state);
    for (int face = box.mesh.interiorFaces; A == 0.0 && face < box.mesh.faces; ++face) {
      if (box.mesh.patch[at(face - box.mesh.interiorFaces)] != 1) continue;
      const double shear = 1.8e-5 * std::abs(length * F - ofMantle) / box.mesh.distance[at(face)];
      EXPECT_NEAR(turbulence.atWall(face, state).shear, shear, 1e-12);
    }
    for (int c = 0; c < box.mesh.owned; ++c) {
      const Vector3& x = box.mesh.centre[at(c)];
      if (std::max(std::abs(x[0] - 0.5 * length), std::abs(x[1] - 0.5 * length)) > 0.3 * length) continue;
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
      EXPECT_NEAR(state.carriedDiffusivity[at(2 * c)], strain, 1e-9 * size);
      EXPECT_NEAR(state.carriedDiffusivity[at(2 * c + 1)], size + b, 1e-9 * size);
      EXPECT_NEAR(state.eddyViscosity[at(c)] / state.density[at(c)], std::abs(stretching), 1e-9 * size * size * size);
    }
  }
}

// Eddies of heated gas: what gravity and the slope of the density make, and the share of it that makes epsilon.
struct Floating {
  static constexpr bool needsWallDistance = false, needsStrainGradient = false;
  [[nodiscard]] std::string name() const { return "floating"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return {{"a", "1", ""}, {"b", "1", ""}}; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream&) const { return {2.0, 3.0}; }
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    return {.diffusivity = {cell.buoyancy, cell.buoyancyShare}};
  }
};

TEST(Turbulence, BuoyancyIsThatOfTheDensityAlongGravity) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const auto axis = uniformAxis(0.007, 7);
  Box box(Geometry::Planar, {axis, axis},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)},
          gas);
  box.context.gravity = {0.0, -9.81, 0.0};
  box.context.eddies.schmidt = 0.7;
  const auto model = std::make_shared<PointwiseModel<Floating>>();
  State state = box.stateWith({TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
                              [&](const Vector3&) {
                                return Box::Local{{3.0, -4.0}, 300.0, air};
                              });
  for (int c = 0; c < box.mesh.cells; ++c)
    state.density[at(c)] = 1.0 + 20.0 * box.mesh.centre[at(c)][0] + 30.0 * box.mesh.centre[at(c)][1];
  GasProperties properties;
  properties.viscosity.assign(state.density.size(), 1.8e-5);
  for (const bool isWanted : {false, true}) {
    TurbulenceOperator turbulence(box.context, state, model, properties, {.buoyancy = isWanted});
    turbulence.setStart(state, {ofMolecules, ofMolecules, 2.0});
    turbulence.addRates(state, state.balance);
    turbulence.setDiffusivities(state);
    for (int c = 0; c < box.mesh.owned; ++c) {
      const Vector3& x = box.mesh.centre[at(c)];
      if (std::max(std::abs(x[0] - 0.0035), std::abs(x[1] - 0.0035)) > 0.0021) continue;
      const double made = 9.81 * 30.0 / state.density[at(c)] / 0.7;  // heavier above: made
      EXPECT_NEAR(state.carriedDiffusivity[at(2 * c)], isWanted ? made : 0.0, 1e-9 * made);
      EXPECT_NEAR(state.carriedDiffusivity[at(2 * c + 1)], isWanted ? std::tanh(4.0 / 3.0) : 0.0, 1e-12);
    }
  }
}

// In shear, k begins with as much production as dissipation where there would be more.
TEST(Turbulence, BeginsInShearWithEddiesThatAreInBalance) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double shear = 5e3, k = 0.6, balance = 0.3 * k / shear;
  std::vector<Side> sides;
  for (const int axis : {0, 1})
    for (const bool isAtMax : {false, true}) sides.push_back(side(BoundaryKind::Wall, axis, isAtMax));
  const auto axis = uniformAxis(0.007, 7);
  Box box(Geometry::Planar, {axis, axis}, sides, gas);
  for (const char* name : {"k_omega", "k_epsilon"})
    for (const double asked : {10.0 * balance, 0.1 * balance}) {
      SCOPED_TRACE(fmt::format("{} {}", name, asked));
      const auto model = turbulenceModel(name);
      const std::vector<FreeStream> none(4, {ofMolecules, ofMolecules, k});
      State state =
          box.stateWith({TurbulenceOperator::blockOf(*model, box.context.boundaries, none)}, [&](const Vector3& x) {
            return Box::Local{{shear * x[1], 0.0}, 300.0, air};
          });
      GasProperties properties;
      properties.viscosity.assign(state.density.size(), 1.8e-5);
      TurbulenceOperator turbulence(box.context, state, model, properties);
      turbulence.setStart(state, {ofMolecules, asked, k});
      int inside = 0;
      for (int c = 0; c < box.mesh.owned; ++c) {
        const Vector3& x = box.mesh.centre[at(c)];
        if (std::max(std::abs(x[0] - 0.0035), std::abs(x[1] - 0.0035)) > 0.0021) continue;
        ++inside;
        const double density = state.density[at(c)], eddies = std::min(asked, balance);
        const std::vector<double> values{state.carried[at(2 * c)] / density, state.carried[at(2 * c + 1)] / density};
        EXPECT_NEAR(values[0], k, 1e-12);
        EXPECT_NEAR(state.eddyViscosity[at(c)] / density / eddies, 1.0, 1e-9);
        EXPECT_NEAR(model->dissipation(values).value() / (0.09 * k * k / eddies), 1.0, 1e-9);
      }
      MPI_Allreduce(MPI_IN_PLACE, &inside, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
      EXPECT_EQ(inside, 25);
    }
}

// All that an operator tells of a cell without walls.
struct Listener {
  static constexpr bool needsWallDistance = false, needsStrainGradient = false;
  [[nodiscard]] std::string name() const { return "listener"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return {{"a", "1", ""}, {"b", "1", ""}}; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const { return {stream.energy, 3.0}; }
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const double a = cell.values[0], b = cell.values[1];
    return {.eddyViscosity = cell.viscosity * b,
            .diffusivity = {cell.viscosity, cell.densityGradient[0]},
            .source = {cell.strain + cell.viscosity, cell.vorticity * b + cell.densityGradient[1]},
            .sink = {a * a, b}};
  }
};

// What was found is kept while all that it is of stays, and no longer.
TEST(Turbulence, WhatIsAskedAgainIsOfWhatThereIsNow) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const auto axis = uniformAxis(0.007, 7);
  Box box(Geometry::Planar, {axis, axis},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)},
          gas);
  const auto model = std::make_shared<PointwiseModel<Listener>>();
  State state = box.stateWith({TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
                              [&](const Vector3& x) {
                                return Box::Local{{30.0 * x[0] * x[0], 90.0 * x[0] * x[1]}, 300.0, air};
                              });
  GasProperties properties;
  properties.viscosity.assign(state.density.size(), 1.8e-5);
  TurbulenceOperator kept(box.context, state, model, properties);
  kept.setStart(state, {ofMolecules, ofMolecules, 2.0});
  const auto same = [&](const char* what) {
    SCOPED_TRACE(what);
    TurbulenceOperator fresh(box.context, state, model, properties);
    State ofKept = state, ofFresh = state;
    for (int again = 0; again < 2; ++again) {
      ofKept = state;
      kept.addRates(state, ofKept.balance);
      kept.setDiffusivities(ofKept);
    }
    fresh.addRates(state, ofFresh.balance);
    fresh.setDiffusivities(ofFresh);
    EXPECT_EQ(ofKept.balance.carried, ofFresh.balance.carried);
    EXPECT_EQ(ofKept.balance.carriedSink, ofFresh.balance.carriedSink);
    EXPECT_EQ(ofKept.carriedDiffusivity, ofFresh.carriedDiffusivity);
    EXPECT_EQ(ofKept.eddyViscosity, ofFresh.eddyViscosity);
  };
  same("first");
  state.velocity[at(2 * 3)] += 0.1;
  same("a velocity");
  state.carried[at(2 * 4 + 1)] *= 1.3;
  same("a variable");
  state.density[at(5)] *= 1.1;
  same("a density");
  for (double& viscosity : properties.viscosity) viscosity *= 2.0;
  same("viscosities");
}

// Rates by a variable's own gradient, as a flow: of the first by its square, of the second along a direction.
struct Drifting {
  static constexpr bool needsWallDistance = false, needsStrainGradient = false;
  [[nodiscard]] std::string name() const { return "drifting"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return {{"a", "1", ""}, {"b", "1", ""}}; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream&) const { return {2.0, 3.0}; }
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const Vector3 &a = cell.gradients[0], &b = cell.gradients[1];
    return {.eddyViscosity = cell.productBeyond + 2.0 * cell.squareBeyond,
            .source = {5.0 * dot(a, a) + b[0], 7.0 * b[0] - 11.0 * b[1] + a[1]}};
  }
};

TEST(Turbulence, RatesByAGradientAreAFlowThroughFaces) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
                          side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)};
  sides[2].condition.slip = false;
  const double length = 0.007;
  Box box(Geometry::Planar, {uniformAxis(length, 7), uniformAxis(length, 7)}, sides, gas);
  const Mesh& m = box.mesh;
  const auto model = std::make_shared<PointwiseModel<Drifting>>();
  State state = box.stateWith({TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
                              [&](const Vector3&) {
                                return Box::Local{{0.0, 0.0}, 300.0, air};
                              });
  GasProperties properties;
  properties.viscosity.assign(state.density.size(), 1.8e-5);
  TurbulenceOperator turbulence(box.context, state, model, properties);
  const double A = 100.0, B = -60.0, density = state.density[0];
  for (int c = 0; c < m.cells; ++c) {
    const Vector3& x = m.centre[at(c)];
    state.carried[at(2 * c)] = density * (1.0 + A * x[0] + B * x[1]);
    state.carried[at(2 * c + 1)] = density * (1.0 + A * x[1]);
  }
  State::Balance rates = state.balance;
  turbulence.addRates(state, rates);
  std::vector<double> flow(at(2 * m.faces), 1.0);
  turbulence.addCarriedFlow(flow);
  int inside = 0;
  for (int face = 0; face < m.faces; ++face) {
    const Vector3 &n = m.normal[at(face)], &x = m.faceCentre[at(face)];
    if (m.high[at(face)] < 0) {
      // Where nothing is given the gradient is not the rate's.
      const bool isHeld = box.context.boundaryOf(face).isNoSlipWall();
      const double along = isHeld ? -7.0 * n[0] + 11.0 * n[1] : 0.0;
      EXPECT_NEAR(flow[at(2 * face + 1)] - 1.0, density * m.area[at(face)] * along, 1e-7);
      continue;
    }
    if (std::max(std::abs(x[0] - 0.5 * length), std::abs(x[1] - 0.5 * length)) > 0.25 * length) continue;
    ++inside;
    const double size = density * m.area[at(face)];
    EXPECT_NEAR((flow[at(2 * face)] - 1.0) / size, -10.0 * (A * n[0] + B * n[1]), 0.2);
    EXPECT_NEAR((flow[at(2 * face + 1)] - 1.0) / size, -7.0 * n[0] + 11.0 * n[1], 1e-6);
  }
  MPI_Allreduce(MPI_IN_PLACE, &inside, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_GE(inside, 20);
  // Parabolas: (h/2)^2 a'' b'' of the product, (h/2)^2 b''^2 of the square.
  for (int c = 0; c < m.cells; ++c) {
    const double y = m.centre[at(c)][1];
    state.carried[at(2 * c)] = density * 1e3 * y * y;
    state.carried[at(2 * c + 1)] = density * (1.0 + 2e3 * y * y);
  }
  turbulence.setDiffusivities(state);
  for (int c = 0; c < m.owned; ++c) {
    if (std::abs(m.centre[at(c)][1] - 0.5 * length) > 0.3 * length) continue;
    EXPECT_NEAR(state.eddyViscosity[at(c)] / density, 2.0 + 2.0 * 4.0, 1e-6);
  }
}

// A stream of fuel into warm air beside a wall, with a passive scalar that eddies spread.
State mixed(std::optional<double> eddies, int sweeps, std::optional<Split> split, EddyNumbers numbers = {}) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79"), fuel = gas.massFractions("H2: 1, N2: 4");
  std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
                          opening(BoundaryKind::Inlet, 1, false, 0.5, 400.0, air),
                          opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)};
  sides[1].condition.slip = false;
  sides[1].condition.isothermal = true;
  sides[1].condition.temperature = 350.0;
  Box box(Geometry::Planar, {uniformAxis(0.006, 6), uniformAxis(0.012, 12)}, sides, gas, split);
  box.context.eddies = numbers;
  std::vector<ScalarBlock> blocks{{"dust", {{"dust", "1/m^3", "", 0.55}}}};
  const auto model = std::make_shared<PointwiseModel<EvenEddies>>(EvenEddies{eddies.value_or(0.0)});
  if (eddies) blocks.push_back(TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4)));
  State state = box.stateWith(blocks, [&](const Vector3& x) {
    return Box::Local{{0.0, 0.5}, 400.0 + 1e4 * x[0], x[1] < 0.005 ? air : fuel};
  });
  const std::size_t n = state.scalars.size();
  for (int c = 0; c < box.mesh.cells; ++c) {
    state.carried[at(c) * n] = 1.0 + std::sin(700.0 * box.mesh.centre[at(c)][0]);
    state.carriedDiffusivity[at(c) * n] = 1e-5;
  }
  TransportOperator transport(box.context, state, {.sweeps = sweeps});
  std::optional<TurbulenceOperator> turbulence;
  if (eddies) turbulence.emplace(box.context, state, model, transport.properties());
  if (turbulence) turbulence->setStart(state, {ofMolecules, *eddies, 0.0});
  transport.initialise(state, 1e-4);
  if (turbulence) turbulence->endSweep(state);
  for (int i = 0; i < 4; ++i)
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      transport.advance(state, i * 1e-4, 1e-4);
      if (turbulence) turbulence->advance(state, i * 1e-4, 1e-4);
      transport.endSweep(state);
      if (turbulence) turbulence->endSweep(state);
    }
  return state;
}

TEST(Turbulence, NoEddyViscosityIsALaminarFlow) {
  for (const auto& split : {std::optional<Split>(), std::optional<Split>(Split{Cells::Triangles})})
    for (const int sweeps : {1, 2}) {
      SCOPED_TRACE(fmt::format("{} sweeps, {}", sweeps, split ? "triangles" : "rectangles"));
      const State laminar = mixed({}, sweeps, split), none = mixed(0.0, sweeps, split),
                  some = mixed(1e-4, sweeps, split);
      for (const auto field : {&State::velocity, &State::temperature, &State::Y, &State::massFlux}) {
        EXPECT_EQ(none.*field, laminar.*field);
        EXPECT_NE(some.*field, laminar.*field);
      }
      double moved = 0.0;
      for (std::size_t c = 0; c < laminar.density.size(); ++c) {
        EXPECT_EQ(none.carried[2 * c], laminar.carried[c]);
        moved = std::max(moved, std::abs(some.carried[2 * c] - laminar.carried[c]));
      }
      EXPECT_GT(moved, 1e-3);
    }
}

// Heat, species and a scalar between two walls or faces spread by molecules and eddies together. One dimension, one
// cosine of each: its amplitude decays at (D + nu_t/Sc_t) (pi/L)^2.
TEST(Turbulence, EddiesSpreadByTheirNumbers) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  const double length = 0.01, eddies = 1e-3, wave = std::numbers::pi / length;
  const EddyNumbers numbers{0.5, 0.8};
  std::vector<Side> sides{side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true),
                          side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  Box box(Geometry::Planar, {uniformAxis(length, 40), uniformAxis(1e-3, 2)}, sides, gas);
  box.context.eddies = numbers;
  const auto model = std::make_shared<PointwiseModel<EvenEddies>>(EvenEddies{eddies});
  State state = box.stateWith({{"dust", {{"dust", "1/m^3", ""}}},
                               TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
                              [&](const Vector3& x) {
                                std::vector<double> Y = air;
                                const double more = 1e-4 * std::cos(wave * x[0]);
                                Y[gas.mechanism.speciesIndex("O2")] += more;
                                Y[gas.mechanism.speciesIndex("N2")] -= more;
                                return Box::Local{{}, 300.0 + 0.1 * std::cos(wave * x[0]), Y};
                              });
  for (int c = 0; c < box.mesh.cells; ++c)
    state.carried[at(2 * c)] = state.density[at(c)] * (1.0 + 0.1 * std::cos(wave * box.mesh.centre[at(c)][0]));
  TransportOperator transport(box.context, state);
  TurbulenceOperator turbulence(box.context, state, model, transport.properties());
  const double dt = 1e-4;
  turbulence.setStart(state, {ofMolecules, eddies, 0.0});
  transport.initialise(state, dt);
  turbulence.endSweep(state);
  const std::size_t oxygen = gas.mechanism.speciesIndex("O2"), n = air.size();
  const auto amplitudes = [&] {
    std::array<double, 3> found{};
    for (int c = 0; c < box.mesh.owned; ++c) {
      const double weight = std::cos(wave * box.mesh.centre[at(c)][0]);
      found[0] += weight * state.temperature[at(c)];
      found[1] += weight * state.Y[at(c) * n + oxygen];
      found[2] += weight * state.carried[at(2 * c)] / state.density[at(c)];
    }
    MPI_Allreduce(MPI_IN_PLACE, found.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return found;
  };
  const auto before = amplitudes();
  const int steps = 40;
  for (int i = 0; i < steps; ++i) {
    transport.advance(state, i * dt, dt);
    turbulence.advance(state, i * dt, dt);
    transport.endSweep(state);
    turbulence.endSweep(state);
  }
  const auto after = amplitudes();
  const GasProperties& gasOf = transport.properties();
  const double density = state.density[0];
  const std::array<double, 3> diffusivities{
      gasOf.conductivity[0] / (density * gasOf.heatCapacity[0]) + eddies / numbers.prandtl,
      gasOf.massDiffusivity[oxygen] / density + eddies / numbers.schmidt, eddies / numbers.schmidt};
  for (std::size_t i = 0; i < 3; ++i) {
    // Of implicit steps of first order.
    const double exact = std::pow(1.0 + dt * diffusivities[i] * wave * wave, -steps);
    EXPECT_NEAR(std::log(after[i] / before[i]) / std::log(exact), 1.0, 5e-3) << i;
  }
}

// The block of the carried scalars has at each place of an inlet what the model makes of the stream there.
TEST(Turbulence, AStreamThatVariesComesInAsItIsThere) {
  const auto model = turbulenceModel("k_epsilon");
  BoundaryCondition inlet, wall;
  inlet.kind = BoundaryKind::Inlet;
  const FreeStream stream{.viscosity = ofMolecules,
                          .energyAt = [](const Vector3& place, double) { return 2.0 + place[0]; },
                          .dissipationAt = [](const Vector3& place, double) { return 30.0 * place[1]; }};
  const ScalarBlock block = TurbulenceOperator::blockOf(*model, {inlet, wall}, {stream, {}});
  const Vector3 place{0.5, 2.0, 0.0};
  EXPECT_NEAR(block.scalars[0].boundaries[0].at(place), 2.5, 1e-14);
  EXPECT_NEAR(block.scalars[1].boundaries[0].at(place), 60.0, 1e-12);
  EXPECT_TRUE(block.scalars[1].boundaries[0].isHeld);
  EXPECT_EQ(block.scalars[0].boundaries[1].at(place), 0.0);
}

}  // namespace
}  // namespace lampblack::test
