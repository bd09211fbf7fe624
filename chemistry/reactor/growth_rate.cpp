#include "chemistry/reactor/growth_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lampblack::chemistry {
namespace {

constexpr double perKelvin = 1e-3;  // what a change of temperature counts beside one of a mass fraction
// Powers until what decays is gone, and those behind, over which a mode that grows does so a hundredfold.
constexpr int powersBefore = 10, powersBehind = 20;
constexpr double hundredfold = 100.0;
// Of dt, the shortest first. Each finds rates from about 0.25/h to 1/h.
constexpr std::array stepShares{0.0156, 0.0625, 0.25};

}  // namespace

GrowthRate::GrowthRate(const Mechanism& mechanism, double leastFraction)
    : n_(mechanism.numSpecies() + 1),
      system_(mechanism, nullptr, leastFraction),
      lu_(n_),
      state_(n_),
      rates_(n_),
      jacobian_(n_ * n_),
      vector_(n_) {}

// The vector becomes one of length one; its length before.
double GrowthRate::normalise() {
  double square = 0.0;
  for (std::size_t i = 0; i < n_; ++i) square += vector_[i] * vector_[i] * (i + 1 == n_ ? perKelvin * perKelvin : 1.0);
  const double length = std::sqrt(square);
  for (double& value : vector_) value /= length;
  return length;
}

// Of a mode with a rate from about 0.25/h to 1/h; zero where there is none.
double GrowthRate::growth(double h) {
  for (std::size_t j = 0; j < n_; ++j) {
    double* column = lu_.column(j);
    for (std::size_t i = 0; i < n_; ++i) column[i] = (i == j ? 1.0 : 0.0) - h * jacobian_[i + n_ * j];
  }
  if (!lu_.factorise()) return 0.0;
  vector_ = rates_;
  if (!(normalise() > 0.0)) return 0.0;
  double last = 0.0;
  for (int power = 0; power < powersBefore; ++power) {
    lu_.solve(vector_.data());
    last = normalise();
  }
  if (!(last > 1.0)) return 0.0;  // most cells of a flow
  double factor = 1.0;
  for (int power = 0; power < powersBehind; ++power) {
    lu_.solve(vector_.data());
    last = normalise();
    factor *= last;
  }
  return factor > hundredfold && std::isfinite(factor) ? (1.0 - 1.0 / last) / h : 0.0;
}

double GrowthRate::of(double temperature, double pressure, std::span<const double> Y, double dt, double rateFactor) {
  std::ranges::copy(Y, state_.begin());
  state_[n_ - 1] = temperature;
  system_.setConditions(pressure, {}, 0.0, rateFactor);
  if (!system_.jacobian(state_.data(), rates_.data(), jacobian_.data(), n_)) return 0.0;
  for (const double share : stepShares)
    if (const double rate = growth(share * dt); rate > 0.0) return rate;
  return 0.0;
}

}  // namespace lampblack::chemistry
