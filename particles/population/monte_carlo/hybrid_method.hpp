// Small particles as numbers, large ones as particles (Boje, Akroyd, Kraft 2019): of spheres of 1
// to `threshold` units only the number of each size is kept, everything else is a numerical particle. All stand for the
// same number of real particles, so that both together are one ensemble of the direct simulation, and a particle may
// change from one to the other at any event. For coalescing spheres the law is exact; other types of particles lose
// below the threshold what a sphere does not have.
//
// Numbers take no memory and never overflow: however many nuclei appear, the ensemble is contracted only when there are
// too many large particles. A contraction takes one of all out, drawn uniformly from numbers and particles together,
// the sample shrinking in proportion, until the particles fit: M_0 stays, and the mean of no moment changes. Doubling,
// when both together are half the capacity or fewer, doubles every number and copies every particle, as in the direct
// simulation. An ensemble that starts empty is not doubled before both together were 3/4 of the capacity.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/hybrid_population.hpp"
#include "particles/population/population_solver.hpp"

namespace lampblack::particles {

template <ParticleType Type>
class HybridMethod {
 public:
  using Particle = typename Type::Particle;
  using Entry = typename HybridPopulation<Type>::Entry;

  struct Options {
    std::size_t capacity = 2;   // of particles that are not numbers
    std::size_t threshold = 1;  // units
    double unit = 1;            // m3
    double weight = 1;          // 1/m3, real particles for each of the sample
  };

  HybridMethod(const Type& type, const PopulationModel& model, const Options& options)
      : type_(type),
        model_(model),
        capacity_(options.capacity),
        weight_(options.weight),
        gelShare_(std::min(0.5, 2 / std::cbrt(static_cast<double>(options.capacity)))),
        population_(type, model, options.threshold, options.unit) {}

  // The initial population.
  template <class Volumes>
  void start(const Volumes& volumes, RandomStream& random) {
    for (const double volume : volumes) population_.add(type_.make(volume));
    retune();
    keepInRange(random);
  }

  [[nodiscard]] double coagulationRate() const { return weight_ * population_.pairRate(); }
  bool coagulate(RandomStream& random) {
    Entry i, j;
    if (!population_.drawPair(random, i, j)) return false;
    const Particle joined = type_.coagulated(i.particle, j.particle);
    largest_ = std::max(largest_, type_.volume(joined));
    population_.add(joined);
    ++counters_.coagulations;
    // With the cost of as many events as there are particles and sizes, after as many events.
    if (population_.rates().tunable() && --retuneAfter_ == 0) retune();
    keepInRange(random);
    return true;
  }

  [[nodiscard]] double breakageRate() const { return population_.singleRate(SingleProcess::breakage); }
  bool breakUp(RandomStream& random) {
    Entry parent;
    if (!population_.drawSingle(SingleProcess::breakage, random, parent)) return false;
    const BreakageOptions& breakage = *model_.breakage;
    if (breakage.daughters == BreakageOptions::Daughters::uniform) {
      const double fraction = random.uniform();
      population_.add(type_.fragment(parent.particle, fraction));
      population_.add(type_.fragment(parent.particle, 1 - fraction));
    } else {
      const Particle piece = type_.fragment(parent.particle, 1.0 / breakage.fragments);
      for (int k = 0; k < breakage.fragments; ++k) population_.add(piece);
    }
    ++counters_.breakages;
    keepInRange(random);
    return true;
  }

  [[nodiscard]] double depositionRate() const { return population_.singleRate(SingleProcess::deposition); }
  bool deposit(RandomStream& random) {
    Entry gone;
    if (!population_.drawSingle(SingleProcess::deposition, random, gone)) return false;
    ++counters_.depositions;
    keepInRange(random);
    return true;
  }

  // Growth by a monomer: a number of one size becomes one of another.
  [[nodiscard]] double condensationRate() const { return population_.singleRate(SingleProcess::condensation); }
  bool condense(RandomStream& random) {
    Entry before;
    if (!population_.drawSingle(SingleProcess::condensation, random, before)) return false;
    if (const auto after = population_.rates().growthJump().jumped(before.particle)) {
      population_.add(*after);
    } else {
      ++counters_.vanished;
    }
    ++counters_.condensations;
    keepInRange(random);
    return true;
  }

