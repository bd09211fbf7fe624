// The numerical particles of the methods with equal weights, and how each method keeps their number in range. Every
// particle stands for `weight` real ones per m3; 1/weight is the volume of the sample.
//
// - dsmc: of N + 1 particles one drawn uniformly is removed and the sample shrinks by N/(N+1); at half of N all are
//   doubled (Goodson and Kraft 2002). Means of all moments are exact; M_1 is conserved as long as nothing is removed.
// - constantVolume: below N/2 all are doubled, above 2N a random half is discarded (Maisels, Kruis, Fissan 2004), where
//   mass is conserved in the mean only.
// - constantNumberByMass: after each event copies of particles drawn uniformly fill the gap, or such particles go, and
//   the weight changes so that M_1 stays what the event left (Smith and Matsoukas 1998; Lin, Lee, Matsoukas 2002). The
//   weight is a quotient of random sums, which biases M_0, M_2, M_3 by O(1/N) for each e-fold of change in number.
// - constantNumberByNumber: likewise, so that M_0 stays what the event left; M_1 then fluctuates around the exact one.
//
// An ensemble that starts empty fills up first: it is not doubled, nor are particles copied, before it was 3/4 full
// (constant number: full).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/compensated_sum.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/population/monte_carlo/store_operations.hpp"

namespace lampblack::particles {

// The numbers of particles that a method leaves as they are.
struct SampleRange {
  std::size_t fewest = 0, most = 0;
};

[[nodiscard]] inline SampleRange sampleRange(MonteCarloMethod method, std::size_t capacity) {
  if (method == MonteCarloMethod::dsmc) return {capacity / 2 + 1, capacity};
  if (method == MonteCarloMethod::constantVolume) return {(capacity + 1) / 2, 2 * capacity};
  return {capacity, capacity};
}

// What events took out of a sample and put into it, for who keeps sums over it: the sum of a property over its
// particles is `factor` times what it was, and `copies` times that of each of `particles`.
template <class Particle>
struct SampleChanges {
  std::vector<Particle> particles;
  std::vector<double> copies;  // negative: taken out
  double factor = 1;
  std::size_t again = 0;  // one more than the place of the particle that is put in again and again

  void clear() {
    particles.clear();
    copies.clear();
    factor = 1;
    again = 0;
  }
  void addAgain(const Particle& particle) {
    if (again > 0) {
      copies[again - 1] += 1;
    } else {
      add(particle, 1);
      again = copies.size();
    }
  }
  void add(const Particle& particle, double count) {
    particles.push_back(particle);
    copies.push_back(count);
  }
  void doubled() {
    factor *= 2;
    for (double& count : copies) count *= 2;
  }
};

template <class Store>
class EqualWeightSample {
 public:
  using Entry = typename Store::Entry;
  using Particle = decltype(Entry::particle);
  // Whether particles may be copied for who watches.
  static constexpr bool watchable = std::is_trivially_copyable_v<Particle>;

  EqualWeightSample(Store store, MonteCarloMethod method, double weight, std::size_t capacity)
      : store_(std::move(store)),
        method_(method),
        keepsMass_(method == MonteCarloMethod::constantNumberByMass),
        capacity_(capacity),
        range_(sampleRange(method, capacity)),
        fullAt_(range_.fewest == range_.most ? capacity : capacity - capacity / 4),
        weight_(weight),
        gels_(store_.rates().gels()),
        tracked_(keepsMass_ || gels_),
        // See gelled().
        gelShare_(std::min(0.5, 2 / std::cbrt(static_cast<double>(capacity)))) {}

  [[nodiscard]] Store& store() { return store_; }
  [[nodiscard]] const Store& store() const { return store_; }
  [[nodiscard]] double weight() const { return weight_; }
  [[nodiscard]] std::size_t size() const { return store_.size(); }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }

  // Events tell `changes` what they do, until null comes. Not of constantVolume, which discards many at once.
  void watch(SampleChanges<Particle>* changes) {
    changes_ = changes;
    noted_ = tracked_ || changes_ != nullptr;
  }

  // Bookkeeping of what an event takes out and puts in.
  [[gnu::always_inline]] void put(const Entry& entry, std::size_t copies = 1) {
    store_operations::insert(store_, entry, copies);
    if (noted_) changed(entry, static_cast<double>(copies));
  }
  // Of one that is put in again and again, of which the terms are known.
  [[gnu::always_inline]] void putAgain(const Entry& entry, const CollisionKernel::Terms& terms) {
    store_.insert(entry, terms);
    if constexpr (watchable)
      if (changes_ != nullptr) changes_->addAgain(entry.particle);
    if (tracked_) track(entry, 1);
  }
  [[gnu::always_inline]] void taken(const Entry& entry) {
    if (noted_) changed(entry, -1);
  }
  // To be called after an event that changes the mass, and after growth.
  void massChanged() {
    if (keepsMass_) mass_ = weight_ * volume_.value();
  }
  // To be called when an event is over: brings the number of particles into range.
  [[gnu::always_inline]] void bringNumberIntoRange(RandomStream& random, PopulationCounters& counters) {
    const std::size_t count = size();
    if (!filled_) {
      if (count < fullAt_) return;
      filled_ = true;
      massChanged();
    }
    if (count == 0 || (count >= range_.fewest && count <= range_.most)) return;
    if (method_ == MonteCarloMethod::dsmc) {
      doubleOrContract(random, counters);
    } else if (method_ == MonteCarloMethod::constantVolume) {
      keepVolumeStepwise(random, counters);
    } else {
      keepNumber(random, counters);
    }
  }

