// The parts of reading a flow deck; used by readFlowCase alone.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/flow/flow_case.hpp"
#include "core/rooms.hpp"

namespace lampblack::app::flowcase {

using AxisNames = std::array<std::string, 2>;

inline AxisNames axisNames(Geometry geometry) {
  return geometry == Geometry::Axisymmetric ? AxisNames{"r", "z"} : AxisNames{"x", "y"};
}

// Mass fractions of a composition that the deck gives as mole fractions.
std::vector<double> readComposition(const Deck& deck, const std::string& key, const Mechanism& mechanism);

// The section boundaries, on the mesh that has been read: along every side one boundary follows the other.
void readBoundaries(const Deck& deck, FlowCase& flowCase);

}  // namespace lampblack::app::flowcase
