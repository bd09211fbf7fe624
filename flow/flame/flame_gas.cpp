#include "flow/flame/flame_gas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.hpp"

namespace lampblack {
namespace {

TransportOptions transportOptions(const FlameTransport& flame) {
  TransportOptions options;
  options.integrals = flame.integrals;
  if (flame.model == FlameTransport::Model::UnityLewis) options.diffusion = DiffusionModel::UnityLewis;
  if (flame.model == FlameTransport::Model::ConstantLewis) {
    options.diffusion = DiffusionModel::ConstantLewis;
    options.lewisNumbers = flame.lewisNumbers;
  }
  return options;
}

}  // namespace

FlameGas::FlameGas(const Mechanism& mechanism, const FlameProblem& problem, CarriedModel* carried)
    : weights(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()),
      n_(mechanism.numSpecies()),
      pressure_(problem.pressure),
      options_(problem.transport),
      carried_(carried),
      thermo_(mechanism.allSpecies()),
      transport_(mechanism, transportOptions(problem.transport)),
      kinetics_(mechanism) {
  if (problem.transport.model == FlameTransport::Model::Multicomponent)
    multicomponent_.emplace(mechanism, problem.transport.integrals);
  massBasis_ = problem.transport.model == FlameTransport::Model::UnityLewis ||
               problem.transport.model == FlameTransport::Model::ConstantLewis;
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
  if (multicomponent_) pairD_.resize(n_ * n_);
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

CarriedGas FlameGas::carriedGas(const FlameProfile& x, std::size_t i, std::vector<double>& storage) {
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
  return {x.temperature(i), pressure_, rho, mu, nodes.weight[i], storage};
}

void FlameGas::densities(const FlameProfile& x, std::size_t i, std::span<double> out) const {
  const auto scalars = x.scalars(i);
  for (std::size_t s = 0; s < out.size(); ++s) out[s] = scalars[s] * scalarScale[s] * nodes.density[i];
}

void FlameGas::scalarSources(const FlameProfile& x, std::size_t i) {
  const CarriedGas gas = carriedGas(x, i, carriedConcentrations_);
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
  const auto& z = exchange.z;
  const double at = x.z[i];
  if (z.empty() || at < z.front() || at > z.back()) return;
  const std::size_t upper =
      std::clamp<std::size_t>(std::upper_bound(z.begin(), z.end(), at) - z.begin(), 1, z.size() - 1);
  const double share = (at - z[upper - 1]) / (z[upper] - z[upper - 1]);
  const auto between = [&](const std::vector<double>& v, std::size_t stride, std::size_t k) {
    return (1 - share) * v[(upper - 1) * stride + k] + share * v[upper * stride + k];
  };
  for (std::size_t k = 0; k < n_; ++k) {
    const double rate = between(exchange.species, n_, k);
    nodes.source[i * n_ + k] += rate;
    nodes.exchanged[i] += rate;
  }
  nodes.absorption[i] += between(exchange.absorption, 1, 0);
  nodes.loss[i] -= between(exchange.enthalpy, 1, 0);
}

void FlameGas::evaluateCoefficients(double T, std::size_t f, double h) {
  double moles = 0;
  for (std::size_t k = 0; k < n_; ++k) moles += meanX_[k] = meanY_[k] / weights[k];
  const double W = 1 / moles;
  meanMoles_ = moles;
  for (double& value : meanX_) value *= W;
  const double molarDensity = pressure_ / (constants::gasConstant * T);
  double* a = &faces.conductance[f * n_];
  double* thermal = &faces.thermal[f * n_];
  const Transport::Mixture mixture = transport_.mixture(T, pressure_, meanX_, D_);
  faces.viscosity[f] = mixture.viscosity;
  faces.conductivity[f] = mixture.conductivity;
  faces.temperature[f] = T;
  if (multicomponent_) {
    const auto full = multicomponent_->mixture(T, pressure_, meanX_, {thermal, n_});
    faces.conductivity[f] = full.conductivity;
    if (!options_.soret) std::fill(thermal, thermal + n_, 0.0);
    multicomponent_->diffusion(T, pressure_, meanX_, pairD_);
    double* G = &faces.pairs[f * n_ * n_];
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t l = 0; l < n_; ++l)
        G[k * n_ + l] = molarDensity * weights[k] * weights[l] * pairD_[k * n_ + l] / (W * h);
    return;
  }
  const double rho = molarDensity * W;
  for (std::size_t k = 0; k < n_; ++k) a[k] = (massBasis_ ? rho : molarDensity * weights[k]) * D_[k] / h;
  if (options_.soret) transport_.thermalDiffusion(T, pressure_, meanX_, {thermal, n_});
}

void FlameGas::scaleCoefficients(double T, std::size_t f) {
  const double factor = std::pow(T / faces.temperature[f], conductanceExponent);
  faces.temperature[f] = T;
  faces.viscosity[f] *= factor;
  faces.conductivity[f] *= factor;
  for (std::size_t k = f * n_; k < (f + 1) * n_; ++k) {
    faces.conductance[k] *= factor;
    faces.thermal[k] *= factor;
  }
  if (multicomponent_)
    for (std::size_t k = f * n_ * n_; k < (f + 1) * n_ * n_; ++k) faces.pairs[k] *= factor;
}

// Central where diffusion smooths over a spacing, Pe = |m| h / (rho D) < 2 with the slowest that matters, heat or a
// species of more than a per mille; blended towards upwind beyond, in the manner of Spalding (1972).
double FlameGas::pecletNumber(double m, std::size_t f, double h) const {
  constexpr double abundant = 1e-3;
  double cp = 0, slowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n_; ++k) {
    cp += meanY_[k] * faces.heat[f * n_ + k];
    if (meanX_[k] > abundant) slowest = std::min(slowest, D_[k]);
  }
  const double rho = pressure_ / (constants::gasConstant * faces.temperature[f] * meanMoles_);
  return std::abs(m) * h / std::min(rho * slowest, faces.conductivity[f] / cp);
}

