// The gas at the points: composition, sources, and what is exchanged there.
#include "flow/flame/flame_gas.hpp"

#include <algorithm>

#include "core/constants.hpp"

namespace lampblack::flow {
FlameGas::FlameGas(const Mechanism& mechanism, const FlameProblem& problem, CarriedModel* carried)
    : weights(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()),
      n_(mechanism.numSpecies()),
      pressure_(problem.pressure),
      options_(problem.transport),
      carried_(carried),
      thermo_(mechanism.allSpecies()),
      transport_(mechanism, problem.transport.averaged()),
      kinetics_(mechanism) {
  if (problem.transport.isMulticomponent()) multicomponent_.emplace(mechanism, problem.transport.integrals);
  massBasis_ = problem.transport.hasLewisNumbers();
  if (problem.radiation.on) radiation_.emplace(mechanism, problem.radiation.surroundings);
  if (carried_ != nullptr) {
    for (const auto& scalar : carried_->scalars()) {
      scalarElements.push_back(scalar.elements);
      scalarScale.push_back(scalar.scale);
      scalarThermophoresis.push_back(scalar.thermophoresis);
    }
    const std::size_t m = carried_->exchanged().size();
    densities_.resize(scalarScale.size());
    carriedRates_.resize(scalarScale.size());
    carriedD_.resize(scalarScale.size());
    carriedConcentrations_.resize(m);
    carriedExchange_.resize(m);
  }
  meanX_.resize(n_);
  meanY_.resize(n_);
  D_.resize(n_);
  if (multicomponent_) pairM_.resize(n_ * n_);
}

void FlameGas::resize(std::size_t points) {
  const std::size_t s = scalarScale.size(), last = points - 1;
  for (auto* v : {&nodes.density, &nodes.weight, &nodes.cp, &nodes.exchanged, &nodes.absorption, &nodes.loss})
    v->assign(points, 0);
  for (auto* v : {&nodes.X, &nodes.enthalpy, &nodes.heat, &nodes.source}) v->assign(points * n_, 0);
  for (auto* v : {&nodes.scalarRate, &nodes.scalarEnthalpy, &nodes.scalarHeat}) v->assign(points * s, 0);
  for (auto* v :
       {&faces.viscosity, &faces.conductivity, &faces.drift, &faces.upwind, &faces.temperature, &faces.excess})
    v->assign(last, 0);
  for (auto* v : {&faces.conductance, &faces.thermal, &faces.diffusion, &faces.flux, &faces.enthalpy, &faces.heat})
    v->assign(last * n_, 0);
  for (auto* v :
       {&faces.scalarFlux, &faces.scalarLift, &faces.scalarConductance, &faces.scalarEnthalpy, &faces.scalarHeat})
    v->assign(last * s, 0);
  if (multicomponent_) faces.pairs.assign(last * n_ * n_, 0);
}

void FlameGas::composition(const FlameProfile& x, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const auto Y = x.massFractions(i);
    double moles = 0;
    for (std::size_t k = 0; k < n_; ++k) moles += Y[k] / weights[k];
    const double W = 1 / moles;
    nodes.weight[i] = W;
    nodes.density[i] = pressure_ * W / (constants::gasConstant * x.temperature(i));
    double* X = &nodes.X[i * n_];
    for (std::size_t k = 0; k < n_; ++k) X[k] = Y[k] * W / weights[k];
  }
}

void FlameGas::speciesEnthalpies(double T, double* h, double* cp) const {
  thermo_.enthalpyOverRT(T, h);
  thermo_.cpOverR(T, cp);
  for (std::size_t k = 0; k < n_; ++k) {
    const double R = constants::gasConstant / weights[k];
    h[k] *= R * T;
    cp[k] *= R;
  }
}

void FlameGas::heatCapacities(const FlameProfile& x) {
  for (std::size_t i = 0; i < x.points(); ++i) {
    thermo_.cpOverR(x.temperature(i), D_.data());
    const auto Y = x.massFractions(i);
    nodes.cp[i] = 0;
    for (std::size_t k = 0; k < n_; ++k) nodes.cp[i] += Y[k] * D_[k] * constants::gasConstant / weights[k];
  }
}

