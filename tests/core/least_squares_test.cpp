#include "core/least_squares.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

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

// Along and across a cell that is turned by `angle` (rad) and `ratio` times as long as wide, of values that rise by 3
// and by 2 a metre.
std::array<double, 2> slopesOfThinCell(double ratio, double angle) {
  const Vector3 along{std::cos(angle), std::sin(angle), 0.0}, across{-std::sin(angle), std::cos(angle), 0.0};
  const double height = 1.0 / ratio;
  const Vector3 gradient =
      gradientOf({along, scaled(along, -0.7), scaled(across, height), scaled(across, -0.9 * height)},
                 {3.0, -2.1, 2.0 * height, -1.8 * height});
  return {dot(gradient, along), dot(gradient, across)};
}

// Cells beside walls and planes of symmetry are a micrometre thick and metres long.
TEST(LeastSquares, ThinCellsHaveASlopeAcrossHoweverLongTheyAre) {
  for (const double ratio : {1e4, 1e5, 9e5, 1.1e6, 1e7, 1e8}) {
    const auto [along, across] = slopesOfThinCell(ratio, 0.0);
    EXPECT_NEAR(along, 3.0, 1e-12) << ratio;
    EXPECT_NEAR(across, 2.0, 1e-12) << ratio;
  }
  // Turned, squares of lengths tell the width to epsilon times the square of the ratio.
  for (const double angle : {-0.3, 0.1, 0.8})
    for (const double ratio : {1e4, 1e5, 1.1e6}) {
      const auto [along, across] = slopesOfThinCell(ratio, angle);
      const double error = 1e-15 * ratio * ratio;
      EXPECT_NEAR(along, 3.0, error) << ratio << " at " << angle;
      EXPECT_NEAR(across, 2.0, error) << ratio << " at " << angle;
    }
}

TEST(LeastSquares, PlacesOfARowThatAreOffByRoundOffSayNothingAcrossIt) {
  for (const double angle : {0.0, 0.1, 0.8}) {
    const Vector3 along{std::cos(angle), std::sin(angle), 0.0}, across{-std::sin(angle), std::cos(angle), 0.0};
    const Vector3 gradient =
        gradientOf({sum(along, scaled(across, 1e-12)), sum(scaled(along, -0.7), scaled(across, 3e-12))}, {3.0, -2.1});
    EXPECT_NEAR(dot(gradient, along), 3.0, 1e-11) << angle;
    EXPECT_NEAR(dot(gradient, across), 0.0, 1e-11) << angle;
  }
}

}  // namespace
}  // namespace lampblack::test
