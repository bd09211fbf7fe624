// Coagulation with the constant, the additive and the multiplicative kernel. The moments hold from any start; the
// distributions from equal particles (Smoluchowski 1917; Golovin 1963; McLeod 1962) and from an exponential
// distribution (Schumann 1940; Golovin 1963; Scott 1968; Ernst, Ziff and Hendriks 1984).
#include <algorithm>
#include <cmath>

#include "particles/population/exact_solutions/clusters.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"
#include "particles/population/exact_solutions/quadrature.hpp"
#include "particles/population/exact_solutions/series.hpp"
#include "particles/population/exact_solutions/solutions.hpp"

namespace lampblack::particles::exact {
namespace {

using Distribution = InitialPopulation::Distribution;

class Coagulation final : public ExactSolution {
 public:
  Coagulation(CollisionKernelType kernel, double rate, const InitialPopulation& initial)
      : kernel_(kernel), rate_(rate), initial_(initial) {
    for (std::size_t k = 0; k < 4; ++k) start_[k] = initialMoment(initial, static_cast<double>(k));
  }

  std::array<std::optional<double>, 4> moments(double time) const override {
    const auto [m0, m1, m2, m3] = start_;
    const double t = rate_ * time;
    switch (kernel_) {
      case CollisionKernelType::constant:
        return {m0 / (1 + 0.5 * m0 * t), m1, m2 + m1 * m1 * t, m3 + 3 * m1 * t * (m2 + 0.5 * m1 * m1 * t)};
      case CollisionKernelType::additive: {
        const double e = std::exp(m1 * t);
        const double source = m1 > 0 ? 3 * m2 * m2 / m1 * std::expm1(m1 * t) : 0.0;
        return {m0 / e, m1, m2 * e * e, e * e * e * (m3 + source)};
      }
      default: {
        const double rest = 1 - m2 * t;
        if (!(rest > 0)) return {};
        return {m0 - 0.5 * m1 * m1 * t, m1, m2 / rest, m3 / (rest * rest * rest)};
      }
    }
  }

  std::vector<double> numberInBins(double time, std::span<const double> edges) const override {
    const bool isKnown =
        initial_.distribution == Distribution::monodisperse || initial_.distribution == Distribution::exponential;
    if ((!isKnown && initial_.distribution != Distribution::none) || edges.size() < 2) return {};
    if (const auto gelation = gelationTime(); gelation && time >= *gelation) return {};
    std::vector<double> numbers(edges.size() - 1);
    if (time <= 0 || start_[0] <= 0) {
      for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = initialNumber(initial_, edges[k], edges[k + 1]);
      return numbers;
    }
    const bool equal = initial_.distribution == Distribution::monodisperse;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const double lower = std::max(edges[k], 0.0) / initial_.volume, upper = edges[k + 1] / initial_.volume;
      numbers[k] = initial_.number * (equal ? clusters(time, lower, upper) : fraction(time, lower, upper));
    }
    return numbers;
  }

  std::optional<double> gelationTime() const override {
    if (kernel_ != CollisionKernelType::multiplicative || !(rate_ * start_[2] > 0)) return {};
    return 1 / (rate_ * start_[2]);
  }

  std::string name() const override {
    std::string text = "coagulation, ";
    text += kernel_ == CollisionKernelType::constant   ? "constant"
            : kernel_ == CollisionKernelType::additive ? "additive"
                                                       : "multiplicative";
    text += " kernel, ";
    text += initial_.distribution == Distribution::monodisperse  ? "monodisperse"
            : initial_.distribution == Distribution::exponential ? "exponential"
            : initial_.distribution == Distribution::table       ? "tabulated"
            : initial_.distribution == Distribution::modes       ? "several modes at the"
                                                                 : "log-normal";
    return text + " start";
  }

 private:
  // Time in units of A N0 v0^degree.
  double scaledTime(double time) const {
    const double degree = kernel_ == CollisionKernelType::constant   ? 0
                          : kernel_ == CollisionKernelType::additive ? 1
                                                                     : 2;
    return rate_ * time * initial_.number * std::pow(initial_.volume, degree);
  }

  // Share of the initial number that is in clusters of lower <= k < upper, from equal particles.
  double clusters(double time, double lower, double upper) const {
    const double tau = scaledTime(time);
    switch (kernel_) {
      case CollisionKernelType::constant:
        return geometricClusters(tau, lower, upper);
      case CollisionKernelType::additive:
        // (1-T) (kT)^(k-1) exp(-kT) / k!
        return borelClusters({.factor = std::exp(-tau), .power = 1.5, .t = -std::expm1(-tau), .rest = std::exp(-tau)},
                             lower, upper);
      default:
        // k^(k-2) tau^(k-1) exp(-k tau) / k!
        return borelClusters({.factor = 1, .power = 2.5, .t = tau, .rest = 1 - tau}, lower, upper);
    }
  }

  // The same from an exponential distribution.
  double fraction(double time, double lower, double upper) const {
    const double tau = scaledTime(time);
    switch (kernel_) {
      case CollisionKernelType::constant: {
        const double mean = 1 + 0.5 * tau;
        return -std::exp(-lower / mean) * std::expm1((lower - upper) / mean) / mean;
      }
      case CollisionKernelType::additive: {
        const double rest = std::exp(-tau), root = std::sqrt(-std::expm1(-tau));
        const double decay = rest / (1 + root) * rest / (1 + root);  // (1 - root)^2
        const auto density = [&](double x) {
          return rest / (x * root) * std::exp(-decay * x) * scaledBesselI1(2 * x * root);
        };
        return integralOverSizes(density, lower, upper, 80 / decay);
      }
      default:
        // Decays at least as exp(-(1 + tau - 3 (tau/4)^(1/3)) x), zero at tau = 1/2 where it gels.
        return integralOverSizes([&](double x) { return multiplicativeDensity(tau, x); }, lower, upper,
                                 80 / (1 + tau - 3 * std::cbrt(tau / 4)));
    }
  }

  CollisionKernelType kernel_;
  double rate_;
  InitialPopulation initial_;
  std::array<double, 4> start_{};
};

}  // namespace

std::unique_ptr<ExactSolution> coagulation(CollisionKernelType kernel, double rate, const InitialPopulation& initial) {
  return std::make_unique<Coagulation>(kernel, rate, initial);
}

}  // namespace lampblack::particles::exact
