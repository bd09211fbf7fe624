// Breakage alone: moments of the distribution, the population balance itself, and the chain of equal pieces against a
// matrix exponential.
#include "particles/population/exact_solutions/breakage_chain.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/population/exact_solutions/exact_support.hpp"

namespace lampblack::test {
namespace {

constexpr auto equalPieces = BreakageOptions::Daughters::equal;
constexpr auto uniform = BreakageOptions::Daughters::uniform;

TEST(ExactBreakage, UniformPiecesByTheRateV) {
  for (const double time : {0.1, 3.0, 50.0}) {
    for (const auto& initial : {equalStart(), exponentialStart()}) {
      const auto solution = exactSolution(breaking(uniform, 1), initial);
      const auto m = solution->moments(time);
      EXPECT_NEAR(*m[0] / (1 + time), 1, 1e-13) << solution->name();
      EXPECT_NEAR(sum(solution->numberInBins(time, geometricEdges(1e-9, 1e3, 1.5))) / *m[0], 1, 1e-13);
    }
    // From an exponential distribution it stays one, with the mean 1/(1+tau).
    const auto m = exactSolution(breaking(uniform, 1), exponentialStart())->moments(time);
    EXPECT_NEAR(*m[2] * (1 + time), 2, 1e-12);
    EXPECT_NEAR(*m[3] * (1 + time) * (1 + time), 6, 1e-12);
    // From equal particles: M2 = 2 (tau - 1 + exp(-tau)) / tau^2.
    const double m2 = *exactSolution(breaking(uniform, 1), equalStart())->moments(time)[2];
    EXPECT_NEAR(m2 / (2 * (time + std::expm1(-time)) / (time * time)), 1, 1e-12);
  }
}

TEST(ExactBreakage, UniformPiecesByTheRateVSquared) {
  for (const double time : {0.1, 3.0, 50.0}) {
    const auto equal = exactSolution(breaking(uniform, 2), equalStart());
    EXPECT_NEAR(*equal->moments(time)[0], std::exp(-time) + std::sqrt(M_PI * time) * std::erf(std::sqrt(time)), 1e-12);
    for (const auto& initial : {equalStart(), exponentialStart()}) {
      const auto solution = exactSolution(breaking(uniform, 2), initial);
      EXPECT_NEAR(sum(solution->numberInBins(time, geometricEdges(1e-9, 1e3, 1.5))) / *solution->moments(time)[0], 1,
                  1e-13);
      // Mass: the integral of v n, by Simpson's rule over bins too narrow to matter.
      const double continuous =
          simpson([&](double v) { return v * density(*solution, time, v, 1e-4 * v + 1e-9); }, 1e-8,
                  initial.distribution == InitialPopulation::Distribution::monodisperse ? 1 - 1e-4 : 60.0, 20000);
      const double whole =
          initial.distribution == InitialPopulation::Distribution::monodisperse ? std::exp(-time) : 0.0;
      EXPECT_NEAR(continuous + whole, 1, 3e-4) << solution->name() << ' ' << time;
    }
  }
}

TEST(ExactBreakage, UniformPiecesObeyThePopulationBalance) {
  for (const double exponent : {1.0, 2.0}) {
    for (const auto& initial : {equalStart(), exponentialStart()}) {
      const bool equal = initial.distribution == InitialPopulation::Distribution::monodisperse;
      const auto solution = exactSolution(breaking(uniform, exponent), initial);
      const double time = 0.7;
      for (const double v : {0.2, 0.5, 0.9}) {
        const auto gain = [&](double u) { return 2 * std::pow(u, exponent - 1) * density(*solution, time, u, 1e-4); };
        const double sources = equal ? simpson(gain, v, 1 - 1e-4, 400) + 1e-4 * gain(1 - 1e-4) + 2 * std::exp(-time)
                                     : simpson(gain, v, 40, 4000);
        const double here = std::pow(v, exponent) * density(*solution, time, v);
        EXPECT_NEAR(dndt(*solution, time, v), sources - here, 3e-6) << solution->name() << " v = " << v;
      }
    }
  }
}

// exp(A t) applied to the first unit vector, by scaling and squaring of a Taylor series in long double.
std::vector<double> byMatrixExponential(int pieces, double exponent, double tau, int size) {
  using Real = long double;
  const auto n = static_cast<std::size_t>(size);
  std::vector<Real> matrix(n * n, 0), result(n * n, 0), term(n * n, 0), next(n * n, 0);
  const auto multiply = [&](const std::vector<Real>& a, const std::vector<Real>& b) {
    std::fill(next.begin(), next.end(), Real(0));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k <= i; ++k) {
        for (std::size_t j = 0; j <= k; ++j) next[i * n + j] += a[i * n + k] * b[k * n + j];
      }
    }
    return next;
  };
  const Real scale = std::ldexp(Real(tau), -20);
  for (std::size_t k = 0; k < n; ++k) {
    const Real rate = std::pow(Real(pieces), -Real(exponent) * Real(k));
    matrix[k * n + k] = -rate * scale;
    if (k + 1 < n) matrix[(k + 1) * n + k] = Real(pieces) * rate * scale;
    result[k * n + k] = term[k * n + k] = 1;
  }
  for (int order = 1; order < 12; ++order) {
    term = multiply(term, matrix);
    for (auto& x : term) x /= order;
    for (std::size_t i = 0; i < n * n; ++i) result[i] += term[i];
  }
  for (int k = 0; k < 20; ++k) result = multiply(result, result);
  std::vector<double> first;
  for (std::size_t k = 0; k < n; ++k) first.push_back(static_cast<double>(result[k * n]));
  return first;
}

