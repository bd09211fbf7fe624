#include "chemistry/collision_integrals.hpp"

#include <gtest/gtest.h>

#include "tests/chemistry/measured.hpp"

namespace {

using namespace lampblack;
using lampblack::testing::measured;
using lampblack::testing::raise;

// Values without dipole of Monchick, Mason, J. Chem. Phys. 35 (1961) 1676-1697; Omega(1,1)* from A* = Omega22/Omega11.
const struct {
  double T, omega22, A;
} kTable[] = {{0.5, 2.2837, 1.1053},  {1.0, 1.5929, 1.1063},   {2.0, 1.1757, 1.0934},
              {5.0, 0.92676, 1.0997}, {10.0, 0.82435, 1.1107}, {50.0, 0.65099, 1.1297}};

TEST(CollisionIntegrals, FollowTheLennardJonesTables) {
  double neufeld = 0, thesis11 = 0, thesis22 = 0;
  for (const auto& row : kTable) {
    const double omega11 = row.omega22 / row.A;
    raise(neufeld, collisionIntegral11(row.T, 0) / omega11 - 1);
    raise(neufeld, collisionIntegral22(row.T, 0) / row.omega22 - 1);
    raise(thesis11, collisionIntegral11(row.T, 0, CollisionIntegrals::ThesisFits) / omega11 - 1);
    raise(thesis22, collisionIntegral22(row.T, 0, CollisionIntegrals::ThesisFits) / row.omega22 - 1);
    EXPECT_NEAR(collisionIntegral11(row.T, 0) / (row.omega22 / row.A), 1, 0.004) << row.T;
    EXPECT_NEAR(collisionIntegral22(row.T, 0) / row.omega22, 1, 0.004) << row.T;
    EXPECT_NEAR(collisionIntegral11(row.T, 0, CollisionIntegrals::ThesisFits) / (row.omega22 / row.A), 1, 0.01)
        << row.T;
    EXPECT_NEAR(collisionIntegral22(row.T, 0, CollisionIntegrals::ThesisFits) / row.omega22, 1, 0.025) << row.T;
  }
  measured("Neufeld", neufeld);
  measured("thesis fit of (1,1)", thesis11);
  measured("thesis fit of (2,2)", thesis22);
}

// Dipoles attract: they raise the integral, most where it is cold.
TEST(CollisionIntegrals, RiseWithTheDipole) {
  for (const auto source : {CollisionIntegrals::NeufeldBrokaw, CollisionIntegrals::ThesisFits}) {
    for (const double T : {0.5, 1.0, 5.0}) {
      EXPECT_GT(collisionIntegral11(T, 1.0, source), collisionIntegral11(T, 0.0, source));
      EXPECT_GT(collisionIntegral22(T, 1.0, source), collisionIntegral22(T, 0.0, source));
    }
    EXPECT_GT(collisionIntegral22(0.5, 1.0, source) / collisionIntegral22(0.5, 0.0, source),
              collisionIntegral22(5.0, 1.0, source) / collisionIntegral22(5.0, 0.0, source));
  }
}

}  // namespace
