// PairProcess: how long its steps are and what they do. Included by pair_process.hpp.
#pragma once

#include <cstring>
#include <type_traits>
#include <utility>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/pair_process.hpp"

namespace lampblack::particles {

template <ParticleType Type>
PairProcess<Type>::PairProcess(const Type& type, const PopulationModel& model, const InitialPopulation& initial,
                               const MonteCarloOptions& options)
    : model_(model),
      options_(options),
      random_(options.seed, options.repeat, streamPurpose),
      population_(type, model.coagulation),
      sampling_(options.pairProbability),
      growth_(type, model.growth),
      grows_(model.growth.active()),
      gels_(model.coagulation && population_.kernel().kernel().gels(fractalDimension(type))) {
  population_.reserve(options.particles + options.particles / 8 + 16);
  for (const auto& [volume, weight] : initialParticles(initial, options.particles, options.initialWeights, random_))
    population_.add(type.make(volume), weight);
  filled_ = population_.size() >= options.particles;
  if (model.nucleation) {
    schedule_.emplace(*model.nucleation);
    nucleusVolume_ = model.nucleation->volume;
    nucleus_ = type.make(nucleusVolume_);
    if (model.coagulation) {
      const CollisionKernel& kernel = population_.kernel().kernel();
      const CollisionKernel::Properties properties = kernelProperties(kernel, type, *nucleus_);
      nucleusCollisions_ = kernel.value(properties, properties);
    }
  }
  if (model.breakage) breakage_ = PowerLaw(model.breakage->rate, model.breakage->exponent);
  if (model.deposition) deposition_ = PowerLaw(model.deposition->rate, model.deposition->exponent);
  for (const bool is : {model.coagulation.has_value(), model.nucleation.has_value(), model.breakage.has_value(),
                        model.deposition.has_value(), grows_, model.dilution != 0})
    processes_ += is ? 1 : 0;
  measure();
  putIn_ = held_;
}

template <ParticleType Type>
void PairProcess<Type>::advance(double end) {
  while (time_ < end) {
    runCallback();
    const double step = stepTo(end);
    if (processes_ > 1) ++counters_.splitSteps;
    const double middle = time_ + 0.5 * step, next = time_ + step < end ? time_ + step : end;
    double nucleated = time_;  // until when
    splitStep(
        step,
        [&](double) {
          const double until = nucleated < middle ? middle : next;
          if (schedule_) nucleate(std::exchange(nucleated, until), until);
        },
        [&](double dt) {
          if (model_.dilution != 0) population_.scaleWeights(std::exp(-model_.dilution * dt));
        },
        [&](double dt) {
          if (grows_) grow(dt);
        },
        [&](double dt) {
          if (model_.breakage) breakUp(dt);
        },
        [&](double dt) {
          if (model_.deposition) deposit(dt);
        },
        [&](double dt) {
          if (!model_.coagulation) return;
          fit();
          sampling_.advance(population_, dt, random_, counters_);
        });
    fit();
    time_ = next;
    measure();
    if (gels_) checkGelation();
  }
}

// Whatever is alone takes one step, as each process is exact; several go by the fastest of them.
template <ParticleType Type>
double PairProcess<Type>::stepTo(double end) {
  double step = end - time_;
  if (grows_ && model_.growth.step > 0) step = std::min(step, model_.growth.step);
  if (processes_ < 2 && !gels_) return step;
  const double part = options_.splitChange;
  const double pace = model_.coagulation ? sampling_.pace(population_, random_) : 0;
  if (gels_ && pace > 0) step = std::min(step, part / pace);
  if (processes_ < 2) return step;
  const auto limit = [&](double rate) {
    if (rate > 0) step = std::min(step, part / rate);
  };
  limit(pace);
  limit(breakagePace_);
  limit(depositionPace_);
  limit(std::abs(model_.dilution));
  if (grows_) {
    GrowthPace grown;
    if (nucleus_) grown.nucleus = std::abs(growth_.speed(*nucleus_)) / nucleusVolume_;
    grown.population = growthPace_;
    grown.jumpsOfEach = 2 * pace + breakagePace_ + depositionPace_;
    step = std::min(step, growthStep(model_.growth, growthPart, grown));
  }
  return schedule_ ? nucleationStep(step, pace) : step;
}

// Nuclei that appear in a step meet each other: their number N and their collisions K change each other at sqrt(K J).
// What they add to many does not matter to these.
template <ParticleType Type>
double PairProcess<Type>::nucleationStep(double step, double pace) const {
  const double others = std::max({pace, breakagePace_, depositionPace_, std::abs(model_.dilution)});
  for (int k = 0; k < 60; ++k) {
    const double added = schedule_->cumulative(time_ + step) - schedule_->cumulative(time_), rate = added / step;
    const double most =
        std::max(std::sqrt(nucleusCollisions_ * rate), number_ > 0 ? std::min(rate / number_, others) : others);
    if (most * step <= 1.0001 * options_.splitChange) break;
    step = std::max(0.5 * step, options_.splitChange / most);
  }
  return step;
}

template <ParticleType Type>
bool PairProcess<Type>::isNucleus(const Particle& particle) const {
  if constexpr (std::is_trivially_copyable_v<Particle>)  // to the last bit
    return std::memcmp(&particle, &*nucleus_, sizeof(Particle)) == 0;
  else
    return !moreThanVolume<Type>() && population_.type().volume(particle) == population_.type().volume(*nucleus_);
}

// What nucleates is shared by the nuclei that are there, or by new ones where those would stand for too many.
template <ParticleType Type>
void PairProcess<Type>::nucleate(double from, double to) {
  const double added = schedule_->cumulative(to) - schedule_->cumulative(from);
  if (!(added > 0)) return;
  const auto volume = static_cast<float>(population_.type().volume(*nucleus_));
  nuclei_.clear();
  double there = 0, number = added;
  for (std::size_t k = 0; k < population_.size(); ++k) {
    const auto& row = population_.row(k);
    number += row.weight;
    if (row.volume != volume || !isNucleus(population_.particle(k))) continue;
    nuclei_.push_back(k);
    there += row.weight;
  }
  const auto needed = [&](double most) {
    return std::ceil((there + added) / most * (1 - 1e-12)) - static_cast<double>(nuclei_.size());
  };
  const double mean = number / capacity(), given = options_.nucleusWeight;
  // With room, for no more than the mean.
  const double room = mergedTo * capacity() - static_cast<double>(population_.size());
  double missing = needed(given > 0 ? given : gathered * mean);
  if (!(given > 0)) missing = std::max(missing, std::min(needed(mean), std::floor(room)));
  missing = std::min(missing, capacity());
  counters_.nucleations += static_cast<std::uint64_t>(std::max(missing, 0.0));
  if (missing >= 1) {
    for (double k = 0; k < missing; ++k) population_.add(*nucleus_, added / missing);
  } else {
    for (const std::size_t k : nuclei_)
      population_.setWeight(k, population_.weight(k) + added / static_cast<double>(nuclei_.size()));
    counters_.merges += nuclei_.size();
  }
  if (gels_) {
    putIn_[0] += added * nucleusVolume_;
    putIn_[1] += added * nucleusVolume_ * nucleusVolume_;
  }
}

template <ParticleType Type>
void PairProcess<Type>::grow(double step) {
  const Type& type = population_.type();
  const GrowthOptions& growth = model_.growth;
  std::array<double, 2> before{}, after{};
  population_.change([&](Particle& particle, double weight) {
    const double old = type.volume(particle);
    const Particle grown = type.grown(particle, growth.condensation, growth.surface(), step);
    const double v = type.volume(grown);
    before[0] += weight * old;
    before[1] += weight * old * old;
    if (!(v > 0 && v >= growth.smallestVolume)) {
      ++counters_.vanished;
      return false;
    }
    particle = grown;
    after[0] += weight * v;
    after[1] += weight * v * v;
    return true;
  });
  for (std::size_t k = 0; k < 2; ++k)
    if (before[k] > 0) putIn_[k] *= after[k] / before[k];
}

template <ParticleType Type>
void PairProcess<Type>::deposit(double step) {
  for (std::size_t k = 0; k < population_.size(); ++k) {
    const double rate = deposition_(population_.volume(k));
    population_.setWeight(k, population_.weight(k) * std::exp(-rate * step));
  }
  ++counters_.depositions;
}

template <ParticleType Type>
void PairProcess<Type>::breakUp(double step) {
  const Type& type = population_.type();
  const std::size_t size = population_.size();
  bool broken = false;
  fragments_.clear();
  for (std::size_t k = 0; k < size; ++k) {
    const double rate = breakage_(population_.volume(k));
    if (!(rate > 0)) continue;
    const double waits = random_.exponential(rate);
    if (waits >= step) continue;
    breakUp(population_.particle(k), population_.weight(k), step - waits);
    population_.setWeight(k, 0);
    broken = true;
  }
  while (!fragments_.empty()) {
    const Fragment fragment = fragments_.back();
    fragments_.pop_back();
    const double rate = breakage_(type.volume(fragment.particle));
    const double waits = rate > 0 ? random_.exponential(rate) : fragment.time;
    if (waits < fragment.time)
      breakUp(fragment.particle, fragment.weight, fragment.time - waits);
    else
      population_.add(fragment.particle, fragment.weight);
  }
  if (broken) population_.remove([this](std::size_t k) { return population_.weight(k) == 0; });
}

// Equal fragments are one numerical particle.
template <ParticleType Type>
void PairProcess<Type>::breakUp(const Particle& parent, double weight, double time) {
  const Type& type = population_.type();
  ++counters_.breakages;
  const int count = model_.breakage->fragments;
  if (model_.breakage->daughters == BreakageOptions::Daughters::equal) {
    fragments_.push_back({type.fragment(parent, 1.0 / count), weight * count, time});
  } else {
    const double part = random_.uniform();
    fragments_.push_back({type.fragment(parent, part), weight, time});
    fragments_.push_back({type.fragment(parent, 1 - part), weight, time});
  }
}

template <ParticleType Type>
void PairProcess<Type>::fit() {
  const std::size_t size = population_.size();
  if (size > options_.particles) {
    counters_.merges += merging_.makeRoom(options_.particles, population_);
    filled_ = true;
  } else if (filled_ && static_cast<double>(size) < filledTo * capacity()) {
    counters_.copies += merging_.halveUpTo(static_cast<std::size_t>(mergedTo * capacity()), population_);
  }
  filled_ = filled_ || size >= options_.particles;
}

// Paces by number and by volume, the larger of the two.
template <ParticleType Type>
void PairProcess<Type>::measure() {
  number_ = growthPace_ = breakagePace_ = depositionPace_ = 0;
  held_ = {};
  double broken = 0, brokenVolume = 0, lost = 0, lostVolume = 0;
  for (std::size_t k = 0; k < population_.size(); ++k) {
    const double weight = population_.weight(k), v = population_.volume(k);
    number_ += weight;
    held_[0] += weight * v;
    held_[1] += weight * v * v;
    if (grows_) growthPace_ += weight * std::abs(growth_.speed(population_.particle(k))) / v;
    if (model_.breakage) {
      broken += weight * breakage_(v);
      brokenVolume += weight * v * breakage_(v);
    }
    if (model_.deposition) {
      lost += weight * deposition_(v);
      lostVolume += weight * v * deposition_(v);
    }
  }
  if (!(number_ > 0)) return;
  growthPace_ /= number_;
  breakagePace_ = std::max(broken / number_, brokenVolume / held_[0]);
  depositionPace_ = std::max(lost / number_, lostVolume / held_[0]);
}

// As in the other methods of different weights.
template <ParticleType Type>
void PairProcess<Type>::checkGelation() const {
  if (held_[1] / held_[0] > 4 * std::cbrt(capacity()) * putIn_[1] / putIn_[0]) throw GelationError(time_);
}

}  // namespace lampblack::particles
