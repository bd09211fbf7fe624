// A turbulence operator: its start, its rates by gradients, what it keeps, and the streams that come in.
#include "flow/models/turbulence/turbulence_operator.hpp"

#include <gtest/gtest.h>

#include "flow/models/turbulence/turbulence_model.hpp"
#include "tests/every_module.hpp"
#include "turbulence_fixture.hpp"

namespace lampblack::test {
namespace {

// In shear, k begins with as much production as dissipation where there would be more.
TEST(Turbulence, BeginsInShearWithEddiesThatAreInBalance) {
  const double shear = 5e3, k = 0.6, balance = 0.3 * k / shear;
  for (const char* name : {"k_omega", "k_epsilon"})
    for (const double asked : {10.0 * balance, 0.1 * balance}) {
      SCOPED_TRACE(fmt::format("{} {}", name, asked));
      TurbulentSquare square(turbulenceModel(name));
      State state = square.state([&](const Vector3& x) { return Vector3{shear * x[1], 0.0}; });
      TurbulenceOperator turbulence = square.turbulence(state);
      turbulence.setStart(state, {ofMolecules, asked, k});
      square.forCellsWellInside([&](std::size_t c, const Vector3&) {
        const double density = state.density[c], eddies = std::min(asked, balance);
        const std::vector<double> values{state.carried[2 * c] / density, state.carried[2 * c + 1] / density};
        EXPECT_NEAR(values[0], k, 1e-12);
        EXPECT_NEAR(state.eddyViscosity[c] / density / eddies, 1.0, 1e-9);
        EXPECT_NEAR(square.model->dissipation(values).value() / (0.09 * k * k / eddies), 1.0, 1e-9);
      });
    }
}

// All that an operator tells of a cell without walls.
struct Listener : TwoVariables {
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
  TurbulentSquare square(std::make_shared<PointwiseModel<Listener>>());
  State state = square.state([](const Vector3& x) { return Vector3{30.0 * x[0] * x[0], 90.0 * x[0] * x[1]}; });
  TurbulenceOperator kept = square.turbulence(state);
  kept.setStart(state, {ofMolecules, ofMolecules, 2.0});
  const auto same = [&](const char* what) {
    SCOPED_TRACE(what);
    TurbulenceOperator fresh = square.turbulence(state);
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
  for (double& viscosity : square.properties.viscosity) viscosity *= 2.0;
  same("viscosities");
}

// Rates by a variable's own gradient, as a flow: of the first by its square, of the second along a direction.
struct Drifting : TwoVariables {
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const Vector3 &a = cell.gradients[0], &b = cell.gradients[1];
    return {.eddyViscosity = cell.productBeyond + 2.0 * cell.squareBeyond,
            .source = {5.0 * dot(a, a) + b[0], 7.0 * b[0] - 11.0 * b[1] + a[1]}};
  }
};

TEST(Turbulence, RatesByAGradientAreAFlowThroughFaces) {
  std::vector<Side> sides = TurbulentSquare::walls(Geometry::Planar);
  sides[0].condition.kind = BoundaryKind::Symmetry;
  sides[2].condition.slip = false;
  TurbulentSquare square(std::make_shared<PointwiseModel<Drifting>>(), Geometry::Planar, sides);
  const Mesh& m = square.box.mesh;
  const double length = TurbulentSquare::length;
  State state = square.state([](const Vector3&) { return Vector3{}; });
  TurbulenceOperator turbulence = square.turbulence(state);
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
      const bool isHeld = square.box.context.boundaryOf(face).isNoSlipWall();
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