void FlameGas::sources(const FlameProfile& x, std::size_t begin, std::size_t end, const GivenExchange* exchange) {
  if (begin >= end) return;
  const std::size_t count = end - begin;
  temperatures_.resize(count);
  concentrations_.resize(count * n_);
  rates_.resize(count * n_);
  for (std::size_t i = begin; i < end; ++i) {
    temperatures_[i - begin] = x.temperature(i);
    const auto Y = x.massFractions(i);
    for (std::size_t k = 0; k < n_; ++k) concentrations_[k * count + i - begin] = nodes.density[i] * Y[k] / weights[k];
  }
  kinetics_.netProductionRates(temperatures_, concentrations_, rates_, count);
  for (std::size_t i = begin; i < end; ++i) {
    const double T = x.temperature(i);
    const auto Y = x.massFractions(i);
    double* h = &nodes.enthalpy[i * n_];
    double* cp = &nodes.heat[i * n_];
    speciesEnthalpies(T, h, cp);
    double* source = &nodes.source[i * n_];
    nodes.cp[i] = 0;
    for (std::size_t k = 0; k < n_; ++k) {
      nodes.cp[i] += Y[k] * cp[k];
      source[k] = rates_[k * count + i - begin] * weights[k];
    }
    nodes.exchanged[i] = nodes.absorption[i] = nodes.loss[i] = 0;
    if (carried_ != nullptr) addCarried(x, i);
    if (exchange != nullptr) addExchange(x, i, *exchange);
    if (radiation_) {
      nodes.absorption[i] += radiation_->absorption(T, pressure_, {&nodes.X[i * n_], n_});
      nodes.loss[i] += radiation_->loss(nodes.absorption[i], T);
    }
  }
}

double FlameGas::lossSlope(const FlameProfile& x, std::size_t i) const {
  return radiation_ ? radiation_->lossSlope(nodes.absorption[i], x.temperature(i)) : 0;
}

ParticleGas FlameGas::carriedGas(const FlameProfile& x, std::size_t i, std::vector<double>& storage) {
  const auto& species = carried_->exchanged();
  storage.resize(species.size());
  const double rho = nodes.density[i];
  const auto Y = x.massFractions(i);
  for (std::size_t e = 0; e < species.size(); ++e) storage[e] = rho * Y[species[e]] / weights[species[e]];
  // The mean of the faces beside it: the viscosity is needed for drag only.
  const std::size_t last = faces.viscosity.size();
  const double mu = i == 0      ? faces.viscosity[0]
                    : i == last ? faces.viscosity[last - 1]
                                : 0.5 * (faces.viscosity[i - 1] + faces.viscosity[i]);
  return {{x.temperature(i), pressure_, rho, mu, nodes.weight[i]}, storage};
}

void FlameGas::densities(const FlameProfile& x, std::size_t i, std::span<double> out) const {
  const auto scalars = x.scalars(i);
  for (std::size_t s = 0; s < out.size(); ++s) out[s] = scalars[s] * scalarScale[s] * nodes.density[i];
}

void FlameGas::scalarSources(const FlameProfile& x, std::size_t i) {
  const ParticleGas gas = carriedGas(x, i, carriedConcentrations_);
  densities(x, i, densities_);
  carried_->sources(gas, densities_, carriedRates_, carriedExchange_);
  std::copy(carriedRates_.begin(), carriedRates_.end(), nodes.scalarRate.begin() + i * scalarScale.size());
}

void FlameGas::addCarried(const FlameProfile& x, std::size_t i) {
  const std::size_t S = scalarScale.size();
  scalarSources(x, i);
  const auto& species = carried_->exchanged();
  for (std::size_t e = 0; e < species.size(); ++e) {
    const double rate = carriedExchange_[e] * weights[species[e]];
    nodes.source[i * n_ + species[e]] += rate;
    nodes.exchanged[i] += rate;
  }
  carried_->enthalpies(x.temperature(i), {&nodes.scalarEnthalpy[i * S], S}, {&nodes.scalarHeat[i * S], S});
  if (radiation_) nodes.absorption[i] += carried_->absorption(x.temperature(i), densities_);
}

void FlameGas::addExchange(const FlameProfile& x, std::size_t i, const GivenExchange& exchange) {
  const GivenExchange::Sample given = exchange.at(x.z[i]);
  for (std::size_t k = 0; k < n_; ++k) {
    const double rate = given.species(k);
    nodes.source[i * n_ + k] += rate;
    nodes.exchanged[i] += rate;
  }
  nodes.absorption[i] += given.absorption();
  nodes.loss[i] -= given.enthalpy();
}

}  // namespace lampblack::flow
