#include "particles/models/sectional/sectional_soot_pah.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::particles {

double SectionPah::smallestNucleus(const SectionalSootOptions& options) {
  if (options.soot.pah.empty()) {
    throw InputError("soot: sections without a PAH need the number of carbon atoms of a nucleus");
  }
  int smallest = options.soot.pah[0].carbon;
  for (const PahSpecies& pah : options.soot.pah) smallest = std::min(smallest, pah.carbon);
  return (options.nucleation == SectionalSootOptions::Nucleation::dimer ? 4 : 2) * smallest;
}

SectionPah::SectionPah(const SectionalSootOptions& options, std::span<const double> pivots)
    : options_(options),
      dimerModel_(options.soot),
      pivots_(pivots.begin(), pivots.end()),
      carbonMass_(options.soot.carbonWeight / constants::avogadro),
      dimers_(options.nucleation == SectionalSootOptions::Nucleation::dimer) {
  const int molecules = dimers_ ? 4 : 2;
  for (const PahSpecies& pah : options.soot.pah) {
    Molecule molecule{};
    molecule.carbon = pah.carbon;
    molecule.mass = pah.carbon * carbonMass_ + pah.hydrogen * options.soot.hydrogenWeight / constants::avogadro;
    molecule.diameter = std::cbrt(6 * molecule.mass / (constants::pi * options.soot.sootDensity));
    for (const double m : pivots) molecule.root.push_back(std::sqrt(1 / molecule.mass + 1 / m));
    molecules_.push_back(std::move(molecule));
    const double nucleus = molecules * pah.carbon * carbonMass_;
    if (nucleus < pivots.front() * (1 - 1e-12) || nucleus > pivots.back()) {
      throw InputError(fmt::format(
          "soot: a nucleus of {} {} has {} carbon atoms, the sections reach from {:.6g} to {:.6g}", molecules, pah.name,
          molecules * pah.carbon, pivots.front() / carbonMass_, pivots.back() / carbonMass_));
    }
  }
}

SectionPah::Uptake SectionPah::makeUptake() const {
  Uptake uptake;
  for (auto* values : {&uptake.condensation, &uptake.slope, &uptake.collision, &uptake.collisionSlope})
    values->assign(pivots_.size(), 0);
  return uptake;
}

SectionPah::Nuclei SectionPah::divideBetweenPivots(double rate, double mass) const {
  Nuclei nuclei;
  nuclei.rate = rate;
  nuclei.carbon = rate * mass;
  const auto upper = std::upper_bound(pivots_.begin(), pivots_.end(), mass * (1 + 1e-12));
  nuclei.lower = upper == pivots_.begin() ? 0 : static_cast<std::size_t>(upper - pivots_.begin()) - 1;
  nuclei.lower = std::min(nuclei.lower, pivots_.size() - 2);
  const double low = pivots_[nuclei.lower], high = pivots_[nuclei.lower + 1];
  nuclei.share = (high - mass) / (high - low);
  return nuclei;
}

void SectionPah::addConsumption(double temperature, double concentration, const SectionShapes& shapes, std::size_t k,
                                std::span<double> perAggregate, std::span<double> slope) const {
  if (!options_.soot.condensation || !(concentration > 0)) return;
  const Molecule& molecule = molecules_[k];
  const double scale =
      options_.condensationEfficiency * concentration * freeMolecularPrefactor(temperature, options_.soot.vanDerWaals);
  for (std::size_t i = 0; i + 1 < pivots_.size(); ++i) {
    const double reach = molecule.diameter + shapes.collision[i], rate = scale * molecule.root[i] * reach;
    perAggregate[i] += rate * reach;
    slope[i] += 2 * rate * shapes.collisionSlope[i];
  }
}

