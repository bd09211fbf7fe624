// What SectionalSoot reports: diffusivities, properties, processes and size distributions.
#include <algorithm>
#include <cmath>

#include "particles/models/sectional/sectional_soot_impl.hpp"

namespace lampblack::particles {

void SectionalSoot::diffusivities(const ParticleGas& gas, std::span<const double> densities,
                                  std::span<double> D) const {
  Impl& m = *impl_;
  m.prepareSections(densities);
  m.shapes.updateGas(2 * meanFreePath(gas));
  // Wang (2025), eqs. 9-17 to 9-20. Hydrogen moves as the carbon it is bound to.
  const double scale = constants::boltzmann * gas.temperature / (3 * constants::pi * gas.viscosity);
  double carbon = 0, flux = 0;
  for (std::size_t i = 0; i < m.sections; ++i) {
    D[i] = scale * m.shapes.slip[i] / m.shapes.mobility[i];
    if (!m.spheres) D[m.sections + i] = D[i];
    const double here = (m.state.aggregates[i] + m.numberScale[i]) * m.pivots[i];
    carbon += here;
    flux += here * D[i];
  }
  if (m.withHydrogen) D[m.hydrogenScalar()] = flux / carbon;
}

std::vector<std::vector<double>> SectionalSoot::gridSums() const {
  const Impl& m = *impl_;
  constexpr double number = 1e17, carbon = 1e-3, hydrogen = 1e-5;  // per kg of gas
  const double mean = carbon / number;                             // kg
  std::vector<std::vector<double>> sums;
  for (const double power : {0.0, 2.0 / 3, 1.0, 2.0}) {
    auto& weights = sums.emplace_back(m.numberScalars(), 0.0);
    for (std::size_t i = 0; i < m.sections; ++i) weights[i] = std::pow(m.pivots[i] / mean, power) / number;
  }
  if (!m.spheres) {
    auto& weights = sums.emplace_back(m.numberScalars(), 0.0);
    std::fill_n(weights.begin() + static_cast<std::ptrdiff_t>(m.sections), m.sections, 1 / number);
  }
  if (m.withHydrogen) sums.emplace_back(m.numberScalars(), 0.0).back() = 1 / hydrogen;
  return sums;
}

ParticleProperties SectionalSoot::properties(const ParticleGas& /*gas*/, std::span<const double> densities) const {
  Impl& m = *impl_;
  m.prepareSections(densities);
  const Impl::State& s = m.state;
  ParticleProperties p;
  p.numberDensity = s.number;
  p.volumeFraction = s.carbon / m.options.soot.sootDensity;
  if (!(s.number > 0)) return p;
  double primaries = 0;
  for (std::size_t i = 0; i < m.sections; ++i) {
    const double N = s.aggregates[i];
    primaries += N * m.shapes.primariesEach[i];
    p.surfaceArea += N * m.shapes.area[i];
    p.mobilityDiameter += N * m.shapes.mobility[i] / s.number;
    p.gyrationDiameter += N * m.shapes.gyration(i) / s.number;
  }
  p.primariesPerAggregate = primaries / s.number;
  p.meanDiameter = std::cbrt(6 * p.volumeFraction / (constants::pi * s.number));
  p.primaryDiameter = std::cbrt(6 * p.volumeFraction / (constants::pi * primaries));
  return p;
}

double SectionalSoot::volumeFraction(std::span<const double> densities) const {
  double carbon = 0;
  for (std::size_t i = 0; i < impl_->sections; ++i) carbon += std::max(densities[i], 0.0) * impl_->pivots[i];
  return carbon / impl_->options.soot.sootDensity;
}

double SectionalSoot::volumeFractionAtLimit(std::span<const double> densities) const {
  const std::size_t last = impl_->sections - 1;
  return std::max(densities[last], 0.0) * impl_->pivots[last] / impl_->options.soot.sootDensity;
}

ParticleProcesses SectionalSoot::processes(const ParticleGas& gas, std::span<const double> densities) const {
  Impl& m = *impl_;
  m.prepare(gas, densities);
  const Impl::State& s = m.state;
  ParticleProcesses p;
  for (std::size_t k = 0; k < s.uptake.kinds; ++k) {
    p.nucleationNumber += s.uptake.nuclei[k].rate;
    p.nucleation += s.uptake.nuclei[k].carbon;
  }
  if (m.options.soot.coagulation) {
    m.pairs.updateKernels(m.shapes, m.collisionGas(gas));
    std::vector<double> fN(m.sections, 0), fP(s.primaries.size(), 0);
    m.pairs.addRates(s.aggregates, s.primaries, fN, fP);
    for (const double f : fN) p.coagulationNumber += f;
  }
  p.oxidationNumber = -s.down.frequency[0] * s.aggregates[0];
  for (std::size_t i = 0; i < m.sections; ++i) p.fragmentationNumber += s.breaking[i] * s.aggregates[i];
  const double weight = m.options.soot.carbonWeight;
  double hydrogen = 0;  // kg/m3/s with PAH, to go with their carbon
  double carbon = 0;
  for (std::size_t k = 0; k < m.pahs && m.withHydrogen; ++k) {
    hydrogen += m.options.soot.pah[k].hydrogen * m.options.soot.hydrogenWeight * s.uptake.consumption[k];
    carbon += m.options.soot.pah[k].carbon * weight * s.uptake.consumption[k];
  }
  const double perCarbon = 1 + (carbon > 0 ? hydrogen / carbon : 0), bound = s.carbon > 0 ? s.hydrogen / s.carbon : 0;
  p.nucleation *= perCarbon;
  p.condensation = s.condensed * perCarbon;
  p.growth = 2 * weight * s.growth;
  p.oxidationO2 = -2 * weight * s.byO2 * (1 + bound);
  p.oxidationOH = -weight * s.byOH * (1 + bound);
  p.carbonisation = -s.dehydrogenation * s.hydrogen;
  p.dimerNumber = s.uptake.dimers;
  p.dimerProduction = s.uptake.production;
  return p;
}

SizeDistribution SectionalSoot::sizeDistribution(std::span<const double> densities) const {
  const Impl& m = *impl_;
  const double width = std::log10(m.options.factor) / 3;
  SizeDistribution distribution;
  for (std::size_t i = 0; i < m.sections; ++i) {
    distribution.diameter.push_back(m.shapes.sphere[i]);
    distribution.density.push_back(std::max(densities[i], 0.0) / width);
  }
  return distribution;
}

}  // namespace lampblack::particles
