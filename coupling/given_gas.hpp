// The path of particles through a gas whose history is given: temperature, pressure and composition over time. The
// particles move with the gas, so that their number per mass of gas stays as it is while the gas expands:
//   d ln N/dt = d ln rho/dt + particle processes,
// rho the density of the mixture. docs/theory/particles_along.md.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "coupling/reactor_particles.hpp"
#include "particles/gas/gas_path.hpp"

namespace lampblack::coupling {

struct GasHistory {
  std::vector<double> time, temperature, pressure;  // s, rising; K; Pa
  std::vector<double> fractions;                    // mole fractions of all species of the mechanism, a row a time
  // 1/s, between a row and the next: rate at which the number of particles per kg of gas falls because the particles
  // drift against the gas. Empty: the particles move with the gas.
  std::vector<double> numberLossRate = {};
};

// InputError for no row, times that do not rise, temperatures and pressures that are not positive, fractions below
// -1e-6, and sums that are not one within 2 %.
void requireHistory(const Mechanism& mechanism, const GasHistory& history);
// mol/m3, of all `species` at a row, whose fractions are divided by their sum.
[[nodiscard]] std::vector<double> concentrationsOf(const GasHistory& history, std::size_t row, std::size_t species);

// Between the given times concentrations, temperature and pressure are straight lines. Each row of fractions is divided
// by its sum. `species`: those that the particles see, in their order; a name that the mechanism lacks has none in the
// gas. InputError as requireHistory().
[[nodiscard]] ParticlePath givenPath(const Mechanism& mechanism, const GasHistory& history,
                                     std::span<const std::string> species, GasViscosity viscosity);

// The history of a gas that is known along a path, of all species of the mechanism in their order.
[[nodiscard]] GasHistory historyAlong(const ParticlePath& path);

// Puts points at these times (s, rising, within the path) where it has none; returns which points they are.
[[nodiscard]] std::vector<std::size_t> insertPoints(ParticlePath& path, std::span<const double> times);

}  // namespace lampblack::coupling
