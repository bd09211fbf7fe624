#include "chemistry/reactor/reactor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "chemistry/reactor/reactor_failure.hpp"
#include "chemistry/reactor/reactor_impl.hpp"

namespace lampblack::chemistry {

namespace {

using Method = ConstantPressureReactor::Method;
using Event = ConstantPressureReactor::Event;

// Largest deviation of the sum of mass fractions that may be put down to round-off and removed by rescaling.
constexpr double kSumTolerance = 1e-9;

}  // namespace

ConstantPressureReactor::Impl::Impl(const Mechanism& mechanismIn, const Options& optionsIn)
    : mechanism(mechanismIn),
      options(optionsIn),
      n(mechanismIn.numSpecies()),
      counted(n),
      system(mechanismIn, nullptr, optionsIn.leastFraction()),
      rosenbrock(system),
      bdf(system) {
  for (auto* work : {&start, &predicted, &chemical, &chemicalEnd}) work->assign(n + 1, 0.0);
  if (options.rosenbrockSteps > 0 && ReactorLanes::covers(mechanism)) lanes.emplace(mechanism, options.leastFraction());
}

void ConstantPressureReactor::Impl::checkInput(const Cell& cell, double dt) const {
  if (cell.Y.size() != n || (!cell.source.empty() && cell.source.size() != n))
    throw std::logic_error("ConstantPressureReactor: arrays of the cell do not have one value a species");
  bool good = dt >= 0 && std::isfinite(dt) && cell.pressure > 0 && std::isfinite(cell.pressure) &&
              cell.temperature >= Thermo::minTemperature && cell.temperature <= Thermo::maxTemperature;
  double sum = 0;
  for (const double value : cell.Y) sum += value;
  for (const double value : cell.source) good = good && std::isfinite(value);
  good = good && std::isfinite(cell.heating) && std::isfinite(cell.rateFactor) && cell.rateFactor >= 0;
  good = good && std::abs(sum - 1) < 1e-3;
  if (!good) throwFailure(cell, dt);
}

// Explicit trapezoid where the chemistry is negligible at both ends; see Options::negligibleChange.
bool ConstantPressureReactor::Impl::skip(Cell& cell, double dt, Result& result) {
  if (options.negligibleChange <= 0) return false;
  system.setConditions(cell.pressure, cell.source, cell.heating, cell.rateFactor);
  ++result.rhsEvaluations;
  result.work += counted.rates;
  if (!system.chemicalRates(start.data(), chemical.data())) return false;
  double largest = 0;
  for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(chemical[k]));
  if (!(largest * dt < options.negligibleChange)) return false;
  for (std::size_t k = 0; k < n; ++k)
    predicted[k] = start[k] + dt * (chemical[k] + (cell.source.empty() ? 0.0 : cell.source[k]));
  predicted[n] = start[n];
  if (!cell.source.empty() || cell.heating != 0) {
    try {
      predicted[n] = system.thermo().temperatureFromEnthalpy(end.enthalpy, {predicted.data(), n}, start[n]);
    } catch (const NumericsError&) {
      return false;  // too far for one step; the integrator will tell
    }
  }
  ++result.rhsEvaluations;
  result.work += counted.rates;
  if (!system.chemicalRates(predicted.data(), chemicalEnd.data())) return false;
  for (std::size_t k = 0; k < n; ++k) {
    if (!(std::abs(chemicalEnd[k]) * dt < options.negligibleChange)) return false;
    if (!(0.5 * dt * std::abs(chemicalEnd[k] - chemical[k]) < options.absoluteTolerance)) return false;
  }
  for (std::size_t k = 0; k < n; ++k) predicted[k] += 0.5 * dt * (chemicalEnd[k] - chemical[k]);
  return accept(cell, predicted);
}

