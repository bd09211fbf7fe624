#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "type_fixtures.hpp"

namespace lampblack::particles {
namespace {

using test::ball;
using test::extensive;

void expectSame(const std::vector<double>& x, const std::vector<double>& y) {
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], 1e-15 * std::abs(y[k])) << k;
}

template <class Type>
class EveryParticleType : public testing::Test {
 protected:
  Type type = test::makeType<Type>();
  // Grown differently, so that they are not alike in what a type may distinguish.
  typename Type::Particle large =
      type.grown(type.coagulated(type.make(ball(30e-9)), type.make(ball(50e-9))), 0, 1e-9, 1);
  typename Type::Particle small = type.make(ball(6e-9));
};

using Types = testing::Types<Sphere, FractalAggregate, SurfaceVolume, Components>;
TYPED_TEST_SUITE(EveryParticleType, Types);

TYPED_TEST(EveryParticleType, IsMadeWithItsVolume) {
  EXPECT_NEAR(this->type.volume(this->small) / ball(6e-9), 1, 1e-15);
  EXPECT_NEAR(this->type.collisionDiameter(this->small) / 6e-9, 1, 1e-15);
  EXPECT_NEAR(this->type.surface(this->small) / (constants::pi * 36e-18), 1, 1e-15);
}

TYPED_TEST(EveryParticleType, CoagulationAddsWhatIsExtensive) {
  auto sum = extensive(this->large);
  const auto other = extensive(this->small);
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += other[k];
  const auto joined = this->type.coagulated(this->large, this->small);
  expectSame(extensive(joined), sum);
  EXPECT_NEAR(this->type.mass(joined), this->type.mass(this->large) + this->type.mass(this->small),
              1e-15 * this->type.mass(joined));
  EXPECT_GT(this->type.collisionDiameter(joined), this->type.collisionDiameter(this->large));
}

TYPED_TEST(EveryParticleType, MeanConservesWhatIsExtensive) {
  const double w = 3e5, wSmall = 1.7e7;
  auto sum = extensive(this->large);
  const auto other = extensive(this->small);
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = w * sum[k] + wSmall * other[k];
  auto mean = extensive(this->type.mean(this->large, w, this->small, wSmall));
  for (double& x : mean) x *= w + wSmall;
  expectSame(mean, sum);
}

TYPED_TEST(EveryParticleType, FragmentsShareOutVolumeAndMass) {
  const auto a = this->type.fragment(this->large, 0.3), b = this->type.fragment(this->large, 0.7);
  EXPECT_NEAR(this->type.volume(a) / (0.3 * this->type.volume(this->large)), 1, 1e-15);
  EXPECT_NEAR((this->type.volume(a) + this->type.volume(b)) / this->type.volume(this->large), 1, 1e-15);
  EXPECT_NEAR((this->type.mass(a) + this->type.mass(b)) / this->type.mass(this->large), 1, 1e-15);
}

// A small step of growth is that by the change of volume it makes.
TYPED_TEST(EveryParticleType, IsEnlargedAsItGrows) {
  for (const double rate : {1e-3, -1e-3}) {
    const auto grown = this->type.grown(this->large, rate, 0, 1);
    const auto jumped = enlarged(this->type, this->large, this->type.volume(this->large) * std::expm1(rate));
    const auto x = extensive(grown), y = extensive(jumped);
    for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], 1e-14 * y[k]) << k;
  }
}

TYPED_TEST(EveryParticleType, IsGoneWhenItsDiameterIsUsedUp) {
  EXPECT_EQ(this->type.volume(this->type.grown(this->small, 0, -3.1e-9, 1)), 0);
  EXPECT_GT(this->type.volume(this->type.grown(this->small, 0, -2.9e-9, 1)), 0);
}

TEST(FractalAggregate, CollidesAsAFractalAboveOnePrimary) {
  const FractalAggregate type(1800, 20e-9, 1.8);
  const auto hundred = type.make(100 * ball(20e-9));
  EXPECT_NEAR(type.collisionDiameter(hundred) / (20e-9 * std::pow(100, 1 / 1.8)), 1, 1e-14);
  EXPECT_NEAR(type.surface(hundred) / (100 * constants::pi * 4e-16), 1, 1e-14);
  // Continuous where spheres become aggregates, and larger than the sphere of the same volume.
  EXPECT_NEAR(type.collisionDiameter(type.make(ball(20e-9) * (1 + 1e-12))) / 20e-9, 1, 1e-11);
  EXPECT_GT(type.collisionDiameter(hundred), std::cbrt(100.0) * 20e-9);
}

