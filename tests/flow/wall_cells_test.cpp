// The law of the wall in a flow: friction and heat of a gas beside a wall, and what it makes of the turbulence in the
// cells there.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/errors.hpp"
#include "flow/discretisation/velocity_gradient.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "tests/every_module.hpp"
#include "wall_corner.hpp"

namespace lampblack::test {
namespace {

TEST(WallLaw, FrictionAndHeatOfAGasAreThoseOfTheLaw) {
  for (const double k : {0.5, 1e-5}) {
    SCOPED_TRACE(k);
    WallCorner corner(k);
    const Mesh& m = corner.box.mesh;
    const bool isLogarithmic = k > 0.1;
    for (int face = m.interiorFaces; face < m.faces; ++face) {
      if (corner.box.context.boundaryOf(face).kind != BoundaryKind::Wall) continue;
      const auto b = at(face - m.interiorFaces), c = at(m.low[face]);
      const double viscosity = corner.properties.boundaryViscosity[b], rho = corner.state.density[c];
      const double conductivity = corner.properties.boundaryConductivity[b], cp = corner.properties.heatCapacity[c];
      const double uStar = std::pow(0.09, 0.25) * std::sqrt(k), yStar = rho * uStar * m.distance[face] / viscosity;
      EXPECT_EQ(yStar > 11.6, isLogarithmic);
      const double friction = corner.properties.effectiveBoundaryViscosity()[b] / m.distance[face];  // of 1 m/s
      const double heat = corner.properties.effectiveBoundaryConductivity()[b] / m.distance[face];   // of 1 K
      if (!isLogarithmic) {
        EXPECT_NEAR(friction / (viscosity / m.distance[face]), 1.0, 1e-12);
        EXPECT_NEAR(heat / (conductivity / m.distance[face]), 1.0, 1e-12);
        continue;
      }
      const double uPlus = std::log(9.8 * yStar) / 0.41, prandtl = viscosity * cp / conductivity,
                   ratio = prandtl / 0.85;
      const double more = 9.24 * (std::pow(ratio, 0.75) - 1.0) * (1.0 + 0.28 * std::exp(-0.007 * ratio));
      EXPECT_NEAR(friction / (rho * uStar / uPlus), 1.0, 1e-10);
      EXPECT_NEAR(heat / (rho * cp * uStar / (0.85 * (uPlus + more))), 1.0, 1e-10);
    }
  }
}

// Friction, y+ and heat of each face of a wall: of gas at 320 K along one at 300 K.
TEST(WallLaw, WallsTellEachFace) {
  WallCorner corner(0.5);
  const Mesh& m = corner.box.mesh;
  TransportOperator transport(corner.box.context, corner.state);
  transport.adopt(corner.state);
  const double rho = corner.state.density[0], uStar = std::pow(0.09, 0.25) * std::sqrt(0.5);
  for (int wall = 0; wall < 3; wall += 2) {
    const std::vector<WallFace> faces = transport.wallFaces(corner.state, wall);
    EXPECT_EQ(faces.size(), m.rank > 0 ? 0U : wall == 0 ? 2U : 3U);
    const GasProperties& of = transport.properties();
    for (const WallFace& face : faces) {
      const auto along = at(wall == 0 ? 1 : 0);
      const double speed = wall == 0 ? corner.v : corner.u;
      EXPECT_NEAR(face.place[1 - along], 0.0, 1e-12);
      EXPECT_NEAR(face.area, 0.01, 1e-12);
      EXPECT_GT(face.friction[along], 0.0);
      EXPECT_NEAR(face.friction[1 - along], 0.0, 1e-9);
      // Half a centimetre from it. y+ by the friction, y* by k.
      const double yStar = face.yPlus * rho * uStar / std::sqrt(rho * face.friction[along]);
      EXPECT_NEAR(face.friction[along] / (rho * uStar * speed / walllaw::velocity(yStar)), 1.0, 1e-3);
      EXPECT_NEAR(face.heatFlux / (-20.0 * rho * uStar * of.heatCapacity[0] / walllaw::scalar(yStar, 0.715, 0.85)), 1.0,
                  0.03);
    }
  }
}

TEST(WallLaw, CellsBesideWallsHaveItsRatesAndACornerThoseOfBothWalls) {
  WallCorner corner(0.5);
  const Mesh& m = corner.box.mesh;
  TurbulenceOperator turbulence(corner.box.context, corner.state, corner.model, corner.properties);
  State::Balance rates = corner.state.balance;
  turbulence.addRates(corner.state, rates);
  VelocityGradient gradient(corner.box.context);
  gradient.setBoundary(corner.state.velocity);
  gradient.compute(corner.state.velocity);
  for (int c = 0; c < m.owned; ++c) {
    const bool isLeft = m.centre[at(c)][0] < 0.01, isLow = m.centre[at(c)][1] < 0.01;
    const double rho = corner.state.density[at(c)], nu = corner.properties.viscosity[at(c)] / rho;
    // Half a cell of 1 cm from each.
    const walllaw::Layer left = walllaw::layer(0.5, corner.v, nu, 0.005),
                         low = walllaw::layer(0.5, corner.u, nu, 0.005);
    const double net = rates.carried[at(3 * c + 1)] / rho - rates.carriedSink[at(3 * c + 1)] * 0.5;
    const double held = rates.carried[at(3 * c + 2)] / rho / rates.carriedSink[at(3 * c + 2)];
    if (!isLeft && !isLow) {
      EXPECT_LT(rates.carriedSink[at(3 * c + 2)], 1e3 * 20.0 / 0.5);  // the model's own
      continue;
    }
    double produced = 0.0;
    if (isLeft) produced += left.production * (isLow ? 0.5 : 1.0);
    if (isLow) produced += low.production * (isLeft ? 0.5 : 1.0);
    const double expands = gradient.dilatation(c, corner.state.velocity);
    EXPECT_NEAR(net, produced - low.dissipation - 2.0 / 3.0 * 0.5 * expands, 1e-9 * low.dissipation);
    EXPECT_NEAR(held / low.dissipation, 1.0, 1e-9);
    EXPECT_GT(rates.carriedSink[at(3 * c + 2)], 1e3 * low.dissipation / 0.5);
  }
}

// The same of a k-omega model by both layers: friction, production, omega that is held, and the shear that its eddies
// see.
TEST(WallLaw, AModelOfOmegaHasBothLayersAtOnce) {
  for (const double k : {0.5, 1e-5}) {
    SCOPED_TRACE(k);
    WallCorner corner(k, "k_omega", true);
    const Mesh& m = corner.box.mesh;
    TurbulenceOperator turbulence(corner.box.context, corner.state, corner.model, corner.properties);
    State::Balance rates = corner.state.balance;
    turbulence.addRates(corner.state, rates);
    turbulence.setDiffusivities(corner.state);
    VelocityGradient gradient(corner.box.context);
    gradient.setBoundary(corner.state.velocity);
    gradient.compute(corner.state.velocity);
    for (int c = 0; c < m.owned; ++c) {
      const bool isLeft = m.centre[at(c)][0] < 0.01, isLow = m.centre[at(c)][1] < 0.01;
      const double rho = corner.state.density[at(c)], nu = corner.properties.viscosity[at(c)] / rho;
      if (!isLeft && !isLow) continue;
      const walllaw::Layer left = walllaw::blendedLayer(k, corner.v, nu, 0.005, 0.0708),
                           low = walllaw::blendedLayer(k, corner.u, nu, 0.005, 0.0708);
      const double net = rates.carried[at(3 * c + 1)] / rho - rates.carriedSink[at(3 * c + 1)] * k;
      const double held = rates.carried[at(3 * c + 2)] / rho / rates.carriedSink[at(3 * c + 2)];
      const double ofLeft = !isLeft ? 0.0 : isLow ? 0.5 : 1.0;
      const double produced = ofLeft * left.production + (1.0 - ofLeft) * low.production;
      const double strain = ofLeft * left.strain + (1.0 - ofLeft) * low.strain;
      const double expands = gradient.dilatation(c, corner.state.velocity);
      EXPECT_NEAR(net, produced - low.dissipation - 2.0 / 3.0 * k * expands, 1e-9 * (produced + low.dissipation));
      EXPECT_NEAR(held * held * low.frequency, 1.0, 1e-9);
      // g as it is, 20, in the eddy viscosity: the shear's limit counts.
      EXPECT_NEAR(corner.state.eddyViscosity[at(c)] / (rho * k / (0.875 * strain / 0.3)), 1.0, 1e-9);
    }
    for (int face = m.interiorFaces; face < m.faces; ++face) {
      if (corner.box.context.boundaryOf(face).kind != BoundaryKind::Wall) continue;
      const auto b = at(face - m.interiorFaces), c = at(m.low[at(face)]);
      const double viscosity = corner.properties.boundaryViscosity[b], rho = corner.state.density[c];
      const double yStar = rho * std::pow(0.09, 0.25) * std::sqrt(k) * m.distance[at(face)] / viscosity;
      EXPECT_NEAR(corner.properties.effectiveBoundaryViscosity()[b] / viscosity / walllaw::blended(yStar).friction, 1.0,
                  1e-10);
    }
  }
  EXPECT_THROW((void)turbulenceModel("sa", {.blendsLayers = true}), InputError);
}

// Beside a wall a k-epsilon model that resolves the layers has epsilon of both: 2 nu k/y^2 and u*^3/(kappa y), the root
// of their squares' sum.
TEST(WallLaw, AModelOfEpsilonHasBothLayersAtOnce) {
  for (const double k : {0.5, 1e-5}) {
    WallCorner corner(k, "k_epsilon", true);
    const Mesh& m = corner.box.mesh;
    corner.box.context.wallDistance.assign(at(m.owned), 0.005);
    TurbulenceOperator turbulence(corner.box.context, corner.state, corner.model, corner.properties);
    State::Balance rates = corner.state.balance;
    turbulence.addRates(corner.state, rates);
    int beside = 0;
    for (int c = 0; c < m.owned; ++c) {
      if (m.centre[at(c)][0] > 0.01 && m.centre[at(c)][1] > 0.01) continue;
      ++beside;
      const double rho = corner.state.density[at(c)], nu = corner.properties.viscosity[at(c)] / rho;
      const double friction = std::pow(0.09, 0.25) * std::sqrt(k), y = 0.005;
      const double exact = std::hypot(2.0 * nu * k / (y * y), std::pow(friction, 3) / (0.41 * y));
      const double held = rates.carried[at(3 * c + 2)] / rho / rates.carriedSink[at(3 * c + 2)];
      EXPECT_NEAR(held / exact, 1.0, 1e-9);
    }
    MPI_Allreduce(MPI_IN_PLACE, &beside, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(beside, 4);
  }
}

// First centres 5 mm from the left wall, of 2 cm, and 2.5 mm from the lower one, of 3 cm; the gas moves at 10^(1/2)
// m/s.
TEST(WallLaw, ThinCellsAreCountedBeforeARun) {
  struct Row {
    double viscosity, share, mostYPlus;  // m^2/s; y+ is a tenth of the speed times the distance over the viscosity
  };
  const double speed = std::sqrt(10.0);
  for (const Row& of :
       {Row{1e-3, 1.0, 0.1 * speed * 0.005 / 1e-3}, Row{1e-4, 0.6, 0.1 * speed * 0.0025 / 1e-4}, Row{1e-5, 0.0, 0.0}}) {
    WallCorner corner(0.5, "k_epsilon", false, 4);
    for (int c = 0; c < corner.box.mesh.cells; ++c)
      corner.properties.viscosity[at(c)] = of.viscosity * corner.state.density[at(c)];
    const TurbulenceOperator turbulence(corner.box.context, corner.state, corner.model, corner.properties);
    const TurbulenceOperator::ThinCells thin = turbulence.thinCells(corner.state);
    EXPECT_NEAR(thin.share, of.share, 1e-12);
    EXPECT_NEAR(thin.mostYPlus, of.mostYPlus, 1e-9);
    EXPECT_NEAR(thin.speed, speed, 1e-12);
  }
  WallCorner corner(0.5, "k_omega", true);
  const TurbulenceOperator other(corner.box.context, corner.state, corner.model, corner.properties);
  EXPECT_EQ(other.thinCells(corner.state).share, 0.0);
}

// y+ and friction that are told; walls do not hold k and epsilon.
TEST(WallLaw, TellsFrictionAndWhatIsOutOfItsRange) {
  for (const double k : {0.5, 1e-5}) {
    WallCorner corner(k);
    const Mesh& m = corner.box.mesh;
    TurbulenceOperator turbulence(corner.box.context, corner.state, corner.model, corner.properties);
    const auto columns = turbulence.historyColumns();
    const auto values = turbulence.historyValues(corner.state);
    const auto value = [&](const char* name) {
      for (std::size_t i = 0; i < columns.size(); ++i)
        if (columns[i].name == name) return values[i];
      return -1.0;
    };
    double shear = 0.0, area = 0.0;
    for (int face = m.interiorFaces; face < m.faces; ++face) {
      if (corner.box.context.boundaryOf(face).kind != BoundaryKind::Wall) continue;
      EXPECT_FALSE(corner.state.scalars[1].boundaries[at(m.patch[at(face - m.interiorFaces)])].isHeld);
      const double speed = std::abs(m.normal[face][0]) > 0.5 ? corner.v : corner.u;
      shear += m.area[face] * speed * corner.properties.effectiveBoundaryViscosity()[at(face - m.interiorFaces)] /
               m.distance[face];
      area += m.area[face];
    }
    std::array<double, 2> sums{shear, area};
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_NEAR(value("wall_shear") / (sums[0] / sums[1]), 1.0, 1e-10);
    EXPECT_EQ(value("y_plus_outside") > 0.5, k < 0.1);
    EXPECT_EQ(turbulence.warning().empty(), k > 0.1);
  }
}

}  // namespace
}  // namespace lampblack::test
