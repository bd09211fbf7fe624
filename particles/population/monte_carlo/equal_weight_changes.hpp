// EqualWeightMethod: what changes, takes in or looks at all of its particles. Included by equal_weight_method.hpp.
#pragma once

#include "core/modules.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"

namespace lampblack::particles {

template <CoagulatingType Type, class Store>
template <class F>
void EqualWeightMethod<Type, Store>::changeParticles(F f) {
  const double weight = sample_.weight();
  const auto change = [&](Entry& entry) {
    if (!f(entry.particle, weight)) {
      ++counters_.vanished;
      return false;
    }
    entry.diameter = rates().entryDiameter(entry.particle);
    return true;
  };
  // One rebuild serves both the change and the majorant that suits it, where the store can tell.
  const auto tune = [&](std::span<const Entry> entries) {
    if (!rates().tunable() || entries.empty()) return;
    sample_.store().rates().tune(
        [&](const auto& g) {
          for (const Entry& entry : entries) g(entry);
        },
        entries.size());
  };
  if constexpr (requires { sample_.store().transform(change, tune); }) {
    sample_.transform(change, tune);
    retuneAfter_ = std::max<std::size_t>(size(), 16);
  } else {
    sample_.transform(change);
    if (rates().tunable()) retune();
  }
  findNucleusTerms();
  sample_.massChanged();
}

template <CoagulatingType Type, class Store>
void EqualWeightMethod<Type, Store>::join(const std::vector<WeightedParticle<typename Type::Particle>>& coming,
                                          RandomStream& random) {
  double number = static_cast<double>(size()) * sample_.weight();
  for (const auto& one : coming) number += one.weight;
  const double room = static_cast<double>(sample_.capacity());
  if (number > 2 * room * sample_.weight()) thin(number / room, random);
  const auto copies = systematicCopies(
      coming.size(), [&](std::size_t k) { return coming[k].weight / sample_.weight(); }, random);
  for (std::size_t k = 0; k < coming.size(); ++k)
    if (copies[k] > 0) sample_.put(rates().entry(coming[k].particle), copies[k]);
  sample_.massChanged();
  sample_.bringNumberIntoRange(random, counters_);
}

template <CoagulatingType Type, class Store>
void EqualWeightMethod<Type, Store>::thin(double weight, RandomStream& random) {
  std::vector<typename Type::Particle> kept;
  sample_.store().forEach([&](const Entry& entry) { kept.push_back(entry.particle); });
  const double part = sample_.weight() / weight;
  const auto copies = systematicCopies(
      kept.size(), [&](std::size_t) { return part; }, random);
  std::size_t left = 0;
  for (std::size_t k = 0; k < kept.size(); ++k)
    if (copies[k] > 0) kept[left++] = kept[k];
  counters_.removals += kept.size() - left;
  sample_.replace(weight, sample_.filled(), left, [&](std::size_t k) { return rates().entry(kept[k]); });
  retune();
}

template <CoagulatingType Type, class Store>
void EqualWeightMethod<Type, Store>::measureGrowth() {
  growthStep_ = std::numeric_limits<double>::infinity();
  if (!growth_.active() || growth_.treatment == GrowthOptions::Treatment::jumps) return;
  if (alone_ && !(growth_.step > 0)) return;
  const auto rateOf = [&](const typename Type::Particle& p) {
    return std::abs(rates().growthJump().speed(p)) / type_.volume(p);
  };
  GrowthPace pace;
  if (nucleus_) pace.nucleus = rateOf(nucleus_->particle);
  if (size() > 0) {
    const double n = static_cast<double>(size());
    sample_.store().forEach([&](const Entry& entry) { pace.population += rateOf(entry.particle) / n; });
    pace.jumpsOfEach = (2 * coagulationRate() + breakageRate() + depositionRate()) / n;
  }
  growthStep_ = particles::growthStep(growth_, growthPart, pace);
}

}  // namespace lampblack::particles
