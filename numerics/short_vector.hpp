// SUNDIALS vectors of tens to a few hundred unknowns. A step of CVODE does some forty operations on whole vectors; at
// this size the ones of SUNDIALS' serial vector, compiled for any processor, cost as much as the chemistry.
#pragma once

#include <cstddef>

#include "core/modules.hpp"
#include "numerics/sundials_handles.hpp"

namespace lampblack::numerics::sundials {

// A serial vector of n zeros, all of whose copies (N_VClone) have the faster operations too.
Vector makeShortVector(std::size_t n, SUNContext context);

}  // namespace lampblack::numerics::sundials
