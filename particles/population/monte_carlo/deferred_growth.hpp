// Deferred growth (linear process deferment, LPDA; Patterson, Singh, Balthasar, Kraft, Norris 2006) for any method and
// type of particle. Each particle carries the time it was last grown to and is brought up to date when it is looked at,
// and at the end of a step. What a particle is looked at for - kernel, rate of breakage, volume - is of the present
// time. What it is drawn by are bounds from the present to the end of the step: growth is deterministic and changes the
// volume in one direction, and every term of a majorant has its largest value at either end. Events are then thinned
// from bounds that hold all the time (Lewis and Shedler 1979), so that unlike Strang splitting, and unlike rates that
// are frozen over a step, the treatment has no error of the step. A longer step costs more fictitious jumps, a shorter
// one more updates of the whole population.
//
// Deferred<Type> is a type of particles and DeferredMethod<Method> a method, Method being one of Deferred<Type>. What
// shrinks to nothing within a step has no events any more and is removed at the end of the step; until then it counts
// as a numerical particle.
#pragma once

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/population_model.hpp"
#include "particles/population/monte_carlo_options.hpp"

namespace lampblack::particles {

// The time at which the particles of one population are looked at, and the end of the step, s.
struct GrowthClock {
  double now = 0, end = 0;
};

template <ParticleType Type>
class Deferred {
 public:
  struct Particle {
    typename Type::Particle particle;  // as of `time`
    double time = 0;
    double orderVolume = 0;  // m3, at the end of the step
  };

  // Throws InputError for particles that shrink to nothing: the rates of what is about to vanish have no bound.
  Deferred(Type type, const GrowthOptions& growth) : type_(std::move(type)), growth_(growth) {
    const bool shrinks = growth.condensation < 0 || growth.surface() < 0;
    if (shrinks && !(growth.smallestVolume > 0)) {
      throw InputError(
          "deferred growth of particles that shrink needs a smallest volume, at which they vanish: their collision "
          "rates have no bound otherwise");
    }
  }
  [[nodiscard]] GrowthClock& clock() const { return *clock_; }
  [[nodiscard]] const Type& type() const { return type_; }

  // Now.
  [[nodiscard]] double volume(const Particle& p) const {
    if (upToDate(p)) return type_.volume(p.particle);
    return type_.volume(at(p, clock_->now));
  }
  [[nodiscard]] double mass(const Particle& p) const { return type_.mass(now(p)); }
  [[nodiscard]] double surface(const Particle& p) const { return type_.surface(now(p)); }
  [[nodiscard]] double collisionDiameter(const Particle& p) const { return type_.collisionDiameter(now(p)); }
  [[nodiscard]] CollisionKernel::Properties properties(const CollisionKernel& kernel, const Particle& p) const {
    if (upToDate(p)) return kernelProperties(kernel, type_, p.particle);
    return kernelProperties(kernel, type_, now(p));
  }
  // What vanished waits for the end of the step, and nothing happens to it.
  [[nodiscard]] bool exists(const Particle& p) const {
    return p.orderVolume > growth_.smallestVolume || volume(p) > growth_.smallestVolume;
  }

  [[nodiscard]] double fractalDimension() const { return particles::fractalDimension(type_); }

  // Until the end of the step.
  [[nodiscard]] double orderVolume(const Particle& p) const { return p.orderVolume; }
  [[nodiscard]] CollisionKernel::Terms terms(const CollisionKernel& kernel, const Particle& p) const {
    CollisionKernel::Terms bounds = kernelTerms(kernel, type_, p.particle);
    const CollisionKernel::Terms end = kernelTerms(kernel, type_, last(p));
    for (std::size_t r = 0; r < kernel.rank(); ++r) {
      bounds.p[r] = std::max(bounds.p[r], end.p[r]);
      bounds.q[r] = std::max(bounds.q[r], end.q[r]);
    }
    return bounds;
  }
  template <class F>
  [[nodiscard]] double largest(const Particle& p, F&& f) const {
    return std::max(f(type_.volume(p.particle)), f(std::max(p.orderVolume, growth_.smallestVolume)));
  }

  [[nodiscard]] Particle make(double volume) const { return wrapped(type_.make(volume)); }
  [[nodiscard]] Particle coagulated(const Particle& p, const Particle& q) const {
    return wrapped(type_.coagulated(now(p), now(q)));
  }
  [[nodiscard]] Particle mean(const Particle& p, double wp, const Particle& q, double wq) const {
    return wrapped(type_.mean(now(p), wp, now(q), wq));
  }
  [[nodiscard]] Particle fragment(const Particle& p, double fraction) const {
    return wrapped(type_.fragment(now(p), fraction));
  }
  // Brings the particle up to date: how far is the clock's to say, by the rates given to the constructor.
  [[nodiscard]] Particle grown(const Particle& p, double, double, double) const { return wrapped(now(p)); }

 private:
  using Inner = typename Type::Particle;

  [[nodiscard]] bool upToDate(const Particle& p) const { return p.time == clock_->now; }
  [[nodiscard]] Inner at(const Particle& p, double time) const {
    return type_.grown(p.particle, growth_.condensation, growth_.surface(), time - p.time);
  }
  [[nodiscard]] Inner now(const Particle& p) const { return upToDate(p) ? p.particle : at(p, clock_->now); }
  [[nodiscard]] Particle wrapped(Inner inner) const {
    const double dt = clock_->end - clock_->now;
    const double end = type_.volume(dt == 0 ? inner : type_.grown(inner, growth_.condensation, growth_.surface(), dt));
    return {std::move(inner), clock_->now, end};
  }
  // At the end of the step, or just before it vanishes.
  [[nodiscard]] Inner last(const Particle& p) const {
    Inner end = at(p, clock_->end);
    if (type_.volume(end) >= growth_.smallestVolume) return end;
    double alive = p.time, gone = clock_->end;
    for (int k = 0; k < bisections; ++k) {
      const double middle = 0.5 * (alive + gone);
      Inner particle = at(p, middle);
      if (type_.volume(particle) >= growth_.smallestVolume) {
        alive = middle;
      } else {
        gone = middle;
      }
    }
    return at(p, alive);
  }

  static constexpr int bisections = 50;

  Type type_;
  GrowthOptions growth_;
  std::shared_ptr<GrowthClock> clock_ = std::make_shared<GrowthClock>();
};

// Method::grow() is a pass over all particles that replaces each by grown(), drops what is too small and has its store
// take the new bounds.
template <class Method>
class DeferredMethod : public Method {
 public:
  using Method::Method;

  void beginStep(double from, double to) {
    clock().now = from;
    clock().end = to;
    Method::grow(0);
  }
  void atTime(double time) { clock().now = time; }
  void endStep() {
    clock().now = clock().end;
    Method::grow(0);
  }

 private:
  GrowthClock& clock() { return Method::type().clock(); }
};

template <class Type>
inline constexpr bool isDeferred = false;
template <class Type>
inline constexpr bool isDeferred<Deferred<Type>> = true;
template <class Type, class Method>
using DeferredWhereChanging = std::conditional_t<isDeferred<Type>, DeferredMethod<Method>, Method>;

// Throws InputError where growth cannot be deferred.
[[nodiscard]] inline bool defersGrowth(const PopulationModel& model, const MonteCarloOptions& options) {
  const bool deferred = model.growth.active() && model.growth.treatment == GrowthOptions::Treatment::deferred;
  if (deferred && options.rates == EventRates::exact) {
    throw InputError("deferred growth needs rates: majorant, as rates change while they wait; or use treatment: split");
  }
  return deferred;
}

}  // namespace lampblack::particles
