#include "chemistry/kinetics/kinetics.hpp"

#include <algorithm>
#include <cmath>

#include "chemistry/kinetics/kinetics_powers.hpp"
#include "core/constants.hpp"
#include "numerics/vector_math.hpp"

namespace lampblack::chemistry {

// Everything that depends on temperature alone; nothing to do if it has not changed.
void Kinetics::updateTemperature(double T) {
  if (T == temperature_) return;
  temperature_ = -1;  // in case of an error on the way
  const double lnT = std::log(T), inverseT = 1.0 / T;
  double* __restrict lnkf = lnkf_.data();
  double* __restrict kf = kf_.data();
  {
    const double* __restrict lnA = tables_.lnA.data();
    const double* __restrict b = tables_.b.data();
    const double* __restrict Ta = tables_.Ta.data();
    const auto evaluate = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        lnkf[i] = lnA[i] + b[i] * lnT - Ta[i] * inverseT;
        kf[i] = vectormath::expOne(lnkf[i]);
      }
    };
    evaluate(0, tables_.constantBegin);
    evaluate(tables_.constantEnd, tables_.numReactions);
  }
  if (!tables_.enthalpyDependent.empty()) {
    thermo_.enthalpyOverRT(T, enthalpy_.data());
    const auto logarithms = enthalpyFactors_.logarithms(tables_, T, enthalpy_.data());
    for (std::size_t i = 0; i < logarithms.size(); ++i) {
      const auto r = tables_.enthalpyDependent[i].reaction;
      lnkf[r] += logarithms[i];
      kf[r] = vectormath::expOne(lnkf[r]);
    }
  }
  thermo_.gibbsOverRT(T, lnT, gibbs_.data());
  // ln Kc = -sum nu g/RT + sum nu ln(p0/RT); kr = kf/Kc
  const double lnStandard = std::log(constants::oneAtmosphere / constants::gasConstant) - lnT;
  {
    const double* __restrict g = gibbs_.data();
    const double* __restrict nuSum = tables_.nuSum.data();
    double* __restrict lnkr = lnkr_.data();
    double* __restrict kr = kr_.data();
    const std::int32_t *__restrict r0 = tables_.reactant[0].data(), *__restrict r1 = tables_.reactant[1].data(),
                       *__restrict p0 = tables_.product[0].data(), *__restrict p1 = tables_.product[1].data();
    for (std::size_t i = 0; i < tables_.numReversible; ++i)
      lnkr[i] = lnkf[i] + ((g[p0[i]] + g[p1[i]]) - (g[r0[i]] + g[r1[i]])) - nuSum[i] * lnStandard;
    for (const auto& slot : thirdSlots_[0])
      if (slot.reaction < tables_.numReversible) lnkr[slot.reaction] -= g[slot.species];
    for (const auto& slot : thirdSlots_[1]) lnkr[slot.reaction] += g[slot.species];
    for (const auto& general : tables_.general)
      if (general.reaction < tables_.numReversible)
        for (const auto& term : tables_.netTerms[general.reaction])
          lnkr[general.reaction] += term.coefficient * g[term.species];
    for (std::size_t i = 0; i < tables_.numReversible; ++i) kr[i] = vectormath::expOne(lnkr[i]);
  }
  if (tables_.anyNegative)
    for (std::size_t i = 0; i < tables_.numReactions; ++i) {
      kf_[i] *= tables_.sign[i];
      kr_[i] *= tables_.sign[i];
    }
  falloff_.setTemperature(tables_, T, lnT, lnkf);
  pressureRates_.setTemperature(tables_, T, lnT);
  linearBurke_.setTemperature(T, lnT, lnkf);
  temperature_ = T;
}

void Kinetics::updateConcentrations(std::span<const double> concentrations) {
  double total = 0;
  for (std::size_t k = 0; k < tables_.numSpecies; ++k) {
    c_[k] = concentrations[k];
    total += concentrations[k];
  }
  totalConcentration_ = total;
  for (std::size_t s = 0; s < tables_.sets.size(); ++s) {
    double M = tables_.sets[s].base * total;
    for (const auto& e : tables_.sets[s].excess) M += e.coefficient * c_[e.species];
    M_[s] = M;
  }
}

