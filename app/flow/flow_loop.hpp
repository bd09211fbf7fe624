// One run of a flow: the operators of a step, and everything that watches them.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/flow/cell_costs.hpp"
#include "app/flow/flow_case.hpp"
#include "app/flow/flow_checkpoint.hpp"
#include "app/flow/flow_domain.hpp"
#include "app/flow/flow_output.hpp"
#include "app/flow/flow_tables.hpp"
#include "app/flow/wall_limit.hpp"
#include "core/kept_state.hpp"
#include "core/mesh_quality.hpp"
#include "core/modules.hpp"
#include "core/timers.hpp"
#include "flow/peak.hpp"
#include "io/progress.hpp"
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

  [[nodiscard]] std::int64_t cells() const { return domain_->mesh.totalCells; }

  [[nodiscard]] const MeshQuality& quality() const { return quality_; }

  // A further operator of each step, behind the case's own, which has to live as long; before load() and run().
  void addOperator(Operator& added) {
    added_.push_back(&added);
    operators_.push_back(&added);
  }

  void run(const RunFolder& folder, const RunInfo& info);

  // Between two steps: partitions the mesh by these weights of the owned cells and goes on there. Collective.
  void repartition(const std::vector<double>& weights);
  // The mesh as it is partitioned now.
  [[nodiscard]] const Mesh& mesh() const { return domain_->mesh; }
  [[nodiscard]] const CellCosts& costs() const { return costs_; }

  // How far the run has come.
  void count(RunRecord& record) const;

  void report(double wallTime, RunRecord& record);

 private:
  // What a run writes while it goes on.
  struct Outputs {
    const RunFolder& folder;
    ResultsWriter results;
    HistoryWriter history;
    Progress progress;
    FlowCheckpoints checkpoints;
  };
  struct Wishes {
    int signal = 0;  // that asks the run to stop
    bool checkpoint = false, wallLimit = false;
  };

  ReactionOperator::Options keepingFailedCells(ReactionOperator::Options options);

  double chooseStep(double previous, double until);

  void beginNext();
  // After loading.
  void beginFromLoaded();

  void step(double dt);

  // One that fails is taken back and tried again, smaller; where nothing helps, NumericsError with the last good state
  // on disk.
  void stepOrRetry(double dt, Outputs& outputs);

  // The mesh in pieces of equal weight, of which each owned cell of the present one has what is given.
  Mesh partitionedBy(const std::vector<double>& weights);
  // Goes over to this mesh, with everything blank.
  void install(Mesh mesh);
  // Where the deck asks for it and the ranks' costs have become uneven, partitions the mesh by them and goes on there.
  void repartitionIfUneven(Outputs& outputs);
  void moveTo(Mesh mesh, const std::vector<double>& weights);

  // What ranks agree on after a step, in one reduction; NumericsError where a value of the state is not finite.
  void agree(FlowCheckpoints& checkpoints);

  // State, operators and budget: what a step changes.
  void saveOrLoadParts(StateArchive& archive);

  void takeBack(double time, std::int64_t steps);

  [[noreturn]] void giveUp(Outputs& outputs, const std::exception_ptr& failure, const std::vector<double>& tried);

  HistoryRow observe();
  // What the state is now, as a row of the history and of the tables that go with it.
  HistoryRow writeRow(HistoryWriter& history);
  [[nodiscard]] FlowTables::Source tableSource() {
    return {domain_->state, domain_->flow, operators_, domain_->ensembles.get()};
  }

  [[nodiscard]] std::string status(const HistoryRow& row) const;

  // All that the next step, its outputs and the report depend on.
  void saveOrLoad(StateArchive& archive, std::vector<double>& history);

  // What the run had written before: its results and history are whole again.
  void restore(ResultsWriter& results, HistoryWriter& history);

  // What kept it from being written, or nothing: a run does not end because its checkpoint has no room.
  std::string writeCheckpoint(Outputs& outputs);

  // Writes a checkpoint, keeps the last state in the results too, and says where.
  std::string keepLast(Outputs& outputs);

  // With both kept, raises Stopped.
  [[noreturn]] void stop(Outputs& outputs);

  void output(ResultsWriter& results);

  MPI_Comm comm_;
  FlowCase case_;
  std::optional<RunFolder> folder_;  // once it runs
  Thermo thermo_;
  Transport transport_;
  std::unique_ptr<FlowDomain> domain_;
  std::vector<Operator*> added_, operators_;  // those of others; all, each advances over the step, one after the other
  MeshQuality quality_;
  CellCosts costs_;
  bool repartitions_;  // whether the mesh may still be partitioned anew
  std::unique_ptr<FlowTables> tables_;
  Timers timers_;
  std::optional<WholeCheckpoint> restart_;  // what the run goes on from
  std::vector<double> earlierRows_;         // of the history before that
  double time_ = 0.0;
  double dt_ = 0.0;  // of the last step
  double nextOutput_ = 0.0;
  std::int64_t steps_ = 0;
  std::int64_t written_ = -1;  // the last step in the results
  std::int64_t retried_ = 0;   // steps that failed and were tried again
  KeptState kept_;             // the start of the step
  WallLimit wallLimit_;
  double stepBegan_ = 0.0;  // s, secondsSinceStart()
  Wishes wishes_;
  HistoryRow last_;
  Peak peakTemperature_;
};

}  // namespace lampblack::app
