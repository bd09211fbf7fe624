// The sample of the hybrid method (hybrid_method.hpp): numbers of small particles and numerical particles together, as
// one store that pairs and single particles are drawn from. A partner is drawn from the numbers or from the classes of
// particles in proportion to their sums of the same term of the majorant; the bounds of numbers are exact.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/equal_rates.hpp"
#include "particles/population/monte_carlo/hybrid_numbers.hpp"

namespace lampblack::particles {

template <ParticleType Type>
class HybridPopulation {
 public:
  using Particle = typename Type::Particle;
  using Rates = EqualRates<Type>;
  using Entry = typename Rates::Entry;

  // Spheres of 1 to `threshold` units of `unit` (m3) are numbers.
  HybridPopulation(const Type& type, const PopulationModel& model, std::size_t threshold, double unit)
      : type_(type),
        unit_(unit),
        store_(Rates(type, model)),
        rank_(store_.rates().rank()),
        numbers_(threshold, store_.components(), [this](std::size_t size) {
          return store_.rates().entry(type_.make(static_cast<double>(size) * unit_));
        }) {
    setBounds();
  }

  [[nodiscard]] const Rates& rates() const { return store_.rates(); }
  [[nodiscard]] std::size_t particles() const { return store_.size(); }
  [[nodiscard]] std::uint64_t countedParticles() const { return numbers_.all(); }
  [[nodiscard]] std::size_t sizes() const { return numbers_.threshold(); }
  [[nodiscard]] double size() const {
    return static_cast<double>(countedParticles()) + static_cast<double>(particles());
  }
  [[nodiscard]] std::size_t bytes() const { return store_.bytes() + numbers_.bytes(); }

  // A particle becomes a number where it is of a whole number of units.
  void add(const Particle& particle) {
    if (const std::size_t size = sizeOf(type_.volume(particle)); size > 0) {
      numbers_.add(size);
    } else {
      store_.insert(store_.rates().entry(particle));
    }
  }
  // A second copy of each.
  void duplicate() {
    store_.duplicate();
    numbers_.doubleAll();
  }

  // Bound of the sum of all rates of pairs, m3/s.
  [[nodiscard]] double pairRate() const {
    double sum = 0;
    for (std::size_t r = 0; r < rank_; ++r) sum += pairRate(r);
    return sum;
  }
  // One attempt; true: both are taken out.
  bool drawPair(RandomStream& random, Entry& first, Entry& second) {
    std::size_t r = 0;
    if (rank_ > 1) {
      for (double x = random.uniform() * pairRate(); r + 1 < rank_ && x >= pairRate(r); ++r) x -= pairRate(r);
    }
    Drawn i = draw(1 + r, random), j = draw(1 + rank_ + r, random);
    if (i.none() || j.none() || same(i, j, random)) return false;
    double majorant = 0;
    for (std::size_t k = 1; k <= rank_; ++k) {
      majorant += bound(i, k) * bound(j, k + rank_) + bound(j, k) * bound(i, k + rank_);
    }
    const double rate = rates().pair(entry(i), entry(j));
    checkBound(rate, majorant);
    if (!(random.uniform() * majorant < rate)) return false;
    // Of two in one class the later one first.
    if (i.particle && j.particle && i.place.index < j.place.index) std::swap(i, j);
    first = take(i);
    second = take(j);
    return true;
  }

  [[nodiscard]] double singleRate(SingleProcess process) const {
    const std::size_t component = store_.component(process);
    return component > 0 ? total(component) : 0;
  }
  // One attempt; true: it is taken out.
  bool drawSingle(SingleProcess process, RandomStream& random, Entry& taken) {
    const std::size_t component = store_.component(process);
    const Drawn drawn = draw(component, random);
    if (drawn.none()) return false;
    if (!(random.uniform() * bound(drawn, component) < rates().single(process, entry(drawn)))) return false;
    taken = take(drawn);
    return true;
  }
  Entry takeUniform(RandomStream& random) {
    Drawn drawn;
    while (drawn.none()) drawn = draw(0, random);
    return take(drawn);
  }