TEST(SurfaceVolume, KnowsItsPrimaries) {
  const SurfaceVolume type(1800);
  auto aggregate = type.make(ball(20e-9));
  for (int k = 1; k < 100; ++k) aggregate = type.coagulated(aggregate, type.make(ball(20e-9)));
  EXPECT_NEAR(type.primaries(aggregate), 100, 1e-10);
  EXPECT_NEAR(type.primaryDiameter(aggregate) / 20e-9, 1, 1e-13);
  // The aggregate of fixed primaries is the same thing.
  const FractalAggregate fixed(1800, 20e-9, 1.8);
  EXPECT_NEAR(type.collisionDiameter(aggregate) / fixed.collisionDiameter({aggregate.volume}), 1, 1e-12);
  EXPECT_NEAR(type.surface(aggregate) / fixed.surface({aggregate.volume}), 1, 1e-12);
}

TEST(SurfaceVolume, SharesOutSurfaceUntilThePiecesAreSpheres) {
  const SurfaceVolume type(1800);
  const SurfaceVolume::Particle ten{10 * ball(20e-9), 10 * type.make(ball(20e-9)).surface};
  const auto half = type.fragment(ten, 0.5);
  EXPECT_NEAR(half.surface / ten.surface, 0.5, 1e-15);
  EXPECT_NEAR(type.primaries(half), 5, 1e-13);
  const auto splinter = type.fragment(ten, 0.01);
  EXPECT_NEAR(splinter.surface / type.make(splinter.volume).surface, 1, 1e-15);
}

TEST(SurfaceVolume, AMeanOfUnlikeSpheresCollidesAsASphere) {
  const SurfaceVolume type(1800);
  const auto mean = type.mean(type.make(ball(10e-9)), 1, type.make(ball(20e-9)), 1);
  EXPECT_LT(mean.surface, type.make(mean.volume).surface);  // conserved, by concavity less than of a sphere
  EXPECT_EQ(type.primaries(mean), 1);
  EXPECT_NEAR(type.collisionDiameter(mean) / std::cbrt(4.5e-24), 1, 1e-14);  // (10^3 + 20^3) / 2 nm3
}

TEST(Components, ConserveEachComponent) {
  // Of a nucleus half of the mass each of 1800 and 4000 kg/m3, of what condenses a quarter 1800, the rest 1000.
  const Components type = test::makeType<Components>();
  const auto nucleus = type.make(1);
  EXPECT_NEAR(nucleus.mass[0], 1 / (1 / 1800.0 + 1 / 4000.0), 1e-11);
  EXPECT_EQ(nucleus.mass[0], nucleus.mass[2]);
  EXPECT_EQ(nucleus.mass[1], 0);
  EXPECT_EQ(nucleus.mass[3], 0);

  const auto grown = type.grown(nucleus, std::log(2.0), 0, 1);  // another 1 m3
  EXPECT_NEAR(type.volume(grown), 2, 1e-14);
  const double added = 1 / (0.25 / 1800 + 0.75 / 1000);  // kg
  EXPECT_NEAR(grown.mass[0] - nucleus.mass[0], 0.25 * added, 1e-11);
  EXPECT_NEAR(grown.mass[1], 0.75 * added, 1e-11);
  EXPECT_EQ(grown.mass[2], nucleus.mass[2]);

  const auto shrunk = type.grown(grown, -std::log(2.0), 0, 1);
  for (std::size_t k = 0; k < Components::most; ++k) EXPECT_NEAR(shrunk.mass[k], grown.mass[k] / 2, 1e-11);
}

TEST(ParticleTypes, RefuseWhatHasNoMeaning) {
  const std::array one{1000.0};
  EXPECT_THROW(SurfaceVolume(0), InputError);
  EXPECT_THROW(SurfaceVolume(1800, 3.1), InputError);
  EXPECT_THROW(SurfaceVolume(1800, 1.8, 0), InputError);
  EXPECT_THROW(FractalAggregate(1800, 0), InputError);
  EXPECT_THROW(FractalAggregate(1800, 1e-8, 0.9), InputError);
  EXPECT_THROW(Components({}, {}, {}), InputError);
  EXPECT_THROW(Components(std::array<double, 5>{1, 1, 1, 1, 1}, one, one), InputError);
  EXPECT_THROW(Components(one, one, std::array{1.0, 1.0}), InputError);
  EXPECT_THROW(Components(one, std::array{-1.0}, one), InputError);
  EXPECT_THROW(Components(one, std::array{0.0}, one), InputError);
  EXPECT_THROW(Components(std::array{0.0}, one, one), InputError);
}

}  // namespace
}  // namespace lampblack::particles
