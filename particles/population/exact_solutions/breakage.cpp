// Breakage alone. Two uniform daughters at a rate that goes with v or v^2 from equal particles or an exponential
// distribution (Ziff and McGrady 1985), in units x = v/v0, tau = B(v0) t:
//
//   B ~ v:    n = exp(-tau x)   [ n0(x) + integral over y > x of n0(y) (2 tau + tau^2 (y - x)) ]
//   B ~ v^2:  n = exp(-tau x^2) [ n0(x) + 2 tau integral over y > x of y n0(y) ]
//
// and any number of equal daughters from equal particles: a chain of sizes, see breakage_chain.hpp.
#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "particles/population/exact_solutions/breakage_chain.hpp"
#include "particles/population/exact_solutions/quadrature.hpp"
#include "particles/population/exact_solutions/solutions.hpp"

namespace lampblack::particles::exact {
namespace {

using Distribution = InitialPopulation::Distribution;

std::string startOf(const InitialPopulation& initial) {
  return initial.distribution == Distribution::monodisperse ? "monodisperse start" : "exponential start";
}

class UniformBreakage final : public ExactSolution {
 public:
  UniformBreakage(const BreakageOptions& options, const InitialPopulation& initial)
      : exponent_(options.exponent), initial_(initial), rate_(options.rate * std::pow(initial.volume, exponent_)) {}

  std::array<std::optional<double>, 4> moments(double time) const override {
    std::array<std::optional<double>, 4> result;
    double unit = initial_.number;
    for (std::size_t k = 0; k < 4; ++k, unit *= initial_.volume) {
      result[k] = unit * (whole(time, 0, HUGE_VAL) + pieces(time, 0, HUGE_VAL, static_cast<double>(k)));
    }
    result[1] = initial_.number * initial_.volume;
    return result;
  }

  std::vector<double> numberInBins(double time, std::span<const double> edges) const override {
    std::vector<double> numbers(edges.empty() ? 0 : edges.size() - 1);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const double lower = std::max(edges[k], 0.0) / initial_.volume, upper = edges[k + 1] / initial_.volume;
      if (upper > lower) numbers[k] = initial_.number * (whole(time, lower, upper) + pieces(time, lower, upper, 0));
    }
    return numbers;
  }

  std::string name() const override {
    return std::string("breakage into two uniform pieces, rate ") + (exponent_ == 1 ? "v, " : "v^2, ") +
           startOf(initial_);
  }

 private:
  bool equal() const { return initial_.distribution == Distribution::monodisperse; }

  // Particles of the start that have not broken, where they all have the same size.
  double whole(double time, double lower, double upper) const {
    return equal() && lower <= 1 && upper > 1 ? std::exp(-rate_ * time) : 0.0;
  }

  // All others: the integral of x^order n dx over [lower, upper).
  double pieces(double time, double lower, double upper, double order) const {
    const double tau = rate_ * time;
    const auto density = [&](double x) { return std::pow(x, order) * continuous(tau, x); };
    if (equal()) return integralOverSizes(density, lower, upper, 1);
    // x^3 exp(-x) ends before 80 whatever tau.
    return integralOverSizes(density, lower, upper, 80);
  }

  double continuous(double tau, double x) const {
    if (exponent_ == 1) {
      if (equal()) return std::exp(-tau * x) * (2 * tau + tau * tau * (1 - x));
      return std::exp(-tau * x - x) * (1 + 2 * tau + tau * tau);
    }
    if (equal()) return 2 * tau * std::exp(-tau * x * x);
    return std::exp(-tau * x * x - x) * (1 + 2 * tau * (1 + x));
  }

  double exponent_;
  InitialPopulation initial_;
  double rate_;  // B(v0)
};

class EqualBreakage final : public ExactSolution {
 public:
  EqualBreakage(const BreakageOptions& options, const InitialPopulation& initial)
      : options_(options), initial_(initial), rate_(options.rate * std::pow(initial.volume, options.exponent)) {}

  std::array<std::optional<double>, 4> moments(double time) const override {
    const auto chain = chainNumbers(time);
    std::array<std::optional<double>, 4> result;
    for (std::size_t k = 0; k < 4; ++k) {
      double sum = 0, volume = initial_.volume;
      for (const double number : chain) {
        sum += number * std::pow(volume, static_cast<double>(k));
        volume /= options_.fragments;
      }
      result[k] = initial_.number * sum;
    }
    return result;
  }

  std::vector<double> numberInBins(double time, std::span<const double> edges) const override {
    if (edges.size() < 2) return {};
    const auto chain = chainNumbers(time);
    std::vector<double> numbers(edges.size() - 1);
    double volume = initial_.volume;
    for (const double number : chain) {
      // An edge that misses a size by a rounding still is that size.
      const auto above = std::upper_bound(edges.begin(), edges.end(), volume * (1 + 1e-12));
      if (above != edges.begin() && above != edges.end()) {
        numbers[static_cast<std::size_t>(above - edges.begin()) - 1] += initial_.number * number;
      }
      volume /= options_.fragments;
    }
    return numbers;
  }

  std::string name() const override {
    return "breakage into " + std::to_string(options_.fragments) + " equal pieces, " + startOf(initial_);
  }

 private:
  std::vector<double> chainNumbers(double time) const {
    return breakageChain(options_.fragments, options_.exponent, rate_ * time);
  }

  BreakageOptions options_;
  InitialPopulation initial_;
  double rate_;  // B(v0)
};

}  // namespace

std::unique_ptr<ExactSolution> breakage(const BreakageOptions& options, const InitialPopulation& initial) {
  const bool monodisperse = initial.distribution == Distribution::monodisperse;
  if (options.daughters == BreakageOptions::Daughters::equal) {
    // A rate that grows as particles shrink turns mass into dust in finite time.
    if (!monodisperse || options.exponent < 0) return nullptr;
    return std::make_unique<EqualBreakage>(options, initial);
  }
  if (!monodisperse && initial.distribution != Distribution::exponential) return nullptr;
  if (options.exponent != 1 && options.exponent != 2) return nullptr;
  return std::make_unique<UniformBreakage>(options, initial);
}

}  // namespace lampblack::particles::exact
