#include "core/least_squares.hpp"

#include <gtest/gtest.h>

namespace lampblack::test {
namespace {

Vector3 gradientOf(const std::vector<Vector3>& places, const std::vector<double>& differences) {
  LeastSquares squares;
  for (const Vector3& d : places) squares.add(d);
  squares.finish(2);
  Vector3 gradient{};
  for (std::size_t i = 0; i < places.size(); ++i)
    gradient = sum(gradient, scaled(squares.weight(places[i]), differences[i]));
  return gradient;
}

TEST(LeastSquares, TwoValuesOnALineGiveTheParabolasSlope) {
  // x + 3 x^2 beside a place, 0.5 before and 2 behind it.
  const Vector3 gradient = gradientOf({{0.5, 0.0, 0.0}, {-2.0, 0.0, 0.0}, {0.0, 0.1, 0.0}, {0.0, -0.1, 0.0}},
                                      {0.5 + 0.75, -2.0 + 12.0, 0.0, 0.0});
  EXPECT_NEAR(gradient[0], 1.0, 1e-12);
  EXPECT_NEAR(gradient[1], 0.0, 1e-12);
}

TEST(LeastSquares, TheSlopeAlongALongCellIsThatOfItsEnds) {
  // The near values lie across a cell seven times as long as wide, and a little to one side: what they differ by is
  // next to no slope along it. By plain distances it would be 0.93.
  const Vector3 gradient =
      gradientOf({{7.0, 0.0, 0.0}, {-7.0, 0.0, 0.0}, {0.7, 1.0, 0.0}, {0.7, -1.0, 0.0}}, {0.0, 0.0, 1.0, 1.0});
  EXPECT_LT(std::abs(gradient[0]), 0.02);
}

// The same cell in metres and in micrometres: what is cut off as no direction does not depend on the size.
TEST(LeastSquares, TheSlopeOfASmallCellIsThatOfALargeOne) {
  for (const double size : {1.0, 1e-3, 1e-6, 1e-8}) {
    const Vector3 gradient =
        gradientOf({{0.5 * size, 0.0, 0.0}, {-0.7 * size, 0.0, 0.0}, {0.0, 0.3 * size, 0.0}, {0.0, -0.2 * size, 0.0}},
                   {0.5 * size, -0.7 * size, 0.6 * size, -0.4 * size});
    EXPECT_NEAR(gradient[0], 1.0, 1e-12) << size;
    EXPECT_NEAR(gradient[1], 2.0, 1e-12) << size;
    // Of a row of cells the slope along it is known, and none across.
    const Vector3 along = gradientOf({{0.5 * size, 0.0, 0.0}, {-0.7 * size, 0.0, 0.0}}, {0.5 * size, -0.7 * size});
    EXPECT_NEAR(along[0], 1.0, 1e-12) << size;
    EXPECT_EQ(along[1], 0.0) << size;
  }
}

}  // namespace
}  // namespace lampblack::test
