// Coagulation alone: moments against tables, distributions against moments, a brute-force Smoluchowski equation of
// discrete clusters, and the population balance itself.
#include "particles/population/exact_solutions/series.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/population/exact_solutions/exact_support.hpp"

namespace lampblack::test {
namespace {

constexpr auto constant = CollisionKernelType::constant;
constexpr auto additive = CollisionKernelType::additive;
constexpr auto multiplicative = CollisionKernelType::multiplicative;

double kernel(CollisionKernelType type, double u, double v) {
  return type == constant ? 1.0 : type == additive ? u + v : u * v;
}

TEST(ExactCoagulation, MomentsInPhysicalUnits) {
  // N0 = 1e12 /m3, v0 = 1e-24 m3, kernels such that tau = 0.4 at t = 2 s.
  const double n0 = 1e12, v0 = 1e-24, tau = 0.4, time = 2;
  const auto check = [&](CollisionKernelType type, const InitialPopulation& initial, std::array<double, 4> expected) {
    const double degree = type == constant ? 0 : type == additive ? 1 : 2;
    const auto solution = exactSolution(coagulating(type, tau / (n0 * std::pow(v0, degree) * time)), initial);
    ASSERT_TRUE(solution);
    const auto m = solution->moments(time);
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_TRUE(m[k]);
      EXPECT_NEAR(*m[k] / (n0 * std::pow(v0, k)), expected[k], 1e-13 * expected[k]) << solution->name() << " M" << k;
    }
  };
  const double e = std::exp(tau);
  check(constant, equalStart(n0, v0), {2 / 2.4, 1, 1.4, 1 + 3 * 0.4 + 1.5 * 0.16});
  check(constant, exponentialStart(n0, v0), {2 / 2.4, 1, 2.4, 6 + 6 * 0.4 + 1.5 * 0.16});
  check(additive, equalStart(n0, v0), {1 / e, 1, e * e, 3 * e * e * e * e - 2 * e * e * e});
  check(additive, exponentialStart(n0, v0), {1 / e, 1, 2 * e * e, 12 * e * e * e * e - 6 * e * e * e});
  check(multiplicative, equalStart(n0, v0), {0.8, 1, 1 / 0.6, 1 / (0.6 * 0.6 * 0.6)});
  check(multiplicative, exponentialStart(n0, v0), {0.8, 1, 2 / 0.2, 6 / (0.2 * 0.2 * 0.2)});
}

TEST(ExactCoagulation, ClustersAddUpToTheMoments) {
  for (const auto type : {constant, additive, multiplicative}) {
    for (const double time : {0.05, 0.3, 0.9}) {
      const auto solution = exactSolution(coagulating(type), equalStart());
      std::vector<double> edges;
      for (int k = 1; k < 40000; ++k) edges.push_back(k);
      const auto numbers = solution->numberInBins(time, edges);
      std::array<double, 4> sums{};
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        double power = numbers[k];
        for (double& s : sums) {
          s += power;
          power *= static_cast<double>(k + 1);
        }
      }
      const auto m = solution->moments(time);
      // Forty thousand terms, each to about 1e-15 sqrt(k).
      for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(sums[j] / *m[j], 1, 1e-12) << solution->name() << ' ' << time;
    }
  }
}

TEST(ExactCoagulation, BinsOfManyClustersEqualTheirSum) {
  // The Euler-Maclaurin branch: bins beyond 4096 against single clusters.
  for (const auto type : {additive, multiplicative}) {
    const auto solution = exactSolution(coagulating(type), equalStart());
    const double time = type == additive ? 4.5 : 0.985;
    std::vector<double> single;
    for (int k = 3000; k <= 9000; ++k) single.push_back(k);
    const double wide = solution->numberInBins(time, std::vector<double>{3000, 9000}).at(0);
    EXPECT_NEAR(wide / sum(solution->numberInBins(time, single)), 1, 1e-12) << solution->name();
    EXPECT_GT(wide, 0);
  }
  // The whole of a very old additive population, clusters of up to 1e13 particles.
  const auto solution = exactSolution(coagulating(additive), equalStart());
  const double total = sum(solution->numberInBins(14, geometricEdges(1, 1e20, 10)));
  EXPECT_NEAR(total / std::exp(-14.0), 1, 1e-11);
}

TEST(ExactCoagulation, ClustersObeySmoluchowskisEquation) {
  constexpr int largest = 400;
  for (const auto type : {constant, additive, multiplicative}) {
    // Runge-Kutta of order 4 with 500 steps to tau = 0.4: an error of about 1e-12. What is larger than 400 would be
    // below 1e-14 of the number.
    std::vector<double> n(largest + 1, 0.0);
    n[1] = 1;
    const auto rate = [&](const std::vector<double>& c) {
      std::vector<double> f(largest + 1, 0.0);
      double m0 = 0, m1 = 0;
      int top = 1;
      for (int k = 1; k <= largest; ++k) {
        m0 += c[static_cast<std::size_t>(k)];
        m1 += k * c[static_cast<std::size_t>(k)];
        if (c[static_cast<std::size_t>(k)] > 1e-18) top = k;
      }
      for (int k = 1; k <= largest; ++k) {
        const double total = type == constant ? m0 : type == additive ? k * m0 + m1 : k * m1;
        f[static_cast<std::size_t>(k)] -= c[static_cast<std::size_t>(k)] * total;
      }
      for (int i = 1; i <= top; ++i) {
        for (int j = 1; j <= std::min(top, largest - i); ++j) {
          f[static_cast<std::size_t>(i + j)] +=
              0.5 * kernel(type, i, j) * c[static_cast<std::size_t>(i)] * c[static_cast<std::size_t>(j)];
        }
      }
      return f;
    };
    const double h = 0.4 / 500;
    const auto moved = [](const std::vector<double>& c, const std::vector<double>& f, double step) {
      std::vector<double> result = c;
      for (std::size_t k = 0; k < c.size(); ++k) result[k] += step * f[k];
      return result;
    };
    for (int step = 0; step < 500; ++step) {
      const auto k1 = rate(n), k2 = rate(moved(n, k1, h / 2)), k3 = rate(moved(n, k2, h / 2)),
                 k4 = rate(moved(n, k3, h));
      for (std::size_t k = 0; k < n.size(); ++k) n[k] += h / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
    }
    const auto solution = exactSolution(coagulating(type), equalStart());
    for (const int k : {1, 2, 3, 7, 20}) {
      const auto exact = solution->numberInBins(0.4, std::vector<double>{k - 0.5, k + 0.5});
      EXPECT_NEAR(n[static_cast<std::size_t>(k)], exact.at(0), 1e-11) << solution->name() << " k = " << k;
    }
  }
}

