// The population balance by jumps (event_loop.hpp), for any method. A method (see the concept below) knows its
// particles and weights; the loop knows time.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>
#include <utility>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/engine/event_loop.hpp"
#include "particles/population/engine/jumps.hpp"
#include "particles/population/engine/nucleation_births.hpp"
#include "particles/population/engine/split_step.hpp"
#include "particles/population/gelation_error.hpp"
#include "particles/population/monte_carlo_options.hpp"

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
        births_(method_, model, options.nucleation, random_) {}

  void advance(double end) override {
    const bool jumps = model_.growth.active() && model_.growth.treatment == GrowthOptions::Treatment::jumps;
    const bool continuous = model_.growth.active() && !jumps;
    const bool deferred = continuous && model_.growth.treatment == GrowthOptions::Treatment::deferred;
    Events events{*this, deferred};
    const auto dilute = [&](double dt) {
      if (model_.dilution != 0) method_.dilute(std::exp(-model_.dilution * dt));
    };
    const auto grow = [&](double dt) {
      if (continuous && !deferred) method_.grow(dt);
    };
    while (time_ < end) {
      runCallback();
      double next = end;
      if (continuous) next = std::min(next, time_ + method_.growthStep());
      if (model_.dilution != 0) next = std::min(next, time_ + dilutionStep / std::abs(model_.dilution));
      if (continuous || model_.dilution != 0) ++method_.counters().splitSteps;
      splitStep(next - time_, dilute, grow, [&](double) {
        if (deferred) method_.beginStep(time_, next);
        runEvents(
            time_, next, random_, births_, events, CoagulationJumps<Method>{method_, model_.coagulation.has_value()},
            BreakageJumps<Method>{method_, model_.breakage.has_value()},
            DepositionJumps<Method>{method_, model_.deposition.has_value()}, CondensationJumps<Method>{method_, jumps});
        if (deferred) method_.endStep();
      });
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

  // What the events of the loop do here.
  struct Events {
    JumpProcess& of;
    bool deferred;
    void look() {
      if (++of.attempts_ % eventsUnwatched == 0) of.runCallback();
    }
    void setTime(double time) {
      if (deferred) of.method_.atTime(time);
    }
    void giveBirth() {
      const double weight = of.method_.nucleusWeight();
      of.method_.nucleate(of.random_);
      of.births_.bear(weight, of.random_);
    }
    template <class Process>
    void take(const Process&, bool happened) {
      if (!happened)
        ++of.method_.counters().fictitious;
      else if (std::same_as<Process, CoagulationJumps<Method>> && of.method_.gelled())
        throw GelationError(of.time_);
    }
  };

  Method method_;
  PopulationModel model_;
  RandomStream random_;
  NucleationBirths<Method> births_;
  double time_ = 0;
  std::uint64_t attempts_ = 0;
};

}  // namespace lampblack::particles
