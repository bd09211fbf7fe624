#include "particles/soot/soot_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.hpp"
#include "particles/population/model/newborn_step.hpp"

namespace lampblack::particles {
namespace {

CollisionKernel::Properties meanParticle(const SootPopulationLaw& law, const SootSums& s) {
  const double mass = (s.carbon + s.hydrogen) / s.number;
  return {mass / law.soot.sootDensity, mass, s.diameters / s.number};
}

// Change of the sum of collisions with dimers by coagulation, 1/s2, as for a population of equal particles.
double coagulating(const SootPopulationLaw& law, const SootMedium& medium, const SootSums& s) {
  if (law.kernel == nullptr || !(s.number > 0)) return 0;
  const CollisionKernel::Properties mean = meanParticle(law, s);
  const double rate = 0.5 * law.kernel->value(mean, mean) * s.number * s.number;
  const SootAggregate::Particle one{mean.mass, 0, 1, mean.diameter};
  const SootAggregate::Particle two{2 * mean.mass, 0, 2, mean.diameter * law.joined};
  return rate * (medium.collision(two) - 2 * medium.collision(one));
}

// The step that nuclei allow which are born in it.
double newborns(const SootPopulationLaw& law, const SootMedium& medium, const SootSums& s, const SootFluxes& flux,
                double dimers) {
  const SootAggregate::Particle nucleus = sootNucleus(medium, law.soot.sootDensity);
  const double d = nucleus.diameter, mass = SootAggregate::mass(nucleus);
  const double gain = (flux.growth + flux.O2 + flux.OH) * constants::pi * d * d +
                      (medium.condensing() ? medium.collision(nucleus) * dimers * medium.dimer().mass : 0);
  const CollisionKernel::Properties one{mass / law.soot.sootDensity, mass, d};
  return newbornStep(law.splitTolerance, medium.inception(s.collisions), s.number, gain / (3 * mass),
                     law.kernel != nullptr ? law.kernel->value(one, one) : 0);
}

}  // namespace

double sootStep(const SootPopulationLaw& law, const SootMedium& medium, const SootSums& s, double fastest,
                double remaining) {
  const double dimers = medium.dimers(s.collisions);
  const SootFluxes flux = medium.fluxes();
  if (medium.incepting() && medium.condensing() && !medium.ofMonomers()) {
    const double rate = medium.inception(s.collisions);
    const double scale =
        s.collisions + medium.breaking() + 2 * std::sqrt(medium.dimer().rate * medium.dimer().selfCollision);
    fastest = std::max(fastest, rate * medium.collision(sootNucleus(medium, law.soot.sootDensity)) / scale);
  }
  if (s.number > 0) {
    const double most = (flux.growth + flux.O2 + flux.OH) * s.area + s.collisions * dimers * medium.dimer().mass;
    fastest = std::max(fastest, most / (3 * (s.carbon + s.hydrogen)));
    // By itself coagulation needs no steps.
    if (law.kernel != nullptr && (medium.condensing() || medium.surfaceActive())) {
      const CollisionKernel::Properties mean = meanParticle(law, s);
      fastest = std::max(fastest, 0.5 * law.kernel->value(mean, mean) * s.number);
    }
  }
  double longest = std::numeric_limits<double>::infinity();
  if (medium.incepting()) {
    // One event of oxidation ends a nucleus.
    if (law.byEvents) {
      const double d = sootNucleus(medium, law.soot.sootDensity).diameter;
      const double lost = medium.alpha(law.dimers.smallestNucleus()) * flux.O2 / 2 + flux.OH;
      // Births and ends in turn, at x = rate times step, leave a part x^2/12 too many of what is born and ends.
      fastest = std::max(fastest, lost * constants::pi * d * d / medium.carbonAtom() / 3);
    }
    longest = newborns(law, medium, s, flux, dimers);
  }
  return std::min({remaining, fastest > 0 ? law.splitTolerance / fastest : remaining, longest});
}

double sootInception(const SootPopulationLaw& law, const SootMedium& medium, const SootSums& s, double dt) {
  const double first = medium.inception(s.collisions);
  const double change =
      first * medium.collision(sootNucleus(medium, law.soot.sootDensity)) + coagulating(law, medium, s);
  return medium.inception(std::max(0.0, s.collisions + 0.5 * dt * change));
}

SootFluxes sootFluxes(const SootPopulationLaw& law, const SootMedium& medium, const SootSums& s, double dt) {
  SootFluxes flux = medium.fluxes();
  const double counted = law.alphaOfPrimaries ? s.primaries : s.number;
  const auto alpha = [&](double carbon) {
    const double atoms = carbon / counted * constants::avogadro / law.soot.carbonWeight;
    return medium.alpha(std::max({atoms, law.dimers.smallestNucleus(), 2.0}));
  };
  const auto surface = [&](double a) { return a * (flux.growth - flux.O2) - flux.OH; };
  const double half = 0.5 * dt, first = alpha(s.carbon), dimersFirst = medium.dimers(s.collisions);
  const double condensing = s.collisions * dimersFirst * medium.dimer().mass;
  const double mass = s.carbon + s.hydrogen, gain = half * (surface(first) * s.area + condensing);
  flux.alpha = alpha(std::max(0.5 * s.carbon, s.carbon + gain * s.carbon / mass));
  if (medium.condensing()) {
    const double stretch = std::clamp(gain / (3 * mass), -0.3, 0.3);  // of the diameters
    flux.condensation =
        medium.condensation(medium.dimers(std::max(0.5 * s.collisions, s.collisions + stretch * s.slopes)));
  }
  return flux;
}

void exchangeDimers(const SootMedium& medium, const SootModelOptions& soot, double dimers, SootSpeciesArray& gas) {
  for (std::size_t i = 0; i < soot.pah.size(); ++i)
    gas[SootSpecies::fixed + i] -= dimers * medium.pahOfDimer()[i] / constants::avogadro;
  gas[SootSpecies::H2] += 0.5 * dimers * medium.freedHydrogen() / soot.hydrogenWeight;
}

void exchangeSurface(const SootModelOptions& soot, const SootTransfer& all, SootSpeciesArray& gas) {
  using S = SootSpecies;
  const double perCarbon = 1 / soot.carbonWeight, perH2 = 0.5 / soot.hydrogenWeight;
  gas[S::C2H2] -= 0.5 * all.growth * perCarbon;
  gas[S::O2] -= 0.5 * all.oxidationO2 * perCarbon;
  gas[S::OH] -= all.oxidationOH * perCarbon;
  gas[S::CO] += (all.oxidationO2 + all.oxidationOH) * perCarbon;
  gas[S::H] += all.oxidationOH * perCarbon;
  gas[S::H2] += 0.5 * all.growth * perCarbon + (all.hydrogenO2 + all.hydrogenOH) * perH2;
}

SpeciesExchanged exchangedByDimers(const SootModelOptions& soot) {
  SpeciesExchanged gas{{}, {SootSpecies::H2}};
  for (std::size_t i = 0; i < soot.pah.size(); ++i) gas.takes.push_back(SootSpecies::fixed + i);
  return gas;
}
SpeciesExchanged exchangedByGrowth() {
  return {{SootSpecies::C2H2}, {SootSpecies::H2}};
}
SpeciesExchanged exchangedByO2() {
  return {{SootSpecies::O2}, {SootSpecies::CO, SootSpecies::H2}};
}
SpeciesExchanged exchangedByOH() {
  return {{SootSpecies::OH}, {SootSpecies::CO, SootSpecies::H, SootSpecies::H2}};
}

}  // namespace lampblack::particles
