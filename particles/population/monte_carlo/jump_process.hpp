// The Markov jump process of a population: which event comes when, for any method. A method (see the concept below)
// knows its particles and weights; this loop knows time. Events with a majorant are attempted at the majorant's rate
// and may turn out fictitious, which leaves the law of the others exact.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/gelation_error.hpp"
#include "particles/population/model/nucleation_schedule.hpp"
#include "particles/population/monte_carlo/monte_carlo_options.hpp"

namespace lampblack::particles {

// Rates are of the sample, in 1/s, and bounds from above; an attempt says whether the event took place. All events keep
// the counters.
template <class M>
concept JumpMethod = requires(M method, const M fixed, RandomStream& random, double x, std::span<const double> edges) {
  { fixed.coagulationRate() } -> std::convertible_to<double>;
  { method.coagulate(random) } -> std::same_as<bool>;
  { fixed.breakageRate() } -> std::convertible_to<double>;
  { method.breakUp(random) } -> std::same_as<bool>;
  { fixed.depositionRate() } -> std::convertible_to<double>;
  { method.deposit(random) } -> std::same_as<bool>;
  { fixed.condensationRate() } -> std::convertible_to<double>;  // growth by jumps
  { method.condense(random) } -> std::same_as<bool>;
  method.nucleate(random);
  { fixed.nucleusWeight() } -> std::convertible_to<double>;  // 1/m3 that the next nucleus stands for
  method.grow(x);                                            // all particles by this time (s), continuously
  method.dilute(x);                                          // multiplies all number densities
  { fixed.growthStep() } -> std::convertible_to<double>;     // s, over which growth changes the rates by a few per cent
  method.beginStep(x, x);  // deferred growth: from the first to the second time particles may be behind
  method.atTime(x);        // deferred growth: the time of the attempt that follows
  method.endStep();        // deferred growth: all particles are brought to the end
  { fixed.gelled() } -> std::same_as<bool>;
  { fixed.moments() } -> std::same_as<std::array<double, 4>>;
  { fixed.numberInBins(edges) } -> std::same_as<std::vector<double>>;
  { fixed.geometricDeviation() } -> std::convertible_to<double>;
  { fixed.size() } -> std::same_as<std::size_t>;
  { fixed.bytes() } -> std::same_as<std::size_t>;
  { method.counters() } -> std::same_as<PopulationCounters&>;
};

template <JumpMethod Method>
class JumpProcess final : public PopulationSolver {
 public:
  static constexpr std::uint32_t streamPurpose = 0x504f5055;

  JumpProcess(Method method, const PopulationModel& model, const MonteCarloOptions& options, RandomStream random)
      : method_(std::move(method)),
        model_(model),
        random_(random),
        sampling_(options.nucleation),
        condenses_(model.growth.active() && model.growth.treatment == GrowthOptions::Treatment::jumps) {
    if (model_.nucleation) {
      schedule_.emplace(*model_.nucleation);
      planNucleus(0, 0);
    }
  }

  void advance(double end) override {
    const bool continuous = model_.growth.active() && model_.growth.treatment != GrowthOptions::Treatment::jumps;
    const bool deferred = continuous && model_.growth.treatment == GrowthOptions::Treatment::deferred;
    while (time_ < end) {
      runCallback();
      double next = end;
      if (continuous) next = std::min(next, time_ + method_.growthStep());
      if (model_.dilution != 0) next = std::min(next, time_ + dilutionStep / std::abs(model_.dilution));
      const double dt = next - time_;
      if (continuous || model_.dilution != 0) ++method_.counters().splitSteps;
      if (model_.dilution != 0) method_.dilute(std::exp(-0.5 * model_.dilution * dt));
      if (deferred)
        method_.beginStep(time_, next);
      else if (continuous)
        method_.grow(0.5 * dt);
      jump(next, deferred);
      if (deferred)
        method_.endStep();
      else if (continuous)
        method_.grow(0.5 * dt);
      if (model_.dilution != 0) method_.dilute(std::exp(-0.5 * model_.dilution * dt));
      time_ = next;
    }
  }

  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::array<double, 4> moments() const override { return method_.moments(); }
  [[nodiscard]] std::vector<double> numberInBins(std::span<const double> edges) const override {
    return method_.numberInBins(edges);
  }
  [[nodiscard]] double geometricDeviation() const override { return method_.geometricDeviation(); }
  [[nodiscard]] std::size_t particles() const override { return method_.size(); }
  [[nodiscard]] std::size_t bytes() const override { return method_.bytes(); }
  [[nodiscard]] const PopulationCounters& counters() const override { return const_cast<Method&>(method_).counters(); }
  [[nodiscard]] const Method& method() const { return method_; }

