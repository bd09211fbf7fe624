#include "chemistry/reactor/ignition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::chemistry {

using Kind = IgnitionCriterion::Kind;

namespace {

// A largest fraction of fewer absolute tolerances is noise.
constexpr double kNoise = 1e4;
constexpr double kStageRise = 1;    // K, of a first stage
constexpr double kTimeStep = 1e-6;  // of a time, for derivatives by it

}  // namespace

IgnitionQuantity::IgnitionQuantity(const Mechanism& mechanism, OdeSystem& system, const VolumeLaw* volume)
    : mechanism_(mechanism),
      system_(system),
      volume_(volume),
      f_(system.size()),
      J_(system.size() * system.size()),
      byTime_(system.dependsOnTime() ? system.size() : 0),
      other_(byTime_.size()) {}

void IgnitionQuantity::prepare(double t, const double* y, bool withJacobian) {
  time_ = t;
  bool good = true;
  if (withJacobian && !byTime_.empty()) {
    const double h = kTimeStep * std::max(t, kTimeStep);
    good = system_.rates(t + h, y, byTime_.data()) && system_.rates(t - h, y, other_.data());
    for (std::size_t i = 0; i < byTime_.size(); ++i) byTime_[i] = (byTime_[i] - other_[i]) / (2 * h);
  }
  good = good &&
         (withJacobian ? system_.jacobian(t, y, f_.data(), J_.data(), system_.size()) : system_.rates(t, y, f_.data()));
  if (!good) throw NumericsError(fmt::format("this is not a state of a gas: {}", system_.describe(t, y)));
}

double IgnitionQuantity::moles(const double* Y) const {
  const auto W = mechanism_.molecularWeights();
  double sum = 0;
  for (std::size_t k = 0; k < W.size(); ++k) sum += Y[k] / W[k];
  return sum;
}

IgnitionQuantity::MoleFraction IgnitionQuantity::moleFraction(std::size_t k, const double* y) const {
  const double M = moles(y);
  return {y[k] / mechanism_.molecularWeights()[k] / M, M};
}

double IgnitionQuantity::moleFractionChange(std::size_t k, const MoleFraction& at, const double* s) const {
  return (s[k] / mechanism_.molecularWeights()[k] - at.X * moles(s)) / at.M;
}

double IgnitionQuantity::second(std::size_t row) const {
  double sum = byTime_.empty() ? 0 : byTime_[row];
  for (std::size_t j = 0; j < f_.size(); ++j) sum += J_[row + j * f_.size()] * f_[j];
  return sum;
}

IgnitionQuantity::Value IgnitionQuantity::of(const IgnitionCriterion& criterion, const double* y) const {
  const std::size_t n = mechanism_.numSpecies(), k = criterion.species;
  switch (criterion.kind) {
    case Kind::TemperatureRate:
      return {f_[n], second(n)};
    case Kind::PressureRate: {
      // p/scale = T M, M = sum Y/W
      const double M = moles(y), rate = moles(f_.data());
      double M2 = 0;
      for (std::size_t i = 0; i < n; ++i) M2 += second(i) / mechanism_.molecularWeights()[i];
      const double g = y[n] * M, slope = f_[n] * M + y[n] * rate;
      const double curvature = second(n) * M + 2 * f_[n] * rate + y[n] * M2;
      if (volume_ == nullptr) return {criterion.scale * slope, criterion.scale * curvature};
      // p/scale = g/v, v' = e v
      const double h = kTimeStep * std::max(time_, kTimeStep), scale = criterion.scale / volume_->ratio(time_);
      const double e = volume_->expansion(time_);
      const double eSlope = (volume_->expansion(time_ + h) - volume_->expansion(time_ - h)) / (2 * h);
      return {scale * (slope - g * e), scale * (curvature - 2 * slope * e + g * (e * e - eSlope))};
    }
    case Kind::MoleFraction:
      return {moleFraction(k, y).X, moleFractionChange(k, moleFraction(k, y), f_.data())};
    case Kind::MassFraction:
      return {y[k], f_[k]};
    case Kind::TemperatureRise:
      return {y[n], f_[n]};
  }
  return {};
}

