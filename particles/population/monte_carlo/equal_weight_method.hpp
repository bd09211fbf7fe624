// The jumps of the methods whose numerical particles all have the same weight, for any type of particles and store. How
// the methods keep the number of particles in range: equal_weight_sample.hpp. Without treatment of deferred growth:
// that is a method around this one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/equal_rates.hpp"
#include "particles/population/monte_carlo/equal_weight_sample.hpp"
#include "particles/population/monte_carlo/growth_step.hpp"
#include "particles/population/monte_carlo/jump_process.hpp"
#include "particles/population/monte_carlo/sample_statistics.hpp"
#include "particles/population/monte_carlo/systematic_sample.hpp"
#include "particles/population/monte_carlo/weighted_particle.hpp"

namespace lampblack::particles {

template <CoagulatingType Type, class Store>
class EqualWeightMethod {
 public:
  using Entry = typename Store::Entry;

  EqualWeightMethod(const Type& type, const PopulationModel& model, const InitialPopulation& initial,
                    const MonteCarloOptions& options, RandomStream& random)
      : type_(type),
        breakage_(model.breakage),
        growth_(model.growth),
        alone_(!model.coagulation && !model.breakage && !model.deposition && !model.nucleation),
        retuneAfter_(options.particles),
        sample_(Store(EqualRates<Type>(type, model)), options.method, initialWeight(initial, options),
                options.particles) {
    if (model.nucleation) {
      nucleusVolume_ = model.nucleation->volume;
      nucleus_ = rates().entry(type_.make(nucleusVolume_));
      findNucleusTerms();
    }
    for (const double v : initialVolumes(initial, options.particles, random)) sample_.put(rates().entry(type.make(v)));
    retune();
    sample_.bringNumberIntoRange(random, counters_);
    measureGrowth();
  }

  [[nodiscard]] double coagulationRate() const {
    return size() < 2 ? 0.0 : sample_.weight() * sample_.store().pairRate();
  }
  bool coagulate(RandomStream& random) {
    Entry i, j;
    if (!sample_.store().drawPair(random, i, j)) return false;
    sample_.taken(i);
    sample_.taken(j);
    if constexpr (requires { type_.meet(i.particle, j.particle, random); })
      if (!type_.meet(i.particle, j.particle, random)) {
        sample_.put(i);
        sample_.put(j);
        return false;
      }
    sample_.put(rates().entry(joined(type_, i.particle, j.particle, random)));
    ++counters_.coagulations;
    if (rates().tunable() && --retuneAfter_ == 0) retune();
    sample_.bringNumberIntoRange(random, counters_);
    return true;
  }

  [[nodiscard]] double breakageRate() const { return sample_.store().singleRate(SingleProcess::breakage); }
  bool breakUp(RandomStream& random) {
    Entry parent;
    if (!sample_.store().drawSingle(SingleProcess::breakage, random, parent)) return false;
    sample_.taken(parent);
    if (breakage_->daughters == BreakageOptions::Daughters::equal) {
      sample_.put(rates().entry(type_.fragment(parent.particle, 1.0 / breakage_->fragments)),
                  static_cast<std::size_t>(breakage_->fragments));
    } else {
      const double fraction = random.uniform();
      sample_.put(rates().entry(type_.fragment(parent.particle, fraction)));
      sample_.put(rates().entry(type_.fragment(parent.particle, 1 - fraction)));
    }
    ++counters_.breakages;
    sample_.bringNumberIntoRange(random, counters_);
    return true;
  }

  [[nodiscard]] double depositionRate() const { return sample_.store().singleRate(SingleProcess::deposition); }
  bool deposit(RandomStream& random) {
    Entry gone;
    if (!sample_.store().drawSingle(SingleProcess::deposition, random, gone)) return false;
    ++counters_.depositions;
    lose(gone, random);
    return true;
  }