TEST(ExactBreakage, TheChainOfEqualPiecesIsAMatrixExponential) {
  struct Case {
    int pieces;
    double exponent, tau;
  };
  for (const auto& c : {Case{2, 1, 0.3}, Case{2, 1, 50}, Case{12, 1.8, 20}, Case{3, 0.5, 6}, Case{2, 0, 3}}) {
    const auto chain = exact::breakageChain(c.pieces, c.exponent, c.tau);
    const auto expected = byMatrixExponential(c.pieces, c.exponent, c.tau, 24);
    for (std::size_t k = 0; k < std::min<std::size_t>(chain.size(), 24); ++k) {
      // Twenty squarings of long doubles: 1e-19 2^20 = 1e-13. The chain ends where its numbers are below 1e-20.
      EXPECT_NEAR(chain[k], expected[k], 1e-12 * expected[k] + 1e-20) << c.pieces << ' ' << c.tau << " k = " << k;
    }
  }
}

TEST(ExactBreakage, EqualPiecesInClosedForm) {
  for (const double time : {1e-6, 0.1, 5.0, 50.0, 3000.0}) {
    // A rate in proportion to v: every unit of mass breaks at the same rate.
    for (const int pieces : {2, 5}) {
      const auto m = exactSolution(breaking(equalPieces, 1, pieces), equalStart())->moments(time);
      EXPECT_NEAR(*m[0] / (1 + (pieces - 1) * time), 1, 1e-12) << time;
      EXPECT_NEAR(*m[1], 1, 1e-12) << time;
    }
    const auto solution = exactSolution(breaking(equalPieces, 1.8, 12), equalStart(3000, 1));
    EXPECT_NEAR(*solution->moments(time)[1] / 3000, 1, 1e-12) << time;
    EXPECT_NEAR(sum(solution->numberInBins(time, geometricEdges(1e-12, 2, 1.4))) / *solution->moments(time)[0], 1,
                1e-12);
  }
  // A constant rate: M_k grows with f_k - 1, f_k = b^(1-k).
  const auto m = exactSolution(breaking(equalPieces, 0, 3, 0.5), equalStart())->moments(4);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(*m[k] / std::exp(2 * (std::pow(3.0, 1.0 - static_cast<double>(k)) - 1)), 1, 1e-12);
  }
}

TEST(ExactBreakage, WhatHasNoSolutionHasNone) {
  EXPECT_FALSE(exactSolution(breaking(uniform, 1.5), equalStart()));
  EXPECT_FALSE(exactSolution(breaking(equalPieces, 2), exponentialStart()));
  EXPECT_FALSE(exactSolution(breaking(equalPieces, -0.5), equalStart()));
}

}  // namespace
}  // namespace lampblack::test
