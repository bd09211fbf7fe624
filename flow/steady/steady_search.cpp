#include "flow/steady/steady_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

// Steps in time: at least so many, doubled with each return, and at most some times that.
constexpr int leastSteps = 50, mostSteps = 6;
// In a gas without reactions, which has no flame to catch, so many are enough where no equation lacks more than that of
// its throughflow: iterations bring the flow nearer than steps. From further away they take more.
constexpr int stepsIfNear = 10;
constexpr double near = 0.2;
// A flow is established once the heat released has changed by less than a share over so many steps, none of which was
// tried again.
constexpr int quietSteps = 20;
constexpr double quietHeat = 0.05;
constexpr int stepsPerResidual = 10;
// Gain: a residual, the largest or that of momentum or heat, that is less than the best before by a share, or more heat
// than before by a share: while a flame grows the residuals rise from those of a start in which
// little happens, and the largest, of a radical that is hardly there, tells nothing.
constexpr double gain = 0.9, growth = 1.05;
constexpr int mostFailures = 8;  // one behind the other
// Of the residual that iterations begin with: with more they run away.
constexpr double mostGrown = 1e4;
// Of the heat that iterations begin with; with less, so many iterations in a row, the flame has gone out in a time that
// is none. For a few iterations a flame that burns may release less, or take up heat.
constexpr double leftOfHeat = 0.1;
constexpr int darkIterations = 20;
// In a flow at rest: iterations by themselves that leave no less of the largest residual, by that share, and combined
// ones that follow on them.
constexpr int mostAlone = 10, combinedInstead = 50;
// Steps before the first attempt; iterations of one, and of these without gain where it goes on beyond them.
constexpr int stepsOfAttempt = 20, mostOfAttempt = 300, patienceOfAttempt = 30;

}  // namespace

bool SteadySearch::wantsResidual() const {
  return phase_ == Phase::Iterations || stepsNow_ % stepsPerResidual == 0 || stepsNow_ == leastNow();
}

int SteadySearch::leastNow() const {
  return (options_.steps > 0 ? options_.steps : leastSteps) << std::min(returns_, 10);
}

bool SteadySearch::isNear() const {
  return !options_.reacts && options_.steps == 0 && returns_ == 0 && undisturbed_ >= stepsIfNear &&
         latest_.largest <= near;
}

bool SteadySearch::isEstablished() const {
  if (isNear()) return true;
  const int least = leastNow();
  if (stepsNow_ < least) return false;
  if (options_.steps > 0) return true;
  if (stepsNow_ >= mostSteps * least) return true;
  const auto [low, high] = std::ranges::minmax(heat_);
  return undisturbed_ >= quietSteps && high - low <= quietHeat * std::max(std::abs(low), std::abs(high));
}

bool SteadySearch::isAttemptDue() const {
  return attempts_ < options_.attempts && options_.steps == 0 && returns_ == 0 &&
         steps_ == stepsOfAttempt * ((2 << attempts_) - 1);
}

bool SteadySearch::hasNoIterationsLeft() const {
  if (!isAttempt_) return iterations_ - attempted_ - iterationsBefore_ >= options_.iterations;
  return iterationsNow_ >= options_.iterations ||
         (iterationsNow_ >= mostOfAttempt && iterationsNow_ - bestAt_ >= patienceOfAttempt);
}

void SteadySearch::addStep(double heatRelease, bool wasRetried) {
  takesBack_ = false;
  ++steps_;
  ++stepsNow_;
  undisturbed_ = wasRetried ? 0 : undisturbed_ + 1;
  heat_.push_back(heatRelease);
  if (heat_.size() > static_cast<std::size_t>(quietSteps)) heat_.pop_front();
}

void SteadySearch::addResidualOfStep(const Residual& told, bool burns) {
  const double residual = told.largest;
  latest_ = told;
  isSteady_ = residual <= options_.residual;
  if (first_ > 0.0) least_ = std::min(least_, residual);
  const bool established = isEstablished();
  if (isSteady_ || !(established || (burns && isAttemptDue()))) return;
  isAttempt_ = !established;
  if (!(first_ > 0.0)) first_ = least_ = residual;
  beginIterations(told, heat_.back());
}

