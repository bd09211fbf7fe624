// Flames whose profiles are formulas, for tests of grids.
#pragma once

#include <functional>
#include <vector>

#include "flow/flame/flame_profile.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

using Formula = std::function<double(double)>;

struct AnalyticFlame {
  Formula massFlux, spread, temperature;
  std::vector<Formula> species, scalars;

  // Point values at points, mass fluxes at their faces.
  [[nodiscard]] FlameProfile on(const std::vector<double>& z) const {
    FlameProfile p;
    p.layout = {species.size(), scalars.size()};
    p.z = z;
    p.x.assign(p.size(), 0.0);
    for (std::size_t i = 0; i < z.size(); ++i) {
      p.at(i, FlameLayout::massFlux) = massFlux(i + 1 < z.size() ? 0.5 * (z[i] + z[i + 1]) : z[i]);
      p.at(i, FlameLayout::spread) = spread(z[i]);
      p.at(i, FlameLayout::temperature) = temperature(z[i]);
      for (std::size_t k = 0; k < species.size(); ++k) p.at(i, FlameLayout::firstSpecies + k) = species[k](z[i]);
      for (std::size_t s = 0; s < scalars.size(); ++s) p.at(i, p.layout.firstScalar() + s) = scalars[s](z[i]);
    }
    p.global(leftMassFlux) = massFlux(z.front());
    p.global(pressureGradient) = -7.0;
    p.global(load) = 1.0;
    return p;
  }
};

inline std::vector<double> uniformPoints(double from, double to, std::size_t n) {
  std::vector<double> z;
  for (std::size_t i = 0; i < n; ++i)
    z.push_back(i + 1 < n ? from + (to - from) * static_cast<double>(i) / static_cast<double>(n - 1) : to);
  return z;
}

}  // namespace lampblack::test
