#include "particles/models/two_equation/two_equation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "particles/collisions/sphere.hpp"
#include "particles/models/two_equation/two_equation_state.hpp"

namespace lampblack::particles {

TwoEquationSoot::TwoEquationSoot(SootModelOptions options) : options_(std::move(options)), dimers_(options_) {
  nucleusCarbon_ = dimers_.smallestNucleus() / constants::avogadro;
  nucleusDiameter_ = sphereDiameter(nucleusCarbon_ * options_.carbonWeight / options_.sootDensity);
}

double TwoEquationSoot::meanDiameter(const Population& population) const {
  if (!(population.number > 0) || !(population.mass() > 0)) return 0;
  return sphereDiameter(population.mass() / (options_.sootDensity * population.number));
}

double TwoEquationSoot::surfaceArea(const Population& population) const {
  const double d = meanDiameter(population);
  return constants::pi * d * d * std::max(population.number, 0.0);
}

double TwoEquationSoot::diffusivity(const CarrierGas& gas, const Population& population) const {
  return brownianDiffusivity(gas, std::max(meanDiameter(population), nucleusDiameter_));
}

TwoEquationSoot::Frozen TwoEquationSoot::freeze(const CarrierGas& gas) const {
  requirePhysical(gas, "soot");
  return {SurfaceChemistry(options_, gas.temperature), gas.temperature,
          freeMolecularPrefactor(gas.temperature, options_.vanDerWaals),
          continuumPrefactor(gas.temperature, gas.viscosity), 2 * meanFreePath(gas)};
}

TwoEquationSoot::Rates TwoEquationSoot::rates(const Frozen& frozen, const State& state) const {
  Rates r;
  dimers_.lossRates(frozen.temperature, state.pah(dimers_.size()), r.pahLoss);
  r.number = state.number;
  r.carbon = state.carbon;
  const double mass = state.carbon * options_.carbonWeight + state.hydrogen * options_.hydrogenWeight;
  if (!(state.number > 0) || !(mass > 0)) return r;
  r.particleMass = mass / state.number;
  r.diameter = sphereDiameter(r.particleMass / options_.sootDensity);
  const double d = r.diameter, area = constants::pi * d * d * state.number;
  const double meanCarbon = std::max(state.carbon / state.number, nucleusCarbon_) * constants::avogadro;
  const SurfaceRates surface = frozen.surface.rates(state.gas, frozen.surface.alpha(std::max(meanCarbon, 2.0)));
  r.growth = surface.growth * area;
  r.oxidationO2 = surface.oxidationO2 * area;
  r.oxidationOH = surface.oxidationOH * area;
  if (options_.coagulation) {
    const double slip = slipCorrection(frozen.twiceMeanFreePath / d);
    const double fm = freeMolecularKernel(frozen.freeMolecular, r.particleMass, d, r.particleMass, d);
    r.coagulation = 0.5 * harmonicMean(fm, 4 * frozen.continuum * slip);
  }
  return r;
}

TwoEquationSoot::Sources TwoEquationSoot::sources(const ParticleGas& gas, const Population& population) const {
  using S = SootSpecies;
  const std::size_t n = dimers_.size();
  if (gas.concentrations.size() != S::fixed + n)
    throw std::invalid_argument("soot: the gas has other species than the model");
  const Frozen frozen = freeze(gas);
  State state;
  state.number = std::max(population.number, 0.0);
  state.carbon = std::max(population.carbon, 0.0) / options_.carbonWeight;
  state.hydrogen = std::max(population.hydrogen, 0.0) / options_.hydrogenWeight;
  for (std::size_t k = 0; k < S::fixed + n; ++k) state.gas[k] = std::max(gas.concentrations[k], 0.0);
  const std::span<const double> pah = state.pah(n);
  const Rates r = rates(frozen, state);

  Sources s;
  PahArray consumption{};
  for (std::size_t i = 0; i < n; ++i) consumption[i] = r.pahLoss[i] * pah[i];
  const DimerProduction dimer = dimers_.production(frozen.temperature, {consumption.data(), n});
  const double self = options_.inception ? dimer.selfCollision : 0;
  const double withParticles =
      options_.condensation && r.diameter > 0 && dimer.rate > 0
          ? state.number * DimerModel::particleCollision(dimer, frozen.freeMolecular, r.particleMass, r.diameter)
          : 0;
  double carbon = 0, hydrogen = 0;  // mol/m3/s into soot
  if (self + withParticles > 0) {
    s.dimerNumber = steadyDimers(dimer.rate, self, withParticles);
    for (std::size_t i = 0; i < n; ++i) {
      s.gas[S::fixed + i] = -consumption[i];
      carbon += dimers_.carbonAtoms(i) * consumption[i];
      hydrogen += dimers_.hydrogenAtoms(i) * consumption[i];
    }
    const double mass = carbon * options_.carbonWeight + hydrogen * options_.hydrogenWeight;
    const double condensing = withParticles * s.dimerNumber / dimer.rate;
    s.condensation = condensing * mass;
    s.nucleation = mass - s.condensation;
    s.nucleationNumber = 0.5 * self * s.dimerNumber * s.dimerNumber;
  }
  const double growth = r.growth * state.gas[S::C2H2], byO2 = r.oxidationO2 * state.gas[S::O2],
               byOH = r.oxidationOH * state.gas[S::OH];
  const double x = state.carbon > 0 ? state.hydrogen / state.carbon : 0;
  const double perCarbon = options_.carbonWeight + x * options_.hydrogenWeight;
  carbon += 2 * growth - 2 * byO2 - byOH;
  hydrogen -= x * (2 * byO2 + byOH);
  s.growth = 2 * growth * options_.carbonWeight;
  s.oxidationO2 = -2 * byO2 * perCarbon;
  s.oxidationOH = -byOH * perCarbon;
  s.gas[S::C2H2] = -growth;
  s.gas[S::O2] = -byO2;
  s.gas[S::OH] = -byOH;
  s.gas[S::CO] = 2 * byO2 + byOH;
  s.gas[S::H] = byOH;
  s.gas[S::H2] = growth + x * byO2 + 0.5 * x * byOH;
  s.carbon = carbon * options_.carbonWeight;
  s.hydrogen = hydrogen * options_.hydrogenWeight;
  s.coagulationNumber = -r.coagulation * state.number * state.number;
  s.number = s.nucleationNumber + s.coagulationNumber;
  // A mean particle that is no more than a nucleus cannot shrink: it goes (see the theory page).
  if (state.number > 0 && state.carbon <= state.number * nucleusCarbon_ * (1 + 1e-9)) {
    s.oxidationNumber = std::min(0.0, carbon / nucleusCarbon_ - s.number);
    s.number += s.oxidationNumber;
  }
  return s;
}

}  // namespace lampblack::particles
