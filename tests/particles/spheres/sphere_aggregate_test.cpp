#include "particles/spheres/sphere_aggregate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/spheres/sphere_geometry.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/spheres/sphere_fixtures.hpp"

namespace lampblack::particles {
namespace {

constexpr double pi = constants::pi;

// Simpson's rule of f from a to b.
template <class F>
double integral(double a, double b, const F& f) {
  constexpr int n = 2000;
  const double h = (b - a) / n;
  double total = f(a) + f(b);
  for (int k = 1; k < n; ++k) total += (k % 2 == 1 ? 4 : 2) * f(a + k * h);
  return total * h / 3;
}

TEST(SphereGeometry, CapsAreTheirIntegrals) {
  const double r = 1.3;
  for (const double x : {-0.9, -0.1, 0.0, 0.4, 1.2}) {
    const auto disc = [&](double z) { return pi * (r * r - z * z); };
    EXPECT_NEAR(capVolume(r, x), integral(x, r, disc), 1e-11);
    EXPECT_NEAR(capFirstMoment(r, x), integral(x, r, [&](double z) { return z * disc(z); }), 1e-11);
    EXPECT_NEAR(capSecondMoment(r, x),
                integral(x, r, [&](double z) { return z * z * disc(z) + disc(z) * disc(z) / (2 * pi); }), 1e-11);
    EXPECT_NEAR(capSurface(r, x), integral(x, r, [&](double) { return 2 * pi * r; }), 1e-11);
  }
}

TEST(SphereGeometry, TwoSpheresHaveTheVolumeOfBothWithoutTheirLens) {
  for (const auto& [a, b, neck] : {std::array{1.0, 1.0, 0.7}, std::array{1.0, 0.6, 0.5}, std::array{0.4, 2.0, 0.3}}) {
    const SphereAggregate two = test::pairOfSpheres(a, b, neck);
    const double d = two.distance(1), x = planeOfNeck(a, b, d), y = planeOfNeck(b, a, d);
    EXPECT_NEAR(x + y, d, 1e-14);
    EXPECT_NEAR(x, planeOfNeck(a, neck * neck), 1e-13);
    const auto lens = integral(x, a, [&](double z) { return pi * (a * a - z * z); }) +
                      integral(y, b, [&](double z) { return pi * (b * b - z * z); });
    EXPECT_NEAR(lensVolume(a, b, d), lens, 1e-10);
    EXPECT_NEAR(two.volume(), volumeOfRadius(a) + volumeOfRadius(b) - lens, 1e-10);
    EXPECT_NEAR(two.surface(), 2 * pi * (a * (a + x) + b * (b + y)), 1e-10);
  }
  EXPECT_DOUBLE_EQ(lensVolume(2, 0.5, 1.2), volumeOfRadius(0.5));  // one inside the other
  EXPECT_EQ(lensVolume(2, 0.5, 2.6), 0);
  const SphereAggregate equal = test::pairOfSpheres(1, 1, 0.8);
  EXPECT_NEAR(equal.surface(), 4 * pi * (1 + equal.distance(1) / 2), 1e-13);
}

// dv/dr at fixed planes is the free surface, dv/dx the area of the neck; with a neck that keeps its radius, both.
TEST(SphereGeometry, VolumesChangeByTheirSurfaces) {
  const double h = 1e-6;
  const SphereAggregate two = test::pairOfSpheres(1, 0.8, 0.5);
  std::vector<SphereSurfaces> surfaces;
  two.surfaces(surfaces);
  const double x = planeOfNeck(1.0, 0.25);
  const auto volume = [](double r, double plane) { return volumeOfRadius(r) - capVolume(r, plane); };
  EXPECT_NEAR((volume(1 + h, x) - volume(1 - h, x)) / (2 * h), surfaces[0].free, 1e-8);
  EXPECT_NEAR((volume(1, x + h) - volume(1, x - h)) / (2 * h), pi * 0.25, 1e-8);
  const double more = volume(1 + h, planeOfNeck(1 + h, 0.25)), less = volume(1 - h, planeOfNeck(1 - h, 0.25));
  EXPECT_NEAR((more - less) / (2 * h), surfaces[0].withNecks, 1e-8);
  EXPECT_NEAR(surfaces[0].free + surfaces[1].free, two.surface(), 1e-13);
}

TEST(SphereGeometry, RadiusOfAVolumeBehindNecks) {
  const std::array necks{0.3, 0.1, 0.5};
  const double r = 1.7;
  double volume = volumeOfRadius(r);
  for (const double neck : necks) volume -= capVolume(r, planeOfNeck(r, neck));
  for (const double guess : {0.1, 1.7, 30.0}) EXPECT_NEAR(radiusOfVolume(volume, necks, guess), r, 1e-13);
  EXPECT_TRUE(std::isnan(radiusOfVolume(0.1, std::array{1.0}, 1)));  // less than half a sphere of the neck's radius
  EXPECT_NEAR(radiusOfVolume(volumeOfRadius(2), {}, 1), 2, 1e-14);
}

TEST(SphereAggregate, IsPlacedAlongTheLinesOfItsCentres) {
  SphereAggregate chain = test::chainOfSpheres(6, 0.4);
  EXPECT_LT(test::largestMismatch(chain), 1e-13);
  const Vector3 before = difference(chain.spheres()[5].centre, chain.spheres()[4].centre);
  chain.change()[3].neck = 0.49;
  for (std::size_t k : {2U, 3U}) {  // both of that neck keep their volume
    std::vector<double> necks{0.16, 0.49};
    chain.change()[k].radius = radiusOfVolume(chain.spheres()[k].volume, necks, 1);
  }
  chain.place();
  EXPECT_LT(test::largestMismatch(chain), 1e-12);
  const Vector3 after = difference(chain.spheres()[5].centre, chain.spheres()[4].centre);
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(after[d], before[d], 1e-14);
}

TEST(SphereAggregate, WidestNecksMergeAtTheCentreOfMassAndOtherNecksStay) {
  SphereAggregate chain = test::chainOfSpheres(5, 0.4);
  chain.change()[2].neck = 0.952 * 0.952;
  chain = SphereAggregate(chain.change());
  const double volume = chain.volume(), merged = chain.spheres()[1].volume + chain.spheres()[2].volume;
  const Vector3 middle = scaled(sum(chain.spheres()[1].centre, chain.spheres()[2].centre), 0.5);
  const Vector3 line = difference(chain.spheres()[0].centre, middle);
  std::size_t followed = 3;
  EXPECT_EQ(chain.mergeDue(&followed), 1);
  EXPECT_EQ(followed, 2);
  ASSERT_EQ(chain.count(), 4);
  EXPECT_NEAR(chain.volume(), volume, 1e-12);
  EXPECT_DOUBLE_EQ(chain.spheres()[1].volume, merged);
  for (const std::size_t k : {1U, 2U, 3U}) {
    EXPECT_NEAR(chain.spheres()[k].neck, 0.16, 1e-15);
    EXPECT_EQ(chain.spheres()[k].parent, k - 1);
  }
  EXPECT_LT(test::largestMismatch(chain), 1e-12);
  const Vector3 now = difference(chain.spheres()[0].centre, chain.spheres()[1].centre);
  EXPECT_NEAR(dot(now, line), length(now) * length(line), 1e-10);
  EXPECT_EQ(chain.mergeDue(), 0);
}

TEST(SphereAggregate, OneWithoutAFreeSurfaceMergesWithTheNeighbourOfItsWidestNeck) {
  // A sphere that six others cut: nothing of it is free.
  std::vector<AggregateSphere> spheres{{{0, 0, 0}, 1, 0, 0, 0}};
  const double planes[] = {0.61, 0.62, 0.58, 0.63, 0.64};
  const Vector3 lines[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  for (std::size_t k = 0; k < 5; ++k) spheres.push_back({lines[k], 1.5, 0, 1 - planes[k] * planes[k], 0});
  SphereAggregate star(spheres);
  const double volume = star.volume();
  std::vector<SphereSurfaces> surfaces;
  star.surfaces(surfaces);
  EXPECT_GT(surfaces[0].free, 0);
  EXPECT_EQ(star.mergeDue(), 0);
  spheres.push_back({{0, 0, -1}, 1.5, 0, 1 - 0.65 * 0.65, 0});
  SphereAggregate whole(spheres);
  const double six = whole.volume();
  EXPECT_EQ(whole.mergeDue(), 1);
  EXPECT_NEAR(whole.volume(), six, 1e-12);
  EXPECT_EQ(whole.count(), 6);
  EXPECT_GT(six, volume);
  // That of the plane nearest to its centre, the third: its line is gone.
  for (std::size_t k = 1; k < 6; ++k) EXPECT_LT(whole.spheres()[k].neck, 1 - 0.6 * 0.6);
}

TEST(SphereAggregate, RefusesWhatIsNoTree) {
  EXPECT_THROW(SphereAggregate(std::vector<AggregateSphere>{}), InputError);
  EXPECT_THROW(SphereAggregate({{{}, 1, 0, 0, 0}, {{1, 0, 0}, 1, 0, 0, 1}}), InputError);
  EXPECT_THROW(SphereAggregate({{{}, 1, 0, 0, 0}, {{1, 0, 0}, 0.5, 0, 0.3, 0}}), InputError);
  EXPECT_THROW(SphereAggregate({{{}, -1, 0, 0, 0}}), InputError);
}

}  // namespace
}  // namespace lampblack::particles
