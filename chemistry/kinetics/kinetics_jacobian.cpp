// Analytic derivatives of the net production rates.
#include <algorithm>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/kinetics/kinetics_powers.hpp"

namespace lampblack::chemistry {

// d progress / d concentration of each slot, the factor held constant. An empty slot counts as one; its derivative is
// not used.
void Kinetics::slotDerivatives() {
  const double* __restrict c = c_.data();
  const double* __restrict factor = factor_.data();
  const std::size_t n = tables_.numReactions;
  for (const bool isForward : {true, false}) {
    const auto& slots = isForward ? tables_.reactant : tables_.product;
    const std::size_t count = isForward ? n : tables_.numReversible;
    const double sign = isForward ? 1.0 : -1.0;
    const double* __restrict k = isForward ? kf_.data() : kr_.data();
    const std::int32_t* __restrict s0 = slots[0].data(), * __restrict s1 = slots[1].data();
    double* __restrict d0 = sources_.data() + (isForward ? 0 : 3) * n;
    double* __restrict d1 = d0 + n;
    double* __restrict d2 = d1 + n;
    for (std::size_t i = 0; i < count; ++i) {
      const double rate = sign * factor[i] * k[i];
      d0[i] = rate * c[s1[i]];
      d1[i] = rate * c[s0[i]];
    }
    for (const auto& slot : thirdSlots_[isForward ? 0 : 1]) {
      d2[slot.reaction] = d0[slot.reaction] * c[s0[slot.reaction]];
      d0[slot.reaction] *= c[slot.species];
      d1[slot.reaction] *= c[slot.species];
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
        double d =
            (isForward ? kf_[i] : -kr_[i]) * factor_[i] * concentrationPowerSlope(c_[term.species], term.coefficient);
        for (const auto& other : orders)
          if (other.species != term.species) d *= concentrationPower(c_[other.species], other.coefficient);
        sources_[at++] = d;
      }
    }
  }
}

void Kinetics::addSetColumn(std::size_t set, std::size_t reaction, double factorByM) {
  const double slope = multiplier_[reaction] * factorByM * (forward_[reaction] - reverse_[reaction]);
  double* column = setColumns_.data() + set * tables_.numSpecies;
  for (const auto& term : tables_.netTerms[reaction]) column[term.species] += term.coefficient * slope;
}

// What the factors' dependence on [M] and on pressure adds to the Jacobian; and factorByT_.
void Kinetics::factorDerivatives(double* values, double* common) {
  for (const auto& use : tables_.threeBody) addSetColumn(use.set, use.reaction, 1.0);
  const auto& falloff = tables_.falloff;
  falloff_.evaluateSlopes(tables_);
  for (std::size_t i = 0; i < falloff.reaction.size(); ++i) {
    addSetColumn(falloff.set[i], falloff.reaction[i], falloff_.byM()[i]);
    factorByT_[falloff.reaction[i]] = multiplier_[falloff.reaction[i]] * falloff_.byT()[i];
  }
  for (std::size_t s = 0; s < tables_.sets.size(); ++s) {
    double* column = setColumns_.data() + s * tables_.numSpecies;
    jacobianTable_.addExcess(tables_, s, column, values);
    for (const auto k : jacobianTable_.setRows(s)) {
      common[k] += tables_.sets[s].base * column[k];
      column[k] = 0;
    }
  }
  linearBurke_.evaluateSlopes();
  for (std::size_t i = 0; i < tables_.linearBurke.size(); ++i) {
    const auto r = tables_.linearBurke[i].reaction;
    const double lnBaseByT = (tables_.b[r] + tables_.Ta[r] / temperature_) / temperature_;
    const double scale = multiplier_[r] * (forward_[r] - reverse_[r]);
    factorByT_[r] = multiplier_[r] * linearBurke_.byT(i) - factor_[r] * lnBaseByT;
    for (const auto& term : tables_.netTerms[r])
      common[term.species] += term.coefficient * scale * linearBurke_.byOther(i);
    jacobianTable_.addColliders(tables_, i, scale, linearBurke_.excess(i), values);
  }
  // p = R T sum c: d ln p/d c_j = 1/sum c, d ln p/dT = 1/T.
  const double byTotal = totalConcentration_ > smallestConcentration ? 1.0 / totalConcentration_ : 0.0;
  const double T = temperature_;
  const auto addPressure = [&](std::size_t r, const PressureRates::Slope& slope) {
    const double lnBaseByT = (tables_.b[r] + tables_.Ta[r] / T) / T;
    factorByT_[r] = factor_[r] * (slope.byT + slope.byLnP / T - lnBaseByT);
    const double byConcentration = factor_[r] * slope.byLnP * byTotal * (forward_[r] - reverse_[r]);
    for (const auto& term : tables_.netTerms[r]) common[term.species] += term.coefficient * byConcentration;
  };
  for (std::size_t i = 0; i < tables_.pressureLog.reaction.size(); ++i)
    addPressure(tables_.pressureLog.reaction[i], pressureRates_.logarithmicSlope(tables_, i, lnPressure_));
  for (std::size_t i = 0; i < tables_.chebyshev.reaction.size(); ++i)
    addPressure(tables_.chebyshev.reaction[i], pressureRates_.chebyshevSlope(tables_, i, lnPressure_));
}

