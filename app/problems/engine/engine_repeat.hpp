// One repeat of a run of an engine: its cycles, the rows of the last one, what is said of it, and its particles at
// chosen angles.
#pragma once

#include <mpi.h>

#include <functional>
#include <vector>

#include "app/problems/engine/engine_case.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"

namespace lampblack::app {

// What a row of the history has besides its angle and time, in this order.
[[nodiscard]] std::vector<Quantity> engineQuantities(const EngineCase& made);
// What is said of a cycle as a whole, in this order.
[[nodiscard]] std::vector<Quantity> engineSummaryQuantities(const EngineCase& made);
// What is said of a particle, after angle and number.
[[nodiscard]] std::vector<Quantity> engineParticleQuantities(const EngineCase& made);

struct EngineRepeat {
  std::vector<double> rows;       // row-major, of the last cycle
  std::vector<double> summary;    // of it
  std::vector<double> cycles;     // row-major, engineSummaryQuantities() of each cycle
  std::vector<double> particles;  // row-major: angle, number, engineParticleQuantities()
  bool isConverged = true;        // the cycles
};

// Collective on `comm`, whose ranks share the reactions. `onRow` is called after each row with the cycle and the angle,
// and may throw. NumericsError, naming cycle and angle.
[[nodiscard]] EngineRepeat runEngine(MPI_Comm comm, const EngineCase& made, std::uint64_t repeat,
                                     const std::function<void(std::size_t cycle, double angle)>& onRow);

// The gas as the inlet closes; `left` is what the cycle before left, empty in the first.
struct EngineResidual {
  double temperature = 0, pressure = 0;  // K, Pa
  std::vector<double> massFractions;
};
[[nodiscard]] EngineGas engineCharge(const EngineCase& made, std::uint64_t repeat, const EngineResidual& left);

}  // namespace lampblack::app
