// The one-equation model of Wray and Agarwal without wall distance (Han, Rahman and Agarwal, AIAA 2018-0593).
#pragma once

#include <algorithm>
#include <cmath>

#include "flow/models/turbulence/turbulence_model.hpp"

namespace lampblack::flow {

struct WrayAgarwal {
  static constexpr bool needsWallDistance = false, needsStrainGradient = true;
  static constexpr double kappa = 0.41, c1Omega = 0.0829, c1Epsilon = 0.1284, sigmaOmega = 0.72, sigmaEpsilon = 1.0,
                          cw = 8.54, cm = 8.0;
  static constexpr double c2Omega = c1Omega / (kappa * kappa) + sigmaOmega,
                          c2Epsilon = c1Epsilon / (kappa * kappa) + sigmaEpsilon;

  [[nodiscard]] std::string name() const { return "wray_agarwal"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const {
    return {{"undamped_eddy_viscosity", "m^2/s", "variable of the turbulence model", 1.0}};
  }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const {
    return {stream.viscosity * dampedRatio(stream.eddyViscosity / stream.viscosity, cw), 0.0};
  }

  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const double nu = cell.viscosity, R = std::max(cell.values[0], 1e-12 * nu), S = std::max(cell.strain, leastStrain);
    const double X = R / nu, cube = X * X * X;
    TurbulentRates rates;
    rates.eddyViscosity = R * cube / (cube + cw * cw * cw);
    // (nu + R)/2 eta^2/(C_mu k omega), with k and omega of the eddy viscosity and the strain.
    const double eta = std::max(1.0, cell.vorticity / S);
    const double arg = (nu + R) / 2.0 * eta * eta / std::max(rates.eddyViscosity, 1e-30);
    const double f1 = layerShare(arg);
    rates.diffusivity[0] = nu + (f1 * (sigmaOmega - sigmaEpsilon) + sigmaEpsilon) * R;
    rates.source[0] = (f1 * (c1Omega - c1Epsilon) + c1Epsilon) * R * S;
    const Vector3 &slope = cell.gradients[0], &ofStrain = cell.strainSlope;
    rates.add(0, f1 * c2Omega * R * dot(slope, ofStrain), R);
    const double byStrain = c2Epsilon * R * R * dot(ofStrain, ofStrain);
    rates.add(0, -(1.0 - f1) * std::min(byStrain, cm * dot(slope, slope)), R);
    rates.add(0, -rates.diffusivity[0] * dot(cell.densityGradient, slope), R);
    return rates;
  }
};

}  // namespace lampblack::flow