// d ln kf/dT = b/T + Ta/T^2; d ln Kc/dT = sum nu h/RT / T - sum nu / T (van 't Hoff). Leaves d progress/dT in
// progress_.
void Kinetics::progressTemperatureDerivatives() {
  thermo_.enthalpyOverRT(temperature_, enthalpy_.data());
  const double inverseT = 1.0 / temperature_;
  const double* __restrict h = enthalpy_.data();
  const double* __restrict b = tables_.b.data(), * __restrict Ta = tables_.Ta.data(), * __restrict nuSum = tables_.nuSum.data();
  const double *__restrict forward = forward_.data(), *__restrict reverse = reverse_.data(),
                           *__restrict factor = factor_.data(), *__restrict factorByT = factorByT_.data();
  double* __restrict progress = progress_.data();
  for (std::size_t i = 0; i < tables_.numReactions; ++i) {
    const double net = forward[i] - reverse[i];
    progress[i] = factor[i] * net * (b[i] + Ta[i] * inverseT) * inverseT + factorByT[i] * net;
  }
  if (!tables_.enthalpyDependent.empty()) {
    thermo_.cpOverR(temperature_, heatCapacity_.data());
    const auto slopes = enthalpyFactors_.slopes(tables_, temperature_, h, heatCapacity_.data());
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      const auto r = tables_.enthalpyDependent[i].reaction;
      progress[r] += factor[r] * (forward[r] - reverse[r]) * slopes[i];
    }
  }
  const std::int32_t *__restrict r0 = tables_.reactant[0].data(), *__restrict r1 = tables_.reactant[1].data(),
                     *__restrict p0 = tables_.product[0].data(), *__restrict p1 = tables_.product[1].data();
  for (std::size_t i = 0; i < tables_.numReversible; ++i) {
    const double reactionEnthalpy = (h[p0[i]] + h[p1[i]]) - (h[r0[i]] + h[r1[i]]);
    progress[i] += factor[i] * reverse[i] * (reactionEnthalpy - nuSum[i]) * inverseT;
  }
  const auto addEnthalpy = [&](std::size_t i, double enthalpy) {
    progress[i] += factor[i] * reverse[i] * enthalpy * inverseT;
  };
  for (const auto& slot : thirdSlots_[0]) addEnthalpy(slot.reaction, -h[slot.species]);
  for (const auto& slot : thirdSlots_[1]) addEnthalpy(slot.reaction, h[slot.species]);
  for (const auto& general : tables_.general)
    for (const auto& term : tables_.netTerms[general.reaction])
      addEnthalpy(general.reaction, term.coefficient * h[term.species]);
}

void Kinetics::netProductionRatesAndSparseJacobian(double T, std::span<const double> concentrations,
                                                   std::span<double> wdot, std::span<double> values,
                                                   std::span<double> common, std::span<double> temperatureDerivative) {
  netProductionRates(T, concentrations, wdot);
  std::fill(values.begin(), values.end(), 0.0);
  std::fill(common.begin(), common.end(), 0.0);
  slotDerivatives();
  generalDerivatives();
  jacobianTable_.addMassAction(sources_.data(), values.data());
  factorDerivatives(values.data(), common.data());
  progressTemperatureDerivatives();
  sumProduction(temperatureDerivative.data());
}

void Kinetics::netProductionRatesAndJacobian(double T, std::span<const double> concentrations, std::span<double> wdot,
                                             std::span<double> jacobian, std::span<double> temperatureDerivative,
                                             std::size_t leadingDimension) {
  netProductionRatesAndSparseJacobian(T, concentrations, wdot, sparseValues_, common_, temperatureDerivative);
  const std::size_t ld = leadingDimension == 0 ? numSpecies() : leadingDimension;
  const auto& pattern = jacobianPattern();
  for (std::size_t j = 0; j < pattern.size; ++j) {
    double* column = jacobian.data() + j * ld;
    std::copy(common_.begin(), common_.end(), column);
    for (auto e = pattern.columnStart[j]; e < pattern.columnStart[j + 1]; ++e)
      column[pattern.row[static_cast<std::size_t>(e)]] += sparseValues_[static_cast<std::size_t>(e)];
  }
}

}  // namespace lampblack::chemistry
