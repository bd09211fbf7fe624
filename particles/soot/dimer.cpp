#include "particles/soot/dimer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "particles/collisions/sphere.hpp"

namespace lampblack::particles {

double steadyDimers(double production, double selfCollision, double particleCollision) {
  if (production <= 0) return 0;
  // The textbook root subtracts two almost equal numbers when condensation dominates; this form of it does not.
  const double root = std::sqrt(particleCollision * particleCollision + 4 * selfCollision * production);
  return 2 * production / (particleCollision + root);
}

DimerModel::DimerModel(const SootModelOptions& options)
    : carbonMass_(options.carbonWeight / constants::avogadro),
      hydrogenMass_(options.hydrogenWeight / constants::avogadro),
      sootDensity_(options.sootDensity),
      vanDerWaals_(options.vanDerWaals),
      equilibrium_(options.dimerEquilibrium),
      consumes_(!options.pah.empty() && (options.inception || options.condensation)) {
  const std::size_t n = options.pah.size();
  if (n > maximumPahSpecies) {
    throw InputError(fmt::format("soot: {} PAH species listed, at most {} are possible", n, maximumPahSpecies));
  }
  std::vector<double> mass, diameter;
  for (const PahSpecies& pah : options.pah) {
    if (pah.carbon < 1 || pah.hydrogen < 0 || !(pah.stickingCoefficient >= 0)) {
      throw InputError(
          fmt::format("soot: PAH '{}' needs carbon atoms and a sticking coefficient of 0 or more", pah.name));
    }
    carbon_.push_back(pah.carbon);
    hydrogen_.push_back(pah.hydrogen);
    mass.push_back(pah.carbon * carbonMass_ + pah.hydrogen * hydrogenMass_);
    diameter.push_back(sphereDiameter(mass.back() / pahDensity(pah.carbon, pah.hydrogen)));
  }
  pair_.resize(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double sticking =
          std::sqrt(options.pah[i].stickingCoefficient * options.pah[j].stickingCoefficient);  // eq. 7-37
      const double perRootTemperature = freeMolecularPrefactor(1, 1);                          // eq. 7-34
      pair_[i * n + j] = constants::avogadro * sticking *
                         freeMolecularKernel(perRootTemperature, mass[i], diameter[i], mass[j], diameter[j]);
    }
  }
  const int molecules = options.inceptionBy == InceptionBy::dimers ? 4 : 2;
  if (n > 0) smallestNucleus_ = molecules * *std::min_element(carbon_.begin(), carbon_.end());
}

void DimerModel::lossRates(double temperature, std::span<const double> pah, PahArray& loss) const {
  const std::size_t n = size();
  const double root = consumes_ ? std::sqrt(temperature) : 0;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += pair_[i * n + j] * std::max(pah[j], 0.0);
    loss[i] = root * sum;
  }
}

double DimerModel::breaking(double temperature, double rate, std::span<const double> pah) const {
  double sum = 0;
  for (const double c : pah) sum += std::max(c, 0.0);
  if (!equilibrium_ || !(sum > 0)) return 0;
  const double K = 1e-6 * valueAt(*equilibrium_, std::log(temperature), 1 / (constants::gasConstant * temperature));
  return rate / (constants::avogadro * K * sum * sum);
}

DimerProduction DimerModel::production(double temperature, std::span<const double> consumption) const {
  DimerProduction dimer;
  double molecules = 0, carbon = 0, hydrogen = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    molecules += consumption[i];
    carbon += carbon_[i] * consumption[i];
    hydrogen += hydrogen_[i] * consumption[i];
  }
  if (!(molecules > 0)) return dimer;
  dimer.rate = 0.5 * constants::avogadro * molecules;
  dimer.carbon = 2 * carbon / molecules;
  dimer.hydrogen = 2 * hydrogen / molecules;
  dimer.mass = dimer.carbon * carbonMass_ + dimer.hydrogen * hydrogenMass_;
  dimer.diameter = sphereDiameter(dimer.mass / sootDensity_);
  dimer.selfCollision = freeMolecularKernel(freeMolecularPrefactor(temperature, vanDerWaals_), dimer.mass,
                                            dimer.diameter, dimer.mass, dimer.diameter);
  return dimer;
}

}  // namespace lampblack::particles
