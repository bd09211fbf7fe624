// How few cells a flame has across itself. A premixed flame of three and less stays where the cells are: its heat
// is set free in one cell, whose burning follows what flows in, so that it stands still at any speed of the gas within
// tens of per cent of its own.
#pragma once

#include <optional>

#include "core/vector3.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

struct FlameSteepness {
  static constexpr double fewCells = 3.5;
  double difference = 0.0;  // K, the largest between a cell that burns and one beside it
  double cells = 0.0;       // from the coldest gas to the hottest, were all as steep
  Vector3 place{};          // m, centre of the cell that burns
};

// Collective. Cells burn that set free at least 0.3 of what the one with the most does in a volume. Nothing where that
// is below 1e4 W/m^3, which takes a second to heat gas of 1 atm and 1000 K by 25 K, or where all gas is as hot.
[[nodiscard]] std::optional<FlameSteepness> flameSteepness(const FlowContext& context, const State& state);

}  // namespace lampblack::flow
