// Fields at places: continuous over the mesh, linear between the centre of a cell and its corners, where values come
// from the cells around and from what is known at the boundaries (flow/discretisation/vertex_field.hpp). Nowhere beyond
// what these have, so that a linear field is met exactly but beside boundaries where nothing is known, and in corners.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/cell_finder.hpp"
#include "core/modules.hpp"
#include "core/place_in_cell.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

class FieldSampler {
 public:
  // Collective, with the same places on all ranks.
  FieldSampler(const FlowContext& context, std::vector<Vector3> places);

  [[nodiscard]] const std::vector<Vector3>& places() const { return places_; }
  // The first place that is outside the mesh, or -1.
  [[nodiscard]] int firstOutside() const;

  // A value a cell (the halo is filled here), and what is known of it at the boundary faces.
  struct Field {
    std::vector<double> values;
    std::vector<double> boundary;
    std::vector<BoundaryData> known;
    bool isLedOut = false;  // at a boundary where nothing is known, by the slopes of the cells there
  };
  // A field of which nothing is known at boundaries but that it is even at a symmetry.
  [[nodiscard]] static Field scalarField(const FlowContext& context);

  // Collective, all places inside. Values at the places, the fields of a place one after the other; the same on all
  // ranks.
  [[nodiscard]] std::vector<double> sample(std::span<Field> fields) const;

 private:
  const FlowContext& context_;
  std::vector<Vector3> places_;
  FoundCells found_;
  std::vector<PlaceInCell> inCell_;     // of places in cells that this rank owns
  std::vector<std::int64_t> vertices_;  // permanent numbers of all ranks' corners of these places, increasing
};

}  // namespace lampblack::flow
