// The stochastic population that a deck asks for, of either kind, for all places.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "coupling/reactor_particles.hpp"
#include "io/deck.hpp"
#include "particles/stochastic/stochastic_population.hpp"

namespace lampblack::app {

struct PopulationRequest {
  MakePopulation make;
  std::string material = {};
  std::vector<std::string> elements = {};  // of the particles
  std::vector<std::size_t> species = {};   // of the mechanism, that they exchange
  bool hasStart = false;                   // whether anything is
  std::vector<std::string> notes;          // what the user should be told before the run

  // Of repeats, in reactors and along a given gas.
  std::size_t repeats = 1;
  SizeBins bins;
  GasViscosity viscosity = GasViscosity::transport;
  std::vector<double> tablesAt;  // s (plug flow: m), rising: where every particle of the first repeat is written
  // Classes of particles for averages: by which of StochasticPopulation::classedBy(), and the edges between them.
  struct Classes {
    std::size_t by = 0;
    std::vector<double> edges;
  };
  std::vector<Classes> classes;
};

// Of a deck that asks for one (hasPopulation): in reactors, along a given gas and along the paths of a flame; for the
// cells of a flow, whose random numbers begin with `seed`; and along trajectories through the flow, where a deck with a
// model has an ensemble of its soot. InputError, pointing into the deck.
[[nodiscard]] PopulationRequest readPopulation(const Deck& deck, const std::shared_ptr<const Mechanism>& mechanism);
[[nodiscard]] PopulationRequest readCellPopulation(const Deck& deck, const std::shared_ptr<const Mechanism>& mechanism,
                                                   std::uint64_t seed);
[[nodiscard]] PopulationRequest readTrajectoryPopulation(const Deck& deck,
                                                         const std::shared_ptr<const Mechanism>& mechanism,
                                                         std::uint64_t seed);

}  // namespace lampblack::app
