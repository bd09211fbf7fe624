// A flame on its grid: the unknowns of every point, and the few that belong to the flame as a whole.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::flow {

// The unknowns of a point, in this order.
struct FlameLayout {
  std::size_t species = 0, scalars = 0;

  // rho u through the face to the next point (at the last point: out of the domain), kg/m2/s, towards larger z.
  static constexpr std::size_t massFlux = 0;
  static constexpr std::size_t spread = 1;        // V = v_r / r, 1/s
  static constexpr std::size_t temperature = 2;   // K
  static constexpr std::size_t firstSpecies = 3;  // mass fractions of the gas
  // Carried scalars per kg of gas, over their scale (CarriedModel).
  [[nodiscard]] std::size_t firstScalar() const { return firstSpecies + species; }
  [[nodiscard]] std::size_t width() const { return firstSpecies + species + scalars; }
  bool operator==(const FlameLayout&) const = default;
};

// Unknowns of the flame as a whole, after those of all points.
enum FlameGlobal : std::size_t {
  leftMassFlux,      // rho u at z = 0, kg/m2/s
  pressureGradient,  // Lambda = (1/r) dp/dr, N/m4
  load,              // factor on the strain: of the streams' mass fluxes, or of the strain rate; 1 unless continued
  numFlameGlobals,
};

struct FlameProfile {
  FlameLayout layout;
  std::vector<double> z;  // m, rising
  std::vector<double> x;  // points * width() unknowns, point by point, then the globals

  [[nodiscard]] std::size_t points() const { return z.size(); }
  [[nodiscard]] std::size_t size() const { return points() * layout.width() + numFlameGlobals; }
  [[nodiscard]] double& at(std::size_t point, std::size_t component) { return x[point * layout.width() + component]; }
  [[nodiscard]] double at(std::size_t point, std::size_t component) const {
    return x[point * layout.width() + component];
  }
  [[nodiscard]] double& global(FlameGlobal g) { return x[points() * layout.width() + g]; }
  [[nodiscard]] double global(FlameGlobal g) const { return x[points() * layout.width() + g]; }
  [[nodiscard]] double temperature(std::size_t point) const { return at(point, FlameLayout::temperature); }
  [[nodiscard]] std::span<const double> massFractions(std::size_t point) const {
    return std::span(x).subspan(point * layout.width() + FlameLayout::firstSpecies, layout.species);
  }
  [[nodiscard]] std::span<const double> scalars(std::size_t point) const {
    return std::span(x).subspan(point * layout.width() + layout.firstScalar(), layout.scalars);
  }
  [[nodiscard]] double peakTemperature() const;  // K
};

// The same profile with more or fewer scalars (new ones are zero), or species that come last.
[[nodiscard]] FlameProfile withLayout(const FlameProfile& from, const FlameLayout& layout);

}  // namespace lampblack::flow
