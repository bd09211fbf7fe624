#include "particles/molecules/molecule_population.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/poisson.hpp"
#include "particles/population/engine/coagulating_sample.hpp"
#include "particles/population/engine/event_loop.hpp"
#include "particles/population/engine/jumps.hpp"
#include "particles/population/engine/split_step.hpp"

namespace lampblack::particles {
namespace {

const MoleculeOptions& checkedMolecules(const MoleculeOptions& options) {
  requireMolecules(options);
  return options;
}

}  // namespace

MoleculePopulation::MoleculePopulation(const MoleculeOptions& options)
    : options_(checkedMolecules(options)),
      type_(options.material(), options.sticking, options.spheres),
      ofGas_(std::make_shared<const Molecule>(options.rings)),
      carbonOfGas_(static_cast<double>(ofGas_->carbon())),
      hydrogenOfGas_(static_cast<double>(ofGas_->hydrogen())),
      random_(options.seed, options.owner, moleculeStream),
      method_(type_, modelOfSample(options), InitialPopulation{}, monteCarloOfSample(options), random_),
      formation_(options_.formation),
      sintering_(type_.trees(), options.sinteringTolerance),
      single_(ofGas(1)) {
  sintering_.tell(&fusions_);
  one_ = properties(*single_);
  if (options.atStart > 0) fill(std::vector<MoleculeParticle>(options.particles, *single_), options.atStart);
}

void MoleculePopulation::fill(const std::vector<MoleculeParticle>& particles, double number) {
  method_.replace(particles, number / static_cast<double>(particles.size()), random_);
  births_.startAfresh();
  exchange_ = {};
}

void MoleculePopulation::setGas(const ParticleGas& gas) {
  requirePhysical(gas, "particles");
  CollisionKernelOptions kernel = options_.kernel;
  kernel.gas = gas;
  kernel_.emplace(kernel);
  if (options_.coagulation) method_.setKernel(kernel);
  outside_ = pahRates(options_.rates, gas.temperature, gas.concentrations);
  byOH_ = oxidationByOH(options_.rates, gas.temperature, gas.concentrations);
  for (std::size_t p = 0; p < pahProcessCount; ++p) {
    if (!options_.active[p]) outside_[p] = 0;
    inside_[p] = options_.growthFactor * outside_[p];
  }
  type_.setTemperature(gas.temperature);
  gasNumber_ = std::max(gas.concentrations[MoleculeOptions::precursorAt], 0.0) * constants::avogadro;
  sintering_.setTemperature(gas.temperature);
}

double MoleculePopulation::condensation(const MoleculeParticle& p) const {
  const double sticks = options_.condensationEfficiency * type_.sticking(p, *single_);
  return sticks > 0 ? sticks * gasNumber_ * kernel_->value(properties(p), one_) : 0;
}

double MoleculePopulation::inception(double dt) const {
  if (options_.inception == MoleculeOptions::Inception::byFormation) {
    const double now = type_.trees().clock();
    return (formation_.cumulative(now + dt) - formation_.cumulative(now)) / dt;
  }
  if (!isPairs()) return 0;
  const double sticks = options_.inceptionEfficiency * type_.sticking(*single_, *single_);
  return 0.5 * sticks * gasNumber_ * gasNumber_ * kernel_->value(one_, one_);
}

// By the share of particles that collide, and of the carbon of all that comes, goes and reacts in a step.
double MoleculePopulation::stepLength(double remaining) const {
  double rate = 0;
  const bool pairs = isPairs();
  if (size() > 0) {
    double carbon = 0, moved = 0;
    forEach([&](const MoleculeParticle& p, double) {
      carbon += p.carbon();
      if (pairs) moved += carbonOfGas_ * condensation(p);
      for (const MoleculesOfPrimary& primary : *p.inside) {
        const PahRates& rates = ratesIn(primary);
        for (const HeldMolecule& m : primary)
          for (std::size_t k = 0; k < pahProcessCount; ++k)
            moved += std::abs(pahProcesses[k].carbon) * rates[k] * static_cast<double>(m->count(pahProcesses[k].site));
      }
    });
    rate = moved / carbon;
    if (options_.coagulation) rate = std::max(rate, method_.coagulationRate() / static_cast<double>(size()));
  }
  // So many births as a sample has room for.
  rate = std::max(rate, inception(remaining) / (method_.weight() * static_cast<double>(options_.particles)));
  return rate > 0 ? std::min(remaining, options_.splitTolerance / rate) : remaining;
}

void MoleculePopulation::advance(const ParticleGas& gas, double dt) {
  if (!(dt > 0)) return;
  setGas(gas);
  if (size() == 0) {
    method_.startAfresh(options_.fullAt / static_cast<double>(options_.particles));
    births_.startAfresh();
  }
  method_.setNucleus(isPairs() ? ofGas(2) : *single_);
  cost_ = 0;
  const PopulationCounters before = counters();
  followGas();
  const auto length = [&](double remaining) {
    cost_ += static_cast<double>(size());
    return stepLength(remaining);
  };
  inSteps(dt, length, [&](double step) {
    splitStep(
        step, [&](double time) { jump(time); }, [&](double time) { change(time); });
    followGas();
    ++method_.counters().splitSteps;
  });
  const PopulationCounters& now = counters();
  cost_ += static_cast<double>(now.events() + now.fictitious - before.events() - before.fictitious);
}

void MoleculePopulation::recordMolecules(double number, double sign) {
  exchange_.gas[MoleculeOptions::precursorAt] -= sign * number / constants::avogadro;
  exchange_.carbon += sign * number * carbonOfGas_;
  exchange_.hydrogen += sign * number * hydrogenOfGas_;
}

void MoleculePopulation::Events::giveBirth() {
  of.method_.nucleate(of.random_);
  of.births_.bear(weight, of.method_.weight(), of.random_);
  of.exchange_.inceptions += weight;
  of.recordMolecules((of.isPairs() ? 2 : 1) * weight, 1);
}

void MoleculePopulation::jump(double dt) {
  births_.setRate(inception(dt));
  births_.plan(method_.weight(), random_);
  double time = type_.trees().clock();
  const double end = time + dt;
  Events events{*this};
  runEvents(time, end, random_, births_, events, CoagulationJumps<Method>{method_, options_.coagulation});
  type_.trees().clock() = end;
}

void MoleculePopulation::condense(MoleculeParticle& p, double dt) {
  const double times = poisson(random_, dt * condensation(p));
  if (!(times > 0)) return;
  MoleculesOfParticle inside = *p.inside;
  const auto primaries = p.tree.primaries();
  for (double k = 0; k < times; ++k) {
    // On a primary by its surface.
    std::size_t i = 0;
    if (primaries.size() > 1)
      for (double at = random_.uniform() * p.tree.head().surfaces; i + 1 < primaries.size(); ++i)
        if ((at -= primarySurface(primaries[i].diameter)) < 0) break;
    inside[i].push_back(ofGas_);
  }
  condensed_ += times;
  type_.set(p, std::move(inside));
}

// Where nothing happens, nothing is touched.
void MoleculePopulation::grow(MoleculeParticle& p, double dt) {
  std::optional<MoleculesOfParticle> changed;
  for (std::size_t i = 0; i < p.inside->size(); ++i) {
    const MoleculesOfPrimary& primary = (*p.inside)[i];
    const PahRates& rates = ratesIn(primary);
    for (std::size_t k = 0; k < primary.size(); ++k) {
      double total = totalRate(*primary[k], rates);
      if (!(total > 0)) continue;
      double left = dt - random_.exponential(total);
      if (!(left > 0)) continue;
      Molecule molecule = *primary[k];
      do {
        particles::jump(molecule, rates, random_, events_);
        total = totalRate(molecule, rates);
        if (!(total > 0)) break;
        left -= random_.exponential(total);
      } while (left > 0);
      if (!changed) changed = *p.inside;
      (*changed)[i][k] = std::make_shared<const Molecule>(std::move(molecule));
    }
  }
  if (changed) type_.set(p, std::move(*changed));
}

void MoleculePopulation::sinter(MoleculeParticle& p, double dt) {
  if (p.tree.count() == 1) return;
  fusions_.clear();
  p.tree.own().time = type_.trees().clock() - dt;  // the jumps before and behind are half of the step each
  TreeSintering::Changes changes;
  sintering_.advance(p.tree, type_.trees().clock(), changes);
  fused_ += changes.fused;
  type_.fuse(p, fusions_);
}

void MoleculePopulation::change(double dt) {
  if (size() == 0) return;
  events_ = {};
  condensed_ = 0;
  const bool condenses = isPairs();
  const double weight = method_.weight();
  method_.changeParticles([&](MoleculeParticle& p, double) {
    if (condenses)
      splitStep(
          dt, [&](double time) { condense(p, time); }, [&](double time) { grow(p, time); });
    else
      grow(p, dt);
    sinter(p, dt);
    return true;
  });
  exchange_.condensations += weight * condensed_;
  recordMolecules(weight * condensed_, 1);
  std::array<double, pahProcessCount> happened;
  for (std::size_t k = 0; k < pahProcessCount; ++k) {
    happened[k] = weight * static_cast<double>(events_.happened[k]);
    exchange_.events[k] += happened[k];
    exchange_.voids[k] += weight * static_cast<double>(events_.voids[k]);
    exchange_.carbon += happened[k] * pahProcesses[k].carbon;
    exchange_.hydrogen += happened[k] * pahProcesses[k].hydrogen;
  }
  std::array<double, SootSpecies::fixed + 1> gas{};
  addGasOfEvents(happened, byOH_, gas);
  for (std::size_t k = 0; k < gas.size(); ++k) exchange_.gas[k] += gas[k] / constants::avogadro;
}

// A sample that is full shrinks by what comes, and holds fewer of what the gas has: so in rounds.
void MoleculePopulation::followGas() {
  if (options_.inception != MoleculeOptions::Inception::asInGas) return;
  constexpr int rounds = 20;
  const double rest = random_.uniform();
  for (int round = 0; round < rounds; ++round) {
    double there = 0;
    forEach([&](const MoleculeParticle& p, double) { there += isOfGas(p) ? 1 : 0; });
    double missing = std::floor(gasNumber_ / method_.weight() - there + rest);
    if (missing == 0) return;
    if (missing > 0) {
      const double once = std::min(missing, static_cast<double>(options_.particles));
      for (double k = 0; k < once; ++k) {
        exchange_.came += method_.weight();
        recordMolecules(method_.weight(), 1);
        method_.nucleate(random_);
      }
      continue;
    }
    const double weight = method_.weight();
    exchange_.went -= missing * weight;
    recordMolecules(-missing * weight, -1);
    // Evenly among those that are there.
    method_.changeParticles([&](const MoleculeParticle& p, double) {
      if (!isOfGas(p)) return true;
      const bool goes = random_.uniform() * there-- < -missing;
      if (goes) ++missing;
      return !goes;
    });
    return;
  }
}

}  // namespace lampblack::particles
