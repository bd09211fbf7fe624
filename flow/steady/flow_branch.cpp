#include "flow/steady/flow_branch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "flow/cell_errors.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/peak.hpp"
#include "flow/steady/residual_norms.hpp"

namespace lampblack::flow {
namespace {

// The pseudo-time of a state beside one that is known: longer than that of a flow that comes from steps in time.
constexpr double courantOfBranch = 20.0;
// Iterations without a residual that is less than the best before by a share: a shorter step is tried.
constexpr int patienceOfBranch = 60;
constexpr double gainOfBranch = 0.9;
constexpr int mostFailuresOfBranch = 8;  // in a row
// A step finds the state it goes to where the temperature of no cell is far from what was foretold: of the largest
// change that was foretold, and K; nothing is foretold of the second state.
constexpr double mostAstray = 1.0, mostBesideForetold = 50.0, mostUnforetold = 300.0;
constexpr double shorterStep = 0.4, longerStep = 1.5;
constexpr int fewOfState = 60, manyOfState = 150;
constexpr double shortestStep = 0.01;  // of the first step
// Of a step: the change of the load and of the largest temperature that it foretells, at most.
constexpr double mostOfLoadInStep = 0.15, mostOfPeakInStep = 60.0;  // K

double largestOwned(const Mesh& m, const std::vector<double>& values) {
  double most = -std::numeric_limits<double>::infinity();
  for (int c = 0; c < m.owned; ++c) most = std::max(most, values[c]);
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  return most;
}

}  // namespace

FlowBranch::FlowBranch(FlowContext& context, State& state, VelocityScheme scheme, std::vector<Operator*> operators,
                       double time, Options options)
    : context_(context),
      state_(state),
      scheme_(scheme),
      operators_(std::move(operators)),
      time_(time),
      options_(options),
      control_(context, state, options.load),
      step_(options.firstStep) {}

std::vector<double> FlowBranch::temperatures(const State& state) const {
  return {state.temperature.begin(), state.temperature.begin() + context_.mesh.owned};
}

FlowBranch::Found FlowBranch::iterate(LoadControl* control) {
  Found found;
  try {
    for (Operator* op : operators_) op->setDiffusivities(state_);
    state_.updateHalo(context_.halo);
    SteadyIteration iteration(context_, state_, {.scheme = scheme_, .firstCourant = courantOfBranch}, operators_,
                              control);
    double best = std::numeric_limits<double>::infinity();
    for (int bestAt = 0, failures = 0; found.iterations < options_.iterations;) {
      const SteadyIteration::Outcome outcome = iteration.iterate(state_);
      ++found.iterations;
      failures = outcome.taken ? 0 : failures + 1;
      if (failures == mostFailuresOfBranch) {
        found.why = outcome.why;
        return found;
      }
      found.residual = 0.0;
      for (const ResidualNorm& norm :
           residualNorms(context_, state_, iteration.residual(), time_ / control_.quickens()))
        found.residual = std::isfinite(norm.value) ? std::max(found.residual, norm.value) : INFINITY;
      found.isSteady = outcome.taken && found.residual <= options_.residual;
      if (found.isSteady) return found;
      if (found.residual < gainOfBranch * best) {
        best = found.residual;
        bestAt = found.iterations;
      }
      if (found.iterations - bestAt >= patienceOfBranch) {
        found.why = fmt::format("the residual does not fall below {:.2g}", best);
        return found;
      }
    }
    found.why = fmt::format("{} iterations were not enough, residual {:.2g}", options_.iterations, found.residual);
  } catch (const NumericsError& error) {
    if (context_.mesh.ranks > 1 && !isCollective(error)) throw;
    found.why = error.what();
  }
  return found;
}

FlowBranch::Point FlowBranch::pointNow(double residual) const {
  const Mesh& m = context_.mesh;
  Point point;
  point.load = control_.load();
  point.residual = residual;
  point.peakTemperature = largestOwned(m, state_.temperature);
  std::vector<double> enthalpies(static_cast<std::size_t>(state_.species));
  for (int c = 0; c < m.owned; ++c)
    point.heatRelease += m.volume[c] * heatRelease(context_, state_, static_cast<std::size_t>(c), enthalpies);
  MPI_Allreduce(MPI_IN_PLACE, &point.heatRelease, 1, MPI_DOUBLE, MPI_SUM, m.comm);
  return point;
}

void FlowBranch::add(Point point, double length) {
  point.arcLength = points_.empty() ? 0.0 : points_.back().arcLength + length;
  points_.push_back(point);
  const std::size_t n = points_.size();
  if (n < 3) return;
  const auto at = [&](std::size_t i) { return numerics::BranchPoint{points_[i].load, points_[i].arcLength, {}}; };
  if (const auto turn = numerics::turningPointOf(n - 2, at(n - 3), at(n - 2), at(n - 1))) turns_.push_back(*turn);
}

bool FlowBranch::isEnd() {
  const Point& point = points_.back();
  if (point.load < options_.lowestLoad || point.load > options_.highestLoad)
    reason_ = "the end of the range of the load";
  else if (point.peakTemperature < options_.lowestPeakTemperature)
    reason_ = fmt::format("the peak temperature fell below {:g} K", options_.lowestPeakTemperature);
  else if (static_cast<int>(points_.size()) >= options_.points)
    reason_ = fmt::format("{} points", options_.points);
  else if (static_cast<int>(turns_.size()) >= options_.turningPoints)
    reason_ = fmt::format("{} turning points", options_.turningPoints);
  isComplete_ = !reason_.empty();
  return isComplete_;
}

void FlowBranch::follow(const std::function<bool(const Point&)>& onPoint) {
  add(pointNow(options_.residual), 0.0);
  last_ = state_;
  while (!onPoint(points_.back()) && !isEnd())
    if (!advance()) return;
}

void FlowBranch::predict(double part) {
  const auto go = [part](std::vector<double>& values, const std::vector<double>& last,
                         const std::vector<double>& before) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = last[i] + part * (last[i] - before[i]);
  };
  go(state_.temperature, last_->temperature, before_->temperature);
  go(state_.Y, last_->Y, before_->Y);
  go(state_.velocity, last_->velocity, before_->velocity);
  go(state_.swirl, last_->swirl, before_->swirl);
  go(state_.pressure, last_->pressure, before_->pressure);
  go(state_.massFlux, last_->massFlux, before_->massFlux);
  const Point &a = points_[points_.size() - 2], &b = points_.back();
  control_.setLoad(state_, b.load + part * (b.load - a.load));
  const auto n = static_cast<std::size_t>(state_.species);
  inEachCell(context_.mesh, [&](int cell) {
    const std::span<double> Y{&state_.Y[static_cast<std::size_t>(cell) * n], n};
    double sum = 0.0;
    for (double& y : Y) sum += y = std::max(y, leastOfSpecies);
    for (double& y : Y) y /= sum;
    followGas(context_, state_, cell);
  });
}

