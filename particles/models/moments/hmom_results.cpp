// What HmomSoot reports: diffusivities, properties and processes.
#include <algorithm>
#include <cmath>

#include "particles/collisions/sphere.hpp"
#include "particles/models/moments/hmom_impl.hpp"

namespace lampblack::particles {

double HmomSoot::mobilityDiameter(const Mode& mode) {
  return 6 * mode.volume / mode.surface * std::pow(mode.primaries, 0.45);  // Wang (2025), eq. 9-21
}

void HmomSoot::diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const {
  const State s = stateOf(densities);
  const double ofNuclei = brownianDiffusivity(gas, s.nuclei.collisionDiameter);
  const double ofLarge = brownianDiffusivity(gas, mobilityDiameter(s.large));
  for (std::size_t i = 0; i < scalarCount; ++i) D[i] = i <= nucleiHydrogen ? ofNuclei : ofLarge;
}

ParticleProperties HmomSoot::properties(const ParticleGas& /*gas*/, std::span<const double> densities) const {
  const State s = stateOf(densities);
  const Mode &n = s.nuclei, &l = s.large;
  ParticleProperties p;
  p.numberDensity = n.number + l.number;
  const double mass = n.mass + l.mass, present = n.present + l.present;
  if (!(present > 0)) return p;
  const double volume = mass / options_.soot.sootDensity;
  p.volumeFraction = volume;
  p.meanDiameter = sphereDiameter(volume / present);
  p.surfaceArea = n.present * n.surface + l.present * l.surface;
  // Means over particles; the primaries' is that of the total volume and surface.
  const auto mean = [&](double ofNuclei, double ofLarge) {
    return (n.present * ofNuclei + l.present * ofLarge) / present;
  };
  p.primaryDiameter = 6 * volume / p.surfaceArea;
  p.primariesPerAggregate = mean(1, l.primaries);
  p.mobilityDiameter = mean(n.collisionDiameter, mobilityDiameter(l));
  const double gyration = l.primaries > 1.8 ? 1 / (std::pow(l.primaries, -0.2) + 0.4) : std::sqrt(0.6);
  p.gyrationDiameter =
      mean(std::sqrt(0.6) * n.collisionDiameter, gyration * mobilityDiameter(l));  // Wang (2025), eq. 9-22
  return p;
}

double HmomSoot::volumeFraction(std::span<const double> densities) const {
  double mass = 0;
  for (std::size_t i : {nucleiCarbon, nucleiHydrogen, carbon, hydrogen}) mass += std::max(densities[i], 0.0);
  return mass / options_.soot.sootDensity;
}

ParticleProcesses HmomSoot::processes(const ParticleGas& gas, std::span<const double> densities) const {
  const MomentGas read = chemistry_.read(gas);
  const State state = stateOf(densities);
  const Rates r = evaluate(read, densities);
  ParticleProcesses p =
      MomentChemistry::processes(options_.soot, read, r.dimers, r.onLarge, state.large.hydrogenToCarbon);
  const ParticleProcesses q =
      MomentChemistry::processes(options_.soot, read, r.dimers, r.onNuclei, state.nuclei.hydrogenToCarbon);
  p.growth += q.growth;
  p.oxidationO2 += q.oxidationO2;
  p.oxidationOH += q.oxidationOH;
  p.coagulationNumber = r.coagulated;
  p.oxidationNumber = r.burntOut;
  return p;
}

}  // namespace lampblack::particles
