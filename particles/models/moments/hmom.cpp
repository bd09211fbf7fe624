// HMOM: its scalars, the particles they stand for, and their rates.
#include "particles/models/moments/hmom.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/collisions/sphere.hpp"
#include "particles/models/moments/hmom_impl.hpp"
#include "particles/soot/soot_oxidation.hpp"

namespace lampblack::particles {
namespace {

// States of no population, in which iterates of Newton's method may be. Where soot has more than two hydrogen atoms to
// a carbon atom or particles are larger than these numbers of nuclei, the rates are those at the bound.
constexpr double largestHydrogenToCarbon = 2, largestInNuclei = 1e12, largestNucleusInNuclei = 100;
constexpr double leastArea = 1e-100;  // m2/m3: no surface at all
// Surface beyond that of as many nuclei as there is mass for goes so many times as fast as the mass burns: what makes
// it is that primaries burn smaller than nuclei, and with more than once it stays in proportion to the mass.
constexpr double excessPace = 3;

}  // namespace

HmomSoot::HmomSoot(HmomOptions options) : options_(std::move(options)), chemistry_(options_.soot) {
  if (!(options_.fractalDimension > 1 && options_.fractalDimension <= 3)) {
    throw InputError(
        fmt::format("soot: HMOM needs a fractal dimension above 1 and up to 3, not {}", options_.fractalDimension));
  }
  if (!(options_.surfaceExponent >= 0)) {
    throw InputError(fmt::format("soot: HMOM needs a surface exponent of 0 or more, not {}", options_.surfaceExponent));
  }
  nucleusMass_ = chemistry_.dimers().smallestNucleus() * options_.soot.carbonWeight / constants::avogadro;
  scalars_ = {{"nuclei", "1/m^3", "number of soot nuclei", 1e15},
              {"nuclei_carbon", "kg/m^3", "carbon in soot nuclei", 1e-7, {{"C", 1}}},
              {"nuclei_hydrogen", "kg/m^3", "hydrogen in soot nuclei", 1e-8, {{"H", 1}}},
              {"number", "1/m^3", "number of larger soot particles", 1e16},
              {"carbon", "kg/m^3", "carbon in larger soot particles", 1e-3, {{"C", 1}}},
              {"hydrogen", "kg/m^3", "hydrogen in larger soot particles", 1e-5, {{"H", 1}}},
              {"surface", "m^2/m^3", "surface of larger soot particles", 100}};
}

HmomSoot::Mode HmomSoot::modeOf(double particles, double carbonMass, double hydrogenMass, double largest) const {
  const SootModelOptions& o = options_.soot;
  const double perHydrogen = o.hydrogenWeight / o.carbonWeight;
  Mode m;
  m.number = std::max(particles, 0.0);
  m.carbon = std::max(carbonMass, 0.0);
  m.hydrogen = std::max(hydrogenMass, 0.0);
  if (m.carbon > 0) m.hydrogenToCarbon = std::min(m.hydrogen / (perHydrogen * m.carbon), largestHydrogenToCarbon);
  m.mass = m.carbon * (1 + perHydrogen * m.hydrogenToCarbon);
  m.particle = nucleusMass_ * largest;
  if (m.number * m.particle > m.mass) m.particle = std::max(m.mass / m.number, nucleusMass_);
  m.present = m.mass / m.particle;
  m.volume = m.particle / o.sootDensity;
  m.surface = sphereSurface(m.volume);
  m.collisionDiameter = sphereDiameter(m.volume);
  return m;
}

HmomSoot::State HmomSoot::stateOf(std::span<const double> densities) const {
  State s;
  s.nuclei = modeOf(densities[nuclei], densities[nucleiCarbon], densities[nucleiHydrogen], largestNucleusInNuclei);
  s.large = modeOf(densities[number], densities[carbon], densities[hydrogen], largestInNuclei);
  s.surface = std::max(densities[surface], 0.0);
  Mode& m = s.large;
  // A surface between that of the sphere and that of as many of the smallest nuclei.
  const double sphere = m.surface, nucleusVolume = nucleusMass_ / options_.soot.sootDensity;
  const double most = m.volume / nucleusVolume * sphereSurface(nucleusVolume);
  if (m.present > 0) m.surface = std::clamp(s.surface / m.present, sphere, std::max(sphere, most));
  // Primaries of diameter 6 V / S (Mueller et al. 2009): n_p = S^3 / (36 pi V^2) = (S / S_sphere)^3.
  const double ratio = m.surface / sphere;
  m.primaries = ratio * ratio * ratio;
  m.collisionDiameter = 6 * m.volume / m.surface * std::pow(m.primaries, 1 / options_.fractalDimension);
  return s;
}

namespace {

// Transition kernel of two particles: harmonic mean of the limits (Wang 2025, eqs. 9-28 to 9-30).
struct Kernel {
  double freeMolecular, continuum, twiceMeanFreePath;

