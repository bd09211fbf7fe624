// Soot along the mean gas of an engine's cycle, which it leaves as it is: the model that the particles of gas carry,
// and a population. Beside what the particles of gas have this tells what their differences do, and what the model
// does.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "app/problems/engine/engine_case.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"

namespace lampblack::app {

struct EngineSootTable {
  std::vector<Quantity> columns;
  std::vector<double> rows;  // row-major, one at each angle of the history
};

// Collective. `history`: of rank 0, with the columns of engineHistoryColumns(). NumericsError.
[[nodiscard]] EngineSootTable sootAlongMeanGas(MPI_Comm comm, const EngineCase& made, std::vector<double> history);

}  // namespace lampblack::app