  // f(entry, how many).
  template <class F>
  void forEach(F&& f) const {
    for (std::size_t size = 1; size <= numbers_.threshold(); ++size) {
      if (numbers_.number(size) > 0) f(numbers_.entry(size), static_cast<double>(numbers_.number(size)));
    }
    store_.forEach([&](const Entry& e) { f(e, 1.0); });
  }
  // Makes the majorant the best one for the population as it is, O(sizes + particles).
  void retune() {
    if (!rates().tunable() || !(size() > 0)) return;
    store_.rates().tune([&](const auto& f) { forEach(f); });
    store_.transform([](const Entry&) { return true; });
    setBounds();
  }

 private:
  // A number where size > 0, a particle where it has a place.
  struct Drawn {
    std::size_t size = 0;
    bool particle = false;
    typename ClassStore<Rates>::Place place{};
    [[nodiscard]] bool none() const { return size == 0 && !particle; }
  };

  [[nodiscard]] double total(std::size_t component) const {
    return numbers_.total(component) + store_.total(component);
  }
  [[nodiscard]] double pairRate(std::size_t r) const { return total(1 + r) * total(1 + rank_ + r); }

  // Units in the volume; zero for what is no number.
  [[nodiscard]] std::size_t sizeOf(double volume) const {
    const double units = volume / unit_, whole = std::round(units);
    if (!(whole >= 1) || whole > static_cast<double>(numbers_.threshold())) return 0;
    return std::abs(units - whole) <= tolerance * whole ? static_cast<std::size_t>(whole) : 0;
  }
  void setBounds() {
    const auto boundOf = [this](const Entry& e, std::size_t component) {
      if (component == 0) return 1.0;
      for (std::size_t k = 0; k < singleProcesses; ++k) {
        const auto process = static_cast<SingleProcess>(k);
        if (store_.component(process) == component) return rates().single(process, e);
      }
      const CollisionKernel::Terms terms = rates().terms(e);
      return component <= rank_ ? terms.p[component - 1] : terms.q[component - 1 - rank_];
    };
    numbers_.setBounds(boundOf, store_.components());
  }

  [[nodiscard]] Drawn draw(std::size_t component, RandomStream& random) const {
    const double numbers = numbers_.total(component);
    double x = random.uniform() * total(component);
    Drawn drawn;
    if (x < numbers) {
      drawn.size = numbers_.find(component, x);
    } else {
      drawn.particle = store_.size() > 0 && store_.findMember(component, x - numbers, drawn.place);
    }
    return drawn;
  }
  // Whether one and the same was drawn twice: of N alike, one time in N.
  [[nodiscard]] bool same(const Drawn& i, const Drawn& j, RandomStream& random) const {
    if (i.size != j.size) return false;
    if (i.size > 0) return random.uniform() * static_cast<double>(numbers_.number(i.size)) < 1;
    return i.place.slot == j.place.slot && i.place.index == j.place.index;
  }
  [[nodiscard]] const Entry& entry(const Drawn& drawn) const {
    return drawn.size > 0 ? numbers_.entry(drawn.size) : store_.entry(drawn.place);
  }
  [[nodiscard]] double bound(const Drawn& drawn, std::size_t component) const {
    return drawn.size > 0 ? numbers_.bound(drawn.size, component) : store_.bound(drawn.place, component);
  }
  Entry take(const Drawn& drawn) {
    if (drawn.size == 0) return store_.take(drawn.place);
    numbers_.remove(drawn.size);
    return numbers_.entry(drawn.size);
  }

  static constexpr double tolerance = 1e-9;

  Type type_;
  double unit_;
  ClassStore<Rates> store_;
  std::size_t rank_;
  HybridNumbers<Rates> numbers_;
};

}  // namespace lampblack::particles
