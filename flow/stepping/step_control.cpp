#include "flow/stepping/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "flow/cell_errors.hpp"
#include "flow/models/reaction_operator.hpp"

namespace lampblack::flow {
namespace {

// Of what a step may change: how much of it the next one aims at, and beyond which a cell that is colder than all else,
// or has less than the least of a species, has come there by the step itself.
constexpr double aimed = 0.8, sudden = 0.1;
// The same of the mass fraction that a step may leave below zero.
constexpr double aimedBelow = 0.5;
constexpr double helping = 0.8;         // of what the attempt before did
constexpr double ofRoundOff = 1e-6;     // of a temperature
constexpr double shortestFactor = 0.2;  // of the step before

// By how much a step has taken a mass fraction, by its place in the state, (further) below zero.
double takenBelowZero(const State& state, std::size_t i) {
  return std::min(state.start.Y.empty() ? 0.0 : state.start.Y[i], 0.0) - state.Y[i];
}

}  // namespace

StepControl::StepControl(const FlowContext& context, const Options& options)
    : context_(context),
      options_(options),
      failed_(std::numeric_limits<double>::infinity()),
      coldest_(failed_),
      heat_(static_cast<std::size_t>(context.mesh.owned), 0.0) {
  if (options.tolerance && options.sweeps < 2) throw std::logic_error("StepControl needs two sweeps");
}

// K, of this rank's boundaries now.
double StepControl::coldestGiven() const {
  const Mesh& m = context_.mesh;
  double coldest = std::numeric_limits<double>::infinity();
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const bool feeds = context_.boundaryOf(face).kind == BoundaryKind::Outlet;
    if (feeds || context_.isTemperatureGiven(face)) coldest = std::min(coldest, context_.boundaryTemperature(face));
  }
  return coldest;
}

void StepControl::advance(State& state, double time, double dt) {
  ++sweep_;
  const auto owned = static_cast<std::size_t>(context_.mesh.owned);
  if (options_.tolerance && sweep_ == options_.sweeps - 1) {
    const std::size_t fractions = owned * static_cast<std::size_t>(state.species);
    temperature_.assign(state.temperature.begin(), state.temperature.begin() + static_cast<std::ptrdiff_t>(owned));
    Y_.assign(state.Y.begin(), state.Y.begin() + static_cast<std::ptrdiff_t>(fractions));
  }
  if (sweep_ < options_.sweeps) return;
  sweep_ = 0;
  if (options_.tolerance) findError(state);
  requireSound(state);
  keepChange(state, time, dt);
  keepHeat(state);
  step_ = dt;
}

void StepControl::findError(const State& state) {
  error_ = 0.0;
  for (std::size_t c = 0; c < temperature_.size(); ++c)
    error_ = std::max(error_, std::abs(state.temperature[c] - temperature_[c]) / state.temperature[c]);
  for (std::size_t i = 0; i < Y_.size(); ++i) error_ = std::max(error_, std::abs(state.Y[i] - Y_[i]));
  MPI_Allreduce(MPI_IN_PLACE, &error_, 1, MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
}

// How far a cell is beyond what a step may do to it, one where it just may; and what is wrong.
double StepControl::excess(const State& state, int cell, std::string* fault) const {
  const auto c = static_cast<std::size_t>(cell), n = static_cast<std::size_t>(state.species);
  const double before = start_[c], now = state.temperature[c], change = now - before;
  double most = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double Y = state.Y[c * n + k];
    if (Y / options_.leastMassFraction <= most) continue;
    if (Y < options_.leastMassFraction && takenBelowZero(state, c * n + k) < -sudden * options_.leastMassFraction)
      continue;  // steps of any length would find it so
    most = Y / options_.leastMassFraction;
    if (fault)
      *fault = fmt::format("the mass fraction of {} has become {:.3g}, below {:.3g} (time.least_mass_fraction)",
                           context_.mechanism.speciesName(k), Y, options_.leastMassFraction);
  }
  const auto blame = [&](double by, const std::string& limit) {
    if (by <= most) return;
    most = by;
    if (fault)
      *fault = fmt::format("the temperature has gone from {:.5g} to {:.5g} K in one step; {}", before, now, limit);
  };
  if (std::abs(change) > options_.temperatureChange)
    blame(std::abs(change) / options_.temperatureChange,
          fmt::format("it may change by {:.4g} K (time.temperature_change)", options_.temperatureChange));
  if (now < coldest_ * (1.0 - ofRoundOff))
    blame(-change / (sudden * options_.temperatureChange),
          fmt::format("the start and all boundaries are warmer ({:.5g} K and more)", coldest_));
  return most;
}