 private:
  static constexpr double dilutionStep = 0.02;
  static constexpr std::uint64_t eventsUnwatched = 256;

  void jump(double end, bool deferred) {
    while (true) {
      if (++attempts_ % eventsUnwatched == 0) runCallback();
      const double coagulation = model_.coagulation ? method_.coagulationRate() : 0;
      const double breakage = model_.breakage ? method_.breakageRate() : 0;
      const double deposition = model_.deposition ? method_.depositionRate() : 0;
      const double condensation = condenses_ ? method_.condensationRate() : 0;
      const double total = coagulation + breakage + deposition + condensation;
      if (!(total < infinity))
        throw NumericsError(fmt::format("the rates of the events are too large for numbers at t = {:.6g} s", time_));
      const double next = total > 0 ? time_ + random_.exponential(total) : infinity;
      if (schedule_) {
        if (sampling_ == NucleationSampling::random && method_.nucleusWeight() != plannedWeight_) replanNucleus();
        if (nucleusTime_ < std::min(next, end)) {
          nucleate(deferred);
          continue;
        }
      }
      if (next >= end) {
        time_ = end;
        return;
      }
      time_ = next;
      if (deferred) method_.atTime(time_);
      double choice = total == coagulation ? 0 : random_.uniform() * total;
      bool happened = false;
      if (choice < coagulation) {
        happened = method_.coagulate(random_);
        if (happened && method_.gelled()) throw GelationError(time_);
      } else if ((choice -= coagulation) < breakage) {
        happened = method_.breakUp(random_);
      } else if ((choice -= breakage) < deposition) {
        happened = method_.deposit(random_);
      } else {
        happened = method_.condense(random_);
      }
      if (!happened) ++method_.counters().fictitious;
    }
  }

  // Nuclei are placed along the integral I of the nucleation rate (1/m3). Random: the distance to the next one is
  // exponentially distributed with mean w, what a nucleus stands for; when w changes, what is left of the distance
  // changes in proportion, as the exponential distribution has no memory. Even: I is cut into intervals as long as the
  // weight of their nucleus, which lies at a random place in its interval. Both have the mean I at any time; for the
  // second, the number put in never differs from it by more than a nucleus or two, whatever w does.
  void planNucleus(double intervalStart, double reached) {
    plannedWeight_ = method_.nucleusWeight();
    intervalStart_ = intervalStart;
    nucleusAt_ = sampling_ == NucleationSampling::even ? intervalStart + random_.uniform() * plannedWeight_
                                                       : reached + random_.exponential(1) * plannedWeight_;
    nucleusTime_ = schedule_->timeOf(nucleusAt_);
  }
  void replanNucleus() {
    const double weight = method_.nucleusWeight(), reached = schedule_->cumulative(time_);
    nucleusAt_ = reached + (nucleusAt_ - reached) * weight / plannedWeight_;
    plannedWeight_ = weight;
    nucleusTime_ = schedule_->timeOf(nucleusAt_);
  }
  void nucleate(bool deferred) {
    time_ = std::max(nucleusTime_, time_);
    if (deferred) method_.atTime(time_);
    const double weight = method_.nucleusWeight();
    method_.nucleate(random_);
    planNucleus(intervalStart_ + weight, nucleusAt_);
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Method method_;
  PopulationModel model_;
  RandomStream random_;
  NucleationSampling sampling_;
  std::optional<NucleationSchedule> schedule_;
  bool condenses_;
  double time_ = 0;
  std::uint64_t attempts_ = 0;
  double intervalStart_ = 0, nucleusAt_ = 0, plannedWeight_ = 0;  // 1/m3
  double nucleusTime_ = infinity;                                 // s
};

}  // namespace lampblack::particles
