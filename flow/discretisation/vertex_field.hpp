// Values at the vertices, from the cells around and from what is known at the boundaries, so that fields at places are
// continuous over the mesh (core/place_in_cell.hpp). Second order, fourth between even cells, exact for linear fields.
//
// At an inner vertex: the mean of the cells around, weighted with the inverse distance, led to the vertex by half of
// each cell's own slope and half of their mean slope. The first half errs by as much as the second, the other way. At a
// vertex of the boundary what is known there counts alone: of walls and symmetries first, then of inlets; where nothing
// is known the cells count as inside. On periodic sides the values at their faces
// count, led as those of cells; where two such sides meet the ends differ by an error of second order.
//
// Sums go by permanent numbers, so that values do not depend on the ranks to the last bit.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/place_in_cell.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

class VertexField {
 public:
  // What it is made from.
  struct Source {
    int components = 1;
    std::vector<double> values;       // of all local cells (halo filled)
    std::vector<double> boundary;     // of boundary faces
    std::vector<BoundaryData> known;  // a flag a boundary face, or a component of each
    // Values at vertices stay between those of the cells around: densities do not fall below zero beside a crest.
    bool isBounded = false;
    // A component each, or none: bounded inside alone. At a boundary it may be led beyond the cells, as a pressure is.
    std::vector<char> isLedOut = {};
    // Permanent numbers, increasing, the same on all ranks: values are made at these vertices alone; nothing: at all.
    std::optional<std::span<const std::int64_t>> only = std::nullopt;
  };

  // Collective. What a rank holds goes with its own share of the mesh alone.
  VertexField(const FlowContext& context, Source source);

  [[nodiscard]] double at(const PlaceInCell& place, int component = 0) const {
    return place.of(values_, vertices_, components_, component);
  }

 private:
  int components_;
  std::vector<double> values_, vertices_;
};

}  // namespace lampblack::flow
