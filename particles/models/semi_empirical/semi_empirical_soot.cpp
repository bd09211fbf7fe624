#include "particles/models/semi_empirical/semi_empirical_soot.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "particles/soot/soot_oxidation.hpp"

namespace lampblack::particles {
namespace {

// Growth by the root of the surface starts with an infinite slope. Below this surface (m2/m3; soot of some 1e-13 by
// volume) it goes with the surface itself: S / sqrt(S + s) instead of sqrt(S).
constexpr double smallSurface = 1e-4;

void require(bool right) {
  if (!right)
    throw InputError(
        "soot: density, nucleus and weight of carbon have to be positive, all other constants not negative");
}

}  // namespace

SemiEmpiricalOptions leungSoot() {
  SemiEmpiricalOptions o;
  o.inceptionFactor = 1.0e4;
  o.inceptionTemperature = 21100;
  o.nucleusCarbon = 100;
  o.growthFactor = 6.0e3;
  o.growthTemperature = 12100;
  o.growthByRootOfSurface = true;
  o.coagulation = 9;
  o.oxygen = SemiEmpiricalOptions::Oxygen::leung;
  o.density = 2000;
  return o;
}

SemiEmpiricalOptions mossBrookesSoot() {
  SemiEmpiricalOptions o;
  // 54 nuclei of 144 g/mol to a mole of acetylene and second: six acetylene molecules each.
  o.inceptionFactor = 6 * 54.0;
  o.inceptionTemperature = 21000;
  o.nucleusCarbon = 12;
  // 11700 kg m/kmol/s of soot to the acetylene and surface: two carbon atoms each.
  o.growthFactor = 11700 / (2 * 12.011);
  o.growthTemperature = 12100;
  o.coagulation = 1;
  o.ohEfficiency = 0.04;
  o.density = 1800;
  return o;
}

SemiEmpiricalSoot::SemiEmpiricalSoot(const SemiEmpiricalOptions& options)
    : options_(options),
      spheres_(options.density, options.nucleusCarbon * options.carbonWeight / constants::avogadro),
      species_{"C2H2", "H2", "O2", "OH", "H", "CO"},
      scalars_{{"number", "1/m^3", "number of soot particles", 1e17},
               {"carbon", "kg/m^3", "carbon in soot", 1e-3, {{"C", 1}}}} {
  require(options.density > 0 && options.nucleusCarbon > 0 && options.carbonWeight > 0);
  for (double constant :
       {options.inceptionFactor, options.inceptionTemperature, options.growthFactor, options.growthTemperature,
        options.coagulation, options.ohEfficiency, options.oxidationFactor})
    require(constant >= 0);
}

SemiEmpiricalSoot::Rates SemiEmpiricalSoot::evaluate(const ParticleGas& gas, std::span<const double> densities) const {
  const SemiEmpiricalOptions& o = options_;
  const double T = gas.temperature, mass = EqualSpheres::possibleMass(densities[number], densities[carbon]);
  const double present = std::max(densities[number], 0.0), possible = spheres_.possibleNumber(densities[number], mass);
  const double diameter = spheres_.diameter(possible, mass), surface = spheres_.surface(possible, mass);
  const auto concentration = [&](Gas species) { return std::max(gas.concentrations[species], 0.0); };

  Rates r;
  if (o.inception) r.inception = o.inceptionFactor * std::exp(-o.inceptionTemperature / T) * concentration(C2H2);
  r.nucleated = 2 * constants::avogadro / o.nucleusCarbon * r.inception;
  if (o.growth)
    r.growth = o.growthFactor * std::exp(-o.growthTemperature / T) * concentration(C2H2) *
               (o.growthByRootOfSurface ? surface / std::sqrt(surface + smallSurface) : surface);
  if (o.oxidation) {
    const double oxygen = concentration(O2);
    double flux = 0;  // mol/m2/s
    switch (o.oxygen) {
      case SemiEmpiricalOptions::Oxygen::none:
        break;
      case SemiEmpiricalOptions::Oxygen::leung:
        flux = 1.0e4 * std::sqrt(T) * std::exp(-19680 / T) * oxygen;
        break;
      case SemiEmpiricalOptions::Oxygen::lee:
        flux = oxidationByLee(T, oxygen);
        break;
      case SemiEmpiricalOptions::Oxygen::nagle:
        flux = oxidationByNagle(T, oxygen);
        break;
    }
    r.O2 = o.oxidationFactor * flux * surface;
    r.OH = o.oxidationFactor * o.ohEfficiency * hydroxylFlux(T, concentration(OH)) * surface;
    r.oxidisedNumber =
        spheres_.burntOut(present, possible, mass, o.carbonWeight * (r.O2 + r.OH), o.carbonWeight * 2 * r.growth);
  }
  if (o.coagulating)
    r.coagulated =
        2 * o.coagulation * std::sqrt(6 * constants::boltzmann * T / o.density * diameter) * present * present;
  return r;
}

void SemiEmpiricalSoot::sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                                std::span<double> exchange) const {
  const Rates r = evaluate(gas, densities);
  const double deposited = r.inception + r.growth, burnt = r.O2 + r.OH;
  rates[number] = r.nucleated - r.coagulated - r.oxidisedNumber;
  rates[carbon] = options_.carbonWeight * (2 * deposited - burnt);
  exchange[C2H2] = -deposited;
  exchange[H2] = deposited;
  exchange[O2] = -0.5 * r.O2;
  exchange[OH] = -r.OH;
  exchange[H] = r.OH;
  exchange[CO] = burnt;
}

void SemiEmpiricalSoot::diffusivities(const ParticleGas& gas, std::span<const double> densities,
                                      std::span<double> D) const {
  const double possible = spheres_.possibleNumber(densities[number], densities[carbon]);
  std::fill(D.begin(), D.end(), spheres_.diffusivity(gas, possible, densities[carbon]));
}

ParticleProperties SemiEmpiricalSoot::properties(const ParticleGas& /*gas*/, std::span<const double> densities) const {
  return spheres_.properties(densities[number], densities[carbon]);
}

double SemiEmpiricalSoot::volumeFraction(std::span<const double> densities) const {
  return std::max(densities[carbon], 0.0) / options_.density;
}

ParticleProcesses SemiEmpiricalSoot::processes(const ParticleGas& gas, std::span<const double> densities) const {
  const Rates r = evaluate(gas, densities);
  ParticleProcesses out;
  out.nucleationNumber = r.nucleated;
  out.coagulationNumber = -r.coagulated;
  out.oxidationNumber = -r.oxidisedNumber;
  out.nucleation = 2 * options_.carbonWeight * r.inception;
  out.growth = 2 * options_.carbonWeight * r.growth;
  out.oxidationO2 = -options_.carbonWeight * r.O2;
  out.oxidationOH = -options_.carbonWeight * r.OH;
  return out;
}

void SemiEmpiricalSoot::addSpheres(double count, double volume, std::span<double> densities) const {
  densities[Scalar::number] += count;
  densities[carbon] += count * volume * options_.density;
}

}  // namespace lampblack::particles
