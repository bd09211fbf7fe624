#include "particles/spheres/sphere_sintering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/cube_root.hpp"
#include "core/errors.hpp"
#include "particles/spheres/sphere_geometry.hpp"

namespace lampblack::particles {
namespace {

constexpr double wellKnown = 0.05;   // of a radius: narrower necks need no relative accuracy
constexpr double pastWidest = 1e-4;  // by how much of a radius a neck may overshoot that at which spheres merge
constexpr double atOnce = 1e-9;      // of the time that is left: spheres with a shorter time of sintering merge

}  // namespace

double approachRate(const SinteringLaw& law, double temperature, double first, double second, double neck) {
  const double smaller = std::min(first, second), x = planeOfNeck(first, neck), y = planeOfNeck(second, neck);
  const double tau = law.time(temperature, 2 * smaller);
  if (law.mechanism == SinteringMechanism::grainBoundary) {
    const double width = std::sqrt(neck);
    // r - x without loss where the neck is narrow.
    const double curvatures = (first + x) / neck + (second + y) / neck - 2 / width;
    return smaller * smaller * smaller * smaller / tau / (constants::pi * neck) * curvatures;
  }
  const double a = first * first, b = second * second, product = first * second, both = first + second;
  const double d = x + y;
  return smaller / tau * 4 * product * d * d * both /
         ((both + d) * ((a - b) * (a - b) + 4 * d * product * both - d * d * (a + b)));
}

SphereSintering::SphereSintering(const SinteringLaw& law, double tolerance) : law_(law), tolerance_(tolerance) {
  if (!(tolerance > 0 && tolerance <= 0.1))
    throw InputError("aggregates of spheres: the tolerance of sintering needs to be in (0, 0.1]");
  if (law.active() && !(law.prefactor > 0))
    throw InputError("aggregates of spheres: the law of sintering needs a positive prefactor");
}

// Radii of the necks of a state, by Newton's method for all spheres at once from those of before.
bool SphereSintering::setRadii(std::span<const double> state) {
  const auto spheres = aggregate_->spheres();
  const std::size_t n = spheres.size();
  for (std::size_t k = 1; k < n; ++k) {
    if (!(state[k - 1] > 0)) return false;
    necks_[k] = normalCubeRoot(state[k - 1]);
  }
  for (int iteration = 0; iteration < 30; ++iteration) {
    for (std::size_t i = 0; i < n; ++i) {
      volumes_[i] = volumeOfRadius(radii_[i]);
      slopes_[i] = surfaceOfRadius(radii_[i]);
    }
    for (std::size_t k = 1; k < n; ++k)
      for (const std::size_t i : {k, std::size_t{spheres[k].parent}}) {
        const double r = radii_[i], x = planeOfNeck(r, necks_[k]);
        volumes_[i] -= capVolume(r, x);
        slopes_[i] += constants::pi * necks_[k] * r / x - capSurface(r, x);
      }
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double change = (spheres[i].volume - volumes_[i]) / slopes_[i];
      if (!(std::abs(change) < 0.5 * radii_[i])) return false;  // not a number, too
      radii_[i] += change;
      largest = std::max(largest, std::abs(change) / radii_[i]);
    }
    if (largest < 1e-13) return true;
  }
  return false;
}

void SphereSintering::rates(std::span<const double> state, std::vector<double>& to) {
  const auto spheres = aggregate_->spheres();
  if (!setRadii(state)) {
    to.assign(state.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < spheres.size(); ++i) radii_[i] = spheres[i].radius;
    return;
  }
  for (std::size_t k = 1; k < spheres.size(); ++k) {
    const std::size_t i = spheres[k].parent;
    const double neck = necks_[k], area = constants::pi * neck;
    // What d(R^2)/2 does to the distance: each plane nears as the neck widens, and farther as the sphere grows.
    double nearer = 0;
    for (const std::size_t s : {i, k}) {
      const double x = planeOfNeck(radii_[s], neck);
      nearer += (1 - radii_[s] * area / (x * slopes_[s])) / x;
    }
    const double square = 2 * approachRate(law_, temperature_, radii_[i], radii_[k], neck) / nearer;
    to[k - 1] = 3 * neck * neck * square;
  }
}

bool SphereSintering::isPastMerging(std::span<const double> state) const {
  constexpr double limit = SphereAggregate::widest + pastWidest;
  for (std::size_t k = 1; k < aggregate_->count(); ++k) {
    const double smaller = std::min(radii_[k], radii_[aggregate_->spheres()[k].parent]);
    if (normalCubeRoot(state[k - 1]) > limit * limit * smaller * smaller) return true;
  }
  return false;
}

