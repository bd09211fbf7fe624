#include "particles/population/moments/quadrature_inversion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {
namespace {

constexpr auto wheeler = QuadratureInversion::wheeler;
constexpr auto productDifference = QuadratureInversion::productDifference;

std::vector<double> momentsOf(const std::vector<double>& nodes, const std::vector<double>& weights, std::size_t count) {
  std::vector<double> m(count, 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t k = 0; k < count; ++k) m[k] += weights[i] * std::pow(nodes[i], k);
  }
  return m;
}

TEST(QuadratureInversion, ExponentialGivesGaussLaguerre) {
  // Abramowitz and Stegun, table 25.9.
  const std::vector<std::vector<double>> nodes{
      {0.585786437626905, 3.414213562373095},
      {0.415774556783479, 2.294280360279042, 6.289945082937479},
      {0.322547689619392, 1.745761101158347, 4.536620296921128, 9.395070912301133}};
  const std::vector<std::vector<double>> weights{
      {0.853553390593274, 0.146446609406726},
      {0.711093009929173, 0.278517733569241, 0.0103892565015861},
      {0.603154104341634, 0.357418692437800, 0.0388879085150054, 0.000539294705561327}};
  for (const auto inversion : {wheeler, productDifference}) {
    for (std::size_t n = 2; n <= 4; ++n) {
      std::vector<double> m;
      for (std::size_t k = 0; k < 2 * n; ++k) m.push_back(std::tgamma(static_cast<double>(k) + 1));
      const auto q = momentQuadrature(m, inversion);
      ASSERT_EQ(q.count, n);
      // The last moment is 5040: its rounding shifts the nodes by the condition of the map, here below 1e4.
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(q.nodes[i], nodes[n - 2][i], 1e-11 * nodes[n - 2][i]);
        EXPECT_NEAR(q.weights[i], weights[n - 2][i], 1e-10 * weights[n - 2][i]);
      }
    }
  }
}

TEST(QuadratureInversion, RecoversAnyNodesInAnyUnits) {
  const std::vector<double> nodes{1.3e-27, 2.2e-26, 9e-26, 4e-25}, weights{3e15, 2e14, 1e15, 4e13};
  for (const auto inversion : {wheeler, productDifference}) {
    for (std::size_t n = 2; n <= 4; ++n) {
      const std::vector<double> x(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(n));
      const std::vector<double> w(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(n));
      const auto q = momentQuadrature(momentsOf(x, w, 2 * n), inversion);
      ASSERT_EQ(q.count, n);
      // The smallest of four nodes in a spread of 300 has a condition number of about 1e6.
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(q.nodes[i] / x[i], 1, 1e-9) << n << ' ' << i;
        EXPECT_NEAR(q.weights[i] / w[i], 1, 1e-9) << n << ' ' << i;
      }
    }
  }
}

TEST(QuadratureInversion, ReproducesItsMoments) {
  for (const auto inversion : {wheeler, productDifference}) {
    for (const double spread : {0.02, 0.3, 1.0}) {  // log-normal
      std::vector<double> m;
      for (int k = 0; k < 8; ++k) m.push_back(std::exp(0.5 * k * k * spread * spread));
      const auto q = momentQuadrature(m, inversion);
      ASSERT_GE(q.count, 2U);
      for (std::size_t k = 0; k < 2 * q.count; ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < q.count; ++i) sum += q.weights[i] * std::pow(q.nodes[i], k);
        EXPECT_NEAR(sum / m[k], 1, 1e-12) << spread << ' ' << k;
      }
    }
  }
}

TEST(QuadratureInversion, FewerSizesGiveFewerNodes) {
  for (const auto inversion : {wheeler, productDifference}) {
    const auto one = momentQuadrature(momentsOf({3e-24}, {2e12}, 8), inversion);
    ASSERT_EQ(one.count, 1U);
    EXPECT_NEAR(one.nodes[0], 3e-24, 1e-37);
    EXPECT_NEAR(one.weights[0], 2e12, 1e-1);
    const auto two = momentQuadrature(momentsOf({1, 5}, {2, 3}, 8), inversion);
    ASSERT_EQ(two.count, 2U);
    EXPECT_NEAR(two.nodes[1], 5, 1e-11);
  }
}

TEST(QuadratureInversion, ImpossibleMomentsGiveWhatIsPossible) {
  for (const auto inversion : {wheeler, productDifference}) {
    EXPECT_EQ(momentQuadrature(std::vector<double>{1, 1, 0.9, 1}, inversion).count, 1U);  // a variance below zero
    // Two nodes of which one is negative.
    EXPECT_EQ(momentQuadrature(std::vector<double>{1, 1, 3, 5}, inversion).count, 1U);
    EXPECT_EQ(momentQuadrature(std::vector<double>{0, 0, 0, 0}, inversion).count, 0U);
    EXPECT_EQ(momentQuadrature(std::vector<double>{1, -1, 1, -1}, inversion).count, 0U);
  }
}

}  // namespace
}  // namespace lampblack::particles
