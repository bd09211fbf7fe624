// Particles as trees of primaries (`particles.description: trees`), and by volume and surface of other materials than
// soot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "coupling/reactor_particles.hpp"
#include "io/deck.hpp"
#include "particles/stochastic/size_bins.hpp"
#include "particles/trees/tree_ensemble.hpp"

namespace lampblack::app {

// What runs have that repeat populations of particles of equal weights: in reactors, along a given gas, in a flame.
struct PopulationRun {
  GasViscosity viscosity = GasViscosity::transport;
  std::size_t repeats = 1;
  SizeBins bins;
  std::vector<double> tablesAt;  // s (plug flow: m), rising
  // Edges of classes, rising, in the order of StochasticPopulation::classedBy(); of none no averages are wanted.
  std::vector<double> classesByDiameter, classesByPrimaries;
};

struct TreeRequest : PopulationRun {
  TreeOptions options;
  std::vector<TreeStart> start;  // what is there from the beginning
};

// The keys of trees that all problems have: material, collisions, sintering.
void addTreeKeys(DeckSchema& schema);
// Adds the keys of the particles that are there at the start, where these conditions hold.
void addStartKeys(DeckSchema& schema, const std::vector<DeckCondition>& conditions = {});
// Adds those of the runs that repeat them: the start of trees, and when a sample is full.
void addTreeRunKeys(DeckSchema& schema);
// Adds those of a reactor, and of a given gas.
void addTreeReactorKeys(DeckSchema& schema);
void addTreePrescribedGasKeys(DeckSchema& schema);

// How particles of equal weights collide.
[[nodiscard]] CollisionKernelOptions readCollisions(const Deck& deck);
// `particles`: numerical ones. InputError, pointing into the deck.
[[nodiscard]] PopulationRun readPopulationRun(const Deck& deck, bool isSoot, std::size_t particles);
// Of a deck with such particles, what all problems have. InputError, pointing into the deck.
[[nodiscard]] TreeOptions readTreeOptions(const Deck& deck, const Mechanism& mechanism);
// What `particles.initial` says is there from the beginning; a sample that misses moments of it is told.
[[nodiscard]] std::vector<TreeStart> readTreeStart(const Deck& deck, const TreeOptions& options);
// Of a reactor, along a given gas or in a flame.
[[nodiscard]] TreeRequest readTrees(const Deck& deck, const Mechanism& mechanism);

}  // namespace lampblack::app