TEST(ExactCoagulation, ExponentialStartsHaveTheMomentsOfTheirDistribution) {
  for (const auto type : {constant, additive, multiplicative}) {
    for (const double time : {0.02, 0.3, 0.45}) {
      const auto solution = exactSolution(coagulating(type), exponentialStart());
      const auto m = solution->moments(time);
      const auto edges = geometricEdges(1e-9, 5e4, 1.7);
      EXPECT_NEAR(sum(solution->numberInBins(time, edges)) / *m[0], 1, 1e-12) << solution->name() << ' ' << time;
      // Simpson's rule over ln x for the others, on densities from bins 0.1 % wide: off by 1e-6/24 of n'' x^2.
      for (const int k : {1, 2, 3}) {
        const auto f = [&](double u) {
          const double x = std::exp(u);
          return std::pow(x, k + 1) * density(*solution, time, x, 1e-3 * x);
        };
        EXPECT_NEAR(simpson(f, std::log(1e-4), std::log(3e4), 1200) / *m[static_cast<std::size_t>(k)], 1, 3e-6)
            << solution->name() << ' ' << time << " M" << k;
      }
    }
  }
}

TEST(ExactCoagulation, ExponentialStartsObeyThePopulationBalance) {
  for (const auto type : {constant, additive, multiplicative}) {
    const auto solution = exactSolution(coagulating(type), exponentialStart());
    const double time = 0.2;
    const auto m = solution->moments(time);
    for (const double v : {0.3, 1.0, 4.0}) {
      const auto n = [&](double u) { return density(*solution, time, u, 1e-4 * (0.05 + std::min(u, v - u))); };
      const double cut = 1e-3;  // Simpson's rule on the open ends by a rectangle
      const auto pair = [&](double u) { return kernel(type, u, v - u) * n(u) * n(v - u); };
      const double gain = 0.5 * (simpson(pair, cut, v - cut, 200) + 2 * cut * pair(cut));
      const double loss = type == constant ? *m[0] : type == additive ? v * *m[0] + *m[1] : v * *m[1];
      const double here = density(*solution, time, v);
      // Central differences over 1e-3 s and bins of 2e-3: about 1e-6; the rectangles: cut^2.
      EXPECT_NEAR(dndt(*solution, time, v), gain - loss * here, 5e-6) << solution->name() << " v = " << v;
    }
  }
}

TEST(ExactCoagulation, GelationAndBeyond) {
  const auto equal = exactSolution(coagulating(multiplicative, 2.0), equalStart(3, 0.5));
  EXPECT_NEAR(equal->gelationTime().value(), 1 / (2.0 * 3 * 0.25), 1e-14);
  const auto wide = exactSolution(coagulating(multiplicative), exponentialStart());
  EXPECT_NEAR(wide->gelationTime().value(), 0.5, 1e-15);
  EXPECT_FALSE(wide->moments(0.5)[2]);
  EXPECT_TRUE(wide->numberInBins(0.6, std::vector<double>{0, 1}).empty());
  EXPECT_FALSE(exactSolution(coagulating(additive), equalStart())->gelationTime());
}

TEST(ExactCoagulation, AtTimeZeroItIsTheStart) {
  for (const auto type : {constant, additive, multiplicative}) {
    const auto equal =
        exactSolution(coagulating(type), equalStart(5, 2))->numberInBins(0, std::vector<double>{1, 2, 3});
    EXPECT_EQ(equal, (std::vector<double>{0, 5}));
    const auto wide = exactSolution(coagulating(type), exponentialStart())->numberInBins(0, std::vector<double>{0, 1});
    EXPECT_NEAR(wide.at(0), 1 - std::exp(-1.0), 1e-15);
  }
}

TEST(ExactCoagulation, ScaledBesselFunctionInBothBranches) {
  // Against the integral representation exp(-z) I1(z) = 1/pi int exp(z (cos a - 1)) cos a da, trapezoidal rule: exact
  // to round-off for a periodic function.
  for (const double z : {0.01, 1.0, 12.0, 29.9, 30.1, 100.0, 3000.0}) {
    const int count = 4000;
    double integral = 0;
    for (int i = 0; i < count; ++i) {
      const double a = 2 * M_PI * i / count;
      integral += std::exp(z * (std::cos(a) - 1)) * std::cos(a) / count;
    }
    EXPECT_NEAR(exact::scaledBesselI1(z) / integral, 1, 3e-13) << z;
  }
}

}  // namespace
}  // namespace lampblack::test