void SectionPah::evaluate(double temperature, std::span<const double> concentrations, const SectionShapes& shapes,
                          std::span<const double> aggregates, Uptake& uptake) const {
  const std::size_t n = pivots_.size();
  const SootModelOptions& soot = options_.soot;
  uptake.kinds = 0;
  uptake.consumption = {};
  uptake.dimers = uptake.production = uptake.bySum = 0;
  std::fill(uptake.condensation.begin(), uptake.condensation.end(), 0);
  std::fill(uptake.slope.begin(), uptake.slope.end(), 0);
  if (!dimers_) {
    for (std::size_t k = 0; k < molecules_.size(); ++k) {
      const Molecule& molecule = molecules_[k];
      const double c = concentrations[k];
      if (!(c > 0)) continue;
      if (soot.inception) {
        // Half the collisions of a gas with itself (Wang 2025, eq. 9-23).
        const double number = constants::avogadro * c, d = molecule.diameter;
        const double rate = 0.5 * options_.nucleationFactor *
                            freeMolecularKernel(freeMolecularPrefactor(temperature, soot.vanDerWaals), molecule.mass, d,
                                                molecule.mass, d) *
                            number * number;
        uptake.nuclei[uptake.kinds++] = divideBetweenPivots(rate, 2 * molecule.carbon * carbonMass_);
        uptake.consumption[k] += 2 * rate / constants::avogadro;
      }
      if (!soot.condensation) continue;
      // Collisions of the section's aggregates with one PAH after the other (Wang 2025, eq. 9-31).
      std::fill(uptake.collision.begin(), uptake.collision.end(), 0);
      std::fill(uptake.collisionSlope.begin(), uptake.collisionSlope.end(), 0);
      addConsumption(temperature, c, shapes, k, uptake.collision, uptake.collisionSlope);
      double sum = 0;
      const double carbon = molecule.carbon * soot.carbonWeight;
      for (std::size_t i = 0; i < n; ++i) {
        sum += uptake.collision[i] * aggregates[i];
        uptake.condensation[i] += carbon * uptake.collision[i];
        uptake.slope[i] += carbon * uptake.collisionSlope[i];
      }
      uptake.consumption[k] += sum;
    }
    return;
  }

  if (!dimerModel_.consumes()) return;
  PahArray loss{};
  dimerModel_.lossRates(temperature, concentrations, loss);
  for (std::size_t k = 0; k < molecules_.size(); ++k) loss[k] *= concentrations[k];
  const DimerProduction dimer = dimerModel_.production(temperature, {loss.data(), molecules_.size()});
  if (!(dimer.rate > 0)) return;
  const double self = soot.inception ? dimer.selfCollision : 0;
  const double prefactor = freeMolecularPrefactor(temperature, soot.vanDerWaals), inverse = 1 / dimer.mass;
  double sum = 0;
  std::fill(uptake.collision.begin(), uptake.collision.end(), 0);
  std::fill(uptake.collisionSlope.begin(), uptake.collisionSlope.end(), 0);
  if (soot.condensation) {
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double reach = dimer.diameter + shapes.collision[i];
      const double rate = prefactor * std::sqrt(inverse + 1 / pivots_[i]) * reach;
      uptake.collision[i] = rate * reach;
      uptake.collisionSlope[i] = 2 * rate * shapes.collisionSlope[i];
      sum += uptake.collision[i] * aggregates[i];
    }
  }
  if (!(self + sum > 0)) return;
  uptake.consumption = loss;
  uptake.production = dimer.rate;
  uptake.dimers = steadyDimers(dimer.rate, self, sum);
  uptake.bySum = -1 / (2 * self * uptake.dimers + sum);
  const double carbon = uptake.dimers * dimer.carbon * carbonMass_;
  for (std::size_t i = 0; i < n; ++i) {
    uptake.condensation[i] = carbon * uptake.collision[i];
    uptake.slope[i] = carbon * uptake.collisionSlope[i];
  }
  if (self > 0) {
    uptake.nuclei[uptake.kinds++] =
        divideBetweenPivots(0.5 * self * uptake.dimers * uptake.dimers, 2 * dimer.carbon * carbonMass_);
  }
}

}  // namespace lampblack::particles
