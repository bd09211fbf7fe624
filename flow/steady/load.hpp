// What a load is: a factor on something that a flow is given, which is followed from one steady state to the next.
#pragma once

#include <cstddef>

#include "core/modules.hpp"

namespace lampblack::flow {

struct Load {
  enum class Of {
    Velocities,    // of all inlets, as the load of a flame of one dimension is one on its strain
    Velocity,      // of one inlet
    Temperature,   // of one inlet or wall
    MoleFraction,  // of one species in one inlet; the others share the rest as they do at a load of one
    Pressure,      // thermodynamic
  };
  Of of = Of::Velocities;
  std::size_t boundary = 0;  // number in FlowContext::boundaries, where the load is of one
  std::size_t species = 0;   // of a mole fraction
};

}  // namespace lampblack::flow
