// The law of the wall: its layers, what it makes of a cell's turbulence, and friction and heat of a gas beside a wall.
#include "flow/boundaries/wall_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <tuple>

#include "flow/discretisation/velocity_gradient.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow/properties/wall_transfer.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

TEST(WallLaw, LayersMeetAndNumbersAreThoseOfTheFormulas) {
  EXPECT_NEAR(walllaw::velocity(walllaw::meeting * (1.0 + 1e-9)) / walllaw::meeting, 1.0, 1e-5);
  EXPECT_EQ(walllaw::velocity(8.0), 8.0);
  // By a calculator: ln(980)/0.41; Jayatilleke's function of 0.71/0.9 and of 1000.
  EXPECT_NEAR(walllaw::velocity(100.0), 16.798909, 1e-5);
  EXPECT_NEAR(walllaw::sublayerResistance(0.71 / 0.9), -1.924682, 1e-5);
  EXPECT_NEAR(walllaw::sublayerResistance(1000.0) / (9.24 * 176.8279), 1.0 + 0.28 * std::exp(-7.0), 1e-5);
  EXPECT_EQ(walllaw::sublayerResistance(1.0), 0.0);
  // Like momentum where the numbers are the same and one; by molecules close to the wall.
  EXPECT_NEAR(walllaw::scalar(100.0, 0.9, 0.9) / (0.9 * walllaw::velocity(100.0)), 1.0, 1e-12);
  EXPECT_NEAR(walllaw::scalar(100.0, 0.71, 0.9), 0.9 * (16.798909 - 1.924682), 1e-5);
  for (const double number : {0.1, 0.71, 7.0, 1e4})
    for (const double yStar : {1e-9, 1e-3, 0.1}) EXPECT_EQ(walllaw::scalar(yStar, number, 0.9), number * yStar);
  // Never more than either layer alone, and rising.
  double last = 0.0;
  for (double yStar = 0.01; yStar < 1e3; yStar *= 1.03) {
    const double now = walllaw::scalar(yStar, 0.71, 0.9);
    EXPECT_GT(now, last);
    EXPECT_LT(now, 1.08 * last + 0.01);
    last = now;
  }
}

// In the logarithmic layer at k = u^2/C_mu^(1/2) production is dissipation, u^3/(kappa y), and friction rho u^2.
// A cell's energy would else go to and fro between the layers, which have not the same rates where they meet.
TEST(WallLaw, OneLayerPassesIntoTheOtherWithoutAJump) {
  constexpr double viscosity = 1.5e-5, distance = 1e-3, velocity = 8.0;
  const auto of = [&](double yStar) {
    const double friction = yStar * viscosity / distance;
    return walllaw::layer(friction * friction / std::sqrt(walllaw::cMu), velocity, viscosity, distance);
  };
  walllaw::Layer last = of(5.0);
  EXPECT_EQ(last.production, 0.0);
  for (double yStar = 5.0; yStar < 30.0; yStar *= 1.001) {
    const walllaw::Layer now = of(yStar);
    EXPECT_LT(now.dissipation, 1.02 * last.dissipation + 1e-12) << yStar;
    EXPECT_GE(now.dissipation, last.dissipation) << yStar;
    EXPECT_LT(now.production - last.production, 0.01 * of(30.0).production) << yStar;
    last = now;
  }
  // Each by itself from half an octave on.
  EXPECT_EQ(walllaw::logarithmicShare(walllaw::meeting / 1.4143), 0.0);
  EXPECT_EQ(walllaw::logarithmicShare(walllaw::meeting * 1.4143), 1.0);
  EXPECT_NEAR(walllaw::logarithmicShare(walllaw::meeting), 0.5, 1e-12);
}

TEST(WallLaw, ALogarithmicLayerIsInBalance) {
  const double u = 0.7, nu = 1.5e-5, y = 60.0 * nu / u, speed = u * std::log(9.8 * 60.0) / 0.41;
  const walllaw::Layer layer = walllaw::layer(u * u / 0.3, speed, nu, y);
  EXPECT_NEAR(layer.dissipation / (u * u * u / (0.41 * y)), 1.0, 1e-12);
  EXPECT_NEAR(layer.production / layer.dissipation, 1.0, 1e-12);
  EXPECT_NEAR(walllaw::layer(u * u / 0.3, 2.0 * speed, nu, y).production / layer.production, 2.0, 1e-12);
  const walllaw::Layer thin = walllaw::layer(1e-3, speed, nu, 1e-4);
  EXPECT_EQ(thin.production, 0.0);
  EXPECT_NEAR(thin.dissipation / (2.0 * nu * 1e-3 / 1e-8), 1.0, 1e-12);
  EXPECT_EQ(walllaw::layer(0.0, speed, nu, y).dissipation, 0.0);
}