void FlowBranch::chooseStep(int iterations) {
  const Point &a = points_[points_.size() - 2], &b = points_.back();
  const double length = b.arcLength - a.arcLength;
  if (points_.size() == 2) step_ = length;
  if (iterations < fewOfState) step_ *= longerStep;
  if (iterations > manyOfState) step_ *= shorterStep;
  const double ofLoad = std::abs(b.load - a.load) / (mostOfLoadInStep * b.load);
  const double ofPeak = std::abs(b.peakTemperature - a.peakTemperature) / mostOfPeakInStep;
  step_ = std::min(step_, length / std::max({ofLoad, ofPeak, 1e-300}));
}

bool FlowBranch::advance() {
  const Mesh& m = context_.mesh;
  const double first = step_;
  const std::vector<double> from = temperatures(*last_);
  // What comes in with the gas of a boundary moves the flame before it changes it, and the change of the gas alone does
  // not know by how much: the load is given as long as that finds a state, and an unknown from there on.
  bool isGiven = before_ && !control_.isOfAllCells() && !isUnknown_;
  while (step_ >= shortestStep * first) {
    Found found;
    std::vector<double> foretold = from;
    const double present = points_.back().load;
    try {
      if (before_) {
        std::vector<double> along = from;
        for (std::size_t c = 0; c < along.size(); ++c) along[c] -= before_->temperature[c];
        control_.require(from, along, step_);
        predict(step_ / control_.lengthOf(along));
        foretold = temperatures(state_);
        found = iterate(isGiven ? nullptr : &control_);
      } else {
        control_.scale(state_, present * (options_.towardsHigherLoad ? 1.0 + step_ : 1.0 / (1.0 + step_)));
        found = iterate(nullptr);
      }
    } catch (const NumericsError& error) {
      if (m.ranks > 1 && !isCollective(error)) throw;
      found.why = error.what();
    }
    failed_ += found.iterations;
    if (found.isSteady) {
      std::vector<double> change = temperatures(state_), beside = change, told = foretold;
      for (std::size_t c = 0; c < change.size(); ++c) {
        beside[c] = std::abs(change[c] - foretold[c]);
        told[c] = std::abs(foretold[c] - from[c]);
        change[c] -= from[c];
      }
      const double most = before_ ? mostAstray * largestOwned(m, told) + mostBesideForetold : mostUnforetold;
      if (largestOwned(m, beside) <= most) {
        Point point = pointNow(found.residual);
        point.iterations = std::exchange(failed_, 0);
        add(point, control_.lengthOf(change));
        isUnknown_ = before_ && !isGiven;
        before_ = std::exchange(last_, state_);
        chooseStep(found.iterations);
        reason_.clear();
        return true;
      }
      found.why = "the state that is found is another than the next of the branch";
    }
    reason_ = found.why;
    state_ = *last_;
    control_.setLoad(state_, present);
    if (isGiven) {
      isGiven = false;
      continue;
    }
    step_ *= shorterStep;
    isGiven = before_ && !control_.isOfAllCells();
  }
  reason_ = fmt::format("even a step of a hundredth finds no state: {}", reason_);
  return false;
}

}  // namespace lampblack::flow
