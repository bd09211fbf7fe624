// The physics of Brownian collisions in a gas, from the free-molecular to the continuum regime: every kernel of the
// module is put together from these. Inline: they sit in the innermost loops.
#pragma once

#include <cmath>

#include "core/constants.hpp"
#include "core/modules.hpp"
#include "core/particle_gas.hpp"

namespace lampblack::particles {

// Slip correction of the continuum part of a collision kernel: Davies (1945) with the gas's mean free path; or 1
// + 1.257 Kn with that of air, Kn = 4.74e-5 (Pa m/K) T/(p d) (Shekar, Smith, Kraft, Wagner 2011, eqs. 37-38).
enum class SlipLaw { davies, air };

// Mean free path of the gas, m (Wang 2025, eq. 7-33).
[[nodiscard]] inline double meanFreePath(const CarrierGas& gas) {
  return gas.viscosity / gas.pressure *
         std::sqrt(constants::pi * constants::gasConstant * gas.temperature / (2 * gas.meanMolecularWeight));
}

// The length over which a diameter is taken for the Knudsen number, m.
[[nodiscard]] inline double slipLength(SlipLaw law, const CarrierGas& gas) {
  return law == SlipLaw::davies ? 2 * meanFreePath(gas) : 4.74e-5 * gas.temperature / gas.pressure;
}

// 1 + Kn (fast + slow exp(-fall/Kn)) (Davies 1945; Wang 2025, eq. 7-31).
struct DaviesSlip {
  static constexpr double fast = 1.257, slow = 0.4, fall = 1.1;
};

// Cunningham slip correction at Knudsen number 2 lambda / d.
[[nodiscard]] inline double slipCorrection(double knudsen) {
  return 1 + knudsen * (DaviesSlip::fast + DaviesSlip::slow * std::exp(-DaviesSlip::fall / knudsen));
}

// Brownian diffusivity of a sphere, m2/s (Wang 2025, eqs. 7-30 to 7-33).
[[nodiscard]] inline double brownianDiffusivity(const CarrierGas& gas, double diameter) {
  return constants::boltzmann * gas.temperature / (3 * constants::pi * gas.viscosity * diameter) *
         slipCorrection(2 * meanFreePath(gas) / diameter);
}

// Particles far smaller than the mean free path drift with V_T = -this (mu/rho) grad T / T (Waldmann; Wang 2025, eq.
// 7-29 with full accommodation).
[[nodiscard]] constexpr double waldmannThermophoresis() {
  return 0.75 / (1 + constants::pi / 8);
}

// Free-molecular kernel (Wang 2025, eq. 9-28) is `prefactor * sqrt(1/mi + 1/mj) (di + dj)^2`; this is the prefactor.
[[nodiscard]] inline double freeMolecularPrefactor(double temperature, double enhancement) {
  return enhancement * std::sqrt(0.5 * constants::pi * constants::boltzmann * temperature);
}

[[nodiscard]] inline double freeMolecularKernel(double prefactor, double mi, double di, double mj, double dj) {
  const double sum = di + dj;
  return prefactor * std::sqrt(1 / mi + 1 / mj) * sum * sum;
}

// Continuum kernel with slip (Wang 2025, eq. 9-29) is `prefactor * (Ci/di + Cj/dj) (di + dj)`; this is the prefactor.
[[nodiscard]] inline double continuumPrefactor(double temperature, double viscosity) {
  return 2 * constants::boltzmann * temperature / (3 * viscosity);
}

// Harmonic mean of the two limits (Wang 2025, eq. 9-30), never above either.
[[nodiscard]] inline double harmonicMean(double freeMolecular, double continuum) {
  return freeMolecular * continuum / (freeMolecular + continuum);
}

// Fuchs (1964): diffusion rules down to a mean distance g from the surface of a particle of diameter d,
//   g = ((d + l)^3 - (d^2 + l^2)^(3/2)) / (3 d l) - d,  l = 8 D / (pi c) the particle's own mean free path.
// With r = sqrt(d^2 + l^2) the difference of cubes has the factor d + l - r = 2 d l / (d + l + r): no cancellation
// there. g lies between 0 and l, as (d^2 + l^2)^(3/2) >= d^3 + l^3.
[[nodiscard]] inline double fuchsDistance(double diameter, double freePath) {
  const double sum = diameter + freePath, r = std::sqrt(diameter * diameter + freePath * freePath);
  return 2 * (sum * sum + sum * r + r * r) / (3 * (sum + r)) - diameter;
}

// The mean free path of a particle (m) in fuchsDistance is `prefactor * C sqrt(m) / d`; this is the prefactor.
[[nodiscard]] inline double fuchsPathPrefactor(double temperature, double viscosity) {
  return std::sqrt(8 * constants::boltzmann * temperature / constants::pi) / (3 * constants::pi * viscosity);
}

}  // namespace lampblack::particles
