#include "particles/models/two_equation/dimer_soot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"

namespace lampblack::particles {
namespace {

// No soot has more hydrogen than this for a carbon atom; an iterate of Newton's method may, and counts as having it.
constexpr double largestHydrogenToCarbon = 2;

double nucleusOf(const TwoEquationSoot& model) {
  return model.dimers().smallestNucleus() * model.options().carbonWeight / constants::avogadro;  // kg of carbon
}

}  // namespace

DimerSoot::DimerSoot(SootModelOptions options)
    : model_(std::move(options)),
      spheres_(model_.options().sootDensity, nucleusOf(model_)),
      species_(sootSpecies(model_.options())) {
  scalars_ = {{"number", "1/m^3", "number of soot particles", 1e17},
              {"carbon", "kg/m^3", "carbon in soot", 1e-3, {{"C", 1}}},
              {"hydrogen", "kg/m^3", "hydrogen in soot", 1e-5, {{"H", 1}}}};
}

// The population whose rates are taken: the densities themselves in any state that soot can be in.
TwoEquationSoot::Population DimerSoot::populationOf(std::span<const double> densities) const {
  TwoEquationSoot::Population p;
  const SootModelOptions& o = model_.options();
  p.carbon = EqualSpheres::possibleMass(densities[number], densities[carbon]);
  p.number = spheres_.possibleNumber(densities[number], p.carbon);
  p.hydrogen =
      std::clamp(densities[hydrogen], 0.0, largestHydrogenToCarbon * o.hydrogenWeight / o.carbonWeight * p.carbon);
  return p;
}

TwoEquationSoot::Sources DimerSoot::evaluate(const ParticleGas& gas, std::span<const double> densities) const {
  const TwoEquationSoot::Population population = populationOf(densities);
  TwoEquationSoot::Sources s = model_.sources(gas, population);

  s.oxidationNumber = 0;
  const double present = std::max(densities[number], 0.0);
  if (population.carbon > 0) {
    const double carbonShare = population.carbon / population.mass();
    s.oxidationNumber =
        -spheres_.burntOut(present, population.number, population.carbon,
                           -carbonShare * (s.oxidationO2 + s.oxidationOH), carbonShare * (s.growth + s.condensation));
  }
  const double excess = population.number > 0 ? present / population.number : 1;
  s.coagulationNumber *= excess * excess;
  s.number = s.nucleationNumber + s.coagulationNumber + s.oxidationNumber;
  return s;
}

void DimerSoot::sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                        std::span<double> exchange) const {
  const TwoEquationSoot::Sources s = evaluate(gas, densities);
  rates[number] = s.number;
  rates[carbon] = s.carbon;
  rates[hydrogen] = s.hydrogen;
  std::copy_n(s.gas.begin(), species_.size(), exchange.begin());
}

void DimerSoot::diffusivities(const ParticleGas& gas, std::span<const double> densities, std::span<double> D) const {
  std::fill(D.begin(), D.end(), model_.diffusivity(gas, populationOf(densities)));
}

double DimerSoot::volumeFraction(std::span<const double> densities) const {
  return (std::max(densities[carbon], 0.0) + std::max(densities[hydrogen], 0.0)) / model_.options().sootDensity;
}

ParticleProperties DimerSoot::properties(const ParticleGas& /*gas*/, std::span<const double> densities) const {
  const TwoEquationSoot::Population p = populationOf(densities);
  ParticleProperties out = spheres_.properties(p.number, p.mass());
  out.numberDensity = std::max(densities[number], 0.0);
  out.volumeFraction = volumeFraction(densities);
  return out;
}

ParticleProcesses DimerSoot::processes(const ParticleGas& gas, std::span<const double> densities) const {
  const TwoEquationSoot::Sources s = evaluate(gas, densities);
  ParticleProcesses out;
  out.nucleationNumber = s.nucleationNumber;
  out.coagulationNumber = s.coagulationNumber;
  out.oxidationNumber = s.oxidationNumber;
  out.nucleation = s.nucleation;
  out.condensation = s.condensation;
  out.growth = s.growth;
  out.oxidationO2 = s.oxidationO2;
  out.oxidationOH = s.oxidationOH;
  out.dimerNumber = s.dimerNumber;
  for (std::size_t i = 0; i < model_.dimers().size(); ++i)
    out.dimerProduction -= 0.5 * constants::avogadro * s.gas[SootSpecies::fixed + i];
  return out;
}

void DimerSoot::addSpheres(double count, double volume, std::span<double> densities) const {
  densities[Scalar::number] += count;
  densities[carbon] += count * volume * model_.options().sootDensity;
}

}  // namespace lampblack::particles
