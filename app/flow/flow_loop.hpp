// One run of a flow: the operators of a step, and everything that watches them.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/flow/flow_case.hpp"
#include "app/flow/flow_checkpoint.hpp"
#include "app/flow/flow_output.hpp"
#include "core/rooms.hpp"
#include "core/timers.hpp"
#include "flow/carried_operator.hpp"
#include "flow/radiation_operator.hpp"
#include "flow/step_control.hpp"
#include "flow/transport_operator.hpp"
#include "io/run_folder.hpp"
#include "io/run_record.hpp"

namespace lampblack::app {

class FlowLoop {
 public:
  FlowLoop(MPI_Comm comm, FlowCase flowCase);
  FlowLoop(const FlowLoop&) = delete;
  FlowLoop& operator=(const FlowLoop&) = delete;

  // Takes everything from a checkpoint. InputError where it is another run's; nothing is written.
  void load(const WholeCheckpoint& checkpoint);

  [[nodiscard]] std::int64_t cells() const { return mesh_.totalCells; }

  void run(const RunFolder& folder, const RunInfo& info);

  void report(double wallTime, RunRecord& record);

 private:
  ReactionOperator::Options keepingFailedCells(ReactionOperator::Options options);

  struct Peak {
    double value = 0.0;
    Vector3 place{};
  };

  double chooseStep(double previous, double until);

  void beginNext();

  void step(double dt);

  Peak peakOf(const std::function<double(int)>& value) const;

  HistoryRow observe();

  [[nodiscard]] std::string status(const HistoryRow& row) const;

  // All that the next step, its outputs and the report depend on.
  void saveOrLoad(StateArchive& archive, std::vector<double>& history);

  // What the run had written before: its results and history are whole again.
  void restore(ResultsWriter& results, HistoryWriter& history);

  // What kept it from being written, or nothing: a run does not end because its checkpoint has no room.
  std::string writeCheckpoint(FlowCheckpoints& checkpoints, const ResultsWriter& results, const HistoryWriter& history);

  // Writes a checkpoint, keeps the last state in the results too, and raises Stopped.
  [[noreturn]] void stop(int signal, const RunFolder& folder, FlowCheckpoints& checkpoints, ResultsWriter& results,
                         HistoryWriter& history);

  void output(ResultsWriter& results);

  MPI_Comm comm_;
  FlowCase case_;
  std::optional<RunFolder> folder_;  // once it runs
  Mesh mesh_;
  HaloExchange halo_;
  Thermo thermo_;
  Transport transport_;
  FlowContext context_;
  State state_;
  TransportOperator flow_;
  ReactionOperator chemistry_;
  std::unique_ptr<CarriedOperator> carried_;
  std::unique_ptr<RadiationOperator> radiation_;
  std::unique_ptr<StepControl> stepControl_;
  std::vector<Operator*> operators_;  // each advances over the step, one after the other
  std::unique_ptr<Budget> budget_;
  Timers timers_;
  std::optional<WholeCheckpoint> restart_;  // what the run goes on from
  std::vector<double> earlierRows_;         // of the history before that
  double time_ = 0.0;
  double dt_ = 0.0;  // of the last step
  double nextOutput_ = 0.0;
  std::int64_t steps_ = 0;
  std::int64_t written_ = -1;  // the last step in the results
  HistoryRow last_;
  Peak peakTemperature_;
};

}  // namespace lampblack::app