void SteadySearch::resume(const Residual& residual, double heatRelease) {
  latest_ = residual;
  isSteady_ = residual.largest <= options_.residual;
  takesBack_ = isAttempt_ = false;
  returns_ = 0;
  iterationsBefore_ = iterations_ - attempted_;
  first_ = least_ = residual.largest;
  beginIterations(residual, heatRelease);
}

void SteadySearch::beginIterations(const Residual& residual, double heatRelease) {
  phase_ = Phase::Iterations;
  began_ = residual;
  best_ = residual;
  heatAtBegin_ = heatRelease;
  mostHeat_ = std::max(heatAtBegin_, 0.0);
  iterationsNow_ = bestAt_ = failures_ = dark_ = alone_ = combined_ = 0;
}

void SteadySearch::chooseKind() {
  if (!isFlowAtRest() || combined_ > 0) {
    combined_ = isFlowAtRest() ? combined_ - 1 : 0;
    alone_ = 0;
  } else if (alone_ == 0 || latest_.largest < gain * leastAlone_) {
    leastAlone_ = latest_.largest;
    alone_ = 1;
  } else if (++alone_ > mostAlone) {
    combined_ = combinedInstead;
  }
}

void SteadySearch::addLighting() {
  ++lightings_;
  phase_ = Phase::Steps;
  isSteady_ = takesBack_ = false;
  stepsNow_ = undisturbed_ = 0;
  heat_.clear();
}

void SteadySearch::addIteration(const Residual& told, double heatRelease, bool burns) {
  const double residual = told.largest;
  ++iterations_;
  ++iterationsNow_;
  failures_ = 0;
  latest_ = told;
  chooseKind();
  dark_ = heatAtBegin_ > 0.0 && heatRelease < leftOfHeat * heatAtBegin_ ? dark_ + 1 : 0;
  if (dark_ >= darkIterations) {
    goBack(fmt::format("the flame has gone out: {:.3g} W of {:.3g} W were left", heatRelease, heatAtBegin_));
    return;
  }
  if (!(residual <= mostGrown * began_.largest)) {
    goBack(fmt::format("the residual has grown from {:.2e} to {:.2e}", began_.largest, residual));
    return;
  }
  least_ = std::min(least_, residual);
  isSteady_ = residual <= options_.residual && dark_ == 0 && (burns || !isAttempt_);
  if (isSteady_) return;
  if (residual <= options_.residual && !burns && isAttempt_) {
    goBack("nothing burns in the steady state that was found");
    return;
  }
  for (double Residual::*of : {&Residual::largest, &Residual::ofMomentum, &Residual::ofEnthalpy})
    if ((of == &Residual::largest || options_.reacts) && told.*of < gain * (best_.*of)) {
      best_.*of = told.*of;
      bestAt_ = iterationsNow_;
    }
  if (heatRelease > growth * mostHeat_) {
    mostHeat_ = heatRelease;
    bestAt_ = iterationsNow_;
  }
  if (!isAttempt_ && iterationsNow_ - bestAt_ >= options_.patience)
    goBack(
        fmt::format("in {} iterations neither the largest residual has fallen below {:.2e} nor, where gas reacts, "
                    "those of momentum and enthalpy further, nor the heat release risen",
                    options_.patience, best_.largest));
  else if (hasNoIterationsLeft() && isAttempt_)
    goBack(fmt::format("{} iterations were not enough", iterationsNow_));
  else if (hasNoIterationsLeft())
    isGivenUp_ = true;
}

void SteadySearch::addFailure(const std::string& why) {
  ++iterations_;
  ++iterationsNow_;
  if (++failures_ >= mostFailures || hasNoIterationsLeft()) goBack(why);
}

void SteadySearch::endIterations(const std::string& why) {
  ++iterations_;
  ++iterationsNow_;
  goBack(why);
  takesBack_ = true;
}

