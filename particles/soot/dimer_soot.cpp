#include "particles/soot/dimer_soot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"

namespace lampblack {
namespace {

// No mean particle of a flame is larger than this many nuclei (a sphere of some 10 um) or has more than two hydrogen
// atoms to a carbon atom. An iterate of Newton's method may; the rates are then those at the bound, which keeps their
// derivatives bounded.
constexpr double largestInNuclei = 1e12;
constexpr double largestHydrogenToCarbon = 2;

SootGasState stateOf(const SootGas& gas) {
  SootGasState state;
  state.temperature = gas.temperature;
  state.pressure = gas.pressure;
  state.density = gas.density;
  state.viscosity = gas.viscosity;
  state.meanMolecularWeight = gas.meanMolecularWeight;
  return state;
}

}  // namespace

DimerSoot::DimerSoot(SootModelOptions options)
    : model_(std::move(options)), species_{"H", "H2", "OH", "H2O", "O2", "C2H2", "CO"} {
  const SootModelOptions& o = model_.options();
  nucleusMass_ = model_.dimers().smallestNucleus() * o.carbonWeight / constants::avogadro;
  for (const PahSpecies& pah : o.pah) species_.push_back(pah.name);
  scalars_ = {{"number", "1/m3", "number of soot particles", 1e17, 0, 0},
              {"carbon", "kg/m3", "carbon in soot", 1e-3, 1, 0},
              {"hydrogen", "kg/m3", "hydrogen in soot", 1e-5, 0, 1}};
}

// The population whose rates are taken: the densities themselves in any state that soot can be in.
TwoEquationSoot::Population DimerSoot::populationOf(std::span<const double> densities) const {
  TwoEquationSoot::Population p;
  const SootModelOptions& o = model_.options();
  p.carbon = std::max(densities[carbon], 0.0);
  const double inNuclei = p.carbon / nucleusMass_;
  p.number = std::clamp(densities[number], inNuclei / largestInNuclei, inNuclei);
  p.hydrogen =
      std::clamp(densities[hydrogen], 0.0, largestHydrogenToCarbon * o.hydrogenWeight / o.carbonWeight * p.carbon);
  return p;
}

TwoEquationSoot::Sources DimerSoot::evaluate(const SootGas& gas, std::span<const double> densities) const {
  const TwoEquationSoot::Population population = populationOf(densities);
  SootGasState state = stateOf(gas);
  const auto& c = gas.concentrations;
  state.H = c[H];
  state.H2 = c[H2];
  state.OH = c[OH];
  state.H2O = c[H2O];
  state.O2 = c[O2];
  state.C2H2 = c[C2H2];
  state.pah = c.subspan(fixedSpecies);
  TwoEquationSoot::Sources s = model_.sources(state, population);

  // Equal spheres of shrinking size never vanish by themselves. The share of the number that goes with a share of the
  // mass is the square of the nucleus's mass over the mean mass: everything where the mean particle is a nucleus,
  // nothing where it is much larger.
  s.oxidationNumber = 0;
  const double present = std::max(densities[number], 0.0);
  if (population.carbon > 0) {
    const double carbonLost = (s.oxidationO2 + s.oxidationOH) * population.carbon / population.mass();
    const double inverseMean = population.number * nucleusMass_ / population.carbon;  // nuclei to a mean particle
    s.oxidationNumber = present / population.carbon * carbonLost * inverseMean * inverseMean;
  }
  const double excess = population.number > 0 ? present / population.number : 1;
  s.coagulationNumber *= excess * excess;
  s.number = s.nucleationNumber + s.coagulationNumber + s.oxidationNumber;
  return s;
}

void DimerSoot::sources(const SootGas& gas, std::span<const double> densities, std::span<double> rates,
                        std::span<double> exchange) const {
  const TwoEquationSoot::Sources s = evaluate(gas, densities);
  rates[number] = s.number;
  rates[carbon] = s.carbon;
  rates[hydrogen] = s.hydrogen;
  exchange[H] = s.H;
  exchange[H2] = s.H2;
  exchange[OH] = s.OH;
  exchange[H2O] = s.H2O;
  exchange[O2] = s.O2;
  exchange[C2H2] = s.C2H2;
  exchange[CO] = s.CO;
  for (std::size_t i = 0; i < model_.dimers().size(); ++i) exchange[fixedSpecies + i] = s.pah[i];
}

void DimerSoot::diffusivities(const SootGas& gas, std::span<const double> densities, std::span<double> D) const {
  std::fill(D.begin(), D.end(), model_.diffusivity(stateOf(gas), populationOf(densities)));
}

double DimerSoot::volumeFraction(std::span<const double> densities) const {
  return (std::max(densities[carbon], 0.0) + std::max(densities[hydrogen], 0.0)) / model_.options().sootDensity;
}

SootProperties DimerSoot::properties(const SootGas& /*gas*/, std::span<const double> densities) const {
  const TwoEquationSoot::Population p = populationOf(densities);
  SootProperties out;
  out.numberDensity = std::max(densities[number], 0.0);
  out.volumeFraction = volumeFraction(densities);
  out.meanDiameter = model_.meanDiameter(p);
  out.surfaceArea = model_.surfaceArea(p);
  out.primaryDiameter = out.meanDiameter;
  out.primariesPerAggregate = 1;
  out.mobilityDiameter = out.meanDiameter;
  out.gyrationDiameter = std::sqrt(0.6) * out.meanDiameter;  // of a solid sphere
  return out;
}

SootProcesses DimerSoot::processes(const SootGas& gas, std::span<const double> densities) const {
  const TwoEquationSoot::Sources s = evaluate(gas, densities);
  SootProcesses out;
  out.nucleationNumber = s.nucleationNumber;
  out.coagulationNumber = s.coagulationNumber;
  out.oxidationNumber = s.oxidationNumber;
  out.nucleation = s.nucleation;
  out.condensation = s.condensation;
  out.growth = s.growth;
  out.oxidationO2 = s.oxidationO2;
  out.oxidationOH = s.oxidationOH;
  out.dimerNumber = s.dimerNumber;
  for (std::size_t i = 0; i < model_.dimers().size(); ++i) out.dimerProduction -= 0.5 * constants::avogadro * s.pah[i];
  return out;
}

}  // namespace lampblack
