// Paths of particles through a frozen flow on any mesh: the gas velocity plus thermophoresis, continuous between
// centres and vertices (flow/discretisation/vertex_field.hpp), traced by the second-order midpoint rule. Each piece of
// a path is traced by the rank that owns the cells it goes through, so that no rank holds more of the flow than its own
// share; a path that leaves a rank's cells goes on at the next. Paths do not depend on the ranks to the last bit.
//
// Paths go through periodic sides and go on at the other side, and slide along symmetries. They end where they leave
// through an opening or meet a wall.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/cell_finder.hpp"
#include "core/modules.hpp"
#include "core/place_in_cell.hpp"
#include "flow/discretisation/vertex_field.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

struct PathPoint {
  int path;           // index of its start
  std::int64_t step;  // times the time step: the time since the start
  Vector3 position;   // m
  PlaceInCell place;
  double divergence;  // 1/s, of the particles' velocity
};

struct PathEnd {
  std::int64_t points = 0;
  int patch = -1;   // of the mesh, where it ended; -1: it did not meet the boundary
  Vector3 place{};  // m, where it met it
};

struct TracedPaths {
  std::vector<PathPoint> points;  // those in this rank's cells
  std::vector<PathEnd> ends;      // of every path, the same on all ranks
};

class Streamlines {
 public:
  // Collective. `thermophoresis` is the coefficient K of the drift velocity -K (mu/rho) grad T / T.
  Streamlines(const FlowContext& context, const State& state, const GasProperties& properties, double thermophoresis);

  // Collective, with the same starts on all ranks. Paths from them until they end or `duration` (s) has passed, one
  // point every `timeStep` (s). InputError for a start outside the mesh, NumericsError where a velocity is not finite.
  [[nodiscard]] TracedPaths trace(std::span<const Vector3> starts, double timeStep, double duration) const;

  [[nodiscard]] Vector3 velocityAt(const PlaceInCell& place) const;  // m/s, of the particles
  [[nodiscard]] double divergenceAt(const PlaceInCell& place) const { return divergence_->at(place); }

 private:
  const FlowContext& context_;
  std::optional<VertexField> velocity_, divergence_;
};

}  // namespace lampblack::flow