bool SteadySearch::hasLostFlame() {
  bool isLost = false;
  const auto look = [&](const char* equation, double before, double now) {
    // Below the limit it is at rest, whatever the last digits do.
    if (!(now > options_.residual) || now < before) return;
    isLost = true;
    if (now > before) whyNot_ += fmt::format("; that of {} went from {:.2e} to {:.2e}", equation, before, now);
  };
  look("momentum", began_.ofMomentum, latest_.ofMomentum);
  look("enthalpy", began_.ofEnthalpy, latest_.ofEnthalpy);
  return isLost;
}

void SteadySearch::goBack(const std::string& why) {
  whyNot_ = why;
  takesBack_ = hasLostFlame() || dark_ > 0 || !(latest_.largest < began_.largest);
  phase_ = Phase::Steps;
  if (isAttempt_) {
    isAttempt_ = false;
    takesBack_ = true;
    ++attempts_;
    attempted_ += iterationsNow_;
    first_ = least_ = 0.0;
    dark_ = 0;
    whyNot_.clear();
    return;
  }
  stepsNow_ = undisturbed_ = 0;
  if (returns_ == options_.returns || hasNoIterationsLeft())
    isGivenUp_ = true;
  else
    ++returns_;
}

double SteadySearch::progress() const {
  if (isSteady_) return 1.0;
  if (!(first_ > options_.residual) || !(least_ > 0.0)) return 0.0;
  return std::clamp(std::log(first_ / least_) / std::log(first_ / options_.residual), 0.0, 1.0);
}

void SteadySearch::saveOrLoad(StateArchive& archive) {
  const std::array<double*, 14> values{&first_,
                                       &least_,
                                       &latest_.largest,
                                       &latest_.ofMomentum,
                                       &latest_.ofEnthalpy,
                                       &began_.largest,
                                       &began_.ofMomentum,
                                       &began_.ofEnthalpy,
                                       &heatAtBegin_,
                                       &mostHeat_,
                                       &best_.largest,
                                       &best_.ofMomentum,
                                       &best_.ofEnthalpy,
                                       &leastAlone_};
  std::vector<double> numbers;
  for (const double* value : values) numbers.push_back(*value);
  for (int* count : {&steps_, &iterations_, &returns_, &stepsNow_, &undisturbed_, &iterationsNow_, &bestAt_, &failures_,
                     &dark_, &lightings_, &iterationsBefore_, &alone_, &combined_})
    numbers.push_back(*count);
  numbers.push_back(phase_ == Phase::Iterations ? 1.0 : 0.0);
  for (const int count : {attempts_, attempted_, isAttempt_ ? 1 : 0}) numbers.push_back(count);
  std::vector<double> heat(heat_.begin(), heat_.end());
  const std::size_t expected = numbers.size();
  archive.shared("steady_search", numbers);
  archive.shared("steady_search_heat", heat);
  if (!archive.loading()) return;
  if (numbers.size() != expected)
    throw InputError(
        "the checkpoint was written by another version of Lampblack, whose search for a steady state kept other "
        "numbers; start anew from its results instead (initial.flow)");
  std::size_t next = 0;
  for (double* value : values) *value = numbers.at(next++);
  for (int* count : {&steps_, &iterations_, &returns_, &stepsNow_, &undisturbed_, &iterationsNow_, &bestAt_, &failures_,
                     &dark_, &lightings_, &iterationsBefore_, &alone_, &combined_})
    *count = static_cast<int>(numbers.at(next++));
  phase_ = numbers.at(next++) != 0.0 ? Phase::Iterations : Phase::Steps;
  for (int* count : {&attempts_, &attempted_}) *count = static_cast<int>(numbers.at(next++));
  isAttempt_ = numbers.at(next) != 0.0;
  heat_.assign(heat.begin(), heat.end());
  isSteady_ = latest_.largest > 0.0 && latest_.largest <= options_.residual && dark_ == 0;
}

}  // namespace lampblack::flow
