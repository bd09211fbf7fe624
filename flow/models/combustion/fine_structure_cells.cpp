#include "flow/models/combustion/fine_structure_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/group_failure.hpp"

namespace lampblack::flow {
namespace {

constexpr double longestPart = 0.5;  // of tau*/chi
constexpr double mostPartsOfAStep = 1e5;
constexpr double unitTime = 1.0;  // s
// Of the tolerances of reactors, for rates of a state: from one state to another the reactors take other steps, and
// their error jumps. What is left of the equations, and differences of it, cannot be known beyond that.
constexpr double smoother = 0.01;
constexpr int moreSteps = 8;
// Slopes steer iterations.
constexpr double toleranceOfSlopes = 1e-5, absoluteToleranceOfSlopes = 1e-11;
constexpr int mostStepsOfSlopes = 1000;

ConstantPressureReactor::Options smoothOf(ConstantPressureReactor::Options options) {
  options.relativeTolerance *= smoother;
  options.absoluteTolerance *= smoother;
  options.belowZero /= smoother;  // rates of the same mass fractions as the slopes have
  options.negligibleChange *= smoother;
  options.rosenbrockSteps *= moreSteps;
  return options;
}

}  // namespace

FineStructureCells::FineStructureCells(const Mechanism& mechanism, const Thermo& thermo,
                                       const ConstantPressureReactor::Options& options)
    : thermo_(thermo),
      plain_(mechanism, thermo, options),
      smooth_(mechanism, thermo, smoothOf(options)),
      system_(mechanism, nullptr, options.leastFraction()),
      steps_(system_) {}

// The fine time of each cell over one second, in which reactions go as many times as fast as it has seconds.
template <typename FractionsOf>
void FineStructureCells::react(ConstantPressureCells& reactor, const FractionsOf& fractionsOf) {
  const std::size_t n = system_.numSpecies();
  reacted_.resize(which_.size() * n);
  inside_.resize(which_.size());
  found_.assign(which_.size(), {});
  for (std::size_t i = 0; i < which_.size(); ++i) {
    const std::span<double> Y = std::span(reacted_).subspan(i * n, n);
    std::ranges::copy(fractionsOf(which_[i]), Y.begin());
    inside_[i] = {now_[which_[i]], Y, {}};
    Gas& gas = inside_[i].gas;
    gas.heating = 0.0;
    gas.firstStep *= unitTime / gas.mixing.fineTime;
    gas.mixing = {gas.mixing.fineTime / unitTime, 0.0};
  }
  try {
    reactor.advance(inside_, unitTime, found_);
  } catch (const ReactorFailure& error) {
    throw ReactorFailure(error.what(), error.cell(), which_[error.place()]);
  } catch (const FailureInGroup& error) {
    throw FailureInGroup(error.what(), which_[error.place()]);
  }
}

// Of the cells without fine structures.
void FineStructureCells::advancePlain(std::span<const Cell> cells, double dt, std::span<Result> results) {
  std::vector<Cell> plain;
  which_.clear();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].gas.mixing.fineTime > 0.0) continue;
    plain.push_back(cells[i]);
    which_.push_back(i);
  }
  if (plain.empty()) return;
  std::vector<Result> found(plain.size());
  try {
    plain_.advance(plain, dt, found);
  } catch (const ReactorFailure& error) {
    throw ReactorFailure(error.what(), error.cell(), which_[error.place()]);
  } catch (const FailureInGroup& error) {
    throw FailureInGroup(error.what(), which_[error.place()]);
  }
  for (std::size_t i = 0; i < plain.size(); ++i) results[which_[i]] = found[i];
}

