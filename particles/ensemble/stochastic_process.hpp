// Inside of makeEnsemble(): the processes of soot in a population of any Monte Carlo method. Not for other modules.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/random.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/ensemble/packed_ensemble.hpp"
#include "particles/population/engine/even_births.hpp"
#include "particles/population/engine/event_loop.hpp"
#include "particles/population/engine/jumps.hpp"
#include "particles/population/engine/split_step.hpp"
#include "particles/population/monte_carlo/equal_weight_sample.hpp"
#include "particles/soot/soot_events.hpp"
#include "particles/soot/soot_steps.hpp"

namespace lampblack::particles {

inline constexpr std::uint32_t ensembleStream = 0x53535354;  // stochastic soot

// `Method` is an EqualWeightMethod, WeightedMethod or PairMethod of SootAggregate.
template <class Method>
class StochasticProcess final : public Ensemble {
 public:
  using Particle = SootAggregate::Particle;

  StochasticProcess(EnsembleOptions options, const SootAggregate& type, Method method, RandomStream random)
      : options_(std::move(options)),
        type_(type),
        dimers_(options_.soot),
        method_(std::move(method)),
        random_(random) {}

  void initialise(std::span<const GivenParticle> population) override;
  void setRoom(std::size_t particles) override {
    if constexpr (drawsPairs) method_.setCapacity(room_ = std::clamp(particles, leastRoom, options_.particles));
  }
  void advance(const ParticleGas& gas, double dilution, double dt) override;
  void dilute(double factor) override;
  [[nodiscard]] std::vector<GivenParticle> particles() const override;
  void join(std::span<const GivenParticle> particles, double share) override;
  [[nodiscard]] EnsembleExchange takeExchange() override { return std::exchange(exchange_, {}); }

  [[nodiscard]] double cost() const override { return cost_; }
  [[nodiscard]] std::vector<double> pack() const override;
  void unpack(std::span<const double> state) override;

  [[nodiscard]] std::size_t size() const override { return method_.size(); }
  [[nodiscard]] Totals totals() const override;
  [[nodiscard]] double moment(double order) const override;
  [[nodiscard]] double geometricDeviation() const override;
  [[nodiscard]] const PopulationCounters& counters() const override { return const_cast<Method&>(method_).counters(); }
  [[nodiscard]] const EnsembleOptions& options() const override { return options_; }

 private:
  using Sums = SootSums;
  void gather() const;  // all particles to columns_, unless they stand there as they are and in their order
  // Some after the other in columns_, which f(place of the first one) may change.
  template <class F>
  void forEachBatch(F f) const;
  [[nodiscard]] Sums sums(const SootMedium& medium) const;
  // f(logDiameters, weights, count): of mobility, ln(d/m), of some particles after the other.
  template <class F>
  void forEachLogDiameter(F f) const;
  struct Atoms {
    double carbon = 0, hydrogen = 0;  // kg/m3
  };
  [[nodiscard]] Atoms atoms() const;
  [[nodiscard]] SootPopulationLaw law() const;
  // Each takes the sums of the population as it is and leaves those of what it has become.
  void thin(double factor, Sums& now);
  void jump(const SootMedium& medium, double dt, double stepLength, Sums& now);
  void takeChanges(const SootMedium& medium, double before, Sums& now);
  void grow(const SootMedium& medium, double dt, Sums& now);
  [[nodiscard]] bool growsSome() const { return changesSome && options_.growthByEvents; }
  SootTransfer growEach(const SootMedium& medium, const SootFluxes& flux, double dt, Sums& now);
  SootTransfer growSome(const SootMedium& medium, const SootFluxes& flux, double dt, Sums& now);
  void recordUptakeOfDimers(const SootMedium& medium, double dimers);

  // What the events of the loop do here.
  template <class Nucleate>
  struct Events {
    PopulationCounters& counters;
    const Nucleate& giveBirth;
    bool& isChanged;
    void look() {}
    void setTime(double) {}
    template <class Process>
    void take(const Process&, bool happened) {
      if (happened)
        isChanged = true;
      else
        ++counters.fictitious;
    }
  };

