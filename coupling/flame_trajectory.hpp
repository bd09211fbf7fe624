// The path of particles through a one-dimensional flame, on the axis of its similarity solution: z, time, gas, and
// the divergence of the particles' velocity.
//
// Particles move with w = u + V_T, V_T the thermophoretic velocity. Their number N per volume obeys
//   d(N w)/dz + 2 V N = S,  along the path  dN/dt = S - N (dw/dz + 2 V),
// as V_T has no radial part on the axis (dT/dr = 0). With the gas's continuity, d(rho u)/dz = -2 rho V, the same is
//   (u + V_T) rho dphi/dz = S - phi d(rho V_T)/dz,  phi = N/rho:
// without thermophoresis inert particles keep their number per kg of gas. The integral of the divergence over an
// interval is taken as ln(w_2/w_1) + 2 V dt, so that without spreading N w is constant to round-off. Diffusion of
// particles is not followed.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_profile.hpp"
#include "particles/gas/gas_path.hpp"
#include "particles/stochastic/stochastic_population.hpp"

namespace lampblack::coupling {

// The gas of a flame at its points as particles see it.
struct GasOfFlame {
  std::vector<double> z;
  std::vector<CarrierGas> carrier;
  std::vector<double> concentrations;                    // mol/m3, of the species that they see, point-major
  std::vector<double> velocity, thermophoresis, spread;  // u, V_T (m/s), V (1/s)
};

// `names`: of the species that the particles see; what the mechanism lacks is not there. `thermophoresis`: of
// V_T = -thermophoresis (mu/rho) grad T / T.
[[nodiscard]] GasOfFlame flameGasOf(std::span<const std::string> names, const FlameProfile& profile,
                                    const Mechanism& mechanism, double pressure, double thermophoresis);

// Of the species that particles of this kind see, with Waldmann's thermophoresis.
[[nodiscard]] GasOfFlame gasOfFlame(const FlameProfile& profile, const Mechanism& mechanism, double pressure,
                                    const StochasticPopulation& kind);

struct FlamePathOptions {
  bool fromRight = false;       // from the right end towards smaller z
  std::optional<double> start;  // m: first point of the grid from there on; the end of the flame
  double slowest = 1e-3;        // m/s: paths end where particles are slower
};

struct FlamePath {
  ParticlePath path;
  std::vector<double> z, velocity;  // of its points: m; m/s, of the particles
  bool stagnates = false;           // ended at the particles' stagnation plane; otherwise at the end of the flame
};

// Empty where particles at the start do not move into the flame.
[[nodiscard]] FlamePath flamePath(const GasOfFlame& gas, const FlamePathOptions& options);

}  // namespace lampblack::coupling