  [[nodiscard]] double condensationRate() const { return sample_.store().singleRate(SingleProcess::condensation); }
  bool condense(RandomStream& random) {
    Entry before;
    if (!sample_.store().drawSingle(SingleProcess::condensation, random, before)) return false;
    ++counters_.condensations;
    const auto after = rates().growthJump().jumped(before.particle);
    if (!after) {
      ++counters_.vanished;
      lose(before, random);
      return true;
    }
    sample_.taken(before);
    sample_.put(rates().entry(*after));
    sample_.massChanged();
    return true;
  }

  void nucleate(RandomStream& random) {
    // Particles that change carry the time they are of.
    if constexpr (EqualRates<Type>::changing) nucleus_ = rates().entry(type_.make(nucleusVolume_));
    if constexpr (knowsTerms)
      sample_.putAgain(*nucleus_, nucleusTerms_);
    else
      sample_.put(*nucleus_);
    ++counters_.nucleations;
    sample_.massChanged();
    sample_.bringNumberIntoRange(random, counters_);
  }
  [[nodiscard]] double nucleusWeight() const { return sample_.weight(); }

  // Continuous growth. The number of particles is brought into range by the event that follows.
  void grow(double dt) {
    sample_.transform([&](Entry& entry) {
      const auto grown = type_.grown(entry.particle, growth_.condensation, growth_.surface(), dt);
      const double v = type_.volume(grown);
      if (!(v > 0) || v < growth_.smallestVolume) {
        ++counters_.vanished;
        return false;
      }
      entry = rates().entry(grown);
      return true;
    });
    sample_.massChanged();
    if (rates().tunable()) retune();
    measureGrowth();
  }
  [[nodiscard]] double growthStep() const { return growthStep_; }

  // For populations in a gas that changes and that grow by laws of their own. f(Particle&, weight) -> bool changes a
  // particle, false drops it.
  template <class F>
  void changeParticles(F f);
  // The same for some of them only, `which`: their places in the order of forEachParticle(), ascending. f(Particle&, k)
  // -> bool, of the one at the place which[k]. The majorant stays the one that there is.
  template <class F>
  void changeSome(std::span<const std::uint32_t> which, F f) requires requires(Store& store) {
    store.transformSome(which, [](Entry&, std::size_t) { return true; });
  }
  {
    sample_.transformSome(which, [&](Entry& entry, std::size_t k) {
      if (!f(entry.particle, k)) {
        ++counters_.vanished;
        return false;
      }
      entry.diameter = rates().entryDiameter(entry.particle);
      return true;
    });
    sample_.massChanged();
  }
  // f(const Particle&, weight).
  template <class F>
  void forEachParticle(F f) const {
    sample_.store().forEach([&](const Entry& entry) { f(entry.particle, sample_.weight()); });
  }
  // Events tell what they change, until null comes (EqualWeightSample::watch).
  void watch(SampleChanges<typename Type::Particle>* changes) { sample_.watch(changes); }
  // Of the type there was; rebuilds.
  void setKernel(const CollisionKernelOptions& kernel) {
    sample_.store().rates().setKernel(kernel);
    if (rates().tunable())
      retune();
    else
      rebuild();
    findNucleusTerms();
  }
  // The store as made of its particles alone, without a trace of the events there were.
  void rebuild() { store_operations::refresh(sample_.store()); }
  // What nucleate() puts in.
  void setNucleus(const typename Type::Particle& nucleus) {
    nucleus_ = rates().entry(nucleus);
    findNucleusTerms();
  }
  // Replaces all particles; each stands for `weight` (1/m3).
  template <class Particles>
  void replace(const Particles& particles, double weight, RandomStream& random) {
    sample_.replace(weight, false, particles.size(), [&](std::size_t k) { return rates().entry(particles[k]); });
    retune();
    sample_.bringNumberIntoRange(random, counters_);
  }
  // Takes in particles of any weights: copies of the weight that all have, as many in
  // the mean. Where these were more than twice as many as there is room for, the sample shrinks first.
  void join(const std::vector<WeightedParticle<typename Type::Particle>>& coming, RandomStream& random);
  // What a population in a gas keeps besides its particles and counters so that it goes on as it would have: for how
  // many real ones (1/m3) each stands, and whether the sample was full.
  [[nodiscard]] std::array<double, 2> memory() const { return {sample_.weight(), sample_.filled() ? 1.0 : 0.0}; }
  void restore(const std::array<double, 2>& memory, const std::vector<typename Type::Particle>& particles) {
    sample_.replace(memory[0], memory[1] != 0, particles.size(),
                    [&](std::size_t k) { return rates().entry(particles[k]); });
    retune();
  }
  void dilute(double factor) { sample_.dilute(factor); }
  // Without particles: those to come stand for `weight` (1/m3) each, and fill the sample before they are doubled.
  void startAfresh(double weight) {
    sample_.replace(weight, false, 0, [&](std::size_t) -> Entry { return *nucleus_; });
  }
  void beginStep(double, double) {}
  void atTime(double) {}
  void endStep() {}

