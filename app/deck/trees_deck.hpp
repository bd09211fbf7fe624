// The section `particles` of reactors, flows and along a given gas: particles as trees of primaries.
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

struct TreeRequest {
  TreeOptions options;
  GasViscosity viscosity = GasViscosity::transport;
  std::vector<TreeStart> start;  // what is there from the beginning
  std::size_t repeats = 1;
  SizeBins bins;
  std::vector<double> tablesAt;  // s (plug flow: m), rising
  // Edges of classes, rising, in the order of TreeEnsemble::classedBy(); of none no averages are wanted.
  std::vector<double> classesByDiameter, classesByPrimaries;
};

// The section, described for the problem, with the keys that all problems have; `number`: the default number of
// numerical particles.
void addTreeKeys(DeckSchema& schema, const std::string& description, const std::string& number);
// Adds the keys of the particles that are there at the start.
void addTreeStartKeys(DeckSchema& schema);
// Adds the keys of the section and those of a reactor.
void addTreeReactorKeys(DeckSchema& schema);
// Adds the keys of the section and those of particles along a given gas.
void addTreePrescribedGasKeys(DeckSchema& schema);

// Adds the keys of the section and those of particles along the paths of a flame.
void addTreeFlameKeys(DeckSchema& schema);

// Of a deck with the section, what all problems have. InputError, pointing into the deck.
[[nodiscard]] TreeOptions readTreeOptions(const Deck& deck, const Mechanism& mechanism);
// What `particles.initial` says is there from the beginning; a sample that misses moments of it is told.
[[nodiscard]] std::vector<TreeStart> readTreeStart(const Deck& deck, const TreeOptions& options);
// Of a reactor, along a given gas or in a flame.
[[nodiscard]] TreeRequest readTrees(const Deck& deck, const Mechanism& mechanism);

}  // namespace lampblack::app
