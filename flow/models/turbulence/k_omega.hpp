// The k-omega models of Wilcox: of 2006 (AIAA J. 46, 2008, 2823) and of 1988 (AIAA J. 26, 1988, 1299).
#pragma once

#include <algorithm>
#include <cmath>

#include "flow/models/turbulence/omega_root.hpp"

namespace lampblack::flow {

template <int year>
struct KOmega {
  static constexpr SecondVariable second = SecondVariable::OmegaRoot;
  static constexpr bool needsWallDistance = false, needsStrainGradient = false, is2006 = year == 2006;
  static constexpr double betaStar = 0.09, sigmaK = is2006 ? 0.6 : 0.5, sigmaOmega = 0.5, sigmaD = is2006 ? 0.125 : 0.0,
                          gamma = is2006 ? 13.0 / 25.0 : 5.0 / 9.0, beta0 = is2006 ? 0.0708 : 0.075,
                          limit = is2006 ? 7.0 / 8.0 : 0.0, wallBeta = beta0;

  [[nodiscard]] std::string name() const { return is2006 ? "k_omega" : "k_omega1988"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return turbulence::variablesOfKOmega(); }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const {
    return turbulence::freeStreamOfKOmega(stream);
  }

  [[nodiscard]] static double dissipation(std::span<const double> variables) {
    return turbulence::dissipationOfKOmega(betaStar, variables);
  }
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const turbulence::KOmegaState s(cell);
    const double S = cell.strain;
    TurbulentRates rates;
    rates.eddyViscosity = s.k / std::max(s.omega, limit * S / std::sqrt(betaStar));
    const double unlimited = s.k / s.omega;
    rates.diffusivity = {cell.viscosity + sigmaK * unlimited, cell.viscosity + sigmaOmega * unlimited};
    double beta = beta0;
    if constexpr (is2006) {
      const double decay = betaStar * s.omega, X = cell.stretching / (decay * decay * decay);
      beta *= (1.0 + 85.0 * X) / (1.0 + 100.0 * X);
    }
    const double produced = rates.eddyViscosity * S * S;
    turbulence::addEnergy(cell, s, produced, betaStar, rates);
    // gamma omega/k P, without k in the denominator; of the dilatation gamma omega (-2/3 div u).
    const double perEnergy = S * S / std::max(s.omega, limit * S / std::sqrt(betaStar)) - 2.0 / 3.0 * cell.dilatation;
    turbulence::addOmega(s, beta, gamma * s.omega * perEnergy + sigmaD * std::max(s.cross, 0.0), rates);
    return rates;
  }
};

}  // namespace lampblack::flow