  [[nodiscard]] bool gelled() const { return sample_.gelled(); }
  [[nodiscard]] std::array<double, 4> moments() const { return sampleMoments(sample_.store(), sample_.weight()); }
  [[nodiscard]] std::vector<double> numberInBins(std::span<const double> edges) const {
    return sampleInBins(sample_.store(), sample_.weight(), edges);
  }
  [[nodiscard]] double geometricDeviation() const {
    return sampleGeometricDeviation(sample_.store(), [&](const Entry& entry) {
      return entry.diameter > 0 ? entry.diameter : type_.collisionDiameter(entry.particle);
    });
  }
  [[nodiscard]] std::size_t size() const { return sample_.size(); }
  [[nodiscard]] std::size_t bytes() const { return sample_.store().bytes(); }
  PopulationCounters& counters() { return counters_; }
  [[nodiscard]] const Type& type() const { return type_; }
  [[nodiscard]] const Store& store() const { return sample_.store(); }
  [[nodiscard]] double weight() const { return sample_.weight(); }

 private:
  // By which volumes change in a step. Splitting has an error of second order in it, deferment none.
  static constexpr double growthPart = EqualRates<Type>::changing ? 0.3 : 0.05;

  // Whether what a nucleus adds to the majorant is the same until the majorant is another one.
  static constexpr bool knowsTerms =
      !EqualRates<Type>::changing && requires(Store & store, const Entry& entry, const CollisionKernel::Terms& terms) {
    store.insert(entry, terms);
  };
  void findNucleusTerms() {
    if constexpr (knowsTerms)
      if (nucleus_ && rates().rank() > 0) nucleusTerms_ = rates().terms(*nucleus_);
  }
  [[nodiscard]] const auto& rates() const { return sample_.store().rates(); }

  // To a larger weight.
  void thin(double weight, RandomStream& random);

  void lose(const Entry& gone, RandomStream& random) {
    sample_.taken(gone);
    sample_.massChanged();
    sample_.bringNumberIntoRange(random, counters_);
  }

  // A majorant that suits the particles as they are; with the cost of N events, after N events.
  void retune() {
    retuneAfter_ = std::max<std::size_t>(size(), 16);
    if (!rates().tunable() || size() == 0) return;
    Store& store = sample_.store();
    store.rates().tune([&](const auto& f) { store.forEach(f); }, size());
    findNucleusTerms();
    store_operations::refresh(store);
  }

  // The step over which growth changes the mean logarithm of the volumes, or that of a nucleus, by `growthPart`.
  // Without other processes growth is exact, however long the step.
  void measureGrowth();

  Type type_;
  std::optional<BreakageOptions> breakage_;
  GrowthOptions growth_;
  bool alone_;
  std::size_t retuneAfter_;
  double growthStep_ = 0;
  double nucleusVolume_ = 0;  // m3
  std::optional<Entry> nucleus_;
  CollisionKernel::Terms nucleusTerms_;
  EqualWeightSample<Store> sample_;
  PopulationCounters counters_;
};

}  // namespace lampblack::particles

#include "core/modules.hpp"
#include "particles/population/monte_carlo/equal_weight_changes.hpp"
