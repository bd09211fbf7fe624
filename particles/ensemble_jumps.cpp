// The stochastic part of an ensemble: coagulation by fictitious jumps under the majorant of the kernel, and inception.
#include <cmath>

#include "core/errors.hpp"
#include "particles/ensemble.hpp"
#include "particles/ensemble_medium.hpp"
#include "particles/population/monte_carlo/class_store.hpp"

namespace lampblack {
namespace {

struct SootParticle {
  double mass, hydrogen, diameter;
};

// What the store of the population balance asks of a particle.
struct SootRates {
  using Entry = SootParticle;
  static constexpr bool weighted = false;

  const CollisionKernel* kernel;
  double density;
  bool coagulating;

  [[nodiscard]] CollisionKernel::Properties properties(const Entry& p) const {
    return {p.mass / density, p.mass, p.diameter};
  }
  [[nodiscard]] double volume(const Entry& p) const { return p.mass / density; }
  [[nodiscard]] double weight(const Entry&) const { return 1; }
  [[nodiscard]] double weightFactor() const { return 1; }
  [[nodiscard]] std::size_t rank() const { return coagulating ? kernel->rank() : 0; }
  [[nodiscard]] CollisionKernel::Terms terms(const Entry& p) const { return kernel->terms(properties(p)); }
  [[nodiscard]] double pair(const Entry& p, const Entry& q) const {
    return kernel->value(properties(p), properties(q));
  }
  [[nodiscard]] double single(SingleProcess, const Entry&) const { return 0; }
  [[nodiscard]] bool active(SingleProcess) const { return false; }
};

}  // namespace

struct Ensemble::Jumps {
  CollisionKernel kernel;
  ClassStore<SootRates> store;

  // Bounds are tuned to the population as it is now. What the store draws depends on it and the random numbers only.
  Jumps(const Ensemble& ensemble, const Medium& medium)
      : kernel(medium.kernel),
        store(SootRates{&kernel, ensemble.options_.soot.sootDensity, ensemble.options_.soot.coagulation}) {
    const auto particle = [&](std::size_t i) {
      return SootParticle{ensemble.masses_[i], ensemble.hydrogen_[i], ensemble.diameters_[i]};
    };
    kernel.tune([&](auto&& f) {
      for (std::size_t i = 0; i < ensemble.size(); ++i) f(store.rates().properties(particle(i)));
    });
    store.insertAll(ensemble.size(), particle);
  }
  Jumps(const Jumps&) = delete;  // the store points at the kernel
  Jumps& operator=(const Jumps&) = delete;

  SootParticle insert(double mass, double hydrogen) {
    const SootParticle p{mass, hydrogen, std::cbrt(6 * mass / (constants::pi * store.rates().density))};
    store.insert(p);
    return p;
  }
  void writeTo(Ensemble& ensemble) const {
    for (auto* values : {&ensemble.masses_, &ensemble.hydrogen_, &ensemble.diameters_}) values->clear();
    store.forEach([&](const SootParticle& p) {
      ensemble.masses_.push_back(p.mass);
      ensemble.hydrogen_.push_back(p.hydrogen);
      ensemble.diameters_.push_back(p.diameter);
    });
  }
};

double Ensemble::incept(const Medium& medium, Jumps& jumps) {
  ++counters_.inceptions;
  const std::size_t n = jumps.store.size();
  const auto collision = [&](const SootParticle& p) {
    return medium.condensing ? medium.collision(p.mass, p.diameter) : 0.0;
  };
  double change = 0;
  if (n == options_.capacity) {
    // Full: of the n + 1 particles one, drawn uniformly, goes, and the sample shrinks with them.
    ++counters_.contractions;
    sampleVolume_ *= static_cast<double>(n) / static_cast<double>(n + 1);
    if (random_.below(n + 1) == n) return 0;
    change -= collision(jumps.store.takeUniform(random_));
  }
  change += collision(jumps.insert(medium.nucleusMass, medium.nucleusHydrogen));
  filled_ = filled_ || jumps.store.size() == options_.capacity;
  return change;
}

void Ensemble::jump(const Medium& medium, double dt) {
  const bool incepting = medium.selfCollision > 0;
  const bool coagulating = options_.soot.coagulation;
  if (!incepting && (!coagulating || size() < 2)) return;
  Jumps jumps(*this, medium);
  double collisionSum = dimerCollisionSum(medium);
  const auto collision = [&](const SootParticle& p) { return medium.collision(p.mass, p.diameter); };
  const bool tracking = incepting && medium.condensing;

  double time = 0;
  while (true) {
    const double coagulationRate = coagulating && jumps.store.size() > 1 ? jumps.store.pairRate() / sampleVolume_ : 0;
    double inceptionRate = 0;
    if (incepting) {
      const double dimers = dimerNumber(medium, collisionSum);
      inceptionRate = 0.5 * medium.selfCollision * dimers * dimers * sampleVolume_;
    }
    const double rate = coagulationRate + inceptionRate;
    if (!(rate > 0)) break;
    time += random_.exponential(rate);
    if (time >= dt) break;

    if (inceptionRate > 0 && random_.uniform() * rate >= coagulationRate) {
      collisionSum += incept(medium, jumps);
      continue;
    }
    SootParticle i{}, j{};
    if (!jumps.store.drawPair(random_, i, j)) {
      ++counters_.fictitious;
      continue;
    }
    const SootParticle joined = jumps.insert(i.mass + j.mass, i.hydrogen + j.hydrogen);
    ++counters_.coagulations;
    if (tracking) collisionSum += collision(joined) - collision(i) - collision(j);
    if (depleted(jumps.store.size())) {
      jumps.store.duplicate();
      sampleVolume_ *= 2;
      ++counters_.doublings;
      collisionSum *= 2;
    }
  }
  jumps.writeTo(*this);
  if (random_.position() >> 33 != 0) throw NumericsError("soot ensemble: the random stream is used up");
}

}  // namespace lampblack
