#include "particles/soot/soot_medium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/errors.hpp"

namespace lampblack::particles {

void SootMoved::add(double weight, const SootMoved& other) {
  for (const auto part : {&SootMoved::dimers, &SootMoved::growth, &SootMoved::oxidationO2, &SootMoved::oxidationOH,
                          &SootMoved::hydrogenO2, &SootMoved::hydrogenOH, &SootMoved::lost})
    this->*part += weight * other.*part;
}

SootMedium::SootMedium(const SootModelOptions& options, const DimerModel& dimers, const ParticleGas& gas,
                       bool keepsHydrogen)
    : options_(options),
      surface_(options, gas.temperature),
      gas_(gas),
      leastCarbon_(dimers.smallestNucleus() * options.carbonWeight / constants::avogadro * (1 - 1e-9)) {
  using S = SootSpecies;
  if (gas.concentrations.size() != S::fixed + dimers.size())
    throw std::invalid_argument("soot: the gas has other species than the model");
  requirePhysical(gas, "stochastic soot");
  SootSpeciesArray c{};
  for (std::size_t k = 0; k < gas.concentrations.size(); ++k) c[k] = std::max(gas.concentrations[k], 0.0);
  if (dimers.consumes()) {
    const std::size_t n = dimers.size();
    PahArray consumption{};
    dimers.lossRates(gas.temperature, {&c[S::fixed], n}, consumption);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += consumption[i] *= c[S::fixed + i];
    dimer_ = dimers.production(gas.temperature, {consumption.data(), n});
    if (dimer_.rate > 0) {
      for (std::size_t i = 0; i < n; ++i) pahOfDimer_[i] = 2 * consumption[i] / sum;
    }
  }
  freeMolecular_ = freeMolecularPrefactor(gas.temperature, options.vanDerWaals);
  if (dimer_.rate > 0) {
    // By the PAH that are taken, so that atoms are counted to round-off.
    for (std::size_t i = 0; i < dimers.size(); ++i) {
      dimerCarbon_ += pahOfDimer_[i] * dimers.carbonAtoms(i) * options.carbonWeight / constants::avogadro;
      dimerHydrogen_ += pahOfDimer_[i] * dimers.hydrogenAtoms(i) * options.hydrogenWeight / constants::avogadro;
    }
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

double SootMedium::dimers(double collisions) const {
  const double withParticles = condensing_ ? std::max(collisions, 0.0) : 0;
  if (!(selfCollision_ + withParticles > 0)) return 0;
  return steadyDimers(dimer_.rate, selfCollision_, withParticles);
}

SootFluxes SootMedium::fluxes() const {
  SootFluxes result;
  result.growth = growth_;
  result.O2 = O2_;
  result.OH = OH_;
  return result;
}

bool SootMedium::grow(const SootAggregate& type, const SootFluxes& fluxes, double dt, SootAggregate::Particle& p,
                      SootMoved& moved) const {
  const double rho = options_.sootDensity, n = p.primaries, before = p.carbon;
  const double shape = SootAggregate::collisionFactor(n);
  const double gainFlux = fluxes.alpha * fluxes.growth, lossO2 = fluxes.alpha * fluxes.O2, lossOH = fluxes.OH;
  const double loss = lossO2 + lossOH;
  const double dimerMass = dimerCarbon_ + dimerHydrogen_;
  const double dimerFraction = dimerMass > 0 ? dimerHydrogen_ / dimerMass : 0;
  double rest = dt;
  while (rest > 0) {
    const double mass = p.carbon + p.hydrogen, fraction = p.hydrogen / mass;
    const double d = cubeRoot(6 / constants::pi * mass / (rho * n));
    // kg/s at a diameter of the primaries: what condenses, and the area.
    const auto condensing = [&](double x, double m) {
      return fluxes.condensation > 0
                 ? dimerMass * freeMolecularKernel(fluxes.condensation, dimer_.mass, dimer_.diameter, m, shape * x)
                 : 0.0;
    };
    const auto area = [&](double x) { return n * constants::pi * x * x; };
    // Hydrogen leaves with its carbon.
    const auto net = [&](double x, double m, double h) {
      return condensing(x, m) + (gainFlux - loss / (1 - h)) * area(x);
    };
    const double v0 = 2 / rho * net(d, mass, fraction) / area(d);
    double step = rest;
    if (std::abs(v0) * step > 0.5 * d) step = 0.5 * d / std::abs(v0);
    const double middle = d + 0.5 * step * v0, massThere = rho * n * constants::pi / 6 * middle * middle * middle;
    const double taken = condensing(d, mass);
    const double half = 0.5 * step * (taken * (dimerFraction - fraction) - gainFlux * area(d) * fraction) / mass;
    const double h = std::clamp(fraction + half, 0.0, std::max(fraction, dimerFraction));
    const double condensed = condensing(middle, massThere), surface = area(middle);
    const double change = step * 2 / rho * net(middle, massThere, h) / surface, centre = d + 0.5 * change;
    // The mass goes with the cube of the diameter, which makes this of the rates at the middle.
    const double amount = step * (3 * centre * centre + 0.25 * change * change) / (3 * middle * middle);
    const double dimers = dimerMass > 0 ? amount * condensed / dimerMass : 0;
    const double grown = amount * gainFlux * surface;
    const double byO2 = amount * lossO2 * surface, byOH = amount * lossOH * surface, withCarbon = h / (1 - h);
    p.carbon += dimers * dimerCarbon_ + grown - byO2 - byOH;
    p.hydrogen += dimers * dimerHydrogen_ - (byO2 + byOH) * withCarbon;
    moved.dimers += dimers;
    moved.growth += grown;
    moved.oxidationO2 += byO2;
    moved.oxidationOH += byOH;
    moved.hydrogenO2 += byO2 * withCarbon;
    moved.hydrogenOH += byOH * withCarbon;
    rest = step < rest ? rest - step : 0;
    if (p.carbon < before && p.carbon < leastCarbon_) {
      const double share = lossO2 / loss;
      moved.oxidationO2 += share * p.carbon;
      moved.oxidationOH += (1 - share) * p.carbon;
      moved.hydrogenO2 += share * p.hydrogen;
      moved.hydrogenOH += (1 - share) * p.hydrogen;
      moved.lost += 1;
      return false;
    }
  }
  p.diameter = shape * type.primaryDiameter(p);
  return true;
}

}  // namespace lampblack::particles
