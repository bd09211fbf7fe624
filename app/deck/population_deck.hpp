// The stochastic population that a deck asks for: one table says which section makes which kind, for all places.
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
  std::string section;  // of the deck, which says what the particles are like
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

// Whether a deck asks for one.
[[nodiscard]] bool hasPopulation(const Deck& deck);
// Of a deck that does, for reactors and along a given gas; for the paths of a flame, where a model may stand beside it,
// and the section `stochastic`, which says where the paths are, beside another; for the cells of a flow with the
// section `stochastic`, whose random numbers begin with `seed`; and along trajectories through the flow. InputError,
// pointing into the deck.
[[nodiscard]] PopulationRequest readPopulation(const Deck& deck, const std::shared_ptr<const Mechanism>& mechanism);
[[nodiscard]] PopulationRequest readFlamePopulation(const Deck& deck,
                                                    const std::shared_ptr<const Mechanism>& mechanism);
[[nodiscard]] PopulationRequest readCellPopulation(const Deck& deck, const std::shared_ptr<const Mechanism>& mechanism,
                                                   std::uint64_t seed);
[[nodiscard]] PopulationRequest readTrajectoryPopulation(const Deck& deck,
                                                         const std::shared_ptr<const Mechanism>& mechanism,
                                                         std::uint64_t seed);

}  // namespace lampblack::app