void FlameGas::coefficients(const FlameProfile& x, std::size_t f, double h) {
  const double T = 0.5 * (x.temperature(f) + x.temperature(f + 1));
  const auto Yl = x.massFractions(f), Yr = x.massFractions(f + 1);
  for (std::size_t k = 0; k < n_; ++k) meanY_[k] = 0.5 * (Yl[k] + Yr[k]);
  double* hk = &faces.enthalpy[f * n_];
  double* cpk = &faces.heat[f * n_];
  speciesEnthalpies(T, hk, cpk);
  if (frozen)
    scaleCoefficients(T, f);
  else
    evaluateCoefficients(T, f, h);
  faces.drift[f] = -faces.viscosity[f] * (x.temperature(f + 1) - x.temperature(f)) / (h * T);
}

void FlameGas::chooseBlend(const FlameProfile& x) {
  for (std::size_t f = 0; f + 1 < x.points(); ++f) {
    const double h = x.z[f + 1] - x.z[f];
    coefficients(x, f, h);
    const double peclet = pecletNumber(x.at(f, FlameLayout::massFlux), f, h);
    faces.upwind[f] = peclet > 2 ? 1 - 2 / peclet : 0;
  }
  chooseScalarValues(x);
}

// Van Leer's (1974) limited slope at the upstream point, over its value: the value of the face is then between those of
// its points, and its equation linear with positive coefficients.
void FlameGas::chooseScalarValues(const FlameProfile& x) {
  const std::size_t S = scalarScale.size(), last = x.points() - 1;
  for (std::size_t f = 0; f < last; ++f)
    for (std::size_t s = 0; s < S; ++s) {
      const double w = x.at(f, FlameLayout::massFlux) + scalarThermophoresis[s] * faces.drift[f];
      const std::size_t near = w > 0 ? f : f + 1, far = w > 0 ? f + 1 : f;
      double& lift = faces.scalarLift[f * S + s];
      lift = 0;
      const double value = x.scalars(near)[s];
      if (near == 0 || near == last || value <= 0) continue;
      const std::size_t behind = w > 0 ? near - 1 : near + 1;
      const double rise = (value - x.scalars(behind)[s]) / std::abs(x.z[near] - x.z[behind]);
      const double ahead = (x.scalars(far)[s] - value) / std::abs(x.z[far] - x.z[near]);
      if (rise * ahead <= 0) continue;
      const double slope = 2 * rise * ahead / (rise + ahead);
      lift = std::clamp(0.5 * slope * std::abs(x.z[far] - x.z[near]) / value, -1.0, 1.0);
    }
}

