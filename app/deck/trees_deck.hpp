// The section `particles` of a reactor: particles as trees of primaries.
#pragma once

#include <optional>

#include "core/rooms.hpp"
#include "coupling/reactor_trees.hpp"
#include "io/deck.hpp"
#include "particles/ensemble/size_bins.hpp"

namespace lampblack::app {

struct TreeRequest {
  TreeOptions options;
  GasViscosity viscosity = GasViscosity::transport;
  std::optional<ReactorTrees::Start> start;
  std::size_t repeats = 1;
  SizeBins bins;
  std::vector<double> tablesAt;  // s (plug flow: m), rising
};

void addTreeKeys(DeckSchema& schema);

// Of a deck with the section. InputError, pointing into the deck.
[[nodiscard]] TreeRequest readTrees(const Deck& deck);

}  // namespace lampblack::app
