// The realizable k-epsilon model (Shih, Liou, Shabbir, Yang and Zhu, Computers and Fluids 24, 1995, 227): C_mu falls
// with strain and rotation, and the source of epsilon goes by the strain, which suits round jets. With the law of the
// wall beside walls, as the standard model. Its constants have C_mu 0.09 and kappa 0.41 in the logarithmic layer.
#pragma once

#include <algorithm>
#include <cmath>

#include "flow/models/turbulence/k_epsilon.hpp"

namespace lampblack::flow {

struct RealizableKEpsilon {
  static constexpr bool needsWallDistance = false, needsStrainGradient = false, needsWallLaw = true;
  static constexpr SecondVariable second = SecondVariable::Dissipation;
  static constexpr double a0 = 4.04, c1Least = 0.43, c2 = 1.9, sigmaK = 1.0, sigmaEpsilon = 1.2;
  static constexpr double wallBeta = KEpsilon::wallBeta;
  static constexpr double c1OfBuoyancy = 1.44;  // that of the standard model

  [[nodiscard]] std::string name() const { return "realizable_k_epsilon"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return KEpsilon().variables(); }
  // The dissipation that the eddy viscosity has in a logarithmic layer.
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const {
    return KEpsilon().freeStream(stream);
  }

  [[nodiscard]] static double dissipation(std::span<const double> variables) { return variables[1]; }

  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const double k = std::max(cell.values[0], 0.0), epsilon = std::max(cell.values[1], 1e-30), S = cell.strain;
    TurbulentRates rates;
    const double time = k / epsilon, root6 = std::sqrt(6.0);
    const double angle = std::acos(std::clamp(root6 * cell.strainShape, -1.0, 1.0)) / 3.0;
    // 1/s, (S_ij S_ij + W_ij W_ij)^(1/2)
    const double speed = std::sqrt(0.5 * (S * S + cell.vorticity * cell.vorticity));
    const double cMu = 1.0 / (a0 + root6 * std::cos(angle) * speed * time);
    rates.eddyViscosity = cMu * k * time;
    rates.diffusivity = {cell.viscosity + rates.eddyViscosity / sigmaK,
                         cell.viscosity + rates.eddyViscosity / sigmaEpsilon};
    rates.source[0] = rates.eddyViscosity * S * S;
    rates.sink[0] = epsilon / std::max(k, 1e-30);
    rates.add(0, -2.0 / 3.0 * k * cell.dilatation, k);
    rates.add(0, rates.eddyViscosity * cell.buoyancy, k);
    const double shear = S * time;
    rates.source[1] = std::max(c1Least, shear / (shear + 5.0)) * S * epsilon;
    rates.source[1] += c1OfBuoyancy * cMu * k * cell.buoyancyShare * std::max(cell.buoyancy, 0.0);
    rates.sink[1] = c2 * epsilon / (k + std::sqrt(cell.viscosity * epsilon));
    return rates;
  }
};

}  // namespace lampblack::flow