// Nuclei far below the size at which a solid becomes liquid sinter by decades faster than any step: whether any merge.
bool SphereSintering::mergeAtOnce(SphereAggregate& aggregate, double shortest) const {
  bool isDue = false;
  for (std::size_t k = 1; k < aggregate.count(); ++k) {
    AggregateSphere& s = aggregate.change()[k];
    const double smaller = std::min(s.radius, aggregate.spheres()[s.parent].radius);
    if (law_.time(temperature_, 2 * smaller) >= shortest) continue;
    s.neck = SphereAggregate::widest * SphereAggregate::widest * smaller * smaller;
    isDue = true;
  }
  return isDue && aggregate.mergeDue() > 0;
}

// The state of necks, those in point contact as they begin.
void SphereSintering::begin(const SphereAggregate& aggregate, double temperature) {
  aggregate_ = &aggregate;
  temperature_ = temperature;
  const std::size_t n = aggregate.count();
  for (std::vector<double>* v : {&radii_, &volumes_, &slopes_, &necks_}) v->resize(n);
  for (std::vector<double>* v : {&state_, &smallest_, &trial_}) v->resize(n - 1);
  for (std::size_t i = 0; i < n; ++i) radii_[i] = aggregate.spheres()[i].radius;
  for (std::size_t k = 1; k < n; ++k) {
    const double smaller = std::min(radii_[k], radii_[aggregate.spheres()[k].parent]);
    const double neck = std::max(aggregate.spheres()[k].neck, firstNeck * firstNeck * smaller * smaller);
    state_[k - 1] = neck * neck * neck;
    smallest_[k - 1] = std::pow(wellKnown * smaller, 6);
  }
}

// dA = (8 pi r - sum 2 pi (2 r - x)) dr + sum 2 pi r dx of each sphere, x dx = r dr - d(R^2)/2.
double SphereSintering::surfaceRate(const SphereAggregate& aggregate, double temperature) {
  if (!law_.active() || aggregate.count() < 2) return 0;
  begin(aggregate, temperature);
  rates(state_, trial_);
  const std::size_t n = aggregate.count();
  std::vector<double>& growth = smallest_;  // of radii, m/s
  growth.assign(n, 0.0);
  const auto square = [&](std::size_t k) { return trial_[k - 1] / (3 * necks_[k] * necks_[k]); };
  const auto bothOf = [&](std::size_t k) { return std::array{k, std::size_t{aggregate.spheres()[k].parent}}; };
  for (std::size_t k = 1; k < n; ++k)
    for (const std::size_t i : bothOf(k)) {
      const double area = constants::pi * necks_[k], x = planeOfNeck(radii_[i], necks_[k]);
      growth[i] += 0.5 * square(k) * area / (x * slopes_[i]);
    }
  double rate = 0;
  for (std::size_t i = 0; i < n; ++i) rate += 8 * constants::pi * radii_[i] * growth[i];
  for (std::size_t k = 1; k < n; ++k)
    for (const std::size_t i : bothOf(k)) {
      const double r = radii_[i], x = planeOfNeck(r, necks_[k]);
      const double plane = (r * growth[i] - 0.5 * square(k)) / x;
      rate += 2 * constants::pi * (r * plane - (2 * r - x) * growth[i]);
    }
  return std::max(-rate, 0.0);
}

void SphereSintering::advance(SphereAggregate& aggregate, double temperature, double time) {
  if (!law_.active() || !(time > 0)) return;
  temperature_ = temperature;
  double step = 0;
  for (bool isNew = true; time > 0 && aggregate.count() > 1;) {
    if (isNew && mergeAtOnce(aggregate, atOnce * time)) continue;
    const std::size_t n = aggregate.count();
    if (isNew) {
      begin(aggregate, temperature);
      // The first step by how fast necks widen, as if the error went with its third power.
      rates(state_, trial_);
      step = time;
      for (std::size_t k = 0; k + 1 < n; ++k)
        step = std::min(step, std::cbrt(tolerance_) * std::max(state_[k], smallest_[k]) / trial_[k]);
      isNew = false;
    }
    const double h = std::min(step, time);
    trial_ = state_;
    const auto f = [this](std::span<const double> y, std::vector<double>& to) { rates(y, to); };
    if (!step_.step(f, h, trial_, tolerance_, smallest_) || !setRadii(trial_) || isPastMerging(trial_)) {
      for (std::size_t i = 0; i < n; ++i) radii_[i] = aggregate.spheres()[i].radius;
      step = 0.5 * h;
      if (!(step > 1e-15 * time) || !(step > 0))
        throw NumericsError("sintering of an aggregate: its steps vanish; a larger 'sintering.step_error' may help");
      continue;
    }
    ++steps_;
    std::swap(state_, trial_);
    time -= h;
    if (h == step) step *= 1.5;
    for (std::size_t i = 0; i < n; ++i) aggregate.change()[i].radius = radii_[i];
    for (std::size_t k = 1; k < n; ++k) aggregate.change()[k].neck = necks_[k];
    isNew = aggregate.mergeDue() > 0;
  }
  aggregate.place();
}

}  // namespace lampblack::particles