// Both layers at once: each where it rules, a slope that is the velocity's, and a logarithmic layer in balance.
TEST(WallLaw, BothLayersAtOnceAreEachOfThemWhereItRules) {
  const auto velocity = [](double yStar) { return yStar / walllaw::blended(yStar).friction; };
  EXPECT_EQ(walllaw::blended(0.0).friction, 1.0);
  EXPECT_EQ(walllaw::blended(0.0).slope, 1.0);
  EXPECT_NEAR(velocity(1.0), 1.0, 1e-4);
  // By a calculator: (1/30^4 + 1/13.8624^4)^(-1/4).
  EXPECT_NEAR(velocity(30.0), 13.708747, 1e-5);
  EXPECT_NEAR(velocity(300.0) / walllaw::velocity(300.0), 1.0, 1e-5);
  for (const double yStar : {0.5, 2.9, 3.1, 8.0, 11.5, 20.0, 100.0}) {
    const double by = 1e-4 * yStar, slope = (velocity(yStar + by) - velocity(yStar - by)) / (2.0 * by);
    EXPECT_NEAR(walllaw::blended(yStar).slope / slope, 1.0, 1e-6) << yStar;
  }
  const double u = 0.7, nu = 1.5e-5, y = 300.0 * nu / u, speed = u * std::log(9.8 * 300.0) / 0.41, beta = 0.075;
  const walllaw::Layer layer = walllaw::blendedLayer(u * u / 0.3, speed, nu, y, beta);
  const double ofLogarithm = u / (0.3 * 0.41 * y), viscous = 6.0 * nu / (beta * y * y);
  EXPECT_NEAR(layer.frequency / std::sqrt(ofLogarithm * ofLogarithm + viscous * viscous), 1.0, 1e-12);
  // What the viscous layer still adds to the slope is 1.3e-4 of it there.
  EXPECT_NEAR(layer.strain / (u / (0.41 * y)), 1.0, 2e-4);
  EXPECT_NEAR(layer.production / (u * u * u / (0.41 * y)), 1.0 - 1.0 / (0.41 * 300.0), 2e-4);
  EXPECT_NEAR(layer.dissipation / (u * u * u / (0.41 * y)), 1.0, 1e-3);
  const walllaw::Layer still = walllaw::blendedLayer(0.0, speed, nu, y, beta);
  EXPECT_EQ(still.production, 0.0);
  EXPECT_NEAR(still.strain / (speed / y), 1.0, 1e-12);
  EXPECT_NEAR(still.frequency / viscous, 1.0, 1e-12);
}

// Warm gas that slides along a wall with a corner.
struct Corner {
  static std::vector<Side> sides(Gas& gas) {
    std::vector<Side> all{side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Symmetry, 0, true),
                          side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Symmetry, 1, true)};
    for (Side& of : all) {
      of.condition.slip = false;
      of.condition.isothermal = of.condition.kind == BoundaryKind::Wall;
      of.condition.takesParticles = of.condition.kind == BoundaryKind::Wall;
      of.condition.temperature = 300.0;
      of.condition.Y = gas.massFractions("O2: 0.21, N2: 0.79");
    }
    return all;
  }
  Gas& gas = Gas::hydrogen();
  int rows = 2;
  double k = 0.5, u = 3.0, v = 1.0;
  Box box{Geometry::Planar, {uniformAxis(0.03, 3), uniformAxis(0.02, rows)}, sides(gas)};
  std::shared_ptr<const TurbulenceModel> model;
  State state =
      box.stateWith({takenByWalls({"dust", {{.name = "dust", .unit = "1", .description = ""}}}, box.context.boundaries),
                     TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
                    [&](const Vector3&) {
                      return Box::Local{{u, v}, 320.0, gas.massFractions("O2: 0.21, N2: 0.79")};
                    });
  GasProperties properties;

  explicit Corner(double energy, const char* name = "k_epsilon", bool blendsLayers = false, int cellsUp = 2)
      : rows(cellsUp), k(energy), model(turbulenceModel(name, {.blendsLayers = blendsLayers})) {
    for (int c = 0; c < box.mesh.cells; ++c) {
      state.carried[at(3 * c + 1)] = state.density[at(c)] * k;
      state.carried[at(3 * c + 2)] = state.density[at(c)] * 20.0;
      state.carriedDiffusivity[at(3 * c)] = 3e-8;
    }
    box.context.eddies = {0.85, 0.7};
    properties.update(box.context, state);
  }
};

