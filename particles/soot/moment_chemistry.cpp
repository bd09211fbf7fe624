#include "particles/soot/moment_chemistry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"

namespace lampblack {

MomentChemistry::MomentChemistry(const SootModelOptions& options)
    : options_(options), dimers_(options), species_{"H", "H2", "OH", "H2O", "O2", "C2H2", "CO"} {
  for (const PahSpecies& pah : options.pah) species_.push_back(pah.name);
}

MomentGas MomentChemistry::read(const SootGas& gas) const {
  if (!(gas.temperature > 0) || !(gas.pressure > 0) || !(gas.viscosity > 0) || !(gas.meanMolecularWeight > 0)) {
    throw NumericsError(fmt::format("soot: gas at T = {} K, p = {} Pa, viscosity {} Pa s, W = {} kg/mol",
                                    gas.temperature, gas.pressure, gas.viscosity, gas.meanMolecularWeight));
  }
  MomentGas read{{}, {}, SurfaceChemistry(options_, gas.temperature), {}, 0};
  SootGasState& state = read.state;
  state.temperature = gas.temperature;
  state.pressure = gas.pressure;
  state.density = gas.density;
  state.viscosity = gas.viscosity;
  state.meanMolecularWeight = gas.meanMolecularWeight;
  const auto amount = [&](std::size_t i) { return std::max(gas.concentrations[i], 0.0); };
  state.H = amount(H);
  state.H2 = amount(H2);
  state.OH = amount(OH);
  state.H2O = amount(H2O);
  state.O2 = amount(O2);
  state.C2H2 = amount(C2H2);
  const std::size_t n = dimers_.size();
  PahArray pah{};
  for (std::size_t i = 0; i < n; ++i) pah[i] = amount(fixedSpecies + i);
  dimers_.lossRates(gas.temperature, {pah.data(), n}, read.consumption);
  for (std::size_t i = 0; i < n; ++i) read.consumption[i] *= pah[i];
  read.dimer = dimers_.production(gas.temperature, {read.consumption.data(), n});
  read.freeMolecular = freeMolecularPrefactor(gas.temperature, options_.vanDerWaals);
  return read;
}

DimerBalance MomentChemistry::balance(const MomentGas& gas, double withParticles) const {
  DimerBalance b;
  const double self = options_.inception ? gas.dimer.selfCollision : 0;
  const double condensing = options_.condensation ? withParticles : 0;
  if (!(gas.dimer.rate > 0) || !(self + condensing > 0)) return b;
  b.number = steadyDimers(gas.dimer.rate, self, condensing);
  b.nucleation = 0.5 * self * b.number * b.number;
  b.condensingShare = condensing / (condensing + self * b.number);
  for (std::size_t i = 0; i < dimers_.size(); ++i) {
    b.atoms.carbon += dimers_.carbonAtoms(i) * gas.consumption[i];
    b.atoms.hydrogen += dimers_.hydrogenAtoms(i) * gas.consumption[i];
  }
  return b;
}

SurfaceEvents MomentChemistry::events(const MomentGas& gas, double area, double meanCarbonAtoms) const {
  const SurfaceRates rates = gas.surface.rates(gas.state, gas.surface.alpha(std::max(meanCarbonAtoms, 2.0)));
  return {rates.growth * area * gas.state.C2H2, rates.oxidationO2 * area * gas.state.O2,
          rates.oxidationOH * area * gas.state.OH};
}

void MomentChemistry::exchange(const MomentGas& gas, const DimerBalance& dimers, const SurfaceEvents& events,
                               double hydrogenLost, std::span<double> production) const {
  const double byO2 = events.oxidationO2, byOH = events.oxidationOH;
  production[H] = byOH;
  production[H2] = events.growth + 0.5 * hydrogenLost;
  production[OH] = -byOH;
  production[H2O] = 0;
  production[O2] = -byO2;
  production[C2H2] = -events.growth;
  production[CO] = 2 * byO2 + byOH;
  const bool consumes = dimers.number > 0;
  for (std::size_t i = 0; i < dimers_.size(); ++i) {
    production[fixedSpecies + i] = consumes ? -gas.consumption[i] : 0;
  }
}

SootProcesses MomentChemistry::processes(const SootModelOptions& options, const MomentGas& gas,
                                         const DimerBalance& dimers, const SurfaceEvents& events,
                                         double hydrogenToCarbon) {
  SootProcesses p;
  const double fromGas = dimers.atoms.carbon * options.carbonWeight + dimers.atoms.hydrogen * options.hydrogenWeight;
  const double perCarbon = options.carbonWeight + hydrogenToCarbon * options.hydrogenWeight;
  p.nucleationNumber = dimers.nucleation;
  p.nucleation = (1 - dimers.condensingShare) * fromGas;
  p.condensation = dimers.condensingShare * fromGas;
  p.growth = 2 * events.growth * options.carbonWeight;
  p.oxidationO2 = -2 * events.oxidationO2 * perCarbon;
  p.oxidationOH = -events.oxidationOH * perCarbon;
  p.dimerNumber = dimers.number;
  p.dimerProduction = gas.dimer.rate;
  return p;
}

double MomentChemistry::diffusivity(const SootGas& gas, double diameter) {
  const double knudsen =
      2 * meanFreePath({gas.temperature, gas.pressure, gas.viscosity, gas.meanMolecularWeight}) / diameter;
  return constants::boltzmann * gas.temperature / (3 * constants::pi * gas.viscosity * diameter) *
         slipCorrection(knudsen);
}

}  // namespace lampblack