void FlameGas::diffusiveFluxes(const FlameProfile& x, std::size_t f, double h) {
  const double Tl = x.temperature(f), Tr = x.temperature(f + 1);
  double* j = &faces.diffusion[f * n_];
  if (multicomponent_) {
    const double* G = &faces.pairs[f * n_ * n_];
    for (std::size_t l = 0; l < n_; ++l) meanX_[l] = nodes.X[(f + 1) * n_ + l] - nodes.X[f * n_ + l];
    for (std::size_t k = 0; k < n_; ++k) {
      double sum = 0;
      for (std::size_t l = 0; l < n_; ++l) sum += G[k * n_ + l] * meanX_[l];
      j[k] = sum;
    }
  } else {
    const double* a = &faces.conductance[f * n_];
    const double* left = massBasis_ ? x.massFractions(f).data() : &nodes.X[f * n_];
    const double* right = massBasis_ ? x.massFractions(f + 1).data() : &nodes.X[(f + 1) * n_];
    for (std::size_t k = 0; k < n_; ++k) j[k] = -a[k] * (right[k] - left[k]);
  }
  if (options_.soret) {
    const double gradient = (Tr - Tl) / (h * 0.5 * (Tl + Tr));
    const double* thermal = &faces.thermal[f * n_];
    for (std::size_t k = 0; k < n_; ++k) j[k] -= thermal[k] * gradient;
  }
  double sum = 0;
  for (std::size_t k = 0; k < n_; ++k) sum += j[k];
  faces.excess[f] = sum;
  for (std::size_t k = 0; k < n_; ++k) j[k] -= meanY_[k] * sum;
}

void FlameGas::fluxes(const FlameProfile& x, std::size_t begin, std::size_t end) {
  const std::size_t S = scalarScale.size();
  for (std::size_t f = begin; f < end; ++f) {
    const double h = x.z[f + 1] - x.z[f];
    coefficients(x, f, h);
    diffusiveFluxes(x, f, h);
    const double m = x.at(f, FlameLayout::massFlux);
    const double lean = m > 0 ? 0.5 * faces.upwind[f] : -0.5 * faces.upwind[f];
    const auto Yl = x.massFractions(f), Yr = x.massFractions(f + 1);
    for (std::size_t k = 0; k < n_; ++k) {
      const double face = (0.5 + lean) * Yl[k] + (0.5 - lean) * Yr[k];
      faces.flux[f * n_ + k] = m * face + faces.diffusion[f * n_ + k];
    }
    // Enthalpy is convected with the temperature of the same face value.
    if (lean != 0) {
      const double T = (0.5 + lean) * x.temperature(f) + (0.5 - lean) * x.temperature(f + 1);
      speciesEnthalpies(T, &faces.enthalpy[f * n_], &faces.heat[f * n_]);
    }
    if (carried_ == nullptr) continue;
    const double T = 0.5 * (x.temperature(f) + x.temperature(f + 1));
    carried_->enthalpies(T, {&faces.scalarEnthalpy[f * S], S}, {&faces.scalarHeat[f * S], S});
    scalarFluxes(x, f);
  }
}

// Particles hardly diffuse: the value from upstream, by the sum of the gas's and the thermophoretic mass flux, and a
// part of it for its slope.
void FlameGas::scalarFluxes(const FlameProfile& x, std::size_t f) {
  const std::size_t S = scalarScale.size();
  const double h = x.z[f + 1] - x.z[f], m = x.at(f, FlameLayout::massFlux);
  const std::size_t upstreamPoint = m > 0 ? f : f + 1;
  const double T = 0.5 * (x.temperature(f) + x.temperature(f + 1));
  const double W = 0.5 * (nodes.weight[f] + nodes.weight[f + 1]);
  const double rho = pressure_ * W / (constants::gasConstant * T);
  CarriedGas gas = carriedGas(x, upstreamPoint, carriedConcentrations_);
  gas.temperature = T;
  gas.density = rho;
  gas.viscosity = faces.viscosity[f];
  gas.meanMolecularWeight = W;
  densities(x, upstreamPoint, densities_);
  carried_->diffusivities(gas, densities_, carriedD_);
  for (std::size_t s = 0; s < S; ++s) {
    const double w = m + scalarThermophoresis[s] * faces.drift[f];
    const double left = x.scalars(f)[s] * scalarScale[s], right = x.scalars(f + 1)[s] * scalarScale[s];
    const double a = rho * carriedD_[s] / h;
    faces.scalarConductance[f * S + s] = a;
    faces.scalarFlux[f * S + s] = w * (1 + faces.scalarLift[f * S + s]) * (w > 0 ? left : right) - a * (right - left);
  }
}

}  // namespace lampblack
