// The path of particles through a gas whose history is given: temperature, pressure and composition over time. The
// particles move with the gas, so that their number per mass of gas stays as it is while the gas expands:
//   d ln N/dt = d ln rho/dt + what happens to them,
// rho the density of the mixture. docs/theory/particles_along.md.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/rooms.hpp"
#include "coupling/reactor_particles.hpp"
#include "particles/ensemble/ensemble_path.hpp"

namespace lampblack::coupling {

struct GasHistory {
  std::vector<double> time, temperature, pressure;  // s, rising; K; Pa
  std::vector<double> fractions;                    // mole fractions of all species of the mechanism, a row a time
};

// Between the given times concentrations, temperature and pressure are straight lines. Each row of fractions is divided
// by its sum. `species`: those that the particles see, in their order; a name that the mechanism lacks has none in the
// gas. InputError for no row, times that do not rise, temperatures and pressures that are not positive, fractions below
// -1e-6, and sums that are not one within 2 %.
[[nodiscard]] ParticlePath givenPath(const Mechanism& mechanism, const GasHistory& history,
                                     std::span<const std::string> species, GasViscosity viscosity);

// Puts points at these times (s, rising, within the path) where it has none; returns which points they are.
[[nodiscard]] std::vector<std::size_t> putPointsAt(ParticlePath& path, std::span<const double> times);

}  // namespace lampblack::coupling
