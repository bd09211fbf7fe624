// The standard k-epsilon model (Launder and Spalding, Comp. Meth. Appl. Mech. Eng. 3, 1974, 269), for turbulence away
// from walls: beside them the law of the wall stands for the layers (flow/boundaries/wall_law.hpp).
#pragma once

#include <algorithm>
#include <cmath>

#include "flow/boundaries/wall_law.hpp"
#include "flow/models/turbulence/turbulence_model.hpp"

namespace lampblack::flow {

struct KEpsilon {
  static constexpr bool needsWallDistance = false, needsStrainGradient = false, needsWallLaw = true;
  static constexpr SecondVariable second = SecondVariable::Dissipation;
  static constexpr double cMu = walllaw::cMu, c2 = 1.92, sigmaK = 1.0, sigmaEpsilon = 1.3;
  // By which 6 nu/(beta y^2) is that omega which has epsilon = C_mu k omega = 2 nu k/y^2 beside a wall.
  static constexpr double wallBeta = 3.0 * cMu;
  double c1 = 1.44;

  [[nodiscard]] std::string name() const { return "k_epsilon"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const {
    return {{"turbulent_kinetic_energy", "m^2/s^2", "k of the turbulence model", 1.0},
            {"turbulent_dissipation", "m^2/s^3", "epsilon of the turbulence model", 1.0}};
  }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const {
    return {stream.energy, cMu * stream.energy * stream.energy / stream.eddyViscosity};
  }

  [[nodiscard]] static double dissipation(std::span<const double> variables) { return variables[1]; }

  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const double k = std::max(cell.values[0], 0.0), epsilon = std::max(cell.values[1], 0.0), S = cell.strain;
    TurbulentRates rates;
    // Where transport has taken epsilon below zero there are no eddies, rather than endless ones, until it is made
    // anew.
    const double time = epsilon > 0.0 ? k / epsilon : 0.0, rate = epsilon / std::max(k, 1e-30);
    rates.eddyViscosity = cMu * k * time;
    rates.diffusivity = {cell.viscosity + rates.eddyViscosity / sigmaK,
                         cell.viscosity + rates.eddyViscosity / sigmaEpsilon};
    rates.source[0] = rates.eddyViscosity * S * S;
    rates.sink[0] = rate;
    rates.add(0, -2.0 / 3.0 * k * cell.dilatation, k);
    rates.source[1] = c1 * cMu * k * S * S;
    rates.sink[1] = c2 * rate;
    rates.add(1, -2.0 / 3.0 * c1 * epsilon * cell.dilatation, epsilon);
    rates.add(0, rates.eddyViscosity * cell.buoyancy, k);
    rates.source[1] += c1 * cMu * k * cell.buoyancyShare * std::max(cell.buoyancy, 0.0);
    return rates;
  }
};

}  // namespace lampblack::flow
