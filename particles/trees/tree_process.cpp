#include "particles/trees/tree_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "particles/ensemble/newborn_step.hpp"
#include "particles/gas/soot_gas.hpp"

namespace lampblack::particles {

TreeProcess::TreeProcess(const TreeOptions& options, const PopulationModel& model, const MonteCarloOptions& monteCarlo)
    : options_(options),
      type_(options.material, options.size),
      random_(options.seed, options.owner, treeStream),
      method_(type_, model, InitialPopulation{}, monteCarlo, random_),
      sintering_(type_, options.sinteringTolerance),
      growth_(type_) {
  method_.setNucleus(type_.make(options_.material.nucleus));
  type_.settleBy([this](Tree& tree, double time) {
    TreeSintering::Changes changes;
    sintering_.advance(tree, time, changes);
    record(changes);
  });
}

void TreeProcess::record(const TreeSintering::Changes& changes) {
  const TreeMaterial& m = options_.material;
  const double weight = method_.weight();
  exchange_.product += weight * changes.bridges / constants::avogadro;
  exchange_.sinteredPairs += weight * changes.bridges;
  exchange_.units[m.site] -= 2 * weight * changes.bridges;
  exchange_.units[m.bridge] += weight * changes.bridges;
  counters_.fused += changes.fused;
  counters_.withoutSites += changes.limited;
}

void TreeProcess::fill(const TreeUnits& units, double number) {
  for (const double amount : units)
    if (!(amount >= 0))
      throw InputError("particles: an initial particle may not have less than nothing of a component");
  if (!(options_.material.volume(units) > 0) || !(number > 0))
    throw InputError("particles: an initial particle needs mass and a number");
  const Tree one = type_.make(units);
  const std::vector<Tree> all(options_.particles, one);
  method_.replace(all, number / static_cast<double>(options_.particles), random_);
  exchange_ = {};
}

TreeProcess::Sums TreeProcess::sums() const {
  Sums s;
  const std::size_t site = options_.material.site;
  method_.forEachParticle([&](const Tree& p, double) {
    const TreeHead& tree = p.head();
    s.volume += tree.volume;
    s.sites += tree.units[site];
    s.diameters += tree.collision;
    s.sintering += tree.sintering;
    s.surface += tree.surface;
    s.primaries += tree.count;
  });
  const double weight = method_.weight();
  s.number = weight * static_cast<double>(size());
  for (double* sum : {&s.volume, &s.sites, &s.diameters, &s.sintering, &s.surface}) *sum *= weight;
  return s;
}

// The step over which neither growth changes the volume, nor coagulation the number, by more than the tolerance; and
// those born in it hardly do either.
double TreeProcess::step(const Sums& s, double remaining) const {
  const TreeMaterial& m = options_.material;
  double fastest = 0;
  if (s.number > 0) {
    fastest = growthRate_ * s.sites * m.growthVolume() / s.volume;
    if (kernel_ && options_.coagulation) {
      const double v = s.volume / s.number;
      const CollisionKernel::Properties mean{v, v * m.density, s.diameters / s.number};
      fastest = std::max(fastest, 0.5 * kernel_->value(mean, mean) * s.number);
    }
  }
  double longest = std::numeric_limits<double>::infinity();
  if (inception_ > 0) {
    const double v = m.volume(m.nucleus);
    const CollisionKernel::Properties one{v, v * m.density, treeDiameter(v)};
    longest = newbornStep(options_.splitTolerance, inception_, s.number,
                          growthRate_ * m.nucleus[m.site] * m.growthVolume() / v,
                          options_.coagulation ? kernel_->value(one, one) : 0);
  }
  return std::min({remaining, fastest > 0 ? options_.splitTolerance / fastest : remaining, longest});
}

void TreeProcess::advance(const ParticleGas& gas, double dt) {
  if (!(dt > 0)) return;
  const TreeMaterial& m = options_.material;
  requirePhysical(gas, "particles");
  CollisionKernelOptions kernel = options_.kernel;
  kernel.gas = gas;
  const bool isNew = !kernel_ || kernel_->options().gas.temperature != gas.temperature ||
                     kernel_->options().gas.pressure != gas.pressure ||
                     std::abs(kernel_->options().gas.viscosity / gas.viscosity - 1) > 1e-12;
  if (isNew) {
    kernel_.emplace(kernel);
    if (options_.coagulation) method_.setKernel(kernel);
  }
  sintering_.setTemperature(gas.temperature);
  const double precursor = std::max(gas.concentrations[0], 0.0), molecules = precursor * constants::avogadro;
  growthRate_ = m.growthRate(gas.temperature, precursor);
  const CollisionKernel::Properties molecule{m.moleculeMass / m.density, m.moleculeMass, m.moleculeDiameter};
  inception_ = 0.5 * kernel_->value(molecule, molecule) * molecules * molecules;
  growth_.setRate(growthRate_);
  if (size() == 0)
    method_.startAfresh(std::max(options_.fullAt, 2 * inception_ * dt) / static_cast<double>(options_.particles));
  double remaining = dt;
  cost_ = 0;
  while (remaining > 0) {
    const Sums s = sums();
    cost_ += s.primaries;
    const double length = step(s, remaining);
    jump(0.5 * length);
    change(length);
    jump(0.5 * length);
    ++counters_.splitSteps;
    remaining = length < remaining ? remaining - length : 0;
  }
  if (random_.position() >> 33U != 0) throw NumericsError("particles: the random stream is used up");
}

void TreeProcess::jump(double dt) {
  const TreeMaterial& m = options_.material;
  const double start = type_.clock();
  type_.lookAt(start + dt);
  double time = 0;
  while (true) {
    const double coagulation = options_.coagulation ? method_.coagulationRate() : 0;
    const double weight = method_.nucleusWeight(), inception = inception_ / weight;
    const double total = coagulation + inception;
    if (!(total > 0)) break;
    time += random_.exponential(total);
    if (time > dt) break;
    ++cost_;
    type_.clock() = start + time;
    if (inception > 0 && random_.uniform() * total < inception) {
      method_.nucleate(random_);
      ++counters_.inceptions;
      exchange_.inceptions += weight;
      exchange_.precursor -= m.nucleusPrecursors * weight / constants::avogadro;
      exchange_.product += m.nucleusProducts * weight / constants::avogadro;
      for (std::size_t c = 0; c < mostTreeComponents; ++c) exchange_.units[c] += weight * m.nucleus[c];
    } else if (method_.coagulate(random_)) {
      exchange_.coagulations += weight;
    } else {
      ++counters_.fictitious;
    }
  }
  type_.clock() = start + dt;
}

void TreeProcess::change(double dt) {
  if (size() == 0) return;
  const TreeMaterial& m = options_.material;
  TreeSintering::Changes sintered;
  TreeGrowth::Changes grown;
  method_.changeParticles([&](Tree& tree, double) {
    sintering_.advanceLazily(tree, sintered);
    if (growthRate_ > 0 && growth_.advance(tree, dt, random_, grown)) sintering_.advanceLazily(tree, sintered);
    return true;
  });
  record(sintered);
  const double weight = method_.weight();
  exchange_.reactions += weight * grown.reactions;
  exchange_.condensations += weight * grown.bridges;
  exchange_.precursor -= weight * grown.reactions / constants::avogadro;
  exchange_.product += weight * (m.growthProducts * grown.reactions + grown.bridges) / constants::avogadro;
  for (std::size_t c = 0; c < mostTreeComponents; ++c) exchange_.units[c] += weight * grown.reactions * m.growth[c];
  exchange_.units[m.site] -= 2 * weight * grown.bridges;
  exchange_.units[m.bridge] += weight * grown.bridges;
  counters_.limited += grown.limited;
}

void TreeProcess::settle() {
  if (size() == 0) return;
  TreeSintering::Changes changes;
  method_.changeParticles([&](Tree& tree, double) {
    if (tree.count() > 1 && tree.head().time < type_.clock()) sintering_.advance(tree, type_.clock(), changes);
    return true;
  });
  record(changes);
}

std::unique_ptr<TreePopulation> makeTreePopulation(const TreeOptions& options) {
  requireMaterial(options.material);
  if (options.particles < 8) throw InputError("particles: at least 8 numerical particles are needed");
  if (!(options.splitTolerance > 0) || !(options.splitTolerance <= 1) || !(options.fullAt > 0))
    throw InputError(
        "particles: the split tolerance needs to be in (0, 1], the number density of a full sample positive");
  if (!(options.sinteringTolerance >= 0) || !(options.sinteringTolerance <= 0.1))
    throw InputError("particles: the tolerance of sintering needs to be in [0, 0.1]");
  PopulationModel model;
  if (options.coagulation) {
    model.coagulation = options.kernel;  // of some gas, until there is the right one
    model.coagulation->gas = {1500, constants::oneAtmosphere, 0.2, 5e-5, 0.028};
  }
  MonteCarloOptions monteCarlo;
  monteCarlo.method = MonteCarloMethod::dsmc;
  monteCarlo.particles = options.particles;
  monteCarlo.expectedNumber = options.fullAt;
  return std::make_unique<TreeProcess>(options, model, monteCarlo);
}

}  // namespace lampblack::particles