  [[nodiscard]] double operator()(double mi, double di, double mj, double dj) const {
    const double slow = slipCorrection(twiceMeanFreePath / di) / di + slipCorrection(twiceMeanFreePath / dj) / dj;
    return harmonicMean(freeMolecularKernel(freeMolecular, mi, di, mj, dj), continuum * slow * (di + dj));
  }
};

}  // namespace

void HmomSoot::addCoagulation(const MomentGas& gas, const State& state, Rates& rates) const {
  if (!options_.soot.coagulation) return;
  const Mode &n = state.nuclei, &l = state.large;
  const Kernel kernel{gas.freeMolecular, continuumPrefactor(gas.gas.temperature, gas.gas.viscosity),
                      2 * meanFreePath(gas.gas)};
  // Two nuclei coalesce.
  const double pairs = kernel(n.particle, n.collisionDiameter, n.particle, n.collisionDiameter) * n.number;
  rates.leaveNuclei(n, pairs, true);
  rates.scalars[number] += 0.5 * pairs * n.number;
  rates.scalars[surface] += 0.5 * pairs * n.number * sphereSurface(2 * n.volume);
  rates.coagulated -= 0.5 * pairs * n.number;
  if (!(l.present > 0)) return;
  // A nucleus on a large particle adds to the surface what so much volume does.
  const double mixed = kernel(n.particle, n.collisionDiameter, l.particle, l.collisionDiameter) * l.present;
  rates.leaveNuclei(n, mixed, true);
  rates.scalars[surface] += mixed * n.mass / options_.soot.sootDensity * surfacePerVolume(l);
  rates.coagulated -= mixed * n.number;
  // Two large ones aggregate: volume and surface are the sums.
  const double large = 0.5 * kernel(l.particle, l.collisionDiameter, l.particle, l.collisionDiameter) * l.number;
  rates.scalars[number] -= large * l.number;
  rates.coagulated -= large * l.number;
}

// dS/dV by growth: 2/3 S/V n_p^-exponent (Mueller, Blanquart and Pitsch 2009).
double HmomSoot::surfacePerVolume(const Mode& mode) const {
  return 2.0 / 3.0 * mode.surface / mode.volume * std::pow(mode.primaries, -options_.surfaceExponent);
}

void HmomSoot::addDimers(const MomentGas& gas, const State& state, Rates& rates) const {
  const SootModelOptions& o = options_.soot;
  const Mode &n = state.nuclei, &l = state.large;
  double onNucleus = 0, onLarge = 0;  // collision rates of a dimer, 1/s
  if (gas.dimer.rate > 0 && o.condensation) {
    onNucleus =
        n.present * DimerModel::particleCollision(gas.dimer, gas.freeMolecular, n.particle, n.collisionDiameter);
    onLarge = l.present * DimerModel::particleCollision(gas.dimer, gas.freeMolecular, l.particle, l.collisionDiameter);
  }
  rates.dimers = chemistry_.dimerBalance(gas, onNucleus + onLarge);
  const DimerBalance& b = rates.dimers;
  if (!(b.number > 0)) return;
  const double carbonMass = b.atoms.carbon * o.carbonWeight, hydrogenMass = b.atoms.hydrogen * o.hydrogenWeight;
  rates.scalars[nuclei] += b.nucleation;
  rates.scalars[nucleiCarbon] += (1 - b.condensingShare) * carbonMass;
  rates.scalars[nucleiHydrogen] += (1 - b.condensingShare) * hydrogenMass;
  // Condensed matter is on large particles afterwards: a nucleus hit by a dimer is one.
  rates.scalars[carbon] += b.condensingShare * carbonMass;
  rates.scalars[hydrogen] += b.condensingShare * hydrogenMass;
  if (!(onNucleus + onLarge > 0)) return;
  const double volume = b.condensingShare * (carbonMass + hydrogenMass) / o.sootDensity;  // m3/m3/s
  if (onNucleus > 0) {
    const double hits = b.number * onNucleus / n.present;  // of one nucleus, 1/s
    rates.leaveNuclei(n, hits, true);
    rates.scalars[number] += hits * n.number;
    rates.scalars[surface] += hits * n.present * sphereSurface(n.volume + gas.dimer.mass / o.sootDensity);
  }
  const double onLargeVolume = volume * onLarge / (onNucleus + onLarge);
  rates.condensedOnLarge = onLargeVolume * o.sootDensity;
  rates.scalars[surface] += onLargeVolume * surfacePerVolume(l);
}

void HmomSoot::addSurface(const MomentGas& gas, const State& state, Rates& rates) const {
  const SootModelOptions& o = options_.soot;
  const Mode &n = state.nuclei, &l = state.large;
  const double areaOfNuclei = n.present * n.surface, areaOfLarge = l.present * l.surface;
  if (!(areaOfNuclei + areaOfLarge > leastArea)) return;
  const double atoms = (n.carbon + l.carbon) / o.carbonWeight * constants::avogadro;
  const double meanCarbon = atoms / (n.present + l.present);
  rates.onNuclei = chemistry_.events(gas, areaOfNuclei, meanCarbon);
  rates.onLarge = chemistry_.events(gas, areaOfLarge, meanCarbon);

  // Growth: a nucleus that has taken an acetylene is a large particle.
  const double perEvent = 2 * o.carbonWeight / constants::avogadro;  // kg
  if (areaOfNuclei > 0) {
    const double hits = rates.onNuclei.growth * constants::avogadro / n.present;  // 1/s
    rates.leaveNuclei(n, hits, true);
    rates.scalars[number] += hits * n.number;
    rates.scalars[surface] += hits * n.present * sphereSurface(n.volume + perEvent / o.sootDensity);
  }
  rates.scalars[carbon] += 2 * (rates.onNuclei.growth + rates.onLarge.growth) * o.carbonWeight;
  rates.scalars[surface] += 2 * rates.onLarge.growth * o.carbonWeight / o.sootDensity * surfacePerVolume(l);

  // Oxidation takes nuclei away as a whole.
  const auto oxidised = [&](const SurfaceEvents& e, double hydrogenToCarbon) {  // kg/m3/s
    return (2 * e.oxidationO2 + e.oxidationOH) * (o.carbonWeight + hydrogenToCarbon * o.hydrogenWeight);
  };
  if (n.mass > 0) {
    const double rate = oxidised(rates.onNuclei, n.hydrogenToCarbon) / n.mass;
    rates.burntOut -= rate * n.number;
    rates.scalars[nuclei] -= rate * n.number;
    const SootAtoms lost = MomentChemistry::lost(rates.onNuclei, n.hydrogenToCarbon);
    rates.scalars[nucleiCarbon] -= lost.carbon * o.carbonWeight;
    rates.scalars[nucleiHydrogen] -= lost.hydrogen * o.hydrogenWeight;
    rates.hydrogenLost += lost.hydrogen;
  }
  // Large particles shrink with their number of primaries; a share (nucleus/mean)^2 of the net loss
  // goes as a whole.
  if (l.mass > 0) {
    const double rate = oxidised(rates.onLarge, l.hydrogenToCarbon) / l.mass;
    const double q = nucleusMass_ / l.particle,
                 gained = rates.condensedOnLarge + 2 * rates.onLarge.growth * o.carbonWeight;
    const double share = q * q * netOxidation(oxidised(rates.onLarge, l.hydrogenToCarbon), gained);
    rates.burntOut -= share * rate * l.number;
    rates.scalars[number] -= share * rate * l.number;
    rates.scalars[surface] -= (share + (1 - share) * 2.0 / 3.0) * rate * std::min(state.surface, areaOfLarge) +
                              excessPace * rate * std::max(state.surface - areaOfLarge, 0.0);
    const SootAtoms lost = MomentChemistry::lost(rates.onLarge, l.hydrogenToCarbon);
    rates.scalars[carbon] -= lost.carbon * o.carbonWeight;
    rates.scalars[hydrogen] -= lost.hydrogen * o.hydrogenWeight;
    rates.hydrogenLost += lost.hydrogen;
  }
}

HmomSoot::Rates HmomSoot::evaluate(const MomentGas& gas, std::span<const double> densities) const {
  const State state = stateOf(densities);
  Rates rates;
  addCoagulation(gas, state, rates);
  addDimers(gas, state, rates);
  addSurface(gas, state, rates);
  return rates;
}

void HmomSoot::sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                       std::span<double> exchange) const {
  const MomentGas read = chemistry_.read(gas);
  const Rates r = evaluate(read, densities);
  std::copy(r.scalars.begin(), r.scalars.end(), rates.begin());
  const SurfaceEvents events{r.onNuclei.growth + r.onLarge.growth, r.onNuclei.oxidationO2 + r.onLarge.oxidationO2,
                             r.onNuclei.oxidationOH + r.onLarge.oxidationOH};
  chemistry_.exchange(read, r.dimers, events, r.hydrogenLost, exchange);
}

void HmomSoot::addSpheres(double count, double volume, std::span<double> densities) const {
  const double diameter = cubeRoot(6.0 / constants::pi * volume);
  densities[Scalar::number] += count;
  densities[carbon] += count * volume * options_.soot.sootDensity;
  densities[surface] += count * constants::pi * diameter * diameter;
}

}  // namespace lampblack::particles