void StepControl::requireSound(const State& state) {
  const Mesh& m = context_.mesh;
  inEachCell(m, [&](int c) { Transport::requireInRange(state.temperature[c]); });
  double coldest = coldestGiven();
  MPI_Allreduce(MPI_IN_PLACE, &coldest, 1, MPI_DOUBLE, MPI_MIN, m.comm);
  coldest_ = std::min(coldest_, coldest);
  double worst = 0.0;
  for (int c = 0; c < m.owned; ++c) worst = std::max(worst, excess(state, c, nullptr));
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  // Where the shorter step does as much, it is not the step's length.
  const bool helps = worst < helping * failed_;
  failed_ = worst <= 1.0 || !helps ? std::numeric_limits<double>::infinity() : worst;
  hasTakenTooMuch_ = worst > 1.0 && !helps;
  if (worst <= 1.0 || !helps) return;
  inEachCell(m, [&](int c) {
    std::string fault;
    if (excess(state, c, &fault) == worst)
      throw NumericsError(fault + "; shorter steps may help (time.maximum_step, time.courant)");
  });
}

void StepControl::keepChange(const State& state, double time, double dt) {
  const Peak largest = peakOf(
      context_.mesh, [&](int c) { return std::abs(state.temperature[c] - start_[static_cast<std::size_t>(c)]); });
  change_ = largest.value;
  place_ = largest.place;
  changeSinceRow_ = std::max(changeSinceRow_, change_);
  const auto n = static_cast<std::size_t>(state.species);
  undershoot_ = 0.0;
  for (std::size_t i = 0; i < start_.size() * n; ++i) undershoot_ = std::max(undershoot_, takenBelowZero(state, i));
  MPI_Allreduce(MPI_IN_PLACE, &undershoot_, 1, MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
  const Peak missing = peakOf(context_.mesh, [&](int c) {
    const double* Y = &state.Y[static_cast<std::size_t>(c) * n];
    return std::max(0.0, -*std::min_element(Y, Y + n));
  });
  if (hasTakenTooMuch_ && ++takenTooMuch_ == 1.0) firstTooMuch_ = time;
  const auto keep = [&](const Peak& found, Worst& worst) {
    if (found.value > worst.peak.value) worst = {found, time + dt};
  };
  keep(largest, warming_);
  keep(missing, negative_);
}

void StepControl::keepHeat(const State& state) {
  std::array<double, 2> largest{0.0, 0.0};  // heat release, and change of it
  std::vector<double> enthalpies(static_cast<std::size_t>(state.species));
  for (std::size_t c = 0; c < heat_.size(); ++c) {
    const double now = heatRelease(context_, state, c, enthalpies);
    largest[0] = std::max(largest[0], std::abs(now));
    largest[1] = std::max(largest[1], std::abs(now - heat_[c]));
    heat_[c] = now;
  }
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
  const double unit = std::max(largestHeat_, largest[0]);
  largestHeat_ = largest[0];
  if (unit > 0.0) heatChangeSinceRow_ = std::max(heatChangeSinceRow_, largest[1] / unit);
}

void StepControl::endStep(State& state) {
  const auto owned = static_cast<std::ptrdiff_t>(context_.mesh.owned);
  start_.assign(state.temperature.begin(), state.temperature.begin() + owned);
  if (coldest_ < std::numeric_limits<double>::infinity()) return;
  for (const double T : start_) coldest_ = std::min(coldest_, T);
  MPI_Allreduce(MPI_IN_PLACE, &coldest_, 1, MPI_DOUBLE, MPI_MIN, context_.mesh.comm);
}

double StepControl::largestStep(const State&) {
  if (step_ <= 0.0) return std::numeric_limits<double>::infinity();
  double factor = std::numeric_limits<double>::infinity();
  // What is beyond it has not been for the step's length.
  if (change_ <= options_.temperatureChange)
    factor = aimed * options_.temperatureChange / std::max(change_, 1e-6 * options_.temperatureChange);
  if (undershoot_ > 0.0 && undershoot_ <= -options_.leastMassFraction)
    factor = std::min(factor, aimedBelow * -options_.leastMassFraction / undershoot_);
  // A sweep has the error step^(sweeps) after those before it.
  if (options_.tolerance)
    factor = std::min(factor, 0.9 * std::pow(*options_.tolerance / std::max(error_, 1e-6 * *options_.tolerance),
                                             1.0 / options_.sweeps));
  return step_ * std::max(factor, shortestFactor);
}

void StepControl::saveOrLoad(StateArchive& archive) {
  archive.cells("heat_release_of_step", heat_, 1);
  const std::array scalars{&error_,        &step_,         &change_,     &changeSinceRow_, &coldest_,
                           &takenTooMuch_, &firstTooMuch_, &undershoot_, &largestHeat_,    &heatChangeSinceRow_};
  std::vector<double*> values(scalars.begin(), scalars.end());
  for (double& coordinate : place_) values.push_back(&coordinate);
  for (Worst* worst : {&warming_, &negative_}) {
    values.insert(values.end(), {&worst->peak.value, &worst->time});
    for (double& coordinate : worst->peak.place) values.push_back(&coordinate);
  }
  std::vector<double> kept;
  for (const double* value : values) kept.push_back(*value);
  archive.shared("step_control", kept);
  if (!archive.loading()) return;
  for (std::size_t i = 0; i < values.size(); ++i) *values[i] = kept.at(i);
  sweep_ = 0;  // of a step that was broken off
}

std::vector<Quantity> StepControl::historyColumns() const {
  std::vector<Quantity> columns{
      {"temperature_change", "K", "largest change of a cell's temperature in a step since the last row"},
      {"heat_release_change", "1",
       "largest change of a cell's heat release in a step since the last row, over the largest of any cell"},
      {"heat_release", integralUnit(context_.mesh, "W"),
       "heat set free by the gas reactions in the last step, after an iteration in the state"}};
  if (options_.tolerance)
    columns.push_back({"step_error", "1",
                       "largest change of a cell's temperature, relative, or of a mass fraction by the last sweep"});
  return columns;
}

std::vector<double> StepControl::historyValues(const State&) {
  double heat = 0.0;
  for (std::size_t c = 0; c < heat_.size(); ++c) heat += context_.mesh.volume[c] * heat_[c];
  MPI_Allreduce(MPI_IN_PLACE, &heat, 1, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  std::vector<double> values{std::exchange(changeSinceRow_, 0.0), std::exchange(heatChangeSinceRow_, 0.0), heat};
  if (options_.tolerance) values.push_back(error_);
  return values;
}

std::vector<std::string> StepControl::closingLines() const {
  if (step_ <= 0.0) return {};
  const auto whereOf = [&](const Worst& worst) {
    return fmt::format("at {} at t = {:.4g} s", placeText(worst.peak.place, context_.mesh.dimension), worst.time);
  };
  std::vector<std::string> lines{
      fmt::format("largest change of a temperature in one step {:.3g} K {}; {:.3g} K in the last, at {}",
                  warming_.peak.value, whereOf(warming_), change_, placeText(place_, context_.mesh.dimension))};
  if (negative_.peak.value > 0.0)
    lines.push_back(
        fmt::format("most negative mass fraction of all steps {:.2g} {}", -negative_.peak.value, whereOf(negative_)));
  if (takenTooMuch_ > 0.0)
    lines.push_back(fmt::format(
        "steps that did more than time.temperature_change or time.least_mass_fraction allow, and were taken "
        "since a shorter one did as much: {:.0f}, the first at t = {:.4g} s",
        takenTooMuch_, firstTooMuch_));
  return lines;
}

}  // namespace lampblack::flow