// Leaves the end in `predicted`.
bool ConstantPressureReactor::Impl::integrate(const Cell& cell, double dt, const Attempt& attempt, Event event,
                                              const Observer& observer, Result& result) {
  system.setConditions(cell.pressure, cell.source, cell.heating, cell.rateFactor);
  std::copy(start.begin(), start.end(), predicted.begin());
  const ReactorIntegrator::Interval part{dt / attempt.parts, attempt.firstStep,
                                         options.relativeTolerance * attempt.toleranceFactor,
                                         options.absoluteTolerance * attempt.toleranceFactor, attempt.maxSteps};
  double begin = 0;
  ReactorIntegrator::Watcher watcher;
  if (observer) {
    event.relativeTolerance = part.relativeTolerance;
    event.absoluteTolerance = part.absoluteTolerance;
    event.firstStep = part.firstStep;
    event.maxSteps = part.maxSteps;
    event.parts = attempt.parts;
    observer(event);
    watcher = [&](const ReactorIntegrator::Step& step) {
      Event taken;
      taken.kind = Event::Kind::Step;
      taken.attempt = event.attempt;
      taken.time = begin + step.time;
      taken.stepSize = step.size;
      taken.order = step.order;
      taken.temperature = step.temperature;
      observer(taken);
    };
  }
  ReactorIntegrator::Work work;
  bool arrived = true;
  for (int i = 0; arrived && i < attempt.parts; ++i) {
    begin = i * part.duration;
    if (attempt.method == Method::Rosenbrock) {
      arrived = rosenbrock.advance(part, predicted, work, watcher);
    } else {
      std::copy(predicted.begin(), predicted.end(), bdf.state());
      arrived = bdf.advance(part, work, watcher);
      std::copy_n(bdf.state(), n + 1, predicted.begin());
    }
  }
  result.steps += work.steps;
  result.rhsEvaluations += work.rhsEvaluations;
  result.jacobianEvaluations += work.jacobianEvaluations;
  result.work += attempt.method == Method::Rosenbrock ? counted.scalarStep * work.jacobianEvaluations
                                                      : counted.bdfRates * work.rhsEvaluations;
  if (!arrived) reason = attempt.method == Method::Bdf ? bdf.reason() : "more steps than the method may take";
  return arrived;
}

bool ConstantPressureReactor::Impl::attempt(Cell& cell, double dt, const Attempt& attempt, int number,
                                            const Observer& observer, Result& result) {
  Event event;
  event.attempt = number;
  event.method = attempt.method;
  const bool done = integrate(cell, dt, attempt, event, observer, result) && accept(cell, predicted);
  if (!observer) return done;
  event.kind = done ? Event::Kind::Done : Event::Kind::Failed;
  event.temperature = done ? cell.temperature : predicted[n];
  event.reason = done ? "" : reason;
  observer(event);
  return done;
}

// Takes the state in `out` over into the cell: removes the round-off of the sum, recovers the temperature from the
// enthalpy.
bool ConstantPressureReactor::Impl::accept(Cell& cell, std::span<double> out) {
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += out[k];
  if (!(std::abs(sum - end.sum) < kSumTolerance)) {
    reason = fmt::format("the sum of mass fractions moved by {:.3g}", sum - end.sum);
    return false;
  }
  const double scale = end.sum / sum;
  for (std::size_t k = 0; k < n; ++k) out[k] *= scale;
  double T = 0;
  try {
    T = system.thermo().temperatureFromEnthalpy(end.enthalpy, out.first(n), out[n]);
  } catch (const NumericsError& error) {
    reason = error.what();
    return false;
  }
  std::copy_n(out.begin(), n, cell.Y.begin());
  cell.temperature = T;
  return true;
}

