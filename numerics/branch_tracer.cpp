#include "numerics/branch_tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::numerics {
namespace {

// Where load = from.load + slope s + curvature s^2, with s the arc length from there, turns.
TurningPoint vertex(std::size_t index, const BranchPoint& from, double slope, double curvature) {
  const double s = -0.5 * slope / curvature;
  return {index, from.load + 0.5 * slope * s, from.arcLength + s, curvature < 0};
}

}  // namespace

std::optional<TurningPoint> turningPointOf(std::size_t index, const BranchPoint& a, const BranchPoint& b,
                                           const BranchPoint& c) {
  const double before = (b.load - a.load) / (b.arcLength - a.arcLength);
  const double after = (c.load - b.load) / (c.arcLength - b.arcLength);
  if (before * after >= 0) return std::nullopt;
  const double curvature = (after - before) / (c.arcLength - a.arcLength);
  return vertex(index, a, before - curvature * (b.arcLength - a.arcLength), curvature);
}

BranchTracer::BranchTracer(LoadedSystem& system, ContinuationOptions options)
    : system_(system), options_(options), solver_(options.newton), step_(options.firstStep) {}

void BranchTracer::setWeights() {
  const std::size_t n = x_.size();
  weights_.resize(n);
  system_.scales(x_, weights_);
  for (double& w : weights_) w = 1 / (w * w * static_cast<double>(n - 1));
  weights_[n - 1] *= static_cast<double>(n - 1) * options_.loadWeight * options_.loadWeight;
}

double BranchTracer::product(std::span<const double> a, std::span<const double> b) const {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += weights_[i] * a[i] * b[i];
  return sum;
}

void BranchTracer::findTangent(double sign) {
  tangent_.assign(x_.size(), 0.0);
  tangent_.back() = sign;
  system_.solve(tangent_);
  const double length = std::sqrt(product(tangent_, tangent_));
  for (double& t : tangent_) t /= length;
}

void BranchTracer::constrain(double step) {
  LoadConstraint constraint;
  constraint.coefficients.resize(x_.size());
  for (std::size_t i = 0; i < x_.size(); ++i) constraint.coefficients[i] = weights_[i] * tangent_[i];
  constraint.value = product(tangent_, x_) + step;
  system_.setConstraint(std::move(constraint));
}

bool BranchTracer::start(std::span<const double> x) {
  x_.assign(x.begin(), x.end());
  system_.setConstraint(std::nullopt);
  system_.setLoad(x_.back());
  NewtonReport report = solver_.newton(system_, x_);
  if (!report.converged) {
    reason_ = report.reason;
    return false;
  }
  counts_ = report;
  if (!system_.factorise(x_, 0)) {
    reason_ = "the Newton matrix is singular at the start";
    return false;
  }
  ++counts_.factorisations;
  setWeights();
  findTangent(options_.towardsHigherLoad ? 1 : -1);
  tangentIsExact_ = true;
  firstSlope_ = tangent_.back();
  points_.push_back({x_.back(), 0, std::move(report)});
  return true;
}

BranchTracer::Outcome BranchTracer::correct(std::vector<double>& candidate, double step, NewtonReport& report) {
  constrain(step);
  candidate.resize(x_.size());
  std::vector<double> lower(x_.size()), upper(x_.size());
  system_.bounds(lower, upper);
  // Only where the search begins: its result obeys the constraint.
  for (std::size_t i = 0; i < x_.size(); ++i) candidate[i] = std::clamp(x_[i] + step * tangent_[i], lower[i], upper[i]);
  system_.beginStep();
  try {
    report = solver_.newton(system_, candidate);
  } catch (const NumericsError& error) {
    report = {};
    report.reason = error.what();
  }
  counts_.steps += report.steps;
  counts_.factorisations += report.factorisations;
  counts_.residuals += report.residuals;
  if (!report.converged) {
    reason_ = report.reason;
    return Outcome::Failed;
  }
  std::vector<double> off(x_.size());
  for (std::size_t i = 0; i < off.size(); ++i) off[i] = candidate[i] - x_[i] - step * tangent_[i];
  deviation_ = std::sqrt(product(off, off));
  if (step > 0 && deviation_ > 2.5 * options_.bend * step) {
    reason_ = fmt::format("the branch bends away within a step of {:.3g}", step);
    return Outcome::TooFar;
  }
  return Outcome::Converged;
}

bool BranchTracer::advance() {
  std::vector<double> candidate;
  NewtonReport report;
  Outcome outcome = Outcome::Failed;
  while (true) {
    outcome = correct(candidate, step_, report);
    if (outcome == Outcome::Converged) break;
    step_ *= outcome == Outcome::TooFar ? 0.5 : 0.25;
    if (step_ < options_.smallestStep) {
      reason_ = fmt::format("steps became shorter than {:g}: {}", options_.smallestStep, reason_);
      return false;
    }
    if (!tangentIsExact_) {
      // The tangent came from factors of another point. Its own plane orients the new one.
      constrain(0);
      ++counts_.factorisations;
      if (system_.factorise(x_, 0)) findTangent(1);
      tangentIsExact_ = true;
    }
  }

  const double chord = std::hypot(step_, deviation_);
  x_ = candidate;
  setWeights();
  findTangent(1);
  tangentIsExact_ = false;
  double factor = static_cast<double>(options_.goodSteps) / static_cast<double>(std::max<std::size_t>(report.steps, 1));
  factor = std::min(factor, options_.bend * step_ / std::max(deviation_, 1e-300));
  step_ = std::min(step_ * std::clamp(factor, 0.3, 2.0), options_.largestStep);
  points_.push_back({x_.back(), points_.back().arcLength + chord, std::move(report)});
  findTurningPoint();
  return true;
}

bool BranchTracer::resume(std::span<const double> x, std::span<const double> tangent) {
  x_.assign(x.begin(), x.end());
  tangent_.assign(tangent.begin(), tangent.end());
  setWeights();
  const double length = std::sqrt(product(tangent_, tangent_));
  for (double& t : tangent_) t /= length;
  std::vector<double> candidate;
  NewtonReport report;
  if (correct(candidate, 0, report) != Outcome::Converged) return false;
  x_ = candidate;
  setWeights();
  findTangent(1);
  tangentIsExact_ = false;
  return true;
}

void BranchTracer::release() {
  system_.setConstraint(std::nullopt);
  if (!x_.empty()) system_.setLoad(x_.back());
}

void BranchTracer::findTurningPoint() {
  const std::size_t last = points_.size() - 1;
  const BranchPoint& b = points_[last - 1];
  const BranchPoint& c = points_[last];
  if (last > 1) {
    if (const auto turn = turningPointOf(last - 1, points_[last - 2], b, c)) turningPoints_.push_back(*turn);
    return;
  }
  const double after = (c.load - b.load) / (c.arcLength - b.arcLength);
  if (firstSlope_ * after < 0) turningPoints_.push_back(vertex(0, b, firstSlope_, (after - firstSlope_) / c.arcLength));
}

}  // namespace lampblack::numerics
