// The law of the wall: its layers, and the resistance of eddies and of the still layer beside a wall.
#include "flow/boundaries/wall_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

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

// What of a resistance is that of eddies: all but that of molecules up to y* 3.4, where the eddies of van Driest's
// mixing length mix as much as a drift of 0.01 carries.
TEST(WallLaw, EddiesResistBeyondTheStillLayer) {
  const double length = 0.41 * walllaw::still * (1.0 - std::exp(-walllaw::still / 26.0));
  EXPECT_NEAR(length * length / (0.01 * walllaw::still), 1.0, 0.2);
  EXPECT_EQ(walllaw::eddyPart(3.3, 0.71, 0.9), 0.0);
  EXPECT_NEAR(walllaw::eddyPart(10.0, 0.71, 0.9), 0.71 * 6.6, 1e-12);
  EXPECT_NEAR(walllaw::eddyPart(100.0, 0.71, 0.9), 0.9 * (16.798909 - 1.924682) - 0.71 * 3.4, 1e-5);
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

}  // namespace
}  // namespace lampblack::test
