// StochasticProcess: how its population grows, and the sums over it. Included by stochastic_process.hpp.
#pragma once

#include "core/modules.hpp"
#include "particles/ensemble/stochastic_process.hpp"
#include "particles/soot/soot_events.hpp"

namespace lampblack::particles {

template <class Method>
void StochasticProcess<Method>::gather() const {
  if (gathered_) return;
  gathered_ = true;
  columns_.resize(size());
  std::size_t k = 0;
  method_.forEachParticle([&](const Particle& p, double w) { columns_.set(k++, p, w); });
}

template <class Method>
template <class F>
void StochasticProcess<Method>::forEachBatch(F f) const {
  constexpr std::size_t atATime = 512;
  gathered_ = false;
  std::size_t first = 0, k = 0, n = std::min(atATime, size());
  columns_.resize(n);
  SootColumns::Row row = columns_.row();
  method_.forEachParticle([&](const Particle& p, double w) {
    row.set(k++, p, w);
    if (k < n) return;
    f(first);
    first += k;
    k = 0;
    n = std::min(atATime, size() - first);
    columns_.resize(n);
    row = columns_.row();
  });
}

template <class Method>
SootSums StochasticProcess<Method>::sums(const SootMedium& medium) const {
  if (growsSome()) {
    Sums all;
    forEachBatch([&](std::size_t) { all.add(sumsOf(columns_, type_, medium)); });
    return all;
  }
  gather();
  return sumsOf(columns_, type_, medium);
}

// Sums after events that told what they changed; all particles had the weight `before`.
template <class Method>
void StochasticProcess<Method>::takeChanges(const SootMedium& medium, double before, Sums& now) {
  if (size() == 0) {
    now = {};
    return;
  }
  changedColumns_.resize(changes_.particles.size());
  for (std::size_t k = 0; k < changedColumns_.size(); ++k)
    changedColumns_.set(k, changes_.particles[k], changes_.copies[k]);
  const Sums changed = sumsOf(changedColumns_, type_, medium);
  const double weight = method_.nucleusWeight(), kept = changes_.factor * (weight / before);
  for (const auto sum : Sums::all) now.*sum = kept * (now.*sum) + weight * (changed.*sum);
  now.number = weight * static_cast<double>(size());
}

// All particles change.
template <class Method>
SootTransfer StochasticProcess<Method>::growEach(const SootMedium& medium, const SootFluxes& flux, double dt,
                                                 Sums& now) {
  gather();
  const SootTransfer all = options_.growthByEvents ? growAllByEvents(columns_, type_, medium, flux, dt, random_)
                                                   : growAll(columns_, type_, medium, flux, dt);
  std::size_t k = 0;
  method_.changeParticles([&](Particle& p, double) {
    p = columns_.particle(k++);
    return p.carbon > 0;
  });
  // Where none is gone the columns are those of the particles still, unless the store has another order now.
  gathered_ = drawsPairs && !(all.lost > 0);
  now = sums(medium);
  return all;
}

// In whole events, which only some have.
template <class Method>
SootTransfer StochasticProcess<Method>::growSome(const SootMedium& medium, const SootFluxes& flux, double dt,
                                                 Sums& now) {
  GrowthByEvents growth(type_, medium, flux, dt, random_);
  if constexpr (changesSome) {
    changed_.clear();
    grown_.clear();
    now = {};
    forEachBatch([&](std::size_t first) {
      growth.grow(columns_, changedOfBatch_);
      for (const std::uint32_t k : changedOfBatch_) {
        changed_.push_back(static_cast<std::uint32_t>(first + k));
        grown_.push_back(columns_.particle(k));
      }
      for (auto k = changedOfBatch_.rbegin(); k != changedOfBatch_.rend(); ++k)
        if (!(columns_.carbon[*k] > 0)) columns_.remove(*k);
      now.add(sumsOf(columns_, type_, medium));
    });
    method_.changeSome(changed_, [&](Particle& p, std::size_t k) {
      p = grown_[k];
      return p.carbon > 0;
    });
  }
  return growth.moved();
}

template <class Method>
void StochasticProcess<Method>::grow(const SootMedium& medium, double dt, Sums& now) {
  if (size() == 0 || !(medium.condensing() || medium.surfaceActive())) return;
  const SootFluxes flux = sootFluxes(law(), medium, now, dt);
  const SootTransfer all = growsSome() ? growSome(medium, flux, dt, now) : growEach(medium, flux, dt, now);
  recordUptakeOfDimers(medium, all.dimers);
  exchange_.condensed += all.dimers * (medium.dimerCarbon() + medium.dimerHydrogen());
  exchange_.grown += all.growth;
  exchange_.oxidisedO2 += all.oxidationO2 + all.hydrogenO2;
  exchange_.oxidisedOH += all.oxidationOH + all.hydrogenOH;
  exchange_.oxidisedNumber += all.lost;
  exchange_.carbon += all.growth - all.oxidationO2 - all.oxidationOH;
  exchange_.hydrogen -= all.hydrogenO2 + all.hydrogenOH;
  exchangeSurface(options_.soot, all, exchange_.gas);
}

}  // namespace lampblack::particles
