// WeightedMethod: what its events do. Included by weighted_method.hpp.
#pragma once

#include <utility>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/weighted_method.hpp"

namespace lampblack::particles {

template <ParticleType Type, class Store>
bool WeightedMethod<Type, Store>::coagulate(RandomStream& random) {
  if (!(method_ == MonteCarloMethod::swa ? transferWeight(random) : coagulateFractions(random))) return false;
  ++counters_.coagulations;
  if (store_.rates().tunable() && ++sinceTuned_ > 2 * capacity_) retune();
  return true;
}

template <ParticleType Type, class Store>
bool WeightedMethod<Type, Store>::coagulateFractions(RandomStream& random) {
  double amount = 0, leftI = 0, leftJ = 0, times = 1;
  bool stay = false;  // whether what is left over stays as it is, with less weight
  const bool happened = store_.drawPair(random, first_, second_, [&](const Entry& i, const Entry& j) {
    const double vi = type_.volume(i.particle), vj = type_.volume(j.particle);
    if constexpr (bundles) times = store_.collected();
    // Where i takes up several of j at once, it does so as a whole.
    amount =
        times > 1 ? i.weight : store_.rates().fraction()(vi, vj, i.weight, j.weight) * std::min(i.weight, j.weight);
    leftI = i.weight - amount;
    leftJ = j.weight - times * amount;
    expect(type_.coagulated(i.particle, j.particle), amount);
    stay = !(leftI > 0 && leftJ > 0) || (method_ == MonteCarloMethod::sammc && vi != vj);
    return stay ? std::array{leftI, leftJ} : std::array{0.0, 0.0};
  });
  if (!happened) return false;
  const Entry &i = first_, &j = second_;
  taken(i);
  taken(j);
  const Particle fresh = coagulated(i.particle, j.particle, times);
  if (!(leftI > 0 || leftJ > 0)) {  // Wang (2025), eqs. 4-18, 5-13
    put(fresh, 0.5 * amount);
    put(fresh, 0.5 * amount);
    return true;
  }
  if (stay) {  // Wang (2025), eqs. 4-21, 4-22, 5-14; 5-16 with both left over
    if (leftI > 0) track({i.particle, leftI}, 1);
    if (leftJ > 0) track({j.particle, leftJ}, 1);
    if (leftI > 0 && leftJ > 0) {
      makeRoom(1);
    }
  } else if (type_.volume(i.particle) == type_.volume(j.particle) && method_ != MonteCarloMethod::wfmc) {
    const Entry rest = meanOf({i.particle, leftI}, {j.particle, leftJ});  // eqs. 4-19, 4-20, 5-15
    put(rest.particle, rest.weight);
  } else {
    coagulateLeftOvers(i, leftI, j, leftJ, random);
  }
  put(fresh, amount);
  return true;
}

// wfmc and samwfmc: with both left over and the new particle there is one too many.
//
// wfmc: let L_i = leftI v_i and L_j = leftJ v_j be the volumes left over. i is kept with probability L_i / (L_i + L_j)
// and the weight (L_i + L_j) / v_i, so that volume is conserved, or j likewise. Any sum of f over the particles then
// gets L_i / v_i f(v_i) + L_j / v_j f(v_j) = leftI f(v_i) + leftJ f(v_j) in the mean: nothing is biased. (With other
// probabilities, conserved mass and an unbiased mean would not go together.)
template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::coagulateLeftOvers(const Entry& i, double leftI, const Entry& j, double leftJ,
                                                     RandomStream& random) {
  const double vi = type_.volume(i.particle), vj = type_.volume(j.particle);
  if (method_ == MonteCarloMethod::wfmc) {
    const double sum = leftI * vi + leftJ * vj;
    if (random.uniform() * sum < leftI * vi)
      put(i.particle, sum / vi);
    else
      put(j.particle, sum / vj);
    ++counters_.removals;
    return;
  }
  // samwfmc, Wang (2025), eqs. 4-21, 4-22
  const bool lighterIsI = i.weight <= j.weight;
  const Entry& lighter = lighterIsI ? i : j;
  const double left = lighterIsI ? leftI : leftJ;
  // The partner and the new particle are not among the neighbours.
  if (store_.size() > 0) {
    const Entry k = store_.takeNearest(lighter);
    taken(k);
    put(k.particle, k.weight + left * type_.volume(lighter.particle) / type_.volume(k.particle));
    ++counters_.merges;
  } else {
    put(lighter.particle, left);
  }
  put(lighterIsI ? j.particle : i.particle, lighterIsI ? leftJ : leftI);
}

template <ParticleType Type, class Store>
bool WeightedMethod<Type, Store>::transferWeight(RandomStream& random) {
  bool iGrows = false;
  const bool happened = store_.drawPair(random, first_, second_, [&](const Entry& i, const Entry& j) {
    iGrows = random.uniform() * (i.weight + j.weight) < j.weight;  // at the rate K w_j
    return iGrows ? std::array{0.0, j.weight} : std::array{i.weight, 0.0};
  });
  if (!happened) return false;
  const Entry &grows = iGrows ? first_ : second_, &stays = iGrows ? second_ : first_;
  const double wi = first_.weight, wj = second_.weight;
  double weight = 0;
  switch (transfer_) {
    case WeightTransfer::harmonic:
      weight = wi * wj / (wi + wj);
      break;
    case WeightTransfer::half:
      weight = 0.5 * grows.weight;
      break;
    case WeightTransfer::mass: {
      const double own = type_.mass(grows.particle);
      weight = grows.weight * own / (own + type_.mass(stays.particle));
      break;
    }
  }
  taken(grows);
  put(type_.coagulated(grows.particle, stays.particle), weight);
  return true;
}

// Merges neighbours until `count` more particles fit. A store that merges many at once is given more of them.
template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::makeRoom(std::size_t count) {
  if (store_.size() + count < capacity_) return;
  if (mergesMany && store_.size() + count <= capacity_ + capacity_ / 8) {
    filled_ = true;
    return;
  }
  if (!mergeDownTo(count < capacity_ ? capacity_ - count : 1)) return;
  filled_ = true;
}

template <ParticleType Type, class Store>
bool WeightedMethod<Type, Store>::mergeDownTo(std::size_t count) {
  const auto mean = [this](const Entry& lower, const Entry& upper) {
    const Entry both = meanOf(lower, upper);
    taken(lower);
    taken(upper);
    track(both, 1);
    return both;
  };
  if constexpr (mergesMany) {
    counters_.merges += store_.mergeDownTo(count, mean);
  } else {
    while (store_.size() > count) {
      if (!store_.mergeNearest(mean)) return false;
      ++counters_.merges;
    }
  }
  return true;
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::mergeExcess() {
  if (store_.size() >= capacity_) filled_ = true;
  if (store_.size() > capacity_) (void)mergeDownTo(capacity_);
  if constexpr (mergesMany) store_.sort();
}

// Particles that are new to the population, `copies` of the same kind.
template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::add(const Particle& particle, double weight, std::size_t copies) {
  if (method_ != MonteCarloMethod::mmc) {
    makeRoom(copies);
    for (std::size_t k = 0; k < copies; ++k) track({particle, weight}, 1);
    if constexpr (requires { store_.insert({particle, weight}, copies); }) {
      store_.insert({particle, weight}, copies);
    } else {
      for (std::size_t k = 0; k < copies; ++k) store_.insert({particle, weight});
    }
    return;
  }
  for (; copies > 0 && store_.size() < capacity_; --copies) put(particle, weight);
  filled_ = filled_ || store_.size() >= capacity_;
  if (copies == 0) return;
  const Entry nearest = store_.takeNearest({particle, weight});
  taken(nearest);
  if (type_.volume(nearest.particle) != type_.volume(particle)) counters_.limited += copies;
  put(nearest.particle, nearest.weight + static_cast<double>(copies) * weight);
  counters_.merges += copies;
}

// After particles were lost: halves the heaviest ones.
template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::refill() {
  if (!filled_) return;
  while (store_.size() > 0 && store_.size() < capacity_) {
    const Entry heaviest = store_.takeHeaviest();
    store_.insert({heaviest.particle, 0.5 * heaviest.weight});
    store_.insert({heaviest.particle, 0.5 * heaviest.weight});
  }
}

template <ParticleType Type, class Store>
bool WeightedMethod<Type, Store>::breakUp(RandomStream& random) {
  if (!store_.drawSingle(SingleProcess::breakage, random, first_)) return false;
  const Entry& parent = first_;
  taken(parent);
  ++counters_.breakages;
  if (breakage_->daughters == BreakageOptions::Daughters::equal) {
    const Particle daughter = type_.fragment(parent.particle, 1.0 / breakage_->fragments);
    add(daughter, parent.weight, static_cast<std::size_t>(breakage_->fragments));
  } else {
    const double fraction = random.uniform();
    if (method_ != MonteCarloMethod::mmc) makeRoom(2);
    add(type_.fragment(parent.particle, fraction), parent.weight);
    add(type_.fragment(parent.particle, 1 - fraction), parent.weight);
  }
  return true;
}

template <ParticleType Type, class Store>
bool WeightedMethod<Type, Store>::deposit(RandomStream& random) {
  if (!store_.drawSingle(SingleProcess::deposition, random, first_)) return false;
  taken(first_);
  ++counters_.depositions;
  refill();
  return true;
}

template <ParticleType Type, class Store>
bool WeightedMethod<Type, Store>::condense(RandomStream& random) {
  if (!store_.drawSingle(SingleProcess::condensation, random, first_)) return false;
  taken(first_);
  ++counters_.condensations;
  if (const auto after = store_.rates().growthJump().jumped(first_.particle)) {
    put(*after, first_.weight);
  } else {
    ++counters_.vanished;
    refill();
  }
  return true;
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::nucleate(RandomStream&) {
  // Particles that change carry the time they are of.
  if constexpr (isDeferred<Type>) nucleus_ = type_.make(nucleusVolume_);
  add(*nucleus_, nucleusWeight_);
  ++counters_.nucleations;
  if (store_.rates().gels()) {
    const double v = type_.volume(*nucleus_);
    putIn_[0] += nucleusWeight_ * v;
    putIn_[1] += nucleusWeight_ * v * v;
  }
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::grow(double dt) {
  const std::array<double, 2> before = held_;
  held_ = {};
  store_.transform([&](Entry& entry) {
    entry.particle = type_.grown(entry.particle, growth_.condensation, growth_.surface(), dt);
    const double v = type_.volume(entry.particle);
    if (!(v > 0) || v < growth_.smallestVolume) {
      ++counters_.vanished;
      return false;
    }
    track(entry, 1);
    return true;
  });
  for (std::size_t k = 0; k < 2; ++k) {
    if (before[k] > 0) putIn_[k] *= held_[k] / before[k];
  }
  refill();
  retune();
  measureGrowth();
}

template <ParticleType Type, class Store>
template <class F>
void WeightedMethod<Type, Store>::changeParticles(F f) {
  store_.transform([&](Entry& entry) {
    if (f(entry.particle, entry.weight)) return true;
    ++counters_.vanished;
    return false;
  });
  refill();
  retune();
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::setKernel(const CollisionKernelOptions& kernel) {
  if constexpr (mergesMany) {
    sinceTuned_ = 0;
    store_.changeRates([&](WeightedRates<Type>& rates) {
      rates.setKernel(kernel);
      if (rates.tunable() && store_.size() > 0) rates.tune([this](const auto& f) { store_.forEach(f); });
    });
  } else {
    std::vector<Entry> entries = takeAll();
    store_.changeRates([&](WeightedRates<Type>& rates) { rates.setKernel(kernel); });
    assign(std::move(entries));
    retune();
  }
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::rebuild() {
  assign(takeAll());
}

template <ParticleType Type, class Store>
auto WeightedMethod<Type, Store>::takeAll() -> std::vector<Entry> {
  std::vector<Entry> entries;
  entries.reserve(store_.size());
  store_.forEach([&](const Entry& entry) { entries.push_back(entry); });
  store_.clear();
  return entries;
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::replace(std::vector<Entry> entries) {
  store_.clear();
  std::sort(entries.begin(), entries.end(), [this](const Entry& a, const Entry& b) {
    const double va = type_.volume(a.particle), vb = type_.volume(b.particle);
    return va < vb || (va == vb && a.weight < b.weight);
  });
  assign(std::move(entries));
  filled_ = store_.size() >= capacity_;
  retune();
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::join(const std::vector<Entry>& coming, double chance, RandomStream& random) {
  const auto copies = systematicCopies(
      coming.size(), [&](std::size_t) { return chance; }, random);
  // Many at once are cheaper put in order with the others than one by one.
  std::vector<Entry> entries = takeAll();
  for (std::size_t k = 0; k < coming.size(); ++k)
    for (std::size_t copy = 0; copy < copies[k]; ++copy) {
      entries.push_back({coming[k].particle, coming[k].weight / chance});
      track(entries.back(), 1);
    }
  assign(std::move(entries));
  mergeExcess();
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::restore(const std::array<double, 2>& memory, std::vector<Entry> entries) {
  nucleusWeight_ = memory[0];
  store_.clear();
  assign(std::move(entries));
  filled_ = memory[1] != 0;
  if (store_.size() > capacity_) mergeExcess();
  retune();
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::dilute(double factor) {
  store_.transform([&](Entry& entry) {
    entry.weight *= factor;
    return true;
  });
  for (double& sum : held_) sum *= factor;
  for (double& sum : putIn_) sum *= factor;
}

template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::assign(std::vector<Entry> entries) {
  if constexpr (requires { store_.assign(std::move(entries)); }) {
    store_.assign(std::move(entries));
  } else {
    for (const Entry& entry : entries) store_.insert(entry);
  }
}

// A majorant that suits the particles as they are; with the cost of N events, every 2N events.
template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::retune() {
  sinceTuned_ = 0;
  if (!store_.rates().tunable() || store_.size() == 0) return;
  if constexpr (requires(Store & store) { store.changeRates([](WeightedRates<Type>&) {}); }) {
    store_.changeRates(
        [this](WeightedRates<Type>& rates) { rates.tune([this](const auto& f) { store_.forEach(f); }); });
  }
}

// The step over which growth changes the mean logarithm of the volumes, or that of a nucleus, by `growthPart`. Without
// other processes growth is exact, however long the step.
template <ParticleType Type, class Store>
void WeightedMethod<Type, Store>::measureGrowth() {
  growthStep_ = std::numeric_limits<double>::infinity();
  if (!growth_.active() || growth_.treatment == GrowthOptions::Treatment::jumps) return;
  if (alone_ && !(growth_.step > 0)) return;
  const auto rateOf = [&](const Particle& p) {
    return std::abs(store_.rates().growthJump().speed(p)) / type_.volume(p);
  };
  GrowthPace pace;
  if (nucleus_) pace.nucleus = rateOf(*nucleus_);
  double sum = 0, number = 0;
  store_.forEach([&](const Entry& entry) {
    sum += entry.weight * rateOf(entry.particle);
    number += entry.weight;
  });
  if (number > 0) {
    pace.population = sum / number;
    pace.jumpsOfEach = (2 * coagulationRate() + breakageRate() + depositionRate()) / static_cast<double>(store_.size());
  }
  growthStep_ = particles::growthStep(growth_, growthPart, pace);
}

}  // namespace lampblack::particles
