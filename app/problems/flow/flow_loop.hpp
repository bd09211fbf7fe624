// One run of a flow: time steps, retries of failed steps, the search for a steady state, output, checkpoints and
// repartitioning.
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

#include "app/problems/flow/closing_stage.hpp"
#include "app/problems/flow/flow_case.hpp"
#include "app/problems/flow/flow_checkpoint.hpp"
#include "app/problems/flow/flow_domain.hpp"
#include "app/problems/flow/flow_output.hpp"
#include "app/problems/flow/flow_tables.hpp"
#include "core/mesh_quality.hpp"
#include "core/modules.hpp"
#include "core/state_backup.hpp"
#include "core/timers.hpp"
#include "core/wall_limit.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/peak.hpp"
#include "flow/steady/flame_steepness.hpp"
#include "flow/steady/flow_branch.hpp"
#include "flow/steady/leading_modes.hpp"
#include "flow/steady/residual_norms.hpp"
#include "flow/steady/steadiness.hpp"
#include "flow/steady/steady_iteration.hpp"
#include "flow/steady/steady_rounds.hpp"
#include "flow/steady/steady_search.hpp"
#include "flow/stepping/cell_costs.hpp"
#include "io/json.hpp"
#include "io/progress.hpp"
#include "io/run_folder.hpp"
#include "io/run_record.hpp"

namespace lampblack::app {

class FlowLoop {
 public:
  FlowLoop(MPI_Comm comm, FlowCase flowCase);
  FlowLoop(const FlowLoop&) = delete;
  FlowLoop& operator=(const FlowLoop&) = delete;

  // Reads the state from a checkpoint; writes nothing. InputError where the checkpoint belongs to another run.
  void load(const WholeCheckpoint& checkpoint);

  [[nodiscard]] std::int64_t cells() const { return domain_->mesh.totalCells; }

  [[nodiscard]] const MeshQuality& quality() const { return quality_; }
  // Of the case, and of the file of its mesh.
  [[nodiscard]] const std::vector<std::string>& notes() const { return case_.notes; }

  // A further operator of each step, behind the case's own, which has to live as long; before load() and run().
  // Collective.
  void addOperator(Operator& added);

  // Collective. What the user should know of the state that the run is to begin with, of the deck or loaded.
  void warnOfStart() const { domain_->warnOfThinCells(case_); }
  void run(const RunFolder& folder, const RunInfo& info);

  // Between two steps: partitions the mesh by these weights of the owned cells and moves the state. Collective.
  void repartition(const std::vector<double>& weights);
  // The mesh as it is partitioned now.
  [[nodiscard]] const Mesh& mesh() const { return domain_->mesh; }
  [[nodiscard]] const CellCosts& costs() const { return costs_; }

  // Writes numbers of steps and the time reached into the record.
  void count(RunRecord& record) const;
  // Collective: what its parts took, and memory.
  void measure(RunRecord& record) const;

  void report(double wallTime, RunRecord& record);
  // The part of the report that is of the search. Collective.
  void tellSearch();
  // What came of the search, of a run on a coarser mesh; after tellSearch(). Collective.
  [[nodiscard]] TimeControl::Search::Coarser searchAsCoarser() const;

 private:
  // Output of a run in progress.
  struct Outputs {
    const RunFolder& folder;
    ResultsWriter results;
    HistoryWriter history;
    Progress progress;
    FlowCheckpoints checkpoints;
  };
  // Requests that all ranks have agreed on.
  struct Requests {
    int signal = 0;  // the signal to stop; 0: none
    bool checkpoint = false, wallLimit = false;
  };

  ReactionOperator::Options withFailedCellFiles(ReactionOperator::Options options);

  double chooseStep(double previous, double until);

  // Whether the run is to end as steady, and whether it is to end.
  [[nodiscard]] bool isSteady() const;
  [[nodiscard]] bool isAtEnd() const;
  // The state after a step that was taken, or the one to begin with.
  void watchSteadiness();

  void beginNextStep();
  // The same after the state was loaded.
  void resumeFromLoadedState();

  void step(double dt);
  // The next step in time, until an output or the end.
  void stepInTime(Outputs& outputs);

  // A step that fails is repeated from its start with a shorter dt (s). NumericsError where the last retry fails; the
  // last good state is then on disk.
  void stepWithRetries(double dt, Outputs& outputs);

