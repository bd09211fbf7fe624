#include "particles/spheres/sphere_population.hpp"

#include <algorithm>
#include <vector>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/population/engine/coagulating_sample.hpp"
#include "particles/population/engine/event_loop.hpp"
#include "particles/population/engine/jumps.hpp"
#include "particles/population/engine/split_step.hpp"
#include "particles/spheres/sphere_geometry.hpp"
#include "particles/spheres/sphere_growth.hpp"

namespace lampblack::particles {
namespace {

constexpr std::uint32_t sphereStream = 0x53504852;  // which random numbers of an owner

const SpherePopulationOptions& checked(const SpherePopulationOptions& options) {
  if (options.particles < 8) throw InputError("aggregates: at least 8 numerical particles are needed");
  if (!(options.density > 0)) throw InputError("aggregates: the density has to be positive");
  if (!(options.splitTolerance > 0) || !(options.splitTolerance <= 1) || !(options.fullAt > 0))
    throw InputError(
        "aggregates: the split tolerance needs to be in (0, 1], the number density of a full sample positive");
  if (!(options.fractalDimension >= 1) || !(options.fractalDimension <= 3))
    throw InputError("aggregates: the fractal dimension needs to be in [1, 3]");
  return options;
}

}  // namespace

SpherePopulation::SpherePopulation(const SpherePopulationOptions& options)
    : options_(checked(options)),
      type_(options.density, options.size, options.fractalDimension),
      random_(options.seed, options.owner, sphereStream),
      method_(type_, modelOfSample(options), InitialPopulation{}, monteCarloOfSample(options), random_),
      sintering_(options.sintering, options.sinteringTolerance) {}

void SpherePopulation::fill(std::span<const double> radii, double number) {
  std::vector<SphereParticle> particles;
  for (const double radius : radii) particles.push_back(type_.made(SphereAggregate(radius)));
  method_.replace(particles, number / static_cast<double>(particles.size()), random_);
  births_.startAfresh();
}

void SpherePopulation::Events::giveBirth() {
  of.method_.nucleate(of.random_);
  of.births_.bear(weight, of.method_.weight(), of.random_);
}

// By the share of particles that collide or are born in a step, and the part of the smallest radius that grows.
double SpherePopulation::stepLength(const SphereSources& sources, double remaining) const {
  double rate = 0;
  if (size() > 0) {
    const double n = static_cast<double>(size());
    if (options_.coagulation) rate = method_.coagulationRate() / n;
    if (sources.growth > 0) {
      double smallest = HUGE_VAL;
      forEach([&](const SphereParticle& p) {
        for (const AggregateSphere& s : p.aggregate->spheres()) smallest = std::min(smallest, s.radius);
      });
      rate = std::max(rate, sources.growth / smallest);
    }
  }
  // So many births as a sample has particles, or as it has room for.
  const double most = method_.weight() * static_cast<double>(options_.particles);
  rate = std::max(rate, sources.births / most);
  return rate > 0 ? std::min(remaining, options_.splitTolerance / rate) : remaining;
}

void SpherePopulation::advance(const CarrierGas& gas, const SphereSources& sources, double dt) {
  if (!(dt > 0)) return;
  if (!(sources.births >= 0) || !(sources.growth >= 0) || (sources.births > 0 && !(sources.nucleus > 0)))
    throw InputError("aggregates: births and growth may not be negative, and what is born needs a volume");
  if (options_.coagulation) {
    CollisionKernelOptions kernel = options_.kernel;
    kernel.gas = gas;
    method_.setKernel(kernel);
  }
  if (size() == 0) {
    method_.startAfresh(options_.fullAt / static_cast<double>(options_.particles));
    births_.startAfresh();
  }
  if (sources.births > 0) method_.setNucleus(type_.make(sources.nucleus));
  births_.setRate(sources.births);
  inSteps(
      dt, [&](double remaining) { return stepLength(sources, remaining); },
      [&](double step) {
        splitStep(
            step, [&](double time) { jump(time); },
            [&](double time) { change(gas.temperature, sources.growth, time); });
      });
}

void SpherePopulation::jump(double dt) {
  births_.plan(method_.weight(), random_);
  Events events{*this};
  runEvents(time_, time_ + dt, random_, births_, events, CoagulationJumps<Method>{method_, options_.coagulation});
}

void SpherePopulation::change(double temperature, double growth, double dt) {
  if (size() == 0 || !(growth > 0 || options_.sintering.active())) return;
  method_.changeParticles([&](SphereParticle& p, double) {
    if (p.aggregate->count() == 1 && !(growth > 0)) return true;
    SphereAggregate aggregate = *p.aggregate;
    const std::size_t before = aggregate.count();
    growEverywhere(aggregate, 0.5 * dt * growth);
    sintering_.advance(aggregate, temperature, dt);
    growEverywhere(aggregate, 0.5 * dt * growth);
    merged_ += before - aggregate.count();
    p = type_.made(std::move(aggregate));
    return true;
  });
}

}  // namespace lampblack::particles
