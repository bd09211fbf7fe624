// The method that draws pairs for a population in a gas, which changes by laws of its own between the collisions
// (soot): what such a population asks of a method of different weights, on PairPopulation, PairSampling and
// PairMerging. docs/theory/population_balance/pairs.md.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/population/monte_carlo/pair_merging.hpp"
#include "particles/population/monte_carlo/pair_population.hpp"
#include "particles/population/monte_carlo/pair_sampling.hpp"
#include "particles/population/monte_carlo/systematic_sample.hpp"
#include "particles/population/monte_carlo/weighted_particle.hpp"
#include "particles/population/population_solver.hpp"

namespace lampblack::particles {

template <ParticleType Type>
class PairMethod {
 public:
  using Particle = typename Type::Particle;
  using Entry = WeightedParticle<Particle>;

  PairMethod(const Type& type, const PopulationModel& model, const InitialPopulation& initial,
             const MonteCarloOptions& options, RandomStream& random)
      : capacity_(options.particles), population_(type, model.coagulation), sampling_(options.pairProbability) {
    for (const auto& [volume, weight] : initialParticles(initial, capacity_, options.initialWeights, random))
      population_.add(type.make(volume), weight);
  }

  // Over `time` (s).
  void coagulate(double time, RandomStream& random) { sampling_.advance(population_, time, random, counters_); }
  // What nucleate() puts in, and for how many real ones (1/m3) that stands.
  void setNucleus(const Particle& nucleus, double weight) {
    nucleus_ = nucleus;
    nucleusWeight_ = weight;
  }
  [[nodiscard]] double nucleusWeight() const { return nucleusWeight_; }
  void nucleate(RandomStream&) {
    population_.add(*nucleus_, nucleusWeight_);
    ++counters_.nucleations;
  }
  void setKernel(const CollisionKernelOptions& kernel) { population_.setKernel(kernel); }
  void rebuild() {}
  // Most particles, of the next merging on.
  void setCapacity(std::size_t particles) { capacity_ = particles; }
  void mergeExcess() {
    population_.forgetTerms();
    counters_.merges += merging_.makeRoom(capacity_, population_);
  }
  void dilute(double factor) { population_.scaleWeights(factor); }

  // f(Particle&, weight) -> bool changes a particle, false drops it. The heaviest are halved to make up for these.
  template <class F>
  void changeParticles(F f) {
    const std::size_t before = population_.size();
    population_.change(f);
    counters_.vanished += before - population_.size();
    counters_.copies += merging_.halveUpTo(before, population_);
  }
  // f(const Particle&, weight).
  template <class F>
  void forEachParticle(F f) const {
    population_.forEach([&](const auto& entry) { f(entry.particle, entry.weight); });
  }

  void replace(const std::vector<Entry>& entries) {
    population_.clear();
    for (const Entry& entry : entries) population_.add(entry.particle, entry.weight);
    sampling_.remember({});
  }
  // Takes in the part `chance` of these, with weights that make up for the others.
  void join(const std::vector<Entry>& coming, double chance, RandomStream& random) {
    if (chance == 1) {
      for (const Entry& entry : coming) population_.add(entry.particle, entry.weight);
      return mergeExcess();
    }
    const auto copies = systematicCopies(
        coming.size(), [&](std::size_t) { return chance; }, random);
    for (std::size_t k = 0; k < coming.size(); ++k)
      for (std::size_t copy = 0; copy < copies[k]; ++copy)
        population_.add(coming[k].particle, coming[k].weight / chance);
    mergeExcess();
  }
  // What the population goes on with besides its particles and counters.
  [[nodiscard]] std::array<double, 2> memory() const { return sampling_.memory(); }
  void restore(const std::array<double, 2>& memory, const std::vector<Entry>& entries) {
    replace(entries);
    sampling_.remember(memory);
    mergeExcess();
  }

  [[nodiscard]] std::size_t size() const { return population_.size(); }
  PopulationCounters& counters() { return counters_; }

 private:
  std::size_t capacity_;
  PairPopulation<Type> population_;
  PairSampling<Type> sampling_;
  PairMerging<Type> merging_;
  std::optional<Particle> nucleus_;
  double nucleusWeight_ = 0;  // 1/m3
  PopulationCounters counters_;
};

}  // namespace lampblack::particles
