// The stochastic part of an ensemble: coagulation by fictitious jumps under the bound of PairKernel, and inception.
#include <cmath>

#include "core/errors.hpp"
#include "particles/ensemble.hpp"
#include "particles/ensemble_medium.hpp"

namespace lampblack {
namespace {

using Bound = PairKernel::Bound;

// Sum of the bound over all ordered pairs, halved: times 1/V it is the rate of jumps, pairs (i, i) being fictitious.
double boundTotal(const PairKernel& kernel, const PairKernel::Terms& sums, std::size_t n) {
  return kernel.scale() * (static_cast<double>(n) * sums.ab + sums.a * sums.b);
}

}  // namespace

PairKernel Ensemble::buildTree(const Medium& medium) {
  const auto make = [&](Bound bound) {
    return PairKernel(options_.kernel, medium.gas, options_.soot.vanDerWaals, bound, options_.verificationScale);
  };
  const auto fill = [&](const PairKernel& kernel) {
    tree_.assign(size(), [&](std::size_t i) { return kernel.terms(masses_[i], diameters_[i]); });
  };
  const PairKernel kernel = make(Bound::freeMolecular);
  fill(kernel);
  if (options_.kernel != CoagulationKernel::transition || size() < 2) return kernel;
  const PairKernel alternative = make(Bound::continuum);
  PairKernel::Terms sums{0, 0, 0, 0};
  for (std::size_t i = 0; i < size(); ++i) {
    const double slip = tree_.leaf(i).other, d = diameters_[i];
    sums.a += slip;
    sums.b += d;
    sums.ab += slip * d;
  }
  if (boundTotal(kernel, tree_.total(), size()) <= boundTotal(alternative, sums, size())) return kernel;
  fill(alternative);
  return alternative;
}

void Ensemble::setParticle(const PairKernel& kernel, std::size_t i, double mass, double hydrogen) {
  masses_[i] = mass;
  hydrogen_[i] = hydrogen;
  diameters_[i] = std::cbrt(6 * mass / (constants::pi * options_.soot.sootDensity));
  tree_.set(i, kernel.terms(mass, diameters_[i]));
}

void Ensemble::coagulate(const PairKernel& kernel, std::size_t i, std::size_t j) {
  if (i > j) std::swap(i, j);  // so that the particle moved into j's place is never i
  const std::size_t last = size() - 1;
  setParticle(kernel, i, masses_[i] + masses_[j], hydrogen_[i] + hydrogen_[j]);
  if (j != last) tree_.set(j, PairKernel::Terms(tree_.leaf(last)));
  tree_.set(last, {0, 0, 0, 0});
  removeParticle(j);
  ++counters_.coagulations;
}

double Ensemble::incept(const Medium& medium, const PairKernel& kernel) {
  ++counters_.inceptions;
  const std::size_t n = size();
  const double added = medium.condensing ? medium.collision(medium.nucleusMass, medium.nucleusDiameter) : 0;
  if (n < options_.capacity) {
    masses_.push_back(0);
    hydrogen_.push_back(0);
    diameters_.push_back(0);
    setParticle(kernel, n, medium.nucleusMass, medium.nucleusHydrogen);
    filled_ = filled_ || n + 1 == options_.capacity;
    return added;
  }
  // Full: of the n + 1 particles one, drawn uniformly, goes, and the sample shrinks with them.
  ++counters_.contractions;
  sampleVolume_ *= static_cast<double>(n) / static_cast<double>(n + 1);
  const auto victim = static_cast<std::size_t>(random_.below(n + 1));
  if (victim == n) return 0;
  const double removed = medium.condensing ? medium.collision(masses_[victim], diameters_[victim]) : 0;
  setParticle(kernel, victim, medium.nucleusMass, medium.nucleusHydrogen);
  return added - removed;
}

void Ensemble::jump(const Medium& medium, double dt) {
  const bool incepting = medium.selfCollision > 0;
  const bool coagulating = options_.soot.coagulation;
  if (!incepting && (!coagulating || size() < 2)) return;
  const PairKernel kernel = buildTree(medium);
  double collisionSum = dimerCollisionSum(medium);
  const auto collision = [&](std::size_t i) { return medium.collision(masses_[i], diameters_[i]); };
  const bool tracking = incepting && medium.condensing;

  double time = 0;
  while (true) {
    const std::size_t n = size();
    const double coagulationRate = coagulating && n > 1 ? boundTotal(kernel, tree_.total(), n) / sampleVolume_ : 0;
    double inceptionRate = 0;
    if (incepting) {
      const double dimers = dimerNumber(medium, collisionSum);
      inceptionRate = 0.5 * medium.selfCollision * dimers * dimers * sampleVolume_;
    }
    const double rate = coagulationRate + inceptionRate;
    if (!(rate > 0)) break;
    time += random_.exponential(rate);
    if (time >= dt) break;

    const double choice = random_.uniform() * rate;
    if (choice >= coagulationRate) {
      collisionSum += incept(medium, kernel);
      continue;
    }
    // The bound's pairs: one drawn by ab and one uniformly, or one by a and one by b.
    const PairKernel::Terms& sums = tree_.total();
    const double first = static_cast<double>(n) * sums.ab;
    std::size_t i = 0, j = 0;
    if (choice * (first + sums.a * sums.b) < first * coagulationRate) {
      i = tree_.draw<&PairKernel::Terms::ab>(random_.uniform());
      j = static_cast<std::size_t>(random_.below(n));
    } else {
      i = tree_.draw<&PairKernel::Terms::a>(random_.uniform());
      j = tree_.draw<&PairKernel::Terms::b>(random_.uniform());
    }
    if (i == j) {
      ++counters_.fictitious;
      continue;
    }
    const PairKernel::Terms &one = tree_.leaf(i), &other = tree_.leaf(j);
    if (random_.uniform() * kernel.bound(one, other) >= kernel.value(one, other)) {
      ++counters_.fictitious;
      continue;
    }
    if (tracking) collisionSum -= collision(i) + collision(j);
    coagulate(kernel, i, j);
    if (tracking) collisionSum += collision(std::min(i, j));
    if (doubleIfDepleted()) {
      tree_.assign(size(), [&](std::size_t k) { return kernel.terms(masses_[k], diameters_[k]); });
      collisionSum *= 2;
    }
  }
  if (random_.position() >> 33 != 0) throw NumericsError("soot ensemble: the random stream is used up");
}

}  // namespace lampblack
