#include "particles/soot/soot_medium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/errors.hpp"
#include "particles/collisions/sphere.hpp"
#include "particles/population/model/collision_kernel.hpp"

namespace lampblack::particles {

void SootTransfer::add(double weight, const SootTransfer& other) {
  for (const auto part :
       {&SootTransfer::dimers, &SootTransfer::growth, &SootTransfer::oxidationO2, &SootTransfer::oxidationOH,
        &SootTransfer::hydrogenO2, &SootTransfer::hydrogenOH, &SootTransfer::lost})
    this->*part += weight * other.*part;
}

SootMedium::SootMedium(const SootModelOptions& options, const DimerModel& dimers, const ParticleGas& gas,
                       bool keepsHydrogen)
    : options_(options),
      surface_(options, gas.temperature),
      gas_(gas),
      inertia_(options.heavyParticles ? 0 : 1),
      leastCarbon_(dimers.smallestNucleus() * options.carbonWeight / constants::avogadro * (1 - 1e-9)) {
  using S = SootSpecies;
  if (gas.concentrations.size() != S::fixed + dimers.size())
    throw std::invalid_argument("soot: the gas has other species than the model");
  requirePhysical(gas, "stochastic soot");
  SootSpeciesArray c{};
  for (std::size_t k = 0; k < gas.concentrations.size(); ++k) c[k] = std::max(gas.concentrations[k], 0.0);
  freeMolecular_ = freeMolecularPrefactor(gas.temperature, options.vanDerWaals);
  if (dimers.consumes() && options.inceptionBy == InceptionBy::dimers)
    takeDimers(dimers, {&c[S::fixed], dimers.size()});
  if (dimers.consumes() && options.inceptionBy == InceptionBy::monomers) takeMonomers(dimers, c[S::fixed]);
  if (dimerCarbon_ > 0) {
    if (!keepsHydrogen) freedHydrogen_ = std::exchange(dimerHydrogen_, 0.0);
    selfCollision_ = options.inception ? dimer_.selfCollision : 0;
    condensing_ = options.condensation;
  }
  const SurfaceRates most = surface_.rates(c, 1.0);
  growth_ = 2 * most.growth * c[S::C2H2] * options.carbonWeight;
  O2_ = 2 * most.oxidationO2 * c[S::O2] * options.carbonWeight;
  OH_ = most.oxidationOH * c[S::OH] * options.carbonWeight;
  surfaceActive_ = growth_ > 0 || O2_ > 0 || OH_ > 0;
}

void SootMedium::takeDimers(const DimerModel& dimers, std::span<const double> concentrations) {
  const std::size_t n = dimers.size();
  PahArray consumption{};
  dimers.lossRates(gas_.temperature, concentrations, consumption);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += consumption[i] *= concentrations[i];
  dimer_ = dimers.production(gas_.temperature, {consumption.data(), n});
  if (!(dimer_.rate > 0)) return;
  breaking_ = dimers.breaking(gas_.temperature, dimer_.rate, concentrations);
  for (std::size_t i = 0; i < n; ++i) pahOfDimer_[i] = 2 * consumption[i] / sum;
  // By the PAH that are taken, so that atoms are counted to round-off.
  for (std::size_t i = 0; i < n; ++i) {
    dimerCarbon_ += pahOfDimer_[i] * dimers.carbonAtoms(i) * options_.carbonWeight / constants::avogadro;
    dimerHydrogen_ += pahOfDimer_[i] * dimers.hydrogenAtoms(i) * options_.hydrogenWeight / constants::avogadro;
  }
}

void SootMedium::takeMonomers(const DimerModel& dimers, double concentration) {
  if (dimers.size() != 1) throw std::invalid_argument("soot: nuclei of monomers need one PAH");
  if (!(concentration > 0)) return;
  monomers_ = constants::avogadro * concentration;
  pahOfDimer_[0] = 1;
  dimerCarbon_ = dimers.carbonAtoms(0) * options_.carbonWeight / constants::avogadro;
  dimerHydrogen_ = dimers.hydrogenAtoms(0) * options_.hydrogenWeight / constants::avogadro;
  dimer_.carbon = dimers.carbonAtoms(0);
  dimer_.hydrogen = dimers.hydrogenAtoms(0);
  dimer_.mass = options_.monomerMass > 0 ? options_.monomerMass : dimerCarbon_ + dimerHydrogen_;
  dimer_.diameter =
      options_.monomerDiameter > 0 ? options_.monomerDiameter : sphereDiameter(dimer_.mass / options_.sootDensity);
  CollisionKernelOptions kernel{.type = CollisionKernelType::transition};
  kernel.gas = gas_;
  kernel.enhancement = options_.vanDerWaals;
  kernel.slip = options_.slip;
  const CollisionKernel::Properties one{dimer_.mass / options_.sootDensity, dimer_.mass, dimer_.diameter};
  dimer_.selfCollision = CollisionKernel(kernel).value(one, one);
}

double SootMedium::dimers(double collisions) const {
  if (ofMonomers()) return monomers_;
  const double withParticles = condensing_ ? std::max(collisions, 0.0) : 0;
  if (!(selfCollision_ + withParticles > 0)) return 0;
  return steadyDimers(dimer_.rate, selfCollision_, withParticles + breaking_);
}

SootFluxes SootMedium::fluxes() const {
  SootFluxes result;
  result.growth = growth_;
  result.O2 = O2_;
  result.OH = OH_;
  return result;
}

bool SootMedium::grow(const SootAggregate& type, const SootFluxes& fluxes, double dt, SootAggregate::Particle& p,
                      SootTransfer& moved) const {
  const SootGrowth law = growth(fluxes);
  const double before = p.carbon;
  double rest = dt;
  while (rest > 0) {
    const double mass = SootAggregate::mass(p);
    const GrowingShape shape = growingShape(law, type, mass, p.primaries, rest);
    const SootGrowth::Step s = law.step(p.carbon, p.hydrogen, shape.primaries, shape.factor, shape.diameter, rest);
    if (type.shape() == SootShape::surfaceVolume)
      p.primaries = primariesAfter(p.primaries, mass, law.gained(s), law.lost(s));
    p.carbon = s.carbon;
    p.hydrogen = s.hydrogen;
    moved.dimers += s.dimers;
    moved.growth += s.growth;
    moved.oxidationO2 += s.oxidationO2;
    moved.oxidationOH += s.oxidationOH;
    moved.hydrogenO2 += s.hydrogenO2;
    moved.hydrogenOH += s.hydrogenOH;
    rest = s.length < rest ? rest - s.length : 0;
    if (p.carbon < before && p.carbon < leastCarbon_) {
      const double share = law.shareO2();
      moved.oxidationO2 += share * p.carbon;
      moved.oxidationOH += (1 - share) * p.carbon;
      moved.hydrogenO2 += share * p.hydrogen;
      moved.hydrogenOH += (1 - share) * p.hydrogen;
      moved.lost += 1;
      return false;
    }
  }
  p.diameter = type.shapeFactor(p.primaries) * type.primaryDiameter(p);
  return true;
}

}  // namespace lampblack::particles
