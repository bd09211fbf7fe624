// The deterministic part of an ensemble: condensation of dimers, surface growth and oxidation of every particle, and
// the choice of the splitting step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "particles/ensemble.hpp"
#include "particles/ensemble_medium.hpp"
#include "particles/newborn_step.hpp"

namespace lampblack {

double Ensemble::dimerCollisionSum(const Medium& medium) const {
  if (!medium.condensing) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < size(); ++i) sum += medium.collision(masses_[i], diameters_[i]);
  return sum;
}

double Ensemble::dimerNumber(const Medium& medium, double collisionSum) const {
  const double withParticles = std::max(collisionSum, 0.0) / sampleVolume_;
  if (!(medium.selfCollision + withParticles > 0)) return 0;
  return steadyDimers(medium.dimer.rate, medium.selfCollision, withParticles);
}

double Ensemble::splitStep(const Medium& medium, double dilutionRate, double remaining) const {
  double fastest = std::abs(dilutionRate);
  const bool growing = size() > 0 && (medium.condensing || medium.surfaceActive);
  if (growing || (medium.condensing && medium.selfCollision > 0)) {
    const double sum = dimerCollisionSum(medium);
    const double dimers = dimerNumber(medium, sum);
    if (medium.selfCollision > 0) {
      // Inception changes the share of dimers that condense.
      const double inception = 0.5 * medium.selfCollision * dimers * dimers;
      const double scale = sum / sampleVolume_ + 2 * std::sqrt(medium.dimer.rate * medium.selfCollision);
      fastest = std::max(fastest, inception * medium.collision(medium.nucleusMass, medium.nucleusDiameter) / scale);
    }
    if (growing) {
      const double n = static_cast<double>(size());
      double mass = 0, area = 0, moment0 = 0;
      for (std::size_t i = 0; i < size(); ++i) {
        mass += masses_[i];
        area += constants::pi * diameters_[i] * diameters_[i];
        moment0 += diameters_[i];
      }
      const SurfaceRates rates = medium.surface.rates(medium.gas, 1.0);
      const double perArea = std::abs(2 * rates.growth * medium.gas.C2H2) +
                             std::abs(2 * rates.oxidationO2 * medium.gas.O2 + rates.oxidationOH * medium.gas.OH);
      const double massRate =
          perArea * options_.soot.carbonWeight * area + (medium.condensing ? sum * dimers * medium.dimer.mass : 0);
      // Growth changes collision rates by way of the diameter: a third of the relative change of mass.
      fastest = std::max(fastest, massRate / (3 * mass));
      if (options_.soot.coagulation && n > 1) {
        // Coagulation at the rate of equal spheres of the mean diameter.
        const CollisionKernel::Properties mean{mass / n / options_.soot.sootDensity, mass / n, moment0 / n};
        fastest = std::max(fastest, 0.5 * medium.kernel.value(mean, mean) * n / sampleVolume_);
      }
    }
  }
  return std::min({remaining, fastest > 0 ? options_.splitTolerance / fastest : remaining, newborn(medium)});
}

double Ensemble::newborn(const Medium& medium) const {
  if (!(medium.selfCollision > 0)) return std::numeric_limits<double>::infinity();
  const double dimers = dimerNumber(medium, dimerCollisionSum(medium));
  const double d = medium.nucleusDiameter, m = medium.nucleusMass;
  const SurfaceRates rates = medium.surface.rates(medium.gas, 1.0);
  const double perArea =
      2 * (rates.growth * medium.gas.C2H2 + rates.oxidationO2 * medium.gas.O2) + rates.oxidationOH * medium.gas.OH;
  const double gain = perArea * options_.soot.carbonWeight * constants::pi * d * d +
                      (medium.condensing ? medium.collision(m, d) * dimers * medium.dimer.mass : 0);
  const CollisionKernel::Properties nucleus{m / options_.soot.sootDensity, m, d};
  return newbornStep(options_.splitTolerance, 0.5 * medium.selfCollision * dimers * dimers, numberDensity(),
                     gain / (3 * m), options_.soot.coagulation ? medium.kernel.value(nucleus, nucleus) : 0);
}

