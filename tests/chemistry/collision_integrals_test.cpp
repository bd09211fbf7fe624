#include "chemistry/collision_integrals.hpp"

#include <gtest/gtest.h>

namespace {

using namespace lampblack;

// Lennard-Jones (12-6) values of Hirschfelder, Curtiss, Bird (1954), table I-M. The fits claim a few tenths of a percent.
TEST(CollisionIntegrals, FollowTheLennardJonesTables) {
  const struct {
    double T, omega11, omega22;
  } table[] = {{0.5, 2.066, 2.257}, {1.0, 1.439, 1.587}, {2.0, 1.075, 1.175},
               {5.0, 0.8422, 0.9269}, {10.0, 0.7424, 0.8242}, {50.0, 0.5756, 0.6504}};
  for (const auto& row : table) {
    EXPECT_NEAR(collisionIntegral11(row.T, 0) / row.omega11, 1, 0.01) << row.T;
    EXPECT_NEAR(collisionIntegral22(row.T, 0) / row.omega22, 1, 0.01) << row.T;
  }
}

// Dipoles attract: they raise the integral, most where it is cold.
TEST(CollisionIntegrals, RiseWithTheDipole) {
  for (const double T : {0.5, 1.0, 5.0}) {
    EXPECT_GT(collisionIntegral11(T, 1.0), collisionIntegral11(T, 0.0));
    EXPECT_GT(collisionIntegral22(T, 1.0), collisionIntegral22(T, 0.0));
  }
  EXPECT_GT(collisionIntegral22(0.5, 1.0) / collisionIntegral22(0.5, 0.0),
            collisionIntegral22(5.0, 1.0) / collisionIntegral22(5.0, 0.0));
}

}  // namespace