  // A step in time or an iteration, whichever the search for the steady state wants next. NumericsError where it is
  // given up; the last state is then on disk.
  void searchOn(Outputs& outputs);
  void iterate(Outputs& outputs);
  void makeIteration();
  // Collective. Models of turbulence take the molecular viscosity of the flow's operator, which iterations do not
  // change.
  void evaluateForEddies();
  // Collective. Of the state that steps have led to, as searchOn() takes it.
  [[nodiscard]] SteadySearch::Residual evaluateForSearch();
  // Gas and ensembles in turn: what the present turn wants next, and what it has led to.
  void takeTurn(Outputs& outputs);
  void endTurnOfGas(Outputs& outputs);
  void endTurnOfParticles(Outputs& outputs);
  void warnOfRounds() const;
  [[nodiscard]] std::vector<std::string> roundLines() const;
  void addRounds(JsonWriter& json) const;
  // From iterations that have ended in vain to steps in time.
  void goBack(Outputs& outputs, int attemptsBefore);
  // Lights the flow where steps in time have come to their end and nothing burns, though the start was hot.
  void lightIfDark(Outputs& outputs);
  // Collective. Whether there is gas as hot as a start has that is to light a flame.
  [[nodiscard]] bool isHot() const;
  // Collective. Whether there is a flame in the state, or the mechanism has no reactions.
  [[nodiscard]] bool burnsOrCannot() const;
  // Collective. Whether an attempt to iterate may be made: something burns, or is hot and could.
  [[nodiscard]] bool mayAttempt() const;
  [[noreturn]] void giveUp(Outputs& outputs);
  // Collective. Of the state now; kept in norms_.
  void findNorms(const FlowResidual& residual);
  [[nodiscard]] double largestNorm() const;
  [[nodiscard]] SteadySearch::Residual residualOfSearch() const;
  // W/m^3, of the owned cells; W (or per metre or radian) of the domain, zero below Steadiness::leastHeat(),
  // collective.
  [[nodiscard]] std::vector<double> heatRelease() const;
  [[nodiscard]] double totalHeatRelease() const;
  void saveOrLoadSearch(StateArchive& archive);
  // Collective. Of the steady state that was found, where it is asked for.
  void findStability();
  [[nodiscard]] std::vector<std::string> stabilityLines() const;
  void addStability(JsonWriter& json) const;
  void writeStability(ResultsWriter& results) const;
  // Collective. The branch through the steady state that was found, where it is asked for; the flow is then as it was.
  void followBranch(Outputs& outputs);
  [[nodiscard]] std::vector<std::string> branchLines() const;
  void addBranch(JsonWriter& json) const;
  void writeBranch(ResultsWriter& results) const;
  // Of the search: columns and values of the history, for the closing report.
  [[nodiscard]] std::vector<Quantity> searchColumns() const;
  [[nodiscard]] std::vector<double> searchValues() const;
  [[nodiscard]] std::vector<std::string> searchLines() const;
  // For the line of progress: where the search is, and how far of the way.
  [[nodiscard]] std::string searchPlace() const;
  [[nodiscard]] double searchProgress() const;
  [[nodiscard]] bool isTurnOfParticles() const { return rounds_ && rounds_->turn() == SteadyRounds::Turn::Particles; }

  // The mesh, partitioned by the weights of the owned cells.
  Mesh partitionedBy(const std::vector<double>& weights);
  // Replaces the mesh; the state is then not set.
  void replaceMesh(Mesh mesh);
  // Partitions the mesh by the measured costs, where the deck asks for it and the costs of the ranks are uneven.
  void repartitionIfUneven(Outputs& outputs);
  void moveTo(Mesh mesh, const std::vector<double>& weights);

  // After a step: gathers the requests of all ranks in one reduction. NumericsError where a value of the state is not
  // finite.
  void checkStateAndRequests(FlowCheckpoints& checkpoints);

  // Everything a step changes: state, operators and budget.
  void saveOrLoadParts(StateArchive& archive);

  // Restores the state at the start of the step.
  void restoreStepStart(double time, std::int64_t steps);

  // Saves the last good state and throws the failure with the steps tried (s).
  [[noreturn]] void endAfterFailure(Outputs& outputs, const std::exception_ptr& failure,
                                    const std::vector<double>& tried);

  [[nodiscard]] std::vector<Quantity> columns() const;
  HistoryRow observe();
  // Writes the present state as a row of the history and of its tables.
  HistoryRow writeRow(HistoryWriter& history);
  void checkResult() const;
  [[nodiscard]] FlowTables::Source tableSource() { return domain_->tableSource(operators_); }

