// Eigenvalues on the rim of a spectrum.
#include "numerics/arnoldi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/modules.hpp"

namespace lampblack::numerics {
namespace {

// Eigenvalues 0 to 1, and one at -0.1: Chebyshev polynomials promise 2 exp(-2 * 20 * 0.1^1/2) = 1e-5 in 20 steps.
TEST(Arnoldi, FindsAValueBesideAllOthers) {
  constexpr std::size_t n = 400;
  const auto value = [](std::size_t i) { return i == 7 ? -0.1 : static_cast<double>(i) / n; };
  Arnoldi arnoldi(
      [&](std::vector<double>& v) {
        for (std::size_t i = 0; i < n; ++i) v[i] *= value(i);
      },
      std::vector<double>(n, 1.0));
  while (arnoldi.dimension() < 20) ASSERT_TRUE(arnoldi.extend());
  const auto pairs = arnoldi.pairs();
  const auto& least = *std::ranges::min_element(pairs, {}, [](const RitzPair& pair) { return pair.value.real(); });
  EXPECT_NEAR(least.value.real(), -0.1, 1e-4);
  EXPECT_EQ(least.value.imag(), 0);

  // The residual that it names is that of the vector.
  std::vector<double> v = arnoldi.vector(least);
  double square = 0, error = 0;
  for (std::size_t i = 0; i < n; ++i) {
    square += v[i] * v[i];
    error += std::pow((value(i) - least.value.real()) * v[i], 2);
  }
  EXPECT_NEAR(square, 1, 1e-12);
  EXPECT_NEAR(std::sqrt(error), least.residual, 1e-12);
  EXPECT_LT(least.residual, 0.01);
}

TEST(Arnoldi, IsExactOnceTheSpaceIsComplete) {
  // Turns by 0.3 +- 0.4i, and 2.
  Arnoldi arnoldi(
      [](std::vector<double>& v) {
        v = {0.3 * v[0] - 0.4 * v[1], 0.4 * v[0] + 0.3 * v[1], 2 * v[2]};
      },
      {1, 0, 1});
  EXPECT_TRUE(arnoldi.extend());
  EXPECT_TRUE(arnoldi.extend());
  EXPECT_FALSE(arnoldi.extend());
  EXPECT_FALSE(arnoldi.extend());
  auto pairs = arnoldi.pairs();
  ASSERT_EQ(pairs.size(), 3u);
  std::ranges::sort(pairs, {}, [](const RitzPair& pair) { return std::pair(pair.value.real(), pair.value.imag()); });
  const std::complex<double> expected[] = {{0.3, -0.4}, {0.3, 0.4}, {2, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(pairs[i].value - expected[i]), 1e-14);
    EXPECT_LT(pairs[i].residual, 1e-14);
  }
  const std::vector<double> last = arnoldi.vector(pairs[2]);
  EXPECT_NEAR(std::abs(last[2]), 1, 1e-14);
  EXPECT_NEAR(std::hypot(last[0], last[1]), 0, 1e-14);
}

}  // namespace
}  // namespace lampblack::numerics
