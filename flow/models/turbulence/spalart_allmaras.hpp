// The one-equation model of Spalart and Allmaras (La Recherche Aerospatiale 1, 1994), with the trip-free f_t2 and,
// where the variable falls below zero, the negative form of Allmaras, Johnson and Spalart (ICCFD7-1902, 2012).
#pragma once

#include <algorithm>
#include <cmath>

#include "flow/models/turbulence/turbulence_model.hpp"

namespace lampblack::flow {

struct SpalartAllmaras {
  static constexpr bool needsWallDistance = true, needsStrainGradient = false;
  static constexpr double kappa = 0.41, cb1 = 0.1355, sigma = 2.0 / 3.0, cb2 = 0.622, cw2 = 0.3, cw3 = 2.0, cv1 = 7.1,
                          ct3 = 1.2, ct4 = 0.5, cn1 = 16.0;
  static constexpr double cw1 = cb1 / (kappa * kappa) + (1.0 + cb2) / sigma;

  [[nodiscard]] std::string name() const { return "sa"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const {
    return {{"nu_tilde", "m^2/s", "variable of the turbulence model", 1.0 / sigma}};
  }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const {
    return {stream.viscosity * dampedRatio(stream.eddyViscosity / stream.viscosity, cv1), 0.0};
  }

  [[nodiscard]] static double wallFunction(double r) {
    const auto sixth = [](double x) { return (x * x * x) * (x * x * x); };
    const double g = r + cw2 * (sixth(r) - r);
    return g * std::cbrt(std::sqrt((1.0 + sixth(cw3)) / (sixth(g) + sixth(cw3))));
  }

  [[nodiscard]] TurbulentRates at(const TurbulentCell& cell) const {
    const double n = cell.values[0], nu = cell.viscosity, d = cell.distance, W = cell.vorticity;
    const double X = n / nu, cube = X * X * X;
    TurbulentRates rates;
    const double overDistance = n / (d * d);
    if (n < 0.0) {
      rates.diffusivity[0] = (nu + n * (cn1 + cube) / (cn1 - cube)) / sigma;
      rates.source[0] = cb1 * (1.0 - ct3) * W * n + cw1 * n * overDistance;
    } else {
      const double fv1 = cube / (cube + cv1 * cv1 * cv1);
      rates.eddyViscosity = n * fv1;
      rates.diffusivity[0] = (nu + n) / sigma;
      const double square = kappa * kappa * d * d, bar = n / square * (1.0 - X / (1.0 + X * fv1));
      const double shear = bar >= -0.7 * W ? W + bar : W + W * (0.49 * W + 0.9 * bar) / ((0.9 - 1.4) * W - bar);
      const double r = shear > 0.0 ? std::min(n / (shear * square), 10.0) : 10.0;
      const double ft2 = ct3 * std::exp(-ct4 * X * X);
      rates.add(0, cb1 * (1.0 - ft2) * shear * n, n);
      // The square by its tangent: twice of it is taken, once given back.
      const double wall = (cw1 * wallFunction(r) - cb1 / (kappa * kappa) * ft2) * overDistance;
      if (wall > 0.0) {
        rates.sink[0] += 2.0 * wall;
        rates.source[0] += wall * n;
      } else {
        rates.source[0] -= wall * n;
      }
    }
    const Vector3& slope = cell.gradients[0];
    rates.add(0, cb2 / sigma * dot(slope, slope), n);
    rates.add(0, -rates.diffusivity[0] * dot(cell.densityGradient, slope), n);
    return rates;
  }
};

}  // namespace lampblack::flow