  [[nodiscard]] std::string status(const HistoryRow& row) const;
  // The operator that alone advances from now on, in a gas that stays as it is; null: all do.
  [[nodiscard]] const Operator* holder() const;
  // How far from steady the run ended, for the closing report.
  [[nodiscard]] std::vector<std::string> steadyLines() const;
  void addSearch(JsonWriter& json) const;
  // Collective. By equation; nothing where an operator is stochastic, whose rates are those of single events, nor, with
  // a warning, where the gas has no properties or rates.
  [[nodiscard]] std::vector<ResidualNorm> residualNow();
  // The same for the record.
  [[nodiscard]] std::string steadyJson(const std::vector<ResidualNorm>& residual,
                                       const std::optional<flow::FlameSteepness>& flame) const;

  // All that the next step, its outputs and the report depend on.
  void saveOrLoad(StateArchive& archive, std::vector<double>& history);

  // Restores the results and the history that the restarted run had written.
  void restore(ResultsWriter& results, HistoryWriter& history);

  // Returns the reason why the checkpoint could not be written, or nothing. The run continues on a full disk.
  std::string writeCheckpoint(Outputs& outputs);

  // The present state in the results and as a row of the history, where they do not have it yet.
  void writeLastState(Outputs& outputs);
  // Writes a checkpoint and the last state in the results; returns the text that says where.
  std::string saveLastState(Outputs& outputs);
  // What a model of turbulence wants of the cells beside walls and does not have, which may be why a run fails; "; ..."
  // or empty.
  [[nodiscard]] std::string mistakeAtWalls() const;

  // saveLastState(), then throws Stopped.
  [[noreturn]] void stop(Outputs& outputs);

  void output(ResultsWriter& results);

  MPI_Comm comm_;
  FlowCase case_;
  std::optional<RunFolder> folder_;  // once it runs
  Thermo thermo_;
  Transport transport_;
  std::unique_ptr<FlowDomain> domain_;
  std::vector<Operator*> added_, operators_;  // those of others; all, each advances over the step, one after the other
  std::vector<std::unique_ptr<ClosingStage>> closing_;
  MeshQuality quality_;
  Steadiness steadiness_;
  std::optional<SteadySearch> search_;
  std::optional<SteadyRounds> rounds_;  // with ensembles
  Steadiness gases_;                    // of the rounds, one behind the other: each as if a second after the last
  struct Stability {
    LeadingModes modes;
    double time = 0.0, step = 0.0;  // s, of a march and of its steps
  };
  std::optional<Stability> stability_;
  std::optional<FlowBranch> branch_;
  std::unique_ptr<FlowResidual> residual_;         // of the states that steps lead to; made where it is asked for
  std::unique_ptr<SteadyIteration> iteration_;     // while the search iterates
  std::optional<Steadiness> beforeIterations_;     // steadiness_ then
  std::vector<ResidualNorm> norms_;                // of the last state that was evaluated
  std::int64_t normsOf_ = -1;                      // its number of steps
  std::int64_t heldCells_ = 0, heldCellsOf_ = -1;  // of the last iteration, and its number of steps
  enum class ProcessorTimeOf { Steps, Iterations };
  // s, since the start or the restart; of this rank until tellSearch() or report() adds those of the others.
  std::array<double, 2> processorTime_{};
  [[nodiscard]] double& processorTime(ProcessorTimeOf of) { return processorTime_[static_cast<std::size_t>(of)]; }
  [[nodiscard]] double processorTime(ProcessorTimeOf of) const { return processorTime_[static_cast<std::size_t>(of)]; }
  CellCosts costs_;
  bool repartitions_;  // whether the mesh may still be partitioned anew
  std::unique_ptr<FlowTables> tables_;
  Timers timers_;
  std::optional<WholeCheckpoint> restart_;  // what the run goes on from
  std::vector<double> earlierRows_;         // of the history before that
  double time_ = 0.0;
  double dt_ = 0.0;         // of the last step
  bool startsHot_ = false;  // of a search: isHot() at its start
  double nextOutput_ = 0.0;
  std::int64_t steps_ = 0;
  std::int64_t written_ = -1, lastRow_ = -1;            // the last step in the results, and in the history
  std::int64_t retried_ = 0;                            // steps that failed and were tried again
  std::int64_t earlierSteps_ = 0, earlierRetried_ = 0;  // of these, before the restart
  StateBackup backup_;                                  // the start of the step
  WallLimit wallLimit_;
  double stepBegan_ = 0.0;  // s, secondsSinceStart()
  Requests requests_;
  HistoryRow last_;
  Peak peakTemperature_;
};

}  // namespace lampblack::app
