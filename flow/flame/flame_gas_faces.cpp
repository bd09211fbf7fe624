// The gas between the points: transport coefficients, where convection leans upstream, and fluxes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.hpp"
#include "flow/flame/flame_gas.hpp"

namespace lampblack::flow {

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
    multicomponent_->fluxMatrix(T, pressure_, meanX_, pairM_);
    double* G = &faces.pairs[f * n_ * n_];
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t l = 0; l < n_; ++l)
        G[k * n_ + l] = weights[k] * pairM_[k * n_ + l] / (constants::gasConstant * T * h);
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
// species; blended towards upwind beyond, in the manner of Spalding (1972). Species whose mass fraction is below 1e-5
// matter the less the less there is of them: they may swing about zero, by less than that.
double FlameGas::pecletNumber(double m, std::size_t f, double h) const {
  constexpr double matters = 1e-5;
  double cp = 0, slowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n_; ++k) {
    cp += meanY_[k] * faces.heat[f * n_ + k];
    if (meanY_[k] > 0) slowest = std::min(slowest, D_[k] * std::max(1.0, matters / meanY_[k]));
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
    const double lean = faces.lean(f, m);
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
  ParticleGas gas = carriedGas(x, upstreamPoint, carriedConcentrations_);
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

}  // namespace lampblack::flow
