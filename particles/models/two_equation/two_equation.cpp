#include "particles/models/two_equation/two_equation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "particles/collisions/sphere.hpp"

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

// Coefficients at one state of the soot: all zero without soot.
struct TwoEquationSoot::Rates {
  double growth = 0;                      // 1/s, of C2H2
  double oxidationO2 = 0;                 // 1/s, of O2
  double oxidationOH = 0;                 // 1/s, of OH
  double coagulation = 0;                 // m3/s, dN/dt = -coagulation N^2
  double particleMass = 0, diameter = 0;  // kg, m
};

TwoEquationSoot::Rates TwoEquationSoot::rates(const CarrierGas& gas, const SootSpeciesArray& concentrations,
                                              const Population& soot) const {
  Rates r;
  if (!(soot.number > 0) || !(soot.mass() > 0)) return r;
  r.particleMass = soot.mass() / soot.number;
  r.diameter = sphereDiameter(r.particleMass / options_.sootDensity);
  const double d = r.diameter, area = constants::pi * d * d * soot.number;
  const double meanCarbon =
      std::max(soot.carbon / options_.carbonWeight / soot.number, nucleusCarbon_) * constants::avogadro;
  const SurfaceChemistry chemistry(options_, gas.temperature);
  const SurfaceRates surface = chemistry.rates(concentrations, chemistry.alpha(std::max(meanCarbon, 2.0)));
  r.growth = surface.growth * area;
  r.oxidationO2 = surface.oxidationO2 * area;
  r.oxidationOH = surface.oxidationOH * area;
  if (options_.coagulation) {
    const double slip = slipCorrection(2 * meanFreePath(gas) / d);
    const double fm = freeMolecularKernel(freeMolecularPrefactor(gas.temperature, options_.vanDerWaals), r.particleMass,
                                          d, r.particleMass, d);
    r.coagulation = 0.5 * harmonicMean(fm, 4 * continuumPrefactor(gas.temperature, gas.viscosity) * slip);
  }
  return r;
}

TwoEquationSoot::Sources TwoEquationSoot::sources(const ParticleGas& gas, const Population& population) const {
  using S = SootSpecies;
  const std::size_t n = dimers_.size();
  if (gas.concentrations.size() != S::fixed + n)
    throw std::invalid_argument("soot: the gas has other species than the model");
  requirePhysical(gas, "soot");
  const Population soot{std::max(population.number, 0.0), std::max(population.carbon, 0.0),
                        std::max(population.hydrogen, 0.0)};
  SootSpeciesArray concentrations{};
  for (std::size_t k = 0; k < S::fixed + n; ++k) concentrations[k] = std::max(gas.concentrations[k], 0.0);
  const std::span<const double> pah{&concentrations[S::fixed], n};
  const Rates r = rates(gas, concentrations, soot);

  Sources s;
  PahArray consumption{};
  dimers_.lossRates(gas.temperature, pah, consumption);
  for (std::size_t i = 0; i < n; ++i) consumption[i] *= pah[i];
  const DimerProduction dimer = dimers_.production(gas.temperature, {consumption.data(), n});
  const double self = options_.inception ? dimer.selfCollision : 0;
  const double withParticles =
      options_.condensation && r.diameter > 0 && dimer.rate > 0
          ? soot.number * DimerModel::particleCollision(dimer,
                                                        freeMolecularPrefactor(gas.temperature, options_.vanDerWaals),
                                                        r.particleMass, r.diameter)
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
  const double growth = r.growth * concentrations[S::C2H2], byO2 = r.oxidationO2 * concentrations[S::O2],
               byOH = r.oxidationOH * concentrations[S::OH];
  const double molCarbon = soot.carbon / options_.carbonWeight;  // mol/m3
  const double x = molCarbon > 0 ? soot.hydrogen / options_.hydrogenWeight / molCarbon : 0;
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
  s.coagulationNumber = -r.coagulation * soot.number * soot.number;
  s.number = s.nucleationNumber + s.coagulationNumber;
  // A mean particle that is no more than a nucleus cannot shrink: it goes (see the theory page).
  if (soot.number > 0 && molCarbon <= soot.number * nucleusCarbon_ * (1 + 1e-9)) {
    s.oxidationNumber = std::min(0.0, carbon / nucleusCarbon_ - s.number);
    s.number += s.oxidationNumber;
  }
  return s;
}

}  // namespace lampblack::particles