  static constexpr double mostBirthsOfJump = 4;  // times of a jump at which some are born
  static constexpr std::size_t leastRoom = 8;
  static constexpr bool weighted = requires(Method method, const Particle& p) { method.setNucleus(p, 1.0); };
  // Whether a method collides its particles over a time, and not event by event.
  static constexpr bool drawsPairs = requires(Method method, RandomStream& random) { method.coagulate(1.0, random); };
  // Whether a method can change some particles without looking at the others.
  static constexpr bool changesSome = requires(Method method, std::vector<std::uint32_t> which) {
    method.changeSome(which, [](Particle&, std::size_t) { return true; });
  };
  using PackedEntry = std::conditional_t<weighted, typename Method::Entry, Particle>;

  EnsembleOptions options_;
  std::size_t room_ = options_.particles;  // for numerical particles
  SootAggregate type_;
  DimerModel dimers_;
  Method method_;
  RandomStream random_;
  EnsembleExchange exchange_;
  EvenBirths births_;
  double cost_ = 0;
  mutable std::optional<CollisionKernel> kernel_;  // for equal particles
  mutable SootColumns columns_;                    // of the particles, while gathered_
  mutable bool gathered_ = false;
  SootColumns changedColumns_;       // of the particles in changes_
  SampleChanges<Particle> changes_;  // by events, while they are being drawn
  std::vector<Particle> grown_;      // those that had an event of growth, and their places
  std::vector<std::uint32_t> changed_, changedOfBatch_;
};

template <class Method>
typename StochasticProcess<Method>::Atoms StochasticProcess<Method>::atoms() const {
  Atoms all;
  method_.forEachParticle([&](const Particle& p, double w) {
    all.carbon += w * p.carbon;
    all.hydrogen += w * p.hydrogen;
  });
  return all;
}

template <class Method>
SootPopulationLaw StochasticProcess<Method>::law() const {
  return {options_.soot,
          dimers_,
          kernel_ ? &*kernel_ : nullptr,
          type_.coalescing() ? std::cbrt(2.0) : type_.shapeFactor(2),
          options_.alphaOfPrimaries,
          options_.growthByEvents,
          options_.splitTolerance};
}

template <class Method>
void StochasticProcess<Method>::advance(const ParticleGas& gas, double dilution, double dt) {
  if (!(dt > 0)) return;
  const SootMedium medium(options_.soot, dimers_, gas, options_.keepsHydrogen);
  if (options_.soot.coagulation) {
    CollisionKernelOptions kernel = options_.kernel;
    kernel.gas = medium.gas();
    kernel.enhancement = options_.soot.vanDerWaals;
    kernel.slip = options_.soot.slip;
    kernel_.emplace(kernel);
    method_.setKernel(kernel);
  } else {
    method_.rebuild();
  }
  cost_ = 0;
  const std::uint64_t before = counters().events() + counters().fictitious;
  gathered_ = false;
  Sums now = sums(medium);
  double whole = 0;  // s, the step
  const auto length = [&](double remaining) {
    if (size() == 0 && !medium.incepting()) return 0.0;
    cost_ += static_cast<double>(size()) + 1;
    return whole = sootStep(law(), medium, now, std::abs(dilution), remaining);
  };
  inSteps(dt, length, [&](double step) {
    splitStep(
        step,
        [&](double time) {
          if (dilution != 0) thin(std::exp(-dilution * time), now);
        },
        [&](double time) { jump(medium, time, whole, now); }, [&](double time) { grow(medium, time, now); });
    ++method_.counters().splitSteps;
  });
  if constexpr (weighted) method_.mergeExcess();
  cost_ += static_cast<double>(counters().events() + counters().fictitious - before);
}

template <class Method>
void StochasticProcess<Method>::dilute(double factor) {
  const Atoms before = atoms();
  method_.dilute(factor);
  births_.dilute(factor);
  exchange_.dilutedCarbon += before.carbon * (1 - factor);
  exchange_.dilutedHydrogen += before.hydrogen * (1 - factor);
}

// dilute() for who knows the sums.
template <class Method>
void StochasticProcess<Method>::thin(double factor, Sums& now) {
  method_.dilute(factor);
  births_.dilute(factor);
  exchange_.dilutedCarbon += now.carbon * (1 - factor);
  exchange_.dilutedHydrogen += now.hydrogen * (1 - factor);
  for (const auto sum : Sums::all) now.*sum *= factor;
  if (gathered_)
    for (double& weight : columns_.weight) weight *= factor;
}

template <class Method>
void StochasticProcess<Method>::jump(const SootMedium& medium, double dt, double stepLength, Sums& now) {
  const Sums start = now;
  bool isChanged = false;
  const double nucleusCarbon = 2 * medium.dimerCarbon(), nucleusHydrogen = 2 * medium.dimerHydrogen();
  double inception = 0;  // 1/m3/s, of the middle of this step
  if (medium.incepting()) {
    const Particle nucleus = type_.make(nucleusCarbon, nucleusHydrogen, 1);
    inception = sootInception(law(), medium, start, dt);
    if constexpr (weighted) {
      // A new particle for each numerical one as the number of real ones renews itself, and not too many a step.
      const double n = static_cast<double>(room_);
      method_.setNucleus(nucleus,
                         std::max({start.number, 20 * inception * stepLength, options_.leastNumberDensity}) / n);
    } else {
      method_.setNucleus(nucleus);
      if (size() == 0 && inception > 0) {
        // Without particles any number will do for a numerical one to stand for: that at which those born now fill half
        // of the sample. What there was of the interval goes with its particles.
        const double n = static_cast<double>(room_);
        method_.startAfresh(std::max(options_.startNumberDensity, 2 * inception * dt) / n);
        births_.startAfresh();
      }
    }
  }
  births_.setRate(inception);
  births_.plan(method_.nucleusWeight(), random_);
  [[maybe_unused]] const double weightBefore = method_.nucleusWeight();
  if constexpr (!weighted) {
    changes_.clear();
    method_.watch(&changes_);
  }
  double nucleatedCarbon = 0, nucleatedHydrogen = 0, nucleated = 0;
  const auto nucleate = [&] {
    const double weight = method_.nucleusWeight();
    method_.nucleate(random_);
    isChanged = true;
    nucleated += weight;
    nucleatedCarbon += weight * nucleusCarbon;
    nucleatedHydrogen += weight * nucleusHydrogen;
    births_.bear(weight, method_.nucleusWeight(), random_);
  };
  if constexpr (drawsPairs) {
    // Births between two halves of the collisions, several times where they are several: few collisions are left for
    // the splitting to reorder. A nucleus' weight is often such that a whole number is expected, up to round-off, which
    // may not decide.
    const double births = std::ceil(inception * dt / method_.nucleusWeight() - 0.01);
    const int times = kernel_ && births > 1 ? static_cast<int>(std::min(births, mostBirthsOfJump)) : 1;
    const double part = dt / times;
    if (kernel_) method_.coagulate(0.5 * part, random_);
    for (int k = 1; k <= times; ++k) {
      births_.pass(part);
      while (births_.isDue()) nucleate();
      if (kernel_) method_.coagulate(k < times ? part : 0.5 * part, random_);
    }
    isChanged = isChanged || kernel_;
  } else {
    Events<decltype(nucleate)> events{method_.counters(), nucleate, isChanged};
    double time = 0;
    runEvents(time, dt, random_, births_, events, CoagulationJumps<Method>{method_, kernel_.has_value()});
  }
  if constexpr (!weighted) method_.watch(nullptr);
  if (isChanged) {
    gathered_ = false;
    if constexpr (weighted)
      now = sums(medium);
    else
      takeChanges(medium, weightBefore, now);
  }
  // What was born by the rate of a middle that was foreseen becomes the trapezoidal rule's, by those that come next.
  if (inception > 0 && size() > 0)
    births_.add((0.5 * (medium.inception(start.collisions) + medium.inception(now.collisions)) - inception) * dt);
  exchange_.resampledCarbon += now.carbon - start.carbon - nucleatedCarbon;
  exchange_.resampledHydrogen += now.hydrogen - start.hydrogen - nucleatedHydrogen;
  if (nucleated > 0) {
    recordUptakeOfDimers(medium, 2 * nucleated);
    exchange_.nucleatedNumber += nucleated;
    exchange_.nucleated += nucleatedCarbon + nucleatedHydrogen;
  }
}

// Dimers that became soot.
template <class Method>
void StochasticProcess<Method>::recordUptakeOfDimers(const SootMedium& medium, double dimers) {
  exchangeDimers(medium, options_.soot, dimers, exchange_.gas);
  exchange_.carbon += dimers * medium.dimerCarbon();
  exchange_.hydrogen += dimers * medium.dimerHydrogen();
}

}  // namespace lampblack::particles

#include "core/modules.hpp"
#include "particles/ensemble/stochastic_growth.hpp"
#include "particles/ensemble/stochastic_process_population.hpp"
