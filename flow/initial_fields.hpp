// A start that is given over place, in place of a mixing layer or beside one.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/modules.hpp"
#include "flow/boundaries/gas_variation.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

struct InitialFields {
  GasVariation gas;
  std::array<FieldFunction, 3> velocity;        // m/s, along the mesh's axes; empty: at rest
  FieldFunction swirl;                          // m/s, about the axis; empty: none, or at rest
  std::optional<double> thermodynamicPressure;  // Pa, of a closed vessel; none: that of before
  std::vector<FieldFunction> carried;           // per m3, of each carried scalar of all blocks; empty: none
  // Of a turbulence model: its variables per kg, then the eddy viscosity, Pa s; empty: those of its start.
  std::vector<FieldFunction> turbulence;
  bool isLit = false;  // what is mixed burns (lightMixture)

  [[nodiscard]] bool isEmpty() const {
    return gas.isEmpty() && !velocity[0] && !velocity[1] && !velocity[2] && !swirl && carried.empty();
  }
};

// Changes what is given but turbulence (TurbulenceOperator::setStart()), at time zero; the rest of the state is that of
// before (halo included). InputError with the place where a value cannot be.
void setInitialFields(const FlowContext& context, const InitialFields& fields, State& state);

}  // namespace lampblack::flow