Ensemble::Fluxes Ensemble::fluxes(const Medium& medium, double dt) const {
  const SootModelOptions& soot = options_.soot;
  const double rho = soot.sootDensity, n = static_cast<double>(size());
  // Sums over the population, and how fast those grow per unit of each flux.
  double collisions = 0, collisionsBySurface = 0, collisionsByDimers = 0, carbon = 0, area = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double m = masses_[i], d = diameters_[i], surface = constants::pi * d * d;
    carbon += m - hydrogen_[i];
    area += surface;
    if (!medium.condensing) continue;
    const double collision = medium.collision(m, d);
    const double share = medium.dimer.mass / (m + medium.dimer.mass);
    const double perDiameter = collision * (2 / (medium.dimer.diameter + d) - 1.5 * share / d);  // d collision / d d
    collisions += collision;
    collisionsBySurface += perDiameter * 2 / rho;
    collisionsByDimers += perDiameter * 2 / rho * collision / surface;
  }
  Fluxes flux;
  const auto surfaceFluxes = [&](double carbonMass) {
    const double meanCarbon =
        std::max({carbonMass * constants::avogadro / (soot.carbonWeight * n), dimers_.smallestNucleus(), 2.0});  // mu_1
    const SurfaceRates rates = medium.surface.rates(medium.gas, medium.surface.alpha(meanCarbon));
    flux.growth = 2 * rates.growth * medium.gas.C2H2 * soot.carbonWeight;
    flux.oxidation = (2 * rates.oxidationO2 * medium.gas.O2 + rates.oxidationOH * medium.gas.OH) * soot.carbonWeight;
  };
  if (medium.surfaceActive) surfaceFluxes(carbon);
  double dimers = medium.condensing ? dimerNumber(medium, collisions) : 0;
  // Both at the middle of the step, to first order: makes the whole second order.
  const double half = 0.5 * dt, surface = flux.growth - flux.oxidation;
  const double perDimer = dimers * medium.dimer.mass;
  if (medium.surfaceActive) {
    const double dimerCarbon = perDimer * (1 - medium.dimerHydrogenFraction);
    surfaceFluxes(std::max(0.5 * carbon, carbon + half * (surface * area + dimerCarbon * collisions)));
  }
  if (medium.condensing) {
    const double change = half * (surface * collisionsBySurface + perDimer * collisionsByDimers);
    dimers = dimerNumber(medium, collisions * std::clamp(1 + change / collisions, 0.5, 2.0));
  }
  flux.condensation = dimers * medium.dimer.mass * medium.freeMolecular;
  return flux;
}

void Ensemble::grow(const Medium& medium, double dt) {
  if (size() == 0 || !(medium.condensing || medium.surfaceActive)) return;
  const SootModelOptions& soot = options_.soot;
  const Fluxes flux = fluxes(medium, dt);
  const double condensing = flux.condensation, growthFlux = flux.growth, oxidationFlux = flux.oxidation;
  const double rho = soot.sootDensity, dimerMass = std::max(medium.dimer.mass, 1e-300), dd = medium.dimer.diameter;
  const double leastCarbon = dimers_.smallestNucleus() * soot.carbonWeight / constants::avogadro * (1 - 1e-9);
  for (std::size_t i = size(); i-- > 0;) {
    const double startMass = masses_[i];
    const double startFraction = hydrogen_[i] / startMass;
    // The diameter changes at an almost constant rate, whatever the size: integrate it, not the mass.
    const double lossFlux = oxidationFlux / (1 - startFraction);  // hydrogen leaves with its carbon
    const auto condensation = [&](double d, double m) {           // kg/s
      return condensing > 0 ? condensing * std::sqrt(1 / dimerMass + 1 / m) * (dd + d) * (dd + d) : 0;
    };
    const auto massAt = [&](double d) { return rho * constants::pi / 6 * d * d * d; };
    const auto speed = [&](double d) {
      return 2 / rho * (growthFlux - lossFlux + condensation(d, massAt(d)) / (constants::pi * d * d));
    };
    const double d0 = diameters_[i];
    double d = d0, rest = dt, fraction = startFraction;
    bool gone = false;
    while (rest > 0) {
      const double v0 = speed(d), from = d;
      double step = rest;
      if (std::abs(v0) * step > 0.5 * d) step = 0.5 * d / std::abs(v0);
      const double middle = d + 0.5 * step * v0;
      d += step * speed(middle);
      const double area = constants::pi * middle * middle, m = massAt(middle);
      const double gainCondensed = condensation(middle, m), gain = gainCondensed + growthFlux * area;
      if (gain > 0) {
        // What is gained dilutes what was there: exactly by the ratio of masses where nothing is lost.
        const double net = gain - lossFlux * area, ratio = from / d;
        const double target = gainCondensed / gain * medium.dimerHydrogenFraction;
        double kept = ratio * ratio * ratio;
        if (lossFlux > 0) {
          const double share = std::abs(net * step) > 1e-3 * m ? -std::log(kept) / net : step / m;
          kept = std::exp(-gain * share);
        }
        fraction = target + (fraction - target) * kept;
      }
      rest = step < rest ? rest - step : 0;
      if (d < d0 && massAt(d) * (1 - fraction) < leastCarbon) {
        gone = true;
        break;
      }
    }
    if (gone) {
      removeParticle(i);
      ++counters_.oxidised;
      continue;
    }
    const double ratio = d / d0;
    masses_[i] = startMass * ratio * ratio * ratio;
    hydrogen_[i] = masses_[i] * fraction;
    diameters_[i] = d;
  }
  if (size() == 0) {
    restart();
    return;
  }
  while (doubleIfDepleted()) {
  }
}

}  // namespace lampblack
