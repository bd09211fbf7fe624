// A gas that particles meet on their way as decks give it: its history in a table, or the path through a flame that is
// there already; and the times of the rows of what becomes of the particles.
#pragma once

#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "coupling/reactor_particles.hpp"
#include "io/deck.hpp"
#include "particles/gas/gas_path.hpp"

namespace lampblack::app {

// Of the section `gas`: file; flame, side, start, minimum_velocity; end.
void addGivenGasKeys(DeckSchema& schema);
// Of the section `output`.
void addRowKeys(DeckSchema& schema);

// InputError where both are given or none, and where there are keys of a flame without one.
void requireOneGas(const Deck& deck);
// The path of particles that see these species. InputError at the key of the gas.
[[nodiscard]] ParticlePath readGivenPath(const Deck& deck, const Mechanism& mechanism,
                                         const std::vector<std::string>& species, GasViscosity viscosity);
// Times of the rows, the last one of which ends the run, of a gas that is known from `begin` to `last` (s). InputError.
[[nodiscard]] std::vector<double> readRows(const Deck& deck, double begin, double last);

}  // namespace lampblack::app
