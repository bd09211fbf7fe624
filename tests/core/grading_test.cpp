// Mesh axes: vertex positions against the closed form of the geometric series, and what makes an axis wrong.
#include "core/grading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(GradedAxis, UniformSegmentHasEquallySpacedVertices) {
  const auto x = gradedAxis(-1.0, {{3.0, 8, 1.0}});
  ASSERT_EQ(x.size(), 9u);
  // A step of 0.5 is a whole number of binary fractions: exact.
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(x[i], -1.0 + 0.5 * static_cast<double>(i));
}

TEST(GradedAxis, CellsBeyond32BitsAreCountedAndRefused) {
  EXPECT_EQ(gradedCells({{1.0, 4, 1.0}, {2.0, 3, 1.0}}, 1e9), 7e9);
  EXPECT_EQ(gradedCells({{1.0, 4, 1.0}, {2.0, 3, 1.0}}, 0.01), 2.0);
  EXPECT_THROW(gradedAxis(0.0, {{1.0, 4, 1.0}}, 1e9), InputError);
}

TEST(GradedAxis, VerticesFollowTheGeometricSeries) {
  for (const double ratio : {0.1, 0.5, 3.0, 40.0}) {
    const int n = 12;
    const auto x = gradedAxis(0.25, {{1.25, n, ratio}});
    ASSERT_EQ(x.size(), 13u);
    const double growth = std::pow(ratio, 1.0 / (n - 1));
    for (int i = 0; i <= n; ++i) {
      const double exact = 0.25 + (std::pow(growth, i) - 1.0) / (std::pow(growth, n) - 1.0);
      // n additions of positive terms: relative error below n epsilon of the length, twice for both sums; the closed
      // form loses another 1/|growth - 1| to cancellation.
      const double tolerance = 2.0 * n * epsilon * 1.25 + 4.0 * epsilon / std::abs(growth - 1.0);
      EXPECT_NEAR(x[static_cast<std::size_t>(i)], exact, tolerance) << "ratio " << ratio << ", vertex " << i;
    }
  }
}

TEST(GradedAxis, RatioIsLastCellOverFirstForAnyRefinement) {
  for (const double refinement : {0.5, 1.0, 2.0, 5.0}) {
    const auto x = gradedAxis(0.0, {{1.0, 10, 7.0}}, refinement);
    const double first = x[1] - x[0];
    const double last = x[x.size() - 1] - x[x.size() - 2];
    // Positions near 1 carry an error of about n epsilon, which the difference `last` keeps.
    EXPECT_NEAR(last / first, 7.0, 7.0 * 4.0 * static_cast<double>(x.size()) * epsilon / first);
  }
}

TEST(GradedAxis, SegmentsEndExactlyWhereTheDeckSays) {
  const auto x = gradedAxis(0.0, {{0.1, 3, 2.0}, {0.3, 7, 0.3}, {0.7, 1, 5.0}});
  ASSERT_EQ(x.size(), 12u);
  EXPECT_EQ(x[0], 0.0);
  EXPECT_EQ(x[3], 0.1);
  EXPECT_EQ(x[10], 0.3);
  EXPECT_EQ(x[11], 0.7);
  for (std::size_t i = 1; i < x.size(); ++i) EXPECT_GT(x[i], x[i - 1]);
}

TEST(GradedAxis, RefinementMultipliesCellsOfEverySegmentAndKeepsAtLeastOne) {
  EXPECT_EQ(gradedAxis(0.0, {{1.0, 10, 2.0}, {2.0, 3, 1.0}}, 2.0).size(), 27u);
  EXPECT_EQ(gradedAxis(0.0, {{1.0, 10, 2.0}, {2.0, 3, 1.0}}, 0.01).size(), 3u);
}

TEST(GradedAxis, RejectsWhatIsNotAnAxis) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(gradedAxis(0.0, {}), InputError);
  EXPECT_THROW(gradedAxis(0.0, {{1.0, 0, 1.0}}), InputError);
  EXPECT_THROW(gradedAxis(0.0, {{1.0, -3, 1.0}}), InputError);
  EXPECT_THROW(gradedAxis(0.0, {{0.0, 4, 1.0}}), InputError);
  EXPECT_THROW(gradedAxis(0.0, {{1.0, 4, 1.0}, {0.5, 4, 1.0}}), InputError);
  EXPECT_THROW(gradedAxis(nan, {{1.0, 4, 1.0}}), InputError);
  for (const double bad : {nan, infinity}) EXPECT_THROW(gradedAxis(0.0, {{bad, 4, 1.0}}), InputError);
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_THROW(gradedAxis(0.0, {{1.0, 4, bad}}), InputError);
    EXPECT_THROW(gradedAxis(0.0, {{1.0, 4, 1.0}}, bad), InputError);
  }
}

}  // namespace
}  // namespace lampblack