void Kinetics::updateFactors() {
  for (const auto& use : tables_.threeBody) factor_[use.reaction] = multiplier_[use.reaction] * M_[use.set];
  const auto falloffFactors = falloff_.evaluate(tables_, M_.data());
  for (std::size_t i = 0; i < falloffFactors.size(); ++i) {
    const auto r = tables_.falloff.reaction[i];
    factor_[r] = multiplier_[r] * falloffFactors[i];
  }
  const auto mixed = linearBurke_.evaluate(c_.data(), totalConcentration_);
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    const auto r = tables_.linearBurke[i].reaction;
    factor_[r] = multiplier_[r] * mixed[i];
  }
  if (tables_.pressureLog.reaction.empty() && tables_.chebyshev.reaction.empty()) return;
  lnPressure_ = std::log(constants::gasConstant * temperature_ * std::max(totalConcentration_, smallestConcentration));
  for (std::size_t i = 0; i < tables_.pressureLog.reaction.size(); ++i) {
    const auto r = tables_.pressureLog.reaction[i];
    const double lnk = pressureRates_.logarithmic(tables_, i, lnPressure_);
    factor_[r] = multiplier_[r] * vectormath::expOne(lnk - lnkf_[r]);
  }
  for (std::size_t i = 0; i < tables_.chebyshev.reaction.size(); ++i) {
    const auto r = tables_.chebyshev.reaction[i];
    const double lnk = pressureRates_.chebyshev(tables_, i, lnPressure_);
    factor_[r] = multiplier_[r] * vectormath::expOne(lnk - lnkf_[r]);
  }
}

void Kinetics::updateProgress() {
  const double* __restrict c = c_.data();
  double* __restrict forward = forward_.data();
  double* __restrict reverse = reverse_.data();
  {
    const std::int32_t* __restrict r0 = tables_.reactant[0].data(), * __restrict r1 = tables_.reactant[1].data();
    const double* __restrict k = kf_.data();
    for (std::size_t i = 0; i < tables_.numReactions; ++i) forward[i] = k[i] * c[r0[i]] * c[r1[i]];
    for (const auto& slot : thirdSlots_[0]) forward[slot.reaction] *= c[slot.species];
  }
  {
    const std::int32_t* __restrict p0 = tables_.product[0].data(), * __restrict p1 = tables_.product[1].data();
    const double* __restrict k = kr_.data();
    for (std::size_t i = 0; i < tables_.numReversible; ++i) reverse[i] = k[i] * c[p0[i]] * c[p1[i]];
    for (const auto& slot : thirdSlots_[1]) reverse[slot.reaction] *= c[slot.species];
  }
  for (const auto& general : tables_.general) {
    for (const auto& t : general.forwardOrders)
      forward[general.reaction] *= concentrationPower(c[t.species], t.coefficient);
    for (const auto& t : general.reverseOrders)
      reverse[general.reaction] *= concentrationPower(c[t.species], t.coefficient);
  }
  const double* __restrict factor = factor_.data();
  double* __restrict progress = progress_.data();
  for (std::size_t i = 0; i < tables_.numReactions; ++i) progress[i] = factor[i] * (forward[i] - reverse[i]);
}

void Kinetics::sumProduction(double* out) {
  const std::size_t n = tables_.numReactions;
  double* __restrict q = progress_.data();
  for (std::size_t i = 0; i < n; ++i) q[n + i] = -q[i];
  const std::int32_t* __restrict source = tables_.rowSource.data();
  for (std::size_t k = 0; k < tables_.numSpecies; ++k) {
    double a = 0, b = 0, c = 0, d = 0;
    for (std::size_t e = tables_.rows[k]; e < tables_.rows[k + 1]; e += 4) {
      a += q[source[e]];
      b += q[source[e + 1]];
      c += q[source[e + 2]];
      d += q[source[e + 3]];
    }
    out[k] = (a + b) + (c + d);
  }
  for (const auto& term : tables_.decimalTerms) out[term.species] += term.nu * q[term.reaction];
}

void Kinetics::update(double T, std::span<const double> concentrations) {
  updateTemperature(T);
  updateConcentrations(concentrations);
  updateFactors();
}

void Kinetics::netProductionRates(double T, std::span<const double> concentrations, std::span<double> wdot) {
  update(T, concentrations);
  updateProgress();
  sumProduction(wdot.data());
}

}  // namespace lampblack::chemistry