TEST(WallLaw, FrictionAndHeatOfAGasAreThoseOfTheLaw) {
  for (const double k : {0.5, 1e-5}) {
    SCOPED_TRACE(k);
    Corner corner(k);
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

// Dust that walls take, by its Schmidt number: the lesser of both layers' resistances.
TEST(WallLaw, WallsTakeDustByItsSchmidtNumber) {
  for (const double k : {0.5, 1e-5}) {
    SCOPED_TRACE(k);
    Corner corner(k);
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

// What of a resistance is that of eddies: all but that of molecules up to y* 3.4, where the eddies of van Driest's
// mixing length mix as much as a drift of 0.01 carries.
TEST(WallLaw, EddiesResistBeyondTheStillLayer) {
  const double length = 0.41 * walllaw::still * (1.0 - std::exp(-walllaw::still / 26.0));
  EXPECT_NEAR(length * length / (0.01 * walllaw::still), 1.0, 0.2);
  EXPECT_EQ(walllaw::eddyPart(3.3, 0.71, 0.9), 0.0);
  EXPECT_NEAR(walllaw::eddyPart(10.0, 0.71, 0.9), 0.71 * 6.6, 1e-12);
  EXPECT_NEAR(walllaw::eddyPart(100.0, 0.71, 0.9), 0.9 * (16.798909 - 1.924682) - 0.71 * 3.4, 1e-5);
}

// Of the way to a wall what is not the eddies' is the still layer's: of dust that diffuses as heat does up to y* 3.4 by
// molecules alone, of what diffuses better by its own Schmidt number, of dust that hardly diffuses all that the law
// adds.
TEST(WallLaw, WhatDiffusesWellHasTheStillLayerAlone) {
  Corner corner(0.5);
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

// Particles that drift and do not diffuse, in a layer of constant fluxes with the eddies of van Driest's mixing length,
// marched from the wall: J over (q/c_p) c_P against what the still layer and the eddies behind it make of it.
TEST(WallLaw, TheStillLayerIsThatOfVanDriestsEddies) {
  for (const auto& [wall, gas, most] :
       {std::tuple{300.0, 450.0, 0.006}, std::tuple{300.0, 560.0, 0.02}, std::tuple{600.0, 700.0, 0.006}}) {
    constexpr double m = 0.54 * 0.71, yStar = 60.0, step = 0.002;
    constexpr int steps = 30000;
    const auto mixes = [](double y) {  // heat by eddies over that by molecules
      const double length = 0.41 * y * (1.0 - std::exp(-y / 26.0));
      return 0.71 / 0.9 * 0.5 * (std::sqrt(1.0 + 4.0 * length * length) - 1.0);
    };
    double plus = 0.0;  // T+
    for (int i = 0; i < steps; ++i) plus += 0.71 * step / (1.0 + mixes((i + 0.5) * step));
    double T = wall, c = wall / m;  // per J c_p/q
    for (int i = 0; i < steps; ++i) {
      const double eddies = mixes((i + 0.5) * step), share = eddies / (1.0 + eddies);
      const double rise = (gas - wall) * 0.71 * step / (1.0 + eddies) / plus;
      T += rise;
      c = (1.0 + share * c / rise) / (share / rise + m * (1.0 - share) / T);
    }
    const double T_s = wall + (gas - wall) * 0.71 * walllaw::still / plus;
    EXPECT_NEAR(c / (T_s / m + gas - T_s), 1.0, most) << gas;
    EXPECT_NEAR(plus / walllaw::scalar(yStar, 0.71, 0.9), 1.0, 0.03);
  }
}

// Dust that drifts and does not diffuse: through the still layer, at whose end it has the temperature T, passes
// K (Pr q/c_p) c/T, and as much through the eddies, by the difference of c.
TEST(WallLaw, DustDriftsToAWallBehindEddies) {
  constexpr double K = 0.6;
  Corner corner(0.5);
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

// Friction, y+ and heat of each face of a wall: of gas at 320 K along one at 300 K.
TEST(WallLaw, WallsTellEachFace) {
  Corner corner(0.5);
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
  Corner corner(0.5);
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
    Corner corner(k, "k_omega", true);
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
    Corner corner(k, "k_epsilon", true);
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
    Corner corner(0.5, "k_epsilon", false, 4);
    for (int c = 0; c < corner.box.mesh.cells; ++c)
      corner.properties.viscosity[at(c)] = of.viscosity * corner.state.density[at(c)];
    const TurbulenceOperator turbulence(corner.box.context, corner.state, corner.model, corner.properties);
    const TurbulenceOperator::ThinCells thin = turbulence.thinCells(corner.state);
    EXPECT_NEAR(thin.share, of.share, 1e-12);
    EXPECT_NEAR(thin.mostYPlus, of.mostYPlus, 1e-9);
    EXPECT_NEAR(thin.speed, speed, 1e-12);
  }
  Corner corner(0.5, "k_omega", true);
  const TurbulenceOperator other(corner.box.context, corner.state, corner.model, corner.properties);
  EXPECT_EQ(other.thinCells(corner.state).share, 0.0);
}

// y+ and friction that are told; walls do not hold k and epsilon.
TEST(WallLaw, TellsFrictionAndWhatIsOutOfItsRange) {
  for (const double k : {0.5, 1e-5}) {
    Corner corner(k);
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