  void nucleate(RandomStream& random) {
    population_.add(type_.make(model_.nucleation->volume));
    ++counters_.nucleations;
    keepInRange(random);
  }
  [[nodiscard]] double nucleusWeight() const { return weight_; }
  void dilute(double factor) { weight_ *= factor; }

  // Growth is by jumps.
  void grow(double) {}
  [[nodiscard]] double growthStep() const { return std::numeric_limits<double>::infinity(); }
  void beginStep(double, double) {}
  void atTime(double) {}
  void endStep() {}

  // Whether one particle holds more of the mass than clusters do before the gel point (see EqualWeightSample).
  [[nodiscard]] bool gelled() const {
    if (!population_.rates().gels() || !filled_ || largest_ <= gelVolume_) return false;
    double sum = 0;
    largest_ = 0;
    population_.forEach([&](const Entry& e, double number) {
      const double v = type_.volume(e.particle);
      sum += number * v;
      largest_ = std::max(largest_, v);
    });
    gelVolume_ = gelShare_ * sum;
    return largest_ > gelVolume_;
  }

  [[nodiscard]] std::array<double, 4> moments() const {
    std::array<double, 4> moments{};
    population_.forEach([&](const Entry& e, double number) {
      const double v = type_.volume(e.particle);
      double term = weight_ * number;
      for (double& moment : moments) {
        moment += term;
        term *= v;
      }
    });
    return moments;
  }
  [[nodiscard]] std::vector<double> numberInBins(std::span<const double> edges) const {
    std::vector<double> bins(edges.size() > 1 ? edges.size() - 1 : 0, 0.0);
    population_.forEach([&](const Entry& e, double number) {
      const auto above = std::upper_bound(edges.begin(), edges.end(), type_.volume(e.particle));
      if (above == edges.begin() || above == edges.end()) return;
      bins[static_cast<std::size_t>(above - edges.begin()) - 1] += weight_ * number;
    });
    return bins;
  }
  [[nodiscard]] double geometricDeviation() const {
    double sum = 0, mean = 0, square = 0;
    population_.forEach([&](const Entry& e, double number) {
      const double x = std::log(type_.collisionDiameter(e.particle)), before = mean;
      sum += number;
      mean += number / sum * (x - before);
      square += number * (x - before) * (x - mean);
    });
    return sum > 0 ? std::exp(std::sqrt(square / sum)) : 1;
  }
  [[nodiscard]] std::size_t size() const { return population_.particles(); }
  [[nodiscard]] std::size_t bytes() const { return population_.bytes(); }
  [[nodiscard]] PopulationCounters& counters() { return counters_; }
  [[nodiscard]] const HybridPopulation<Type>& population() const { return population_; }

 private:
  void retune() {
    retuneAfter_ = population_.sizes() + std::max<std::size_t>(population_.particles(), 16);
    population_.retune();
  }
  void keepInRange(RandomStream& random) {
    while (population_.particles() > capacity_) {
      const double before = population_.size();
      (void)population_.takeUniform(random);
      weight_ *= before / (before - 1);
      gelVolume_ *= (before - 1) / before;
      ++counters_.removals;
    }
    const double capacity = static_cast<double>(capacity_);
    if (!filled_ && population_.size() < 0.75 * capacity) return;
    filled_ = true;
    while (population_.size() > 0 && 2 * population_.size() <= capacity) {
      population_.duplicate();
      weight_ *= 0.5;
      gelVolume_ *= 2;
      ++counters_.doublings;
    }
  }

  Type type_;
  PopulationModel model_;
  std::size_t capacity_;
  double weight_;    // 1/m3
  double gelShare_;  // of the mass in one particle
  HybridPopulation<Type> population_;
  bool filled_ = false;
  std::size_t retuneAfter_ = 1;
  // m3: at least that of the largest particle, and what it may have before gelled() looks at the mass again.
  mutable double largest_ = 0, gelVolume_ = 0;
  PopulationCounters counters_;
};

}  // namespace lampblack::particles