void FineStructureCells::advance(std::span<const Cell> cells, double dt, std::span<Result> results) {
  advancePlain(cells, dt, results);
  const std::size_t n = system_.numSpecies();
  parts_.assign(cells.size(), 0);
  now_.resize(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    now_[i] = cells[i].gas;
    const auto& [share, time] = now_[i].mixing;
    if (!(time > 0.0)) continue;
    results[i] = {};
    results[i].isSkipped = 1.0;
    const double parts = std::ceil(share * dt / (time * longestPart));
    if (!(parts <= mostPartsOfAStep))
      throw FailureInGroup(fmt::format("fine structures mix within {:.3g} s, of which a step of {:.3g} s has too many; "
                                       "shorter steps help, or a larger combustion.laminar_below",
                                       time / share, dt),
                           i);
    parts_[i] = std::max(static_cast<int>(parts), 1);
  }
  for (int part = 0;; ++part) {
    which_.clear();
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (part < parts_[i]) which_.push_back(i);
    if (which_.empty()) return;
    react(plain_, [&](std::size_t i) { return std::span<const double>(cells[i].Y); });
    for (std::size_t at = 0; at < which_.size(); ++at) {
      const std::size_t i = which_[at];
      Gas& gas = now_[i];
      const Cell& cell = cells[i];
      const double h = dt / parts_[i], mixed = h * gas.mixing.reactingShare / gas.mixing.fineTime;
      for (std::size_t k = 0; k < n; ++k) cell.Y[k] += mixed * (reacted_[at * n + k] - cell.Y[k]) + h * cell.source[k];
      gas.enthalpy += h * gas.heating;
      try {
        gas.temperature = thermo_.temperatureFromEnthalpy(gas.enthalpy, cell.Y, gas.temperature);
      } catch (const NumericsError& error) {
        throw FailureInGroup(error.what(), i);
      }
      gas.firstStep = found_[at].firstStep * gas.mixing.fineTime / unitTime;
      Result& result = results[i];
      result.temperature = gas.temperature;
      result.firstStep = gas.firstStep;
      result.cost += found_[at].cost;
      result.steps += found_[at].steps;
      result.retries += found_[at].retries;
      result.isSkipped = std::min(result.isSkipped, found_[at].isSkipped);
      result.isHandedOver = std::max(result.isHandedOver, found_[at].isHandedOver);
    }
  }
}

void FineStructureCells::rates(std::span<const Asked> cells) {
  which_.clear();
  now_.assign(cells.size(), {});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!(cells[i].gas.mixing.fineTime > 0.0)) {
      plain_.rates(cells.subspan(i, 1));
      continue;
    }
    which_.push_back(i);
    now_[i] = cells[i].gas;
    now_[i].enthalpy = thermo_.enthalpyMass(now_[i].temperature, cells[i].Y);
    now_[i].firstStep = 0.0;
  }
  if (which_.empty()) return;
  react(smooth_, [&](std::size_t i) { return cells[i].Y; });
  const std::size_t n = system_.numSpecies();
  for (std::size_t at = 0; at < which_.size(); ++at) {
    const auto& [gas, Y, rates] = cells[which_[at]];
    const std::span<const double> reacted(&reacted_[at * n], n);
    const double speed = gas.mixing.reactingShare / gas.mixing.fineTime;
    for (std::size_t k = 0; k < n; ++k) rates.values[k] = speed * (reacted[k] - Y[k]);
    if (!rates.slopes.empty()) findSlopes(gas, Y, rates.slopes);
  }
}

// chi/tau* (d(Y*, T*)/d(Y, T) - 1).
void FineStructureCells::findSlopes(const Gas& gas, std::span<const double> Y, std::span<double> slopes) {
  const std::size_t width = system_.size();
  std::vector<double> y(Y.begin(), Y.end());
  y.push_back(gas.temperature);
  std::ranges::fill(slopes, 0.0);
  for (std::size_t j = 0; j < width; ++j) slopes[j * width + j] = 1.0;
  system_.setConditions(gas.pressure, {});
  ReactorIntegrator::Work work;
  if (!steps_.advance({gas.mixing.fineTime, 0.0, toleranceOfSlopes, absoluteToleranceOfSlopes, mostStepsOfSlopes}, y,
                      work, {}, slopes))
    throw NumericsError(fmt::format("the reactions of fine structures have no slopes: {}",
                                    system_.refusal().empty()
                                        ? fmt::format("they need more than {} steps", mostStepsOfSlopes)
                                        : system_.refusal()));
  const double speed = gas.mixing.reactingShare / gas.mixing.fineTime;
  for (std::size_t j = 0; j < width; ++j) {
    slopes[j * width + j] -= 1.0;
    for (std::size_t k = 0; k < width; ++k) slopes[j * width + k] *= speed;
  }
}

}  // namespace lampblack::flow