double IgnitionQuantity::change(const IgnitionCriterion& criterion, const double* y, const double* s,
                                const double* sDot) const {
  const std::size_t n = mechanism_.numSpecies(), k = criterion.species;
  switch (criterion.kind) {
    case Kind::TemperatureRate:
      return sDot[n];
    case Kind::PressureRate:
      return criterion.scale * (sDot[n] * moles(y) + f_[n] * moles(s) + s[n] * moles(f_.data()) + y[n] * moles(sDot));
    case Kind::MoleFraction: {
      // dX/dt = (dY_k/dt/W_k - X dM/dt)/M
      const MoleFraction at = moleFraction(k, y);
      const double slope = moleFractionChange(k, at, f_.data());
      return moleFractionChange(k, at, sDot) -
             (moleFractionChange(k, at, s) * moles(f_.data()) + slope * moles(s)) / at.M;
    }
    case Kind::MassFraction:
      return sDot[k];
    case Kind::TemperatureRise:
      return s[n];
  }
  return 0;
}

IgnitionMonitor::IgnitionMonitor(const Mechanism& mechanism, OdeSystem& system, std::vector<IgnitionCriterion> criteria,
                                 const VolumeLaw* volume)
    : quantity_(mechanism, system, volume),
      criteria_(std::move(criteria)),
      events_(criteria_.size()),
      first_(criteria_.size()),
      signals_(criteria_.size()),
      temperature_(mechanism.numSpecies()),
      y_(system.size()) {
  for (const auto& criterion : criteria_) needsJacobian_ = needsJacobian_ || criterion.ofRate();
}

double IgnitionMonitor::signal(std::size_t i, const IgnitionQuantity::Value& value) const {
  return criteria_[i].kind == Kind::TemperatureRise ? startTemperature_ + criteria_[i].rise - value.value : value.slope;
}

void IgnitionMonitor::begin(double time, const double* y) {
  events_.assign(criteria_.size(), std::nullopt);
  first_.assign(criteria_.size(), std::nullopt);
  startTemperature_ = y[temperature_];
  quantity_.prepare(time, y, needsJacobian_);
  for (std::size_t i = 0; i < criteria_.size(); ++i) signals_[i] = signal(i, quantity_.of(criteria_[i], y));
}

void IgnitionMonitor::observe(const StiffIntegrator& integrator) {
  const double* y = integrator.state().data();
  quantity_.prepare(integrator.time(), y, needsJacobian_);
  std::vector<double> now(criteria_.size());
  for (std::size_t i = 0; i < criteria_.size(); ++i) now[i] = signal(i, quantity_.of(criteria_[i], y));
  for (std::size_t i = 0; i < criteria_.size(); ++i)
    if (signals_[i] > 0 && now[i] <= 0) locate(i, integrator, signals_[i], now[i]);
  signals_ = now;
}

// The zero of the signal inside the last step, by the Illinois form of regula falsi (Dowell, Jarratt 1971).
void IgnitionMonitor::locate(std::size_t i, const StiffIntegrator& integrator, double before, double after) {
  const IgnitionCriterion& criterion = criteria_[i];
  double low = integrator.previousTime(), high = integrator.time();
  const double step = high - low, slopeOfSignal = (after - before) / step;
  IgnitionQuantity::Value value;
  double time = high;
  int side = 0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double last = time;
    time = std::clamp((low * after - high * before) / (after - before), low, high);
    integrator.interpolate(time, y_);
    quantity_.prepare(time, y_.data(), needsJacobian_);
    value = quantity_.of(criterion, y_.data());
    const double here = signal(i, value);
    if (here == 0 || std::abs(time - last) < 1e-10 * step) break;
    // Twice on the same side: the value of the other end counts half.
    if (here > 0) {
      low = time;
      before = here;
      if (side > 0) after *= 0.5;
      side = 1;
    } else {
      high = time;
      after = here;
      if (side < 0) before *= 0.5;
      side = -1;
    }
  }
  IgnitionEvent event{time, value.value, 0};
  if (criterion.kind == Kind::TemperatureRise) {
    if (events_[i]) return;
    event.width = criterion.rise / std::max(value.slope, 1e-300);
  } else {
    const double noise = !criterion.ofRate() ? kNoise * integrator.options().absoluteTolerance : 0.0;
    if (!(value.value > noise) || (events_[i] && events_[i]->value >= value.value)) return;
    event.width = std::sqrt(std::abs(value.value / slopeOfSignal));
    if (criterion.firstStage) {
      if (events_[i]) return;
      if (!first_[i] && y_[temperature_] > startTemperature_ + kStageRise) first_[i] = event;
      if (first_[i] && value.value > first_[i]->value) events_[i] = first_[i];
      return;
    }
  }
  events_[i] = event;
}

}  // namespace lampblack::chemistry
