// Where the cells of a mesh stand in matrices over all ranks.
#pragma once

#include <petscsystypes.h>

#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

// Collective. The row, or row of blocks, of every local cell: those that a rank owns follow each other, ranks in order.
[[nodiscard]] std::vector<PetscInt> matrixRows(const FlowContext& context);

}  // namespace lampblack::flow
