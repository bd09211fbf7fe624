// What walls take of particles behind the layers for which the law of the wall stands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "flow/equations/flow_residual.hpp"
#include "flow/properties/wall_transfer.hpp"
#include "tests/every_module.hpp"
#include "wall_corner.hpp"

namespace lampblack::test {
namespace {

// Dust that walls take, by its Schmidt number: the lesser of both layers' resistances.
TEST(WallLaw, WallsTakeDustByItsSchmidtNumber) {
  for (const double k : {0.5, 1e-5}) {
    SCOPED_TRACE(k);
    WallCorner corner(k);
    const Mesh& m = corner.box.mesh;
    for (int c = 0; c < m.cells; ++c) corner.state.carried[at(3 * c)] = 2.0 * corner.state.density[at(c)];
    FlowResidual residual(corner.box.context, corner.state, VelocityScheme::Limited, {});
    residual.evaluate(corner.state);
    std::vector<double> conductance(at(m.faces) * 3), flux(conductance.size());
    residual.carried().diffusiveFlux(corner.state, residual.faces(), residual.properties(), conductance, flux);
    for (int face = m.interiorFaces; face < m.faces; ++face) {
      if (corner.box.context.boundaryOf(face).kind != BoundaryKind::Wall) continue;
      const auto b = at(face - m.interiorFaces), c = at(m.low[face]);
      const double rho = corner.state.density[c], viscosity = residual.properties().boundaryViscosity[b];
      const double uStar = std::pow(0.09, 0.25) * std::sqrt(k), yStar = rho * uStar * m.distance[face] / viscosity;
      const double ratio = viscosity / (rho * 3e-8) / 0.7;
      const double plus =
          std::log(9.8 * yStar) / 0.41 + 9.24 * (std::pow(ratio, 0.75) - 1.0) * (1.0 + 0.28 * std::exp(-0.007 * ratio));
      const double taken = rho * uStar / (0.7 * std::min(plus, ratio * yStar));
      EXPECT_NEAR(conductance[at(face) * 3] / (m.area[face] * taken), 1.0, 1e-9);
      EXPECT_NEAR(flux[at(face) * 3] / (2.0 * m.area[face] * taken), 1.0, 1e-9);
      EXPECT_EQ(flux[at(face) * 3 + 1], 0.0);
    }
  }
}

// Of the way to a wall what is not the eddies' is the still layer's: of dust that diffuses as heat does up to y* 3.4 by
// molecules alone, of what diffuses better by its own Schmidt number, of dust that hardly diffuses all that the law
// adds.
TEST(WallLaw, WhatDiffusesWellHasTheStillLayerAlone) {
  WallCorner corner(0.5);
  const Mesh& m = corner.box.mesh;
  FlowResidual residual(corner.box.context, corner.state, VelocityScheme::Limited, {});
  residual.evaluate(corner.state);
  const GasProperties& of = residual.properties();
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (corner.box.context.boundaryOf(face).kind != BoundaryKind::Wall) continue;
    const auto b = at(face - m.interiorFaces), c = at(m.low[face]);
    const double rho = corner.state.density[c], viscosity = of.boundaryViscosity[b];
    const double prandtl = viscosity * of.heatCapacity[c] / of.boundaryConductivity[b];
    const double perNumber = rho * std::pow(0.09, 0.25) * std::sqrt(0.5) * m.area[face];
    const double yStar = perNumber / m.area[face] * m.distance[face] / viscosity;
    const auto resists = [&](double ratio) {  // over Sc_t, of Sc/Sc_t over Pr/Pr_t
      const double schmidt = ratio * prandtl / 0.85 * 0.7;
      return perNumber / 0.7 /
             conductanceToWall(corner.box.context, corner.state, of, face, rho, viscosity / (rho * schmidt));
    };
    const double heat = prandtl / 0.85;
    EXPECT_NEAR(resists(0.01) / (0.034 * heat), 1.0, 1e-9);
    EXPECT_NEAR(resists(1.0 - 1e-9) / (3.4 * heat), 1.0, 1e-6);
    EXPECT_NEAR(resists(1.0 + 1e-9) / (3.4 * heat), 1.0, 1e-6);
    EXPECT_NEAR(
        resists(100.0) / (walllaw::scalar(yStar, 100.0 * heat, 1.0) - walllaw::scalar(yStar, heat, 1.0) + 3.4 * heat),
        1.0, 1e-9);
  }
}

// Dust that drifts and does not diffuse: through the still layer, at whose end it has the temperature T, passes
// K (Pr q/c_p) c/T, and as much through the eddies, by the difference of c.
TEST(WallLaw, DustDriftsToAWallBehindEddies) {
  constexpr double K = 0.6;
  WallCorner corner(0.5);
  const Mesh& m = corner.box.mesh;
  corner.state.scalars[0].thermophoresis = K;
  for (int c = 0; c < m.cells; ++c) {
    corner.state.carried[at(3 * c)] = 2.0 * corner.state.density[at(c)];
    corner.state.carriedDiffusivity[at(3 * c)] = 0.0;
  }
  FlowResidual residual(corner.box.context, corner.state, VelocityScheme::Limited, {});
  residual.evaluate(corner.state);
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (corner.box.context.boundaryOf(face).kind != BoundaryKind::Wall) continue;
    const GasProperties& of = residual.properties();
    const auto b = at(face - m.interiorFaces), c = at(m.low[face]);
    const double rho = corner.state.density[c], viscosity = of.boundaryViscosity[b];
    const double yStar = rho * std::pow(0.09, 0.25) * std::sqrt(0.5) * m.distance[face] / viscosity;
    const double prandtl = viscosity * of.heatCapacity[c] / of.boundaryConductivity[b];
    const double heat = of.effectiveBoundaryConductivity()[b] * 20.0 / m.distance[face] / of.heatCapacity[c];
    const double rise = 20.0 * walllaw::eddyPart(yStar, prandtl, 0.85) / walllaw::scalar(yStar, prandtl, 0.85);
    EXPECT_GT(rise, 5.0);
    // heat = (rho u*/R) rise; dust: (rho u*/(R 0.7/0.85)) (2 - c_s) = K Pr heat c_s/T.
    const double T = 320.0 - rise, inLayer = K * prandtl * heat / T, inEddies = heat / rise / (0.7 / 0.85);
    const double expected = m.area[face] * 2.0 * inLayer * inEddies / (inLayer + inEddies);
    EXPECT_NEAR(residual.carried().flux()[at(face) * 3] / expected, 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace lampblack::test
