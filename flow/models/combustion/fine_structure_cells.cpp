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

}  // namespace

FineStructureCells::FineStructureCells(const Mechanism& mechanism, const Thermo& thermo,
                                       const ConstantPressureReactor::Options& options)
    : thermo_(thermo),
      plain_(mechanism, thermo, options),
      system_(mechanism, nullptr, options.leastFraction()),
      matrix_(system_) {}

// The fine time of each cell over one second, in which reactions go as many times as fast as it has seconds.
void FineStructureCells::react(std::span<const Cell> cells, std::span<const std::size_t> which) {
  const std::size_t n = system_.numSpecies();
  reacted_.resize(which.size() * n);
  inside_.resize(which.size());
  found_.assign(which.size(), {});
  for (std::size_t i = 0; i < which.size(); ++i) {
    const std::span<double> Y = std::span(reacted_).subspan(i * n, n);
    std::ranges::copy(cells[which[i]].Y, Y.begin());
    inside_[i] = {now_[which[i]], Y, {}};
    Gas& gas = inside_[i].gas;
    gas.heating = 0.0;
    gas.firstStep *= unitTime / gas.mixing.fineTime;
    gas.mixing = {gas.mixing.fineTime / unitTime, 0.0};
  }
  try {
    plain_.advance(inside_, unitTime, found_);
  } catch (const ReactorFailure& error) {
    throw ReactorFailure(error.what(), error.cell(), which[error.place()]);
  } catch (const FailureInGroup& error) {
    throw FailureInGroup(error.what(), which[error.place()]);
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
    react(cells, which_);
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

void FineStructureCells::rates(const Gas& gas, std::span<const double> Y, const Rates& rates) {
  if (!(gas.mixing.fineTime > 0.0)) return plain_.rates(gas, Y, rates);
  std::vector<double> at(Y.begin(), Y.end());
  now_.assign(1, gas);
  now_[0].enthalpy = thermo_.enthalpyMass(gas.temperature, Y);
  now_[0].firstStep = 0.0;
  const Cell cell{now_[0], at, {}};
  constexpr std::size_t first = 0;
  react({&cell, 1}, {&first, 1});
  const double speed = gas.mixing.reactingShare / gas.mixing.fineTime;
  for (std::size_t k = 0; k < Y.size(); ++k) rates.values[k] = speed * (reacted_[k] - Y[k]);
  if (!rates.slopes.empty()) findSlopes(gas, reacted_, found_[0].temperature, rates.slopes);
}

// Of Y* = Y + tau* w(Y*): (1 - tau* J)^-1 J, J of what has reacted.
void FineStructureCells::findSlopes(const Gas& gas, std::span<const double> reacted, double temperature,
                                    std::span<double> slopes) {
  const std::size_t width = system_.size();
  std::vector<double> y(reacted.begin(), reacted.end()), f(width);
  y.push_back(temperature);
  system_.setConditions(gas.pressure, {});
  if (!system_.jacobian(y.data(), f.data(), slopes.data(), width) || !matrix_.evaluate(system_, y.data(), f.data()))
    throw NumericsError("the reactions have no rates: " + system_.refusal());
  if (!matrix_.factorise(gas.mixing.fineTime)) throw NumericsError("the reactions of fine structures have no slopes");
  for (std::size_t j = 0; j < width; ++j) {
    double* column = &slopes[j * width];
    matrix_.solve(column);
    for (std::size_t k = 0; k < width; ++k) column[k] *= gas.mixing.reactingShare;
  }
}

}  // namespace lampblack::flow
