// The shear stress transport models of Menter (AIAA J. 32, 1994, 1598) and of Menter, Kuntz and Langtry (Turbulence,
// Heat and Mass Transfer 4, 2003).
#pragma once

#include <algorithm>
#include <cmath>

#include "flow/models/turbulence/omega_root.hpp"

namespace lampblack::flow {

template <int year>
struct ShearStressTransport {
  static constexpr SecondVariable second = SecondVariable::OmegaRoot;
  static constexpr bool needsWallDistance = true, needsStrainGradient = false, is2003 = year == 2003;
  static constexpr double betaStar = 0.09, a1 = 0.31, kappa = 0.41, sigmaOmega2 = 0.856, beta1 = 0.075, beta2 = 0.0828,
                          mostProduction = is2003 ? 10.0 : 20.0, leastCross = is2003 ? 1e-10 : 1e-20, wallBeta = beta1;

  [[nodiscard]] std::string name() const { return is2003 ? "sst" : "sst1994"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return turbulence::variablesOfKOmega(); }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const {
    return turbulence::freeStreamOfKOmega(stream);
  }

  [[nodiscard]] static double gammaOf(double beta, double sigma) {
    return beta / betaStar - sigma * kappa * kappa / std::sqrt(betaStar);
  }

  [[nodiscard]] static double dissipation(std::span<const double> variables) {
    return turbulence::dissipationOfKOmega(betaStar, variables);
  }
  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const turbulence::KOmegaState s(cell);
    const double d = cell.distance, S = cell.strain;
    const double length = std::sqrt(s.k) / (betaStar * s.omega * d);
    const double viscous = 500.0 * cell.viscosity / (d * d * s.omega);
    const double cross = std::max(2.0 * sigmaOmega2 * s.cross, leastCross);
    const double arg1 = std::min(std::max(length, viscous), 4.0 * sigmaOmega2 * s.k / (cross * d * d));
    const double F1 = layerShare(arg1);
    const double arg2 = std::min(std::max(2.0 * length, viscous), 10.0), F2 = std::tanh(arg2 * arg2);
    const auto blend = [F1](double inner, double outer) { return F1 * inner + (1.0 - F1) * outer; };
    TurbulentRates rates;
    const double inverseTime = std::max(s.omega, (is2003 ? S : cell.vorticity) * F2 / a1);  // k over the eddy viscosity
    rates.eddyViscosity = s.k / inverseTime;
    rates.diffusivity = {cell.viscosity + blend(0.85, 1.0) * rates.eddyViscosity,
                         cell.viscosity + blend(0.5, sigmaOmega2) * rates.eddyViscosity};
    const double most = mostProduction * betaStar * s.k * s.omega;
    turbulence::addEnergy(cell, s, std::min(rates.eddyViscosity * S * S, most), betaStar, rates);
    const double gamma = is2003 ? blend(5.0 / 9.0, 0.44) : blend(gammaOf(beta1, 0.5), gammaOf(beta2, sigmaOmega2));
    // P over the eddy viscosity, in which k does not stand; the limit counts there in the model of 2003 alone.
    double perViscosity = S * S;
    if (is2003) perViscosity = std::min(perViscosity, mostProduction * betaStar * s.omega * inverseTime);
    // What gas that expands takes is in proportion to omega, also where the eddy viscosity is limited: -2/3 div u over
    // the limited time would take omega below zero.
    perViscosity -= 2.0 / 3.0 * cell.dilatation * s.omega;
    const double crossDiffusion = 2.0 * (1.0 - F1) * sigmaOmega2 * s.cross;
    turbulence::addOmega(s, blend(beta1, beta2), gamma * perViscosity + crossDiffusion, rates);
    return rates;
  }
};

}  // namespace lampblack::flow
