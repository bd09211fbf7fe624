// StochasticProcess: its population as given and as seen from outside. Included by stochastic_process.hpp.
#pragma once

#include <algorithm>
#include <tuple>

#include "core/modules.hpp"
#include "core/packed_doubles.hpp"
#include "numerics/vector_math.hpp"
#include "particles/ensemble/stochastic_process.hpp"
#include "particles/population/monte_carlo/systematic_sample.hpp"
#include "particles/population/monte_carlo/weighted_deviation.hpp"
#include "particles/population/monte_carlo/weighted_particle.hpp"

namespace lampblack::particles {

// `leastHydrogen`: kg. Where almost all hydrogen burns away in a step, the midpoint rule may take a trace too much,
// which is kept, as atoms are counted, and does not go on.
inline void requireParticle(const GivenParticle& p, double leastHydrogen) {
  if (!(p.carbon > 0) || !(p.hydrogen >= leastHydrogen) || !(p.primaries >= 1) || !(p.number > 0))
    throw InputError(
        fmt::format("stochastic soot: a particle needs carbon, a number and at least one primary; found {:.17g} kg of "
                    "carbon, {:.17g} kg of hydrogen, {:.17g} primaries, {:.17g} 1/m^3",
                    p.carbon, p.hydrogen, p.primaries, p.number));
}

template <class Method>
void StochasticProcess<Method>::initialise(std::span<const GivenParticle> population) {
  if (population.empty() || population.size() > options_.particles) {
    throw InputError(
        fmt::format("stochastic soot: {} particles, there is room for 1 to {}", population.size(), options_.particles));
  }
  for (const GivenParticle& p : population) {
    requireParticle(p, 0);
    if (!weighted && p.number != population[0].number)
      throw InputError("stochastic soot: particles of equal weight that stand for different numbers");
  }
  if constexpr (weighted) {
    std::vector<typename Method::Entry> entries;
    for (const GivenParticle& p : population)
      entries.push_back({type_.make(p.carbon, p.hydrogen, p.primaries), p.number});
    method_.replace(std::move(entries));
  } else {
    std::vector<Particle> particles;
    for (const GivenParticle& p : population) particles.push_back(type_.make(p.carbon, p.hydrogen, p.primaries));
    method_.replace(particles, population[0].number, random_);
  }
  exchange_ = {};
  births_.startAfresh();
  cost_ = 0;
}

template <class Method>
std::vector<GivenParticle> StochasticProcess<Method>::particles() const {
  std::vector<GivenParticle> all;
  all.reserve(size());
  method_.forEachParticle([&](const Particle& p, double w) { all.push_back({p.carbon, p.hydrogen, p.primaries, w}); });
  // Whatever order the store has.
  std::sort(all.begin(), all.end(), [](const GivenParticle& a, const GivenParticle& b) {
    return std::tuple(a.carbon + a.hydrogen, a.carbon, a.primaries, a.number) <
           std::tuple(b.carbon + b.hydrogen, b.carbon, b.primaries, b.number);
  });
  return all;
}

template <class Method>
void StochasticProcess<Method>::join(std::span<const GivenParticle> particles, double share) {
  if (particles.empty() || !(share > 0)) return;
  const Atoms before = atoms();
  Atoms mean;
  std::vector<WeightedParticle<Particle>> coming;
  coming.reserve(particles.size());
  for (const GivenParticle& p : particles) {
    const double number = share * p.number;
    coming.push_back({{p.carbon, p.hydrogen, p.primaries, 0}, number});
    mean.carbon += number * p.carbon;
    mean.hydrogen += number * p.hydrogen;
  }
  type_.findDiameters(coming.size(), [&](std::size_t k) -> Particle& { return coming[k].particle; });
  if constexpr (weighted)
    method_.join(coming, std::min(share, 1.0), random_);
  else
    method_.join(coming, random_);
  const Atoms after = atoms();
  exchange_.joinedCarbon += mean.carbon;
  exchange_.joinedHydrogen += mean.hydrogen;
  exchange_.resampledCarbon += after.carbon - before.carbon - mean.carbon;
  exchange_.resampledHydrogen += after.hydrogen - before.hydrogen - mean.hydrogen;
}

// Which layout of a packed state this is; another one is refused.
inline constexpr double packedVersion = 4;

template <class Method>
std::vector<double> StochasticProcess<Method>::pack() const {
  std::vector<double> state;
  state.reserve(packedHead + packedParticle * size());
  packDoubles(state,
              std::array{packedVersion, static_cast<double>(options_.method), static_cast<double>(options_.particles)});
  packDoubles(state, packedOwner(random_.owner()));
  state.push_back(static_cast<double>(random_.position()));
  packDoubles(state, births_.memory());
  state.push_back(cost_);
  packDoubles(state, exchange_);
  for (const PopulationCounter& counter : populationCounters)
    state.push_back(static_cast<double>(counters().*counter.value));  // below 2^53
  packDoubles(state, method_.memory());
  double* row = addRow(state, packedParticle * size()).data();
  method_.forEachParticle([&](const Particle& p, double w) {
    for (const double value : {p.carbon, p.hydrogen, p.primaries, w}) *row++ = value;
  });
  return state;
}

template <class Method>
void StochasticProcess<Method>::unpack(std::span<const double> values) {
  PackedDoubles state(values);
  if (state.next() != packedVersion || state.next() != static_cast<double>(options_.method) ||
      state.next() != static_cast<double>(options_.particles))
    throw InputError("stochastic soot: the saved state is of a population with another method or number of particles");
  random_ = RandomStream(options_.seed, ownerOf(state.next<PackedOwner>()), ensembleStream);
  random_.seek(static_cast<std::uint64_t>(state.next()));
  births_.restore(state.next<EvenBirths::Memory>());
  cost_ = state.next();
  exchange_ = state.next<EnsembleExchange>();
  for (const PopulationCounter& counter : populationCounters)
    method_.counters().*counter.value = static_cast<std::uint64_t>(state.next());
  const auto memory = state.next<std::array<double, 2>>();
  std::vector<PackedEntry> entries;
  entries.reserve(state.left() / packedParticle);
  while (state.left() > 0) {
    const auto p = state.next<GivenParticle>();
    requireParticle(p, -0.5 * p.carbon);
    if (!weighted && p.number != memory[0])
      throw InputError("stochastic soot: the saved state is damaged: particles of equal weight differ in it");
    const Particle particle{p.carbon, p.hydrogen, p.primaries, 0};
    if constexpr (weighted)
      entries.push_back({particle, p.number});
    else
      entries.push_back(particle);
  }
  type_.findDiameters(entries.size(), [&](std::size_t k) -> Particle& {
    if constexpr (weighted)
      return entries[k].particle;
    else
      return entries[k];
  });
  method_.restore(memory, std::move(entries));
}

template <class Method>
Ensemble::Totals StochasticProcess<Method>::totals() const {
  Totals t;
  method_.forEachParticle([&](const Particle& p, double w) {
    addTo(t, {p.carbon, p.hydrogen, p.primaries, w}, type_.coalescing() ? p.diameter : type_.primaryDiameter(p));
  });
  return t;
}

template <class Method>
double StochasticProcess<Method>::moment(double order) const {
  double sum = 0;
  const auto add = [&](auto power) {
    method_.forEachParticle([&](const Particle& p, double w) { sum += w * power(type_.volume(p)); });
  };
  if (order == 2)
    add([](double v) { return v * v; });
  else if (order == 3)
    add([](double v) { return v * v * v; });
  else
    add([order](double v) { return std::pow(v, order); });
  return sum;
}

template <class Method>
template <class F>
void StochasticProcess<Method>::forEachLogDiameter(F f) const {
  constexpr std::size_t atATime = 128;
  double diameter[atATime], weight[atATime];
  std::size_t n = 0;
  const auto flush = [&] {
    numerics::vectormath::log(diameter, diameter, n);
    f(diameter, weight, n);
    n = 0;
  };
  method_.forEachParticle([&](const Particle& p, double w) {
    diameter[n] = type_.coalescing() ? p.diameter : type_.mobilityDiameter(p);
    weight[n] = w;
    if (++n == atATime) flush();
  });
  if (n > 0) flush();
}

template <class Method>
double StochasticProcess<Method>::geometricDeviation() const {
  WeightedDeviation deviation;
  forEachLogDiameter(
      [&](const double* logs, const double* weights, std::size_t n) { deviation.add(logs, weights, n); });
  return deviation.geometric();
}

}  // namespace lampblack::particles