  void dilute(double factor) {
    weight_ *= factor;
    mass_ *= factor;
  }
  // Whether it was full once, so that it is kept so.
  [[nodiscard]] bool filled() const { return filled_; }
  // All particles anew; f(k) is the k-th entry.
  template <class F>
  void replace(double weight, bool filled, std::size_t count, F f) {
    store_.clear();
    weight_ = weight;
    filled_ = filled;
    for (std::size_t k = 0; k < count; ++k) store_operations::insert(store_, f(k), 1);
    measure();
  }
  // f(Entry&) -> bool, as transform() of a store.
  template <class F>
  void transform(F f) {
    store_.transform(f);
    measure();
  }
  // f(Entry&, k) -> bool, as transformSome() of a store that has it.
  template <class F>
  void transformSome(std::span<const std::uint32_t> which, F f) {
    store_.transformSome(which, f);
    measure();
  }

  // With then(entries) before they are put in anew.
  template <class F, class Then>
  void transform(F f, Then then) {
    store_.transform(f, then);
    measure();
  }

  // Whether one particle holds more than 2 N^(-1/3) of the mass, N being the capacity, or half of it if that is less.
  // At the gel point of N merging masses the largest cluster is of the order of N^(2/3) of them (Aldous 1997, for the
  // multiplicative kernel), before it of the order of log N, after it of the order of N: the time at which the share
  // exceeds a few N^(-1/3) tends to the gel point as N grows, the width of the transition being O(N^(-1/3)).
  [[nodiscard]] bool gelled() const {
    if (!gels_ || !filled_ || !(largest_ > gelShare_ * volume_.value())) return false;
    // The largest may be gone.
    largest_ = 0;
    store_.forEach([&](const Entry& entry) { largest_ = std::max(largest_, volumeOf(entry)); });
    return largest_ > gelShare_ * volume_.value();
  }

 private:
  [[nodiscard]] double volumeOf(const Entry& entry) const { return store_.rates().type().volume(entry.particle); }
  void changed(const Entry& entry, double copies) {
    if constexpr (watchable)
      if (changes_ != nullptr) changes_->add(entry.particle, copies);
    if (tracked_) track(entry, copies);
  }
  void track(const Entry& entry, double copies) {
    const double v = volumeOf(entry);
    volume_.add(copies * v);
    largest_ = std::max(largest_, v);
  }
  void measure() {
    if (!tracked_) return;
    CompensatedSum sum;
    store_.forEach([&](const Entry& entry) { sum.add(volumeOf(entry)); });
    volume_ = sum;
  }

  // Constant number.
  void keepNumber(RandomStream& random, PopulationCounters& counters) {
    const std::size_t before = size();
    for (; size() < capacity_; ++counters.copies) {
      const Entry copy = store_operations::copyUniform(store_, random);
      if (noted_) changed(copy, 1);
    }
    removeDownTo(capacity_, random, counters);
    if (keepsMass_)
      weight_ = mass_ / volume_.value();
    else
      weight_ *= static_cast<double>(before) / static_cast<double>(capacity_);
  }
  // Doubling and contraction.
  void doubleOrContract(RandomStream& random, PopulationCounters& counters) {
    while (2 * size() <= capacity_) duplicate(counters);
    if (size() <= capacity_) return;
    weight_ *= static_cast<double>(size()) / static_cast<double>(capacity_);
    removeDownTo(capacity_, random, counters);
  }
  // Stepwise constant volume.
  void keepVolumeStepwise(RandomStream& random, PopulationCounters& counters) {
    while (2 * size() < capacity_) duplicate(counters);
    while (size() > 2 * capacity_) {
      const std::size_t before = size();
      store_operations::discardHalf(store_, random);
      weight_ *= static_cast<double>(before) / static_cast<double>(size());
      counters.removals += before - size();
      measure();
    }
  }
  void duplicate(PopulationCounters& counters) {
    store_operations::duplicate(store_);
    weight_ *= 0.5;
    ++counters.doublings;
    if (changes_ != nullptr) changes_->doubled();
    measure();
  }
  void removeDownTo(std::size_t count, RandomStream& random, PopulationCounters& counters) {
    for (; size() > count; ++counters.removals) taken(store_.takeUniform(random));
  }

  Store store_;
  MonteCarloMethod method_;
  bool keepsMass_;
  std::size_t capacity_;
  SampleRange range_;
  std::size_t fullAt_;
  double weight_;  // 1/m3
  bool gels_;
  bool tracked_;                                // whether the volume of all is kept
  bool noted_ = tracked_;                       // whether that, or somebody watches
  SampleChanges<Particle>* changes_ = nullptr;  // of who watches
  double gelShare_;                             // of the mass in one particle
  double mass_ = 0;                             // M_1, where keepsMass_
  bool filled_ = false;
  CompensatedSum volume_;       // m3, of all particles
  mutable double largest_ = 0;  // m3, at least that of the largest particle
};

}  // namespace lampblack::particles
