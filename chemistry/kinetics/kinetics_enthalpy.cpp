#include "chemistry/kinetics/kinetics_enthalpy.hpp"

namespace lampblack::chemistry {

namespace {

struct Activation {
  double energy = 0, byEnthalpy = 0;  // K, and its derivative by the enthalpy of reaction
};

// V - 2 w = 4 w E0/(w - E0) =: D and V^2 - 4 w^2 = D (D + 4 w): without differences of large numbers where w is large.
Activation activation(const KineticsTables::EnthalpyDependent& of, double H) {
  const double intrinsic = of.intrinsic, w = of.bondEnergy;
  if (H <= -4 * intrinsic) return {};
  if (H >= 4 * intrinsic) return {H, 1};
  const double D = 4 * w * intrinsic / (w - intrinsic), mean = w + 0.5 * H, sum = D + H;
  const double inverse = 1 / (D * (D + 4 * w) + H * H), ratio = sum * inverse;
  return {mean * sum * ratio, ratio * (0.5 * sum + 2 * mean) - 2 * H * mean * ratio * ratio};
}

double sumOver(const std::vector<StoichiometricTerm>& net, const double* values) {
  double sum = 0;
  for (const auto& term : net) sum += term.coefficient * values[term.species];
  return sum;
}

}  // namespace

EnthalpyFactors::EnthalpyFactors(const KineticsTables& tables) : values_(tables.enthalpyDependent.size()) {}

std::span<const double> EnthalpyFactors::logarithms(const KineticsTables& tables, double T,
                                                    const double* enthalpyOverRT) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto& one = tables.enthalpyDependent[i];
    const double H = T * sumOver(tables.netTerms[one.reaction], enthalpyOverRT);
    values_[i] = (one.intrinsic - activation(one, H).energy) / T;
  }
  return values_;
}

// dH/dT = sum nu cp
std::span<const double> EnthalpyFactors::slopes(const KineticsTables& tables, double T, const double* enthalpyOverRT,
                                                const double* cpOverR) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto& one = tables.enthalpyDependent[i];
    const auto& net = tables.netTerms[one.reaction];
    const auto at = activation(one, T * sumOver(net, enthalpyOverRT));
    values_[i] = ((at.energy - one.intrinsic) / T - at.byEnthalpy * sumOver(net, cpOverR)) / T;
  }
  return values_;
}

}  // namespace lampblack::chemistry
