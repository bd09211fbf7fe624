// Analytic derivatives of the net production rates.
#include <algorithm>
#include <cmath>

#include "chemistry/kinetics.hpp"

namespace lampblack {

namespace {

constexpr double kLn10 = 2.30258509299404568402;
constexpr double kTiny = 1e-300;

}  // namespace

// d progress / d concentration of each slot, the factor ([M] or fall-off) held constant.
void Kinetics::slotDerivatives() {
  const double* __restrict c = c_.data();
  const double* __restrict factor = factor_.data();
  for (const bool isForward : {true, false}) {
    const auto& slots = isForward ? tables_.reactant : tables_.product;
    const std::size_t count = isForward ? tables_.numReactions : tables_.numReversible;
    const double sign = isForward ? 1.0 : -1.0;
    const double* __restrict k = isForward ? kf_.data() : kr_.data();
    const std::int32_t* __restrict s0 = slots[0].data(), * __restrict s1 = slots[1].data(), * __restrict s2 = slots[2].data();
    double* __restrict d0 = derivatives_.data() + (isForward ? 0 : 3) * tables_.numReactions;
    double* __restrict d1 = d0 + tables_.numReactions;
    double* __restrict d2 = d1 + tables_.numReactions;
    for (std::size_t i = 0; i < count; ++i) {
      const double rate = sign * factor[i] * k[i];
      const double c0 = c[s0[i]], c1 = c[s1[i]], c2 = c[s2[i]];
      d0[i] = rate * c1 * c2;
      d1[i] = rate * c0 * c2;
      d2[i] = rate * c0 * c1;
    }
  }
}

void Kinetics::generalDerivatives() {
  std::size_t at = 6 * tables_.numReactions;
  for (const auto& general : tables_.general) {
    const auto i = general.reaction;
    for (const bool isForward : {true, false}) {
      const auto& orders = isForward ? general.forwardOrders : general.reverseOrders;
      for (const auto& term : orders) {
        double d = (isForward ? kf_[i] : -kr_[i]) * factor_[i] * term.coefficient *
                   power(c_[term.species], term.coefficient - 1);
        for (const auto& other : orders)
          if (other.species != term.species) d *= power(c_[other.species], other.coefficient);
        derivatives_[at++] = std::isfinite(d) ? d : 0.0;  // an order below one at zero concentration has no slope
      }
    }
  }
}

// The fall-off factor Pr/(1+Pr) F and its partial derivatives with respect to [M] and T.
Kinetics::FalloffDerivatives Kinetics::falloffDerivatives(std::size_t i, double T) const {
  const auto& f = tables_.falloff;
  const std::size_t n = f.reaction.size(), r = f.reaction[i];
  const double Pr = std::max(lowOverHigh_[i] * M_[f.set[i]], kTiny);
  const double lnFcent = lnFcent_[i], logFcent = lnFcent / kLn10;
  const double u = std::log10(Pr) - 0.4 - 0.67 * logFcent;
  const double d = 0.75 - 1.27 * logFcent - 0.14 * u;
  const double shape = u / d, spread = 1.0 + shape * shape;
  const double lnF = lnFcent / spread;
  const double F = std::exp(lnF);
  const double lnFByShape = -2.0 * lnFcent * shape / (spread * spread);
  const double lnFByLnPr = lnFByShape * (0.75 - 1.27 * logFcent) / (d * d) / kLn10;
  const double shapeByLogFcent = (-0.67 * d - u * (-1.27 + 0.14 * 0.67)) / (d * d);
  const double lnFByLnFcent = 1.0 / spread + lnFByShape * shapeByLogFcent / kLn10;
  const double centre = std::exp(lnFcent);
  const double centreByT = centre > 2 * kTiny ? -f.w3[i] * f.inverseT3[i] * troeTerms_[i] -
                                                    f.w1[i] * f.inverseT1[i] * troeTerms_[n + i] +
                                                    f.w2[i] * f.T2[i] / (T * T) * troeTerms_[2 * n + i]
                                              : 0.0;
  const double lnPrByT = (f.b[i] - tables_.b[r]) / T + (f.Ta[i] - tables_.Ta[r]) / (T * T);
  const double lnFactorByLnPr = 1.0 / (1.0 + Pr) + lnFByLnPr;
  FalloffDerivatives result;
  result.value = Pr / (1.0 + Pr) * F;
  result.byM = lowOverHigh_[i] / (1.0 + Pr) * F * lnFactorByLnPr;
  result.byT = result.value * (lnFactorByLnPr * lnPrByT + lnFByLnFcent * centreByT / centre);
  return result;
}

// What the collision efficiencies add to the columns of the Jacobian, and factorByT_.
void Kinetics::thirdBodyDerivatives(double T, double* jacobian, std::size_t ld) {
  for (std::size_t s = 0; s < tables_.sets.size(); ++s) {
    std::fill(setColumn_.begin(), setColumn_.end(), 0.0);
    const auto add = [&](std::size_t i, double factorByM) {
      const double slope = factorByM * (forward_[i] - reverse_[i]);
      for (const auto& term : tables_.netTerms[i]) setColumn_[term.species] += term.coefficient * slope;
    };
    for (const auto& use : tables_.threeBody)
      if (use.set == s) add(use.reaction, 1.0);
    for (std::size_t i = 0; i < tables_.falloff.reaction.size(); ++i) {
      if (tables_.falloff.set[i] != s) continue;
      const auto derivatives = falloffDerivatives(i, T);
      add(tables_.falloff.reaction[i], derivatives.byM);
      factorByT_[tables_.falloff.reaction[i]] = derivatives.byT;
    }
    const double* __restrict column = setColumn_.data();
    for (std::size_t j = 0; j < tables_.numSpecies; ++j) {
      const double efficiency = tables_.sets[s].efficiencies[j];
      if (efficiency == 0) continue;
      double* __restrict out = jacobian + j * ld;
      for (std::size_t k = 0; k < tables_.numSpecies; ++k) out[k] += efficiency * column[k];
    }
  }
}

// d ln kf/dT = b/T + Ta/T^2; d ln Kc/dT = sum nu h/RT / T - sum nu / T (van 't Hoff). Leaves d progress/dT in
// progress_.
void Kinetics::progressTemperatureDerivatives(double T) {
  thermo_.enthalpyOverRT(T, enthalpy_.data());
  const double inverseT = 1.0 / T;
  const double* __restrict h = enthalpy_.data();
  for (std::size_t i = 0; i < tables_.numReactions; ++i) {
    const double lnkfByT = (tables_.b[i] + tables_.Ta[i] * inverseT) * inverseT;
    double byT = forward_[i] * lnkfByT;
    if (i < tables_.numReversible) {
      double reactionEnthalpy = 0;
      for (std::size_t s = 0; s < 3; ++s) reactionEnthalpy += h[tables_.product[s][i]] - h[tables_.reactant[s][i]];
      byT -= reverse_[i] * (lnkfByT - (reactionEnthalpy - tables_.nuSum[i]) * inverseT);
    }
    progress_[i] = factor_[i] * byT + factorByT_[i] * (forward_[i] - reverse_[i]);
  }
  for (const auto& general : tables_.general) {
    const auto i = general.reaction;
    if (i >= tables_.numReversible) continue;
    double reactionEnthalpy = 0;
    for (const auto& term : tables_.netTerms[i]) reactionEnthalpy += term.coefficient * h[term.species];
    progress_[i] += factor_[i] * reverse_[i] * reactionEnthalpy * inverseT;
  }
}

void Kinetics::netProductionRatesAndJacobian(double T, std::span<const double> concentrations, std::span<double> wdot,
                                             std::span<double> jacobian, std::span<double> temperatureDerivative,
                                             std::size_t leadingDimension) {
  const std::size_t ld = leadingDimension == 0 ? tables_.numSpecies : leadingDimension;
  netProductionRates(T, concentrations, wdot);
  for (std::size_t j = 0; j < tables_.numSpecies; ++j) std::fill_n(jacobian.data() + j * ld, tables_.numSpecies, 0.0);
  slotDerivatives();
  generalDerivatives();
  double* __restrict J = jacobian.data();
  const double* __restrict derivative = derivatives_.data();
  for (const auto& term : jacobianTerms_) J[term.species + ld * term.column] += term.nu * derivative[term.source];
  thirdBodyDerivatives(T, J, ld);
  progressTemperatureDerivatives(T);
  sumProduction(progress_.data(), temperatureDerivative.data());
}

}  // namespace lampblack
