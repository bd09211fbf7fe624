#include "particles/population/exact_solutions/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/constants.hpp"

namespace lampblack::particles {
namespace {

constexpr int points = 16;

struct Rule {
  std::array<double, points> nodes{}, weights{};
  Rule() {  // Newton's method for the roots of the Legendre polynomial
    for (int i = 0; i < points; ++i) {
      double x = std::cos(constants::pi * (i + 0.75) / (points + 0.5)), slope = 1;
      for (int iteration = 0; iteration < 20; ++iteration) {
        double previous = 1, value = x;
        for (int n = 2; n <= points; ++n) {
          const double next = ((2 * n - 1) * x * value - (n - 1) * previous) / n;
          previous = value;
          value = next;
        }
        slope = points * (x * value - previous) / (x * x - 1);
        x -= value / slope;
      }
      nodes[static_cast<std::size_t>(i)] = x;
      weights[static_cast<std::size_t>(i)] = 2 / ((1 - x * x) * slope * slope);
    }
  }
};

double panel(const std::function<double(double)>& f, double a, double b) {
  static const Rule rule;
  const double centre = 0.5 * (a + b), half = 0.5 * (b - a);
  double sum = 0;
  for (std::size_t i = 0; i < points; ++i) sum += rule.weights[i] * f(centre + half * rule.nodes[i]);
  return half * sum;
}

double refined(const std::function<double(double)>& f, double a, double b, double whole, int depth) {
  const double centre = 0.5 * (a + b);
  const double left = panel(f, a, centre), right = panel(f, centre, b);
  const double error = std::abs(left + right - whole);
  // Halving gains a factor 2^32: where both agree to 1e-11 the halves are at round-off.
  if (depth == 0 || !(error > 1e-11 * (std::abs(left) + std::abs(right)))) return left + right;
  return refined(f, a, centre, left, depth - 1) + refined(f, centre, b, right, depth - 1);
}

}  // namespace

double integral(const std::function<double(double)>& f, double a, double b, std::span<const double> breakpoints) {
  if (!(b > a)) return 0;
  std::vector<double> edges{a, b};
  for (const double x : breakpoints) {
    if (x > a && x < b) edges.push_back(x);
  }
  std::sort(edges.begin(), edges.end());
  double sum = 0;
  for (std::size_t k = 1; k < edges.size(); ++k) {
    if (edges[k] > edges[k - 1]) {
      sum += refined(f, edges[k - 1], edges[k], panel(f, edges[k - 1], edges[k]), 12);
    }
  }
  return sum;
}

double integralOverSizes(const std::function<double(double)>& f, double a, double b, double largest) {
  std::vector<double> edges;
  const double end = std::min(b, largest);
  double x = end;
  for (int k = 0; k < 120 && x > a; ++k) edges.push_back(x *= 0.5);
  return integral(f, a, end, edges);
}

}  // namespace lampblack::particles