void ConstantPressureReactor::Impl::throwFailure(const Cell& cell, double dt) const {
  std::string composition;
  for (std::size_t k = 0; k < n; ++k)
    if (!(std::abs(cell.Y[k]) <= 1e-6))
      composition += fmt::format("{}{}: {:.6g}", composition.empty() ? "" : ", ", mechanism.speciesName(k), cell.Y[k]);
  const std::string why = reason.empty() ? "this is not a state of a gas" : reason;
  const auto message = fmt::format(
      "the chemistry of a cell could not be advanced: T = {:.6g} K, p = {:.6g} Pa, "
      "dt = {:.6g} s, mass fractions {{{}}}; {}",
      cell.temperature, cell.pressure, dt, composition, why);
  throw ReactorFailure(
      message,
      {cell.temperature, cell.pressure, dt, cell.initialStep, std::vector<double>(cell.Y.begin(), cell.Y.end()),
       std::vector<double>(cell.source.begin(), cell.source.end()), cell.heating, cell.rateFactor, options, why},
      place);
}

ConstantPressureReactor::ConstantPressureReactor(const Mechanism& mechanism, const Options& options)
    : impl_(std::make_unique<Impl>(mechanism, options)) {}
ConstantPressureReactor::~ConstantPressureReactor() = default;
ConstantPressureReactor::ConstantPressureReactor(ConstantPressureReactor&&) noexcept = default;
ConstantPressureReactor& ConstantPressureReactor::operator=(ConstantPressureReactor&&) noexcept = default;

ConstantPressureReactor::Result ConstantPressureReactor::advance(Cell& cell, double dt, const Observer& observer) {
  auto& self = *impl_;
  const Stopwatch watch;
  self.place = 0;
  Result result;
  result.work = self.counted.cell;
  self.begin(cell, dt);
  if (dt > 0) self.advance(cell, dt, observer, result);
  result.seconds = watch.seconds();
  return result;
}

// Checks the cell and sets where it starts and what it keeps.
void ConstantPressureReactor::Impl::begin(const Cell& cell, double dt) {
  reason.clear();
  checkInput(cell, dt);
  std::copy(cell.Y.begin(), cell.Y.end(), start.begin());
  start[n] = cell.temperature;
  end.sum = 0;
  for (const double value : cell.Y) end.sum += value;
  for (const double value : cell.source) end.sum += dt * value;
  end.enthalpy = system.thermo().enthalpyMass(cell.temperature, cell.Y) + dt * cell.heating;
}

void ConstantPressureReactor::Impl::advance(Cell& cell, double dt, const Observer& observer, Result& result) {
  if (skip(cell, dt, result)) {
    result.skipped = true;
    return;
  }
  const double firstStep = cell.initialStep;
  int number = 0;
  if (isForRosenbrock(firstStep, dt, options.rosenbrockSteps)) {
    const bool done =
        attempt(cell, dt, {Method::Rosenbrock, firstStep, 1.0, options.rosenbrockSteps, 1}, ++number, observer, result);
    cell.initialStep = rosenbrock.nextStep();
    if (done) return;
  } else {
    cell.initialStep = 2 * firstStep;  // it is tried again when that would do
  }
  advanceByBdf(cell, dt, firstStep, number, observer, result);
}

// Attempts after `number` others. firstStep: the cell's own, which it keeps where they fail.
void ConstantPressureReactor::Impl::advanceByBdf(Cell& cell, double dt, double firstStep, int number,
                                                 const Observer& observer, Result& result) {
  result.handedOver = true;
  const int maxSteps = options.maxSteps;
  const Attempt attempts[] = {{Method::Bdf, 0.0, 1.0, maxSteps, 1},
                              {Method::Bdf, 1e-9 * dt, 0.1, 2 * maxSteps, 1},
                              {Method::Bdf, 1e-9 * dt, 0.01, 2 * maxSteps, 16}};
  std::string firstReason;
  for (const Attempt& one : attempts) {
    if (attempt(cell, dt, one, ++number, observer, result)) return;
    if (firstReason.empty()) firstReason = reason;
    ++result.retries;
  }
  cell.initialStep = firstStep;
  reason = fmt::format("{} (first attempt: {})", reason, firstReason);
  throwFailure(cell, dt);
}

}  // namespace lampblack::chemistry
