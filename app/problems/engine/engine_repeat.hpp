// One repeat of a run of an engine: its cycles, the rows of the last one, what is said of it, and its particles at
// chosen angles.
#pragma once

#include <mpi.h>

#include <cmath>
#include <optional>
#include <vector>

#include "app/problems/engine/engine_case.hpp"
#include "app/problems/engine/engine_rows.hpp"
#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "coupling/engine_soot.hpp"

namespace lampblack::app {

struct EngineRepeat {
  std::vector<double> rows;       // row-major, of the last cycle
  std::vector<double> summary;    // of it
  std::vector<double> cycles;     // row-major, engineSummaryQuantities() of each cycle
  std::vector<double> particles;  // row-major: angle, number, engineParticleQuantities()
  bool isConverged = true;        // the cycles
};

// The gas as the inlet closes; `left` is what the cycle before left, empty in the first.
struct EngineResidual {
  double temperature = 0, pressure = 0;  // K, Pa
  std::vector<double> massFractions;
};
[[nodiscard]] EngineGas engineCharge(const EngineCase& made, std::uint64_t repeat, const EngineResidual& left);

class EngineCycles {
 public:
  // The case has to live as long. The ranks of `comm` share the reactions.
  EngineCycles(MPI_Comm comm, const EngineCase& made, std::uint64_t repeat);

  // Collective. To the next row, of the next cycle where one has ended. NumericsError, naming cycle and angle.
  void advance();
  [[nodiscard]] bool isDone() const { return isDone_; }
  [[nodiscard]] std::size_t cycle() const { return cycle_; }                        // from 0
  [[nodiscard]] double angle() const { return stops_[at_ - 1]; }                    // deg, of the last row
  [[nodiscard]] std::size_t stops() const { return cycle_ * stops_.size() + at_; }  // since the start
  [[nodiscard]] const EngineRepeat& result() const { return done_; }                // where it is done

  // Between two calls of advance(); collective.
  void saveOrLoad(StateArchive& archive);

 private:
  void endCycle();

  const EngineCase& made_;
  std::uint64_t repeat_;
  Thermo thermo_;
  std::optional<EngineSoot> soot_;
  EngineCylinder cylinder_;
  EngineRows said_;
  std::vector<double> stops_;  // deg: rows, and angles at which particles are written
  EngineRepeat done_;
  EngineResidual left_;
  double halfBefore_ = std::nan(""), temperatureBefore_ = std::nan("");
  std::size_t cycle_ = 0, at_ = 0;  // stops that are behind
  bool isDone_ = false;
};

}  // namespace lampblack::app
