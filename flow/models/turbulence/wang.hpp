// Wang's one-equation model, of the k-epsilon and the k-omega model by Bradshaw's relation (Wang 2025,
// equations 8-11 and 8-16 to 8-25), with the constants as printed there.
#pragma once

#include <algorithm>
#include <cmath>

#include "flow/models/turbulence/turbulence_model.hpp"

namespace lampblack::flow {

struct WangModel {
  static constexpr bool needsWallDistance = true, needsStrainGradient = true;
  static constexpr double cMu = 0.09, betaStar = 0.09, cw = 9.1, c1 = 0.0795, c2 = 1.5385, c3 = 7.0;

  [[nodiscard]] std::string name() const { return "wang"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const {
    return {{"nu_tilde", "m^2/s", "variable of the turbulence model", 1.0}};
  }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const {
    return {stream.viscosity * dampedRatio(stream.eddyViscosity / stream.viscosity, cw), 0.0};
  }

  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const double nu = cell.viscosity, n = std::max(cell.values[0], 1e-12 * nu), S = std::max(cell.strain, leastStrain);
    const double d = cell.distance, X = n / nu, cube = X * X * X;
    TurbulentRates rates;
    rates.eddyViscosity = n * cube / (cube + cw * cw * cw);
    const double arg =
        std::max(std::pow(cMu, 0.25) * std::sqrt(n / S) / (betaStar * d), 500.0 * std::sqrt(cMu) * nu / (d * d * S));
    const double F1 = layerShare(arg);
    const auto blend = [F1](double omega, double epsilon) { return F1 * omega + (1.0 - F1) * epsilon; };
    const double alpha = blend(1.2, 1.0), beta = blend(0.084, 0.144), gamma = blend(1.7, 0.2386);
    rates.diffusivity[0] = nu + alpha * n;
    rates.source[0] = beta * n * S;
    const Vector3 &slope = cell.gradients[0], &ofStrain = cell.strainSlope;
    rates.add(0, gamma * n * slopeAlongStrain(cell), n);
    rates.add(0, c1 * (1.0 - F1) * n * n * cell.strainBend, n);
    const double most = c3 * dot(slope, slope), byStrain = n * n * dot(ofStrain, ofStrain);
    if (most > 0.0) rates.add(0, -c2 * (1.0 - F1) * most * std::tanh(byStrain / most), n);
    rates.add(0, -rates.diffusivity[0] * dot(cell.densityGradient, slope), n);
    return rates;
  }
};

}  // namespace lampblack::flow
