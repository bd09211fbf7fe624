#include "particles/models/moments/momic_soot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "particles/soot/soot_oxidation.hpp"

namespace lampblack::particles {
namespace {

// States of no population, in which iterates of Newton's method may be. Where soot has more than two hydrogen atoms to
// a carbon atom, mean particles of more than 1e12 nuclei (10 um), or a second difference of ln M_k outside [0, 12] (12:
// the ratio of masses in a mixture of two sizes is 6e5), the rates are those at the bound.
constexpr double largestHydrogenToCarbon = 2, largestInNuclei = 1e12, largestWidth = 12;
constexpr double negligible = 1e-60;  // kg/m3: no soot at all

// Variance of ln m that the law of burnout gives to a population of equal particles: the number then falls as the mass
// does when the mean particle is a nucleus.
constexpr double leastVariance = 1 / (2 * constants::pi);

constexpr double unitDiameter = 20e-9;  // m: the mass unit is the sphere's of this diameter

// Binomial coefficients.
constexpr double pascal[MomicSoot::most][MomicSoot::most] = {{1},          {1, 1},          {1, 2, 1},
                                                             {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {1, 5, 10, 10, 5, 1}};

}  // namespace

struct MomicSoot::State {
  bool any = false;
  double present = 0;               // 1/m3, the scalar, at least zero
  double number = 0;                // 1/m3, what the closure takes
  double mass = 0, carbon = 0;      // kg/m3
  double hydrogenToCarbon = 0;      // atoms
  Moments logarithms{}, moments{};  // of the closure, in units
  std::array<double, most> carried{};
  BrokenMoments broken;
  double meanDiameter = 0;  // m, of the sphere of the mean mass
};

struct MomicSoot::Rates {
  Moments moments{};  // of the number and of the moments above the first, 1/m3/s
  SootAtoms atoms;
  DimerBalance dimers;
  SurfaceEvents events;
  double hydrogenToCarbon = 0, hydrogenLost = 0;  // atoms; mol/m3/s
  double coagulated = 0, burntOut = 0;            // 1/m3/s
};

MomicSoot::MomicSoot(MomicOptions options)
    : options_(std::move(options)),
      chemistry_(options_.soot),
      broken_(options_.moments, -6, MomicCoagulation::highestOrder(options_.moments)),
      coagulation_({}, options_.moments, 1, options_.soot.sootDensity) {
  if (options_.moments < fewest || options_.moments > most) {
    throw InputError(fmt::format("soot: MOMIC works with {} to {} moments, not {}", fewest, most, options_.moments));
  }
  const SootModelOptions& o = options_.soot;
  unit_ = o.sootDensity * constants::pi / 6 * unitDiameter * unitDiameter * unitDiameter;
  unitDiameter_ = unitDiameter;
  nucleus_ = chemistry_.dimers().smallestNucleus() * o.carbonWeight / constants::avogadro / unit_;
  constexpr double typicalNumber = 1e16, typicalMass = 1e-3, typicalVariance = 1.5;  // of ln m
  scalars_ = {{"number", "1/m^3", "number of soot particles", typicalNumber},
              {"carbon", "kg/m^3", "carbon in soot", typicalMass, {{"C", 1}}},
              {"hydrogen", "kg/m^3", "hydrogen in soot", 0.01 * typicalMass, {{"H", 1}}}};
  for (std::size_t k = 2; k < options_.moments; ++k) {
    const double order = static_cast<double>(k), ratio = typicalMass / (typicalNumber * unit_);
    scalars_.push_back(
        {fmt::format("moment_{}", k), "1/m^3",
         fmt::format("sum of the particles' masses to the power {}, in units of {:.6e} kg", k, unit_),
         typicalNumber * std::pow(ratio, order) * std::exp(0.5 * typicalVariance * order * (order - 1))});
  }
}

MomicSoot::State MomicSoot::stateOf(std::span<const double> densities) const {
  const SootModelOptions& o = options_.soot;
  State s;
  s.present = std::max(densities[number], 0.0);
  s.carbon = std::max(densities[carbon], 0.0);
  if (!(s.carbon > negligible)) return s;
  s.any = true;
  const double perHydrogen = o.hydrogenWeight / o.carbonWeight;
  s.hydrogenToCarbon = std::clamp(densities[hydrogen] / (perHydrogen * s.carbon), 0.0, largestHydrogenToCarbon);
  s.mass = s.carbon * (1 + perHydrogen * s.hydrogenToCarbon);
  const double inUnits = s.mass / unit_, inNuclei = inUnits / nucleus_;
  s.number = std::clamp(s.present, inNuclei / largestInNuclei, inNuclei);
  Moments& L = s.logarithms;
  L[0] = std::log(s.number);
  L[1] = std::log(inUnits);
  for (std::size_t k = 2; k < options_.moments; ++k) {
    const double straight = 2 * L[k - 1] - L[k - 2];
    s.carried[k] = std::max(densities[higher + k - 2], 0.0);
    L[k] = std::clamp(std::log(std::max(s.carried[k], 1e-300)), straight, straight + largestWidth);
  }
  for (std::size_t k = 0; k < options_.moments; ++k) s.moments[k] = std::exp(L[k]);
  broken_.interpolateWithin({L.data(), options_.moments}, std::log(nucleus_), s.broken);
  s.meanDiameter = unitDiameter_ * std::cbrt(inUnits / s.number);
  return s;
}

void MomicSoot::addCoagulation(const MomentGas& gas, const State& state, Rates& rates) const {
  if (!options_.soot.coagulation) return;
  CollisionKernelOptions kernel;
  kernel.type = CollisionKernelType::transition;
  kernel.gas = gas.gas;
  kernel.enhancement = options_.soot.vanDerWaals;
  MomicCoagulation coagulation = coagulation_;
  coagulation.set(kernel, unit_ / options_.soot.sootDensity, options_.soot.sootDensity);
  std::array<double, MomentInterpolation::mostMoments> f{};
  coagulation.addRates(state.broken, f.data());
  const double excess = state.present / state.number;  // other than 1 in states of no population only
  rates.coagulated = f[0] * excess * excess;
  rates.moments[0] += rates.coagulated;
  for (std::size_t k = 2; k < options_.moments; ++k) rates.moments[k] += f[k];
}

// Collisions of a dimer (mass m_d, diameter d_d) with spheres: sqrt(1/m_d + 1/m) (d_d + d)^2 summed with m^l. With
// (1 + m_d/m)^j instead of the root it is a sum of moments for j = 0 and 1; the logarithm is interpolated to j = 1/2.
void MomicSoot::addDimers(const MomentGas& gas, const State& state, Rates& rates) const {
  const DimerProduction& dimer = gas.dimer;
  const std::size_t n = options_.moments;
  Moments collisions{};
  if (state.any && options_.soot.condensation && dimer.rate > 0) {
    const double md = dimer.mass / unit_, dd = dimer.diameter / unitDiameter_;
    const double prefactor = gas.freeMolecular * unitDiameter_ * unitDiameter_ / std::sqrt(dimer.mass);
    const BrokenMoments& M = state.broken;
    for (std::size_t l = 0; l + 1 < n; ++l) {
      const int at = 6 * static_cast<int>(l);
      const double heavy = dd * dd * M.at(at) + 2 * dd * M.at(at + 2) + M.at(at + 4);
      const double light = dd * dd * M.at(at - 6) + 2 * dd * M.at(at - 4) + M.at(at - 2);
      collisions[l] = prefactor * std::sqrt(heavy * (heavy + md * light));
    }
  }
  rates.dimers = chemistry_.dimerBalance(gas, collisions[0]);
  const DimerBalance& b = rates.dimers;
  if (!(b.number > 0)) return;
  rates.atoms.carbon += b.atoms.carbon;
  rates.atoms.hydrogen += b.atoms.hydrogen;
  rates.moments[0] += b.nucleation;
  const double nucleus = 2 * dimer.mass / unit_, step = dimer.mass / unit_;
  double power = nucleus;
  for (std::size_t k = 2; k < n; ++k) {
    power *= nucleus;
    rates.moments[k] += b.nucleation * power;
    double added = 1;  // step^(k-l)
    for (std::size_t l = k; l-- > 0;) {
      added *= step;
      rates.moments[k] += b.number * pascal[k][l] * added * collisions[l];
    }
  }
}

void MomicSoot::addSurface(const MomentGas& gas, const State& state, Rates& rates) const {
  if (!state.any) return;
  const SootModelOptions& o = options_.soot;
  const std::size_t n = options_.moments;
  const double perUnit = constants::pi * unitDiameter_ * unitDiameter_;  // m2 of a particle of mass 1
  const double area = perUnit * state.broken.at(4);
  const double meanCarbon = state.carbon / o.carbonWeight * constants::avogadro / state.number;
  rates.events = chemistry_.events(gas, area, meanCarbon);
  const SurfaceEvents& e = rates.events;
  rates.hydrogenToCarbon = state.hydrogenToCarbon;
  const SootAtoms lost = MomentChemistry::lost(e, state.hydrogenToCarbon);
  rates.hydrogenLost = lost.hydrogen;
  rates.atoms.carbon += 2 * e.growth - lost.carbon;
  rates.atoms.hydrogen -= lost.hydrogen;

  // A share of what oxidation takes more than particles gain takes whole particles.
  const double carbonWithHydrogen = o.carbonWeight + state.hydrogenToCarbon * o.hydrogenWeight;  // kg/mol of carbon
  const double oxidised = lost.carbon * carbonWithHydrogen;                                      // kg/m3/s
  const SootAtoms& dimers = rates.dimers.atoms;
  const double condensed =
      rates.dimers.condensingShare * (dimers.carbon * o.carbonWeight + dimers.hydrogen * o.hydrogenWeight);
  const auto& L = state.logarithms;
  const double width = L[0] + L[2] - 2 * L[1];
  const double above = std::max(0.0, L[1] - L[0] - 0.5 * width - std::log(nucleus_));
  const double share = std::exp(-0.5 * above * above / (width + leastVariance)) *
                       netOxidation(oxidised, condensed + 2 * e.growth * o.carbonWeight);
  const double removal = share * oxidised / state.mass;  // 1/s
  rates.burntOut = -removal * state.present;
  rates.moments[0] += rates.burntOut;

  // The others add or take the mass of one or two carbon atoms from a place on the surface.
  const double perMoment = constants::avogadro / state.broken.at(4);
  for (std::size_t k = 2; k < n; ++k) {
    const auto change = [&](double rate, double step) {
      double sum = 0, added = rate * perMoment;
      for (std::size_t l = k; l-- > 0;) {
        added *= step;
        sum += pascal[k][l] * added * state.broken.at(6 * static_cast<int>(l) + 4);
      }
      return sum;
    };
    const double atom = o.carbonWeight / constants::avogadro / unit_;
    const double sootAtom = carbonWithHydrogen / constants::avogadro / unit_;
    // What is taken is taken from what is there; the two differ in states of no population only.
    const double there = std::min(1.0, state.carried[k] / state.moments[k]);
    const double taken = (1 - share) * (change(e.oxidationO2, -2 * sootAtom) + change(e.oxidationOH, -sootAtom));
    rates.moments[k] += change(e.growth, 2 * atom) + there * taken - removal * state.carried[k];
  }
}

MomicSoot::Rates MomicSoot::evaluate(const MomentGas& gas, std::span<const double> densities) const {
  const State state = stateOf(densities);
  Rates rates;
  if (state.any) addCoagulation(gas, state, rates);
  addDimers(gas, state, rates);
  addSurface(gas, state, rates);
  return rates;
}

void MomicSoot::sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                        std::span<double> exchange) const {
  const MomentGas read = chemistry_.read(gas);
  const Rates r = evaluate(read, densities);
  rates[number] = r.moments[0];
  rates[carbon] = r.atoms.carbon * options_.soot.carbonWeight;
  rates[hydrogen] = r.atoms.hydrogen * options_.soot.hydrogenWeight;
  for (std::size_t k = 2; k < options_.moments; ++k) rates[higher + k - 2] = r.moments[k];
  chemistry_.exchange(read, r.dimers, r.events, r.hydrogenLost, exchange);
}

void MomicSoot::diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const {
  const double smallest = unitDiameter_ * std::cbrt(nucleus_);
  const double diffusivity = brownianDiffusivity(gas, std::max(stateOf(densities).meanDiameter, smallest));
  for (double& d : D) d = diffusivity;
}

ParticleProperties MomicSoot::properties(const ParticleGas& /*gas*/, std::span<const double> densities) const {
  const State s = stateOf(densities);
  ParticleProperties p;
  p.numberDensity = s.present;
  if (!s.any) return p;
  p.volumeFraction = s.mass / options_.soot.sootDensity;
  p.meanDiameter = p.primaryDiameter = p.mobilityDiameter = s.meanDiameter;
  p.gyrationDiameter = std::sqrt(0.6) * s.meanDiameter;
  p.surfaceArea = constants::pi * unitDiameter_ * unitDiameter_ * s.broken.at(4);
  p.primariesPerAggregate = 1;
  return p;
}

double MomicSoot::volumeFraction(std::span<const double> densities) const {
  return (std::max(densities[carbon], 0.0) + std::max(densities[hydrogen], 0.0)) / options_.soot.sootDensity;
}

ParticleProcesses MomicSoot::processes(const ParticleGas& gas, std::span<const double> densities) const {
  const MomentGas read = chemistry_.read(gas);
  const Rates r = evaluate(read, densities);
  ParticleProcesses p = MomentChemistry::processes(options_.soot, read, r.dimers, r.events, r.hydrogenToCarbon);
  p.coagulationNumber = r.coagulated;
  p.oxidationNumber = r.burntOut;
  return p;
}

SizeDistribution MomicSoot::sizeDistribution(std::span<const double> densities) const {
  constexpr int bins = 120;
  constexpr double from = -9.2, to = -6.0;  // log10(d/m)
  SizeDistribution distribution;
  for (int i = 0; i <= bins; ++i) distribution.diameter.push_back(std::pow(10.0, from + (to - from) * i / bins));
  distribution.density.assign(distribution.diameter.size(), 0.0);
  const State s = stateOf(densities);
  if (!s.any) return distribution;
  const double variance = s.logarithms[0] + s.logarithms[2] - 2 * s.logarithms[1];  // of ln m
  const double width = std::max(std::sqrt(variance) / 3, 0.02);                     // of ln d
  const double median = s.meanDiameter * std::exp(-variance / 6);
  for (std::size_t i = 0; i < distribution.diameter.size(); ++i) {
    const double z = std::log(distribution.diameter[i] / median) / width;
    distribution.density[i] =
        s.number * std::log(10.0) / (width * std::sqrt(2 * constants::pi)) * std::exp(-0.5 * z * z);
  }
  return distribution;
}

void MomicSoot::addSpheres(double count, double volume, std::span<double> densities) const {
  const double mass = volume * options_.soot.sootDensity;
  densities[Scalar::number] += count;
  densities[carbon] += count * mass;
  for (std::size_t k = 2; k < options_.moments; ++k)
    densities[higher + k - 2] += count * std::pow(mass / unit_, static_cast<double>(k));
}

}  // namespace lampblack::particles
