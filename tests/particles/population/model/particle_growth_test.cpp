// Growth in closed form against the numerical integration of its differential equations.
#include <gtest/gtest.h>

#include "core/modules.hpp"
#include "type_fixtures.hpp"

namespace lampblack::particles {
namespace {

using test::ball;

constexpr int steps = 4000;

// Fourth-order Runge-Kutta for dv/dt = condensation v + surface S(v) with the surface that the type itself states.
template <class Type>
double integratedVolume(const Type& type, double volume, double condensation, double surface, double dt) {
  const auto slope = [&](double v) { return condensation * v + surface * type.surface(type.make(v)); };
  const double h = dt / steps;
  for (int k = 0; k < steps; ++k) {
    const double a = slope(volume), b = slope(volume + h / 2 * a), c = slope(volume + h / 2 * b);
    volume += h / 6 * (a + 2 * b + 2 * c + slope(volume + h * c));
  }
  return volume;
}

struct Rates {
  double condensation, surface;  // 1/s, m/s
};

// Over one second the diameter of 30 nm changes by up to its own size; net gain, net loss and both against each other.
constexpr Rates allRates[] = {{1.3, 0},   {-2, 0},    {0, 12e-9},  {0, -8e-9},
                              {1, -4e-9}, {-1, 9e-9}, {0.7, 6e-9}, {1e-9, 5e-9}};

TEST(ParticleGrowth, OfASphereIsThatOfTheEquation) {
  const Sphere type(1800);
  for (const auto& [condensation, surface] : allRates) {
    const double grown = type.grown({ball(30e-9)}, condensation, surface, 1).volume;
    EXPECT_NEAR(grown / integratedVolume(type, ball(30e-9), condensation, surface, 1), 1, 1e-11);
  }
}

TEST(ParticleGrowth, OfComponentsIsThatOfASphere) {
  const Components type = test::makeType<Components>();
  for (const auto& [condensation, surface] : allRates) {
    const double grown = type.volume(type.grown(type.make(ball(30e-9)), condensation, surface, 1));
    EXPECT_NEAR(grown / Sphere(1).grown({ball(30e-9)}, condensation, surface, 1).volume, 1, 1e-14);
  }
}

// From above one primary to below and back: the slope has a kink in its derivative there, which costs the integration
// an error of the order of the step squared.
TEST(ParticleGrowth, OfAFractalCrossesOnePrimary) {
  const FractalAggregate type(1800, 25e-9);
  for (const double start : {20e-9, 30e-9}) {
    for (const auto& [condensation, surface] : allRates) {
      const double grown = type.grown({ball(start)}, condensation, surface, 1).volume;
      EXPECT_NEAR(grown / integratedVolume(type, ball(start), condensation, surface, 1), 1, 1e-7)
          << start << " " << condensation << " " << surface;
    }
  }
}

// dV/dt = condensation V + surface S, dS/dt = (2/3) (S/V) dV/dt - (S - S_sphere)/tau.
SurfaceVolume::Particle integrated(const SurfaceVolume& type, SurfaceVolume::Particle p, const Rates& rates, double tau,
                                   double dt) {
  using P = SurfaceVolume::Particle;
  const auto slope = [&](const P& x) {
    const double growth = rates.condensation * x.volume + rates.surface * x.surface;
    return P{growth, 2.0 / 3 * x.surface / x.volume * growth - (x.surface - type.make(x.volume).surface) / tau};
  };
  const auto moved = [](const P& x, double h, const P& s) {
    return P{x.volume + h * s.volume, x.surface + h * s.surface};
  };
  const double h = dt / steps;
  for (int k = 0; k < steps; ++k) {
    const P a = slope(p), b = slope(moved(p, h / 2, a)), c = slope(moved(p, h / 2, b)), d = slope(moved(p, h, c));
    p = moved(moved(moved(moved(p, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
  }
  return p;
}

SurfaceVolume::Particle aggregate(const SurfaceVolume& type) {
  const auto primary = type.make(ball(30e-9));
  return {50 * primary.volume, 50 * primary.surface};
}

TEST(ParticleGrowth, OfSurfaceAndVolumeKeepsTheNumberOfPrimaries) {
  const SurfaceVolume type(1800);
  for (const auto& rates : allRates) {
    const auto grown = type.grown(aggregate(type), rates.condensation, rates.surface, 1);
    const auto reference = integrated(type, aggregate(type), rates, 1e300, 1);
    EXPECT_NEAR(grown.volume / reference.volume, 1, 1e-11);
    EXPECT_NEAR(grown.surface / reference.surface, 1, 1e-11);
    EXPECT_NEAR(type.primaries(grown), 50, 1e-11);
  }
}

TEST(ParticleGrowth, SinteringAloneIsExponential) {
  const SurfaceVolume type(1800, 1.8, 0.5);
  const auto start = aggregate(type), end = type.grown(start, 0, 0, 0.8);
  const double sphere = type.make(start.volume).surface;
  EXPECT_EQ(end.volume, start.volume);
  EXPECT_NEAR((end.surface - sphere) / (start.surface - sphere), std::exp(-1.6), 1e-14);
  EXPECT_NEAR(type.primaries(type.grown(start, 0, 0, 100)), 1, 1e-14);
}

// Splitting of second order: halving the step divides the error by four.
TEST(ParticleGrowth, SinteringIsSplitFromGrowthInSecondOrder) {
  const double tau = 0.5;
  const SurfaceVolume type(1800, 1.8, tau);
  const Rates rates{0.5, 8e-9};
  const double exact = integrated(type, aggregate(type), rates, tau, 1).surface;
  std::array<double, 2> errors{};
  for (std::size_t k = 0; k < 2; ++k) {
    auto p = aggregate(type);
    const int count = k == 0 ? 32 : 64;
    for (int step = 0; step < count; ++step) p = type.grown(p, rates.condensation, rates.surface, 1.0 / count);
    errors[k] = p.surface / exact - 1;
  }
  EXPECT_LT(std::abs(errors[1]), 1e-4);
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.1);
}

}  // namespace
}  // namespace lampblack::particles
