#include "particles/models/moments/moment_chemistry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"

namespace lampblack::particles {

MomentChemistry::MomentChemistry(const SootModelOptions& options)
    : options_(options), dimers_(options), species_(sootSpecies(options)) {}

MomentGas MomentChemistry::read(const ParticleGas& gas) const {
  requirePhysical(gas, "soot");
  MomentGas read{gas, {}, {}, SurfaceChemistry(options_, gas.temperature), {}, 0};
  const std::size_t n = dimers_.size();
  for (std::size_t k = 0; k < SootSpecies::fixed + n; ++k)
    read.concentrations[k] = std::max(gas.concentrations[k], 0.0);
  const std::span<const double> pah{&read.concentrations[SootSpecies::fixed], n};
  dimers_.lossRates(gas.temperature, pah, read.consumption);
  for (std::size_t i = 0; i < n; ++i) read.consumption[i] *= pah[i];
  read.dimer = dimers_.production(gas.temperature, {read.consumption.data(), n});
  read.freeMolecular = freeMolecularPrefactor(gas.temperature, options_.vanDerWaals);
  return read;
}

DimerBalance MomentChemistry::dimerBalance(const MomentGas& gas, double withParticles) const {
  DimerBalance b;
  const double self = options_.inception ? gas.dimer.selfCollision : 0;
  const double condensing = options_.condensation ? withParticles : 0;
  if (!(gas.dimer.rate > 0) || !(self + condensing > 0)) return b;
  b.number = steadyDimers(gas.dimer.rate, self, condensing);
  b.nucleation = 0.5 * self * b.number * b.number;
  b.condensingShare = condensing / (condensing + self * b.number);
  for (std::size_t i = 0; i < dimers_.size(); ++i) {
    b.atoms.carbon += dimers_.carbonAtoms(i) * gas.consumption[i];
    b.atoms.hydrogen += dimers_.hydrogenAtoms(i) * gas.consumption[i];
  }
  return b;
}

SurfaceEvents MomentChemistry::events(const MomentGas& gas, double area, double meanCarbonAtoms) const {
  const SootSpeciesArray& c = gas.concentrations;
  const SurfaceRates rates = gas.surface.rates(c, gas.surface.alpha(std::max(meanCarbonAtoms, 2.0)));
  return {rates.growth * area * c[SootSpecies::C2H2], rates.oxidationO2 * area * c[SootSpecies::O2],
          rates.oxidationOH * area * c[SootSpecies::OH]};
}

void MomentChemistry::exchange(const MomentGas& gas, const DimerBalance& dimers, const SurfaceEvents& events,
                               double hydrogenLost, std::span<double> production) const {
  using S = SootSpecies;
  const double byO2 = events.oxidationO2, byOH = events.oxidationOH;
  production[S::H] = byOH;
  production[S::H2] = events.growth + 0.5 * hydrogenLost;
  production[S::OH] = -byOH;
  production[S::H2O] = 0;
  production[S::O2] = -byO2;
  production[S::C2H2] = -events.growth;
  production[S::CO] = 2 * byO2 + byOH;
  const bool consumes = dimers.number > 0;
  for (std::size_t i = 0; i < dimers_.size(); ++i) {
    production[S::fixed + i] = consumes ? -gas.consumption[i] : 0;
  }
}

ParticleProcesses MomentChemistry::processes(const SootModelOptions& options, const MomentGas& gas,
                                             const DimerBalance& dimers, const SurfaceEvents& events,
                                             double hydrogenToCarbon) {
  ParticleProcesses p;
  const double fromGas = dimers.atoms.carbon * options.carbonWeight + dimers.atoms.hydrogen * options.hydrogenWeight;
  const double perCarbon = options.carbonWeight + hydrogenToCarbon * options.hydrogenWeight;
  p.nucleationNumber = dimers.nucleation;
  p.nucleation = (1 - dimers.condensingShare) * fromGas;
  p.condensation = dimers.condensingShare * fromGas;
  p.growth = 2 * events.growth * options.carbonWeight;
  p.oxidationO2 = -2 * events.oxidationO2 * perCarbon;
  p.oxidationOH = -events.oxidationOH * perCarbon;
  p.dimerNumber = dimers.number;
  p.dimerProduction = gas.dimer.rate;
  return p;
}

}  // namespace lampblack::particles
