#include "app/flow/flow_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "app/flow/flow_case.hpp"
#include "app/flow/flow_checkpoint.hpp"
#include "app/flow/flow_output.hpp"
#include "app/flow/trajectories.hpp"
#include "app/run/failed_cell.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "core/system_error.hpp"
#include "core/timers.hpp"
#include "flow/carried_operator.hpp"
#include "flow/transport_operator.hpp"
#include "io/progress.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

// One run: the operators of one step and everything that watches them.
class FlowRun {
 public:
  FlowRun(MPI_Comm comm, FlowCase flowCase)
      : comm_(comm),
        case_(std::move(flowCase)),
        mesh_(comm, case_.mesh),
        halo_(mesh_),
        thermo_(*case_.mechanism),
        transport_(*case_.mechanism, case_.transport),
        context_{mesh_, halo_, *case_.mechanism, thermo_, transport_, case_.boundaries},
        state_(mesh_, case_.mechanism->numSpecies(),
               case_.carried ? CarriedOperator::scalarsOf(*case_.carried) : std::vector<CarriedScalar>{}),
        flow_(context_, state_, case_.flow),
        chemistry_(context_, keepingFailedCells(case_.chemistry)) {
    state_.thermodynamicPressure = case_.pressure;
    if (case_.carried) carried_ = std::make_unique<CarriedOperator>(context_, *case_.carried, 0, case_.carriedOptions);
    collectively(comm_, [&] { setMixingLayer(context_, case_.initial, state_); });
    flow_.initialise(state_, case_.time.firstStep);
    planStep();
    for (Operator* op : operators_) op->endStep(state_);
    std::vector<std::vector<double>> carriedMass;
    if (case_.carried)
      for (const CarriedModel::Scalar& scalar : case_.carried->scalars()) carriedMass.push_back(scalar.elements);
    budget_ = std::make_unique<Budget>(context_, massAndElements(*case_.mechanism, carriedMass), state_);
    flow_.watchBoundary([this](const TransportOperator::BoundaryAmounts& amounts) { budget_->addStep(amounts); });
    dt_ = case_.time.firstStep;
    nextOutput_ = case_.output.interval;
  }

  // Takes everything from a checkpoint. InputError where it is another run's; nothing is written.
  void load(const WholeCheckpoint& checkpoint) {
    CheckpointReader reader(comm_, checkpoint.file, stateNumbers(mesh_), flowFingerprint(case_, state_.scalars));
    saveOrLoad(reader, earlierRows_);
    state_.updateHalo(halo_);
    for (Operator* op : operators_) op->endStep(state_);
    restart_ = checkpoint;
  }

  [[nodiscard]] std::int64_t cells() const { return mesh_.totalCells; }

  void run(const RunFolder& folder, const RunInfo& info) {
    folder_ = folder;
    ResultsWriter results(comm_, folder.results(), info, meshOutput(mesh_));
    HistoryWriter history(comm_, folder.history(), historyColumns(operators_, budget_->lines(state_)));
    Progress progress(comm_, time_, case_.time.end);
    FlowCheckpoints checkpoints(mesh_, case_.checkpoint, flowFingerprint(case_, state_.scalars), folder.path());
    if (restart_) {
      restore(results, history);
      checkpoints.startedFrom(*restart_, steps_);
    } else {
      output(results);
    }
    while (time_ < case_.time.end * (1.0 - 1e-12)) {
      if (const int signal = agreedStopRequest(comm_); signal != 0) stop(signal, folder, checkpoints, results, history);
      if (checkpoints.due(steps_)) {
        progress.finish();
        const std::string problem = writeCheckpoint(checkpoints, results, history);
        if (!problem.empty()) printWarnings({problem});
      }
      dt_ = chooseStep(dt_, std::min(nextOutput_, case_.time.end));
      step(dt_);
      const bool due = time_ >= nextOutput_ * (1.0 - 1e-12) || time_ >= case_.time.end * (1.0 - 1e-12);
      if (due || steps_ % case_.output.historySteps == 0) {
        const HistoryRow row = observe();
        history.row(historyValues(row));
        progress.update(steps_, time_, dt_, status(row));
      }
      if (due) {
        output(results);
        nextOutput_ += case_.output.interval;
      }
    }
    progress.finish();
    if (case_.checkpoint.atEnd) {
      const std::string problem = writeCheckpoint(checkpoints, results, history);
      if (!problem.empty()) printWarnings({problem});
    }
    if (last_.step != steps_) observe();  // a restart at the very end
    // A trajectory that fails takes nothing from the flow: its results are closed first.
    std::exception_ptr failure;
    if (case_.trajectories) {
      const Timers::Scope scope(timers_, "trajectories");
      try {
        runTrajectories(context_, case_, state_, flow_.properties(), results);
      } catch (const NumericsError&) {
        failure = std::current_exception();
      }
    }
    const Timers::Scope scope(timers_, "output");
    history.writeTo(results);
    results.close();
    if (failure) std::rethrow_exception(failure);
  }

  void report(double wallTime, RunRecord& record) {
    ClosingReport closing;
    closing.ranks = mesh_.ranks;
    closing.cells = mesh_.totalCells;
    closing.steps = steps_;
    closing.wallTime = wallTime;
    closing.peakMemoryPerRank = peakMemory(comm_);
    for (const auto& stage : timers_.gather(comm_))
      closing.stages.push_back({stage.name, stage.least, stage.mean, stage.most});
    for (const Operator* op : operators_)
      if (const auto imbalance = op->imbalance())
        closing.imbalances.push_back({op->name(), imbalance->before, imbalance->after});
    record.stages = closing.stages;
    record.peakMemoryPerRank = closing.peakMemoryPerRank;
    record.steps = steps_;
    record.cells = mesh_.totalCells;
    record.simulatedTime = time_;
    if (mesh_.rank != 0) return;
    std::cout << formatReport(closing);
    fmt::print("peak temperature {:.1f} K at {} = ({:.3f}, {:.3f}) mm\n", last_.extremes.maximumTemperature,
               mesh_.axisymmetric() ? "(r, z)" : "(x, y)", 1e3 * peakTemperature_.place[0],
               1e3 * peakTemperature_.place[1]);
    for (const Operator* op : operators_)
      for (const std::string& line : op->closingLines()) fmt::print("{}\n", line);
    for (const Budget::Line& line : last_.budget)
      fmt::print("budget of {:<5} closed to {:.2e} of the inflow\n", line.name, line.error);
    fmt::print("sum of mass fractions 1 to {:.1e}; most negative mass fraction {:.1e} (nothing is clipped)\n",
               last_.extremes.massFractionSumError, last_.extremes.minimumMassFraction);
  }

 private:
  ReactionOperator::Options keepingFailedCells(ReactionOperator::Options options) {
    options.keepFailed = [this](std::int64_t cell, const FailedCell& failed) {
      return keepFailedCell(folder_.value(), *case_.mechanism, cell, failed);
    };
    return options;
  }

  // A step is a sequence of operators, each over its share of the step.
  struct Stage {
    Operator* op;
    double share;
  };
  void planStep() {
    operators_ = {&flow_, &chemistry_};
    if (carried_) operators_.push_back(carried_.get());
    if (case_.chemistry.deferred) {
      for (Operator* op : operators_) stages_.push_back({op, 1.0});
      return;
    }
    // Strang splitting around the chemistry, which costs most and so is solved once a step.
    for (Operator* op : operators_)
      if (op != &chemistry_) stages_.push_back({op, 0.5});
    stages_.push_back({&chemistry_, 1.0});
    for (std::size_t i = stages_.size() - 1; i-- > 0;) stages_.push_back(stages_[i]);
  }

  struct Peak {
    double value = 0.0;
    std::array<double, 2> place{};
  };

  double chooseStep(double previous, double until) {
    double dt = std::min(case_.time.maximumStep, previous * case_.time.growth);
    for (Operator* op : operators_) dt = std::min(dt, op->largestStep(state_) / shareOf(op));
    if (steps_ == 0) dt = std::min(dt, case_.time.firstStep);
    // Land on the output without a sliver of a step before it.
    const double left = until - time_;
    if (dt >= left) return left;
    return left < 2.0 * dt ? 0.5 * left : dt;
  }

  // Of a step, that one stage of it advances.
  double shareOf(const Operator* op) const { return std::ranges::find(stages_, op, &Stage::op)->share; }

  void step(double dt) {
    for (const Stage& stage : stages_) {
      const Timers::Scope scope(timers_, stage.op->name());
      stage.op->advance(state_, time_, stage.share * dt);
    }
    for (Operator* op : operators_) op->endStep(state_);
    time_ += dt;
    ++steps_;
  }

  Peak peakOf(const std::function<double(int)>& value) const {
    struct {
      double value;
      int rank;
    } best{-1.0, mesh_.rank};
    Peak peak;
    for (int c = 0; c < mesh_.owned; ++c) {
      const double v = value(c);
      if (v > best.value) {
        best.value = v;
        peak.place = mesh_.centre[c];
      }
    }
    MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm_);
    MPI_Bcast(peak.place.data(), 2, MPI_DOUBLE, best.rank, comm_);
    peak.value = best.value;
    return peak;
  }

  HistoryRow observe() {
    const Timers::Scope scope(timers_, "monitoring");
    HistoryRow row;
    row.step = steps_;
    row.time = time_;
    row.dt = dt_;
    row.extremes = extremesOf(context_, state_);
    for (Operator* op : operators_) {
      const std::vector<double> values = op->historyValues(state_);
      row.operators.insert(row.operators.end(), values.begin(), values.end());
    }
    row.budget = budget_->lines(state_);
    peakTemperature_ = peakOf([&](int c) { return state_.temperature[c]; });
    last_ = row;
    return row;
  }

  [[nodiscard]] std::string status(const HistoryRow& row) const {
    std::string text = fmt::format("Tmax {:.0f} K", row.extremes.maximumTemperature);
    for (const Operator* op : operators_)
      if (const std::string more = op->status(); !more.empty()) text += "  " + more;
    return text;
  }

  // All that the next step, its outputs and the report depend on.
  void saveOrLoad(StateArchive& archive, std::vector<double>& history) {
    state_.saveOrLoad(archive);
    for (Operator* op : operators_) op->saveOrLoad(archive);
    budget_->saveOrLoad(archive);
    const double interval = case_.output.interval;
    std::vector<double> clock{time_,
                              static_cast<double>(steps_),
                              dt_,
                              nextOutput_,
                              interval,
                              static_cast<double>(written_),
                              static_cast<double>(historyColumns(operators_, budget_->lines(state_)).size())};
    const double columns = clock.back();
    archive.shared("clock", clock);
    archive.shared("history", history);
    if (!archive.loading()) return;
    collectively(comm_, [&] {
      if (clock.size() != 7 || clock[6] != columns)
        throw InputError("the checkpoint was written by another version of Lampblack, with another history");
    });
    time_ = clock[0];
    steps_ = static_cast<std::int64_t>(clock[1]);
    dt_ = clock[2];
    // Another interval counts from the start.
    nextOutput_ = clock[4] == interval ? clock[3] : interval * (std::floor(time_ / interval * (1.0 + 1e-12)) + 1.0);
    written_ = static_cast<std::int64_t>(clock[5]);
  }

  // What the run had written before: its results and history are whole again.
  void restore(ResultsWriter& results, HistoryWriter& history) {
    for (const auto& file : restart_->outputs) results.loadSteps(file);
    const std::size_t width = history.columnCount();
    for (std::size_t i = 0; i + width <= earlierRows_.size(); i += width)
      history.row(std::span<const double>(earlierRows_).subspan(i, width));
    earlierRows_.clear();
  }

  // What kept it from being written, or nothing: a run does not end because its checkpoint has no room.
  std::string writeCheckpoint(FlowCheckpoints& checkpoints, const ResultsWriter& results,
                              const HistoryWriter& history) {
    const Timers::Scope scope(timers_, "checkpoints");
    try {
      checkpoints.write(steps_, results, [&](StateArchive& archive) {
        std::vector<double> rows = history.rows();
        saveOrLoad(archive, rows);
      });
    } catch (const SystemError& error) {
      return fmt::format("no checkpoint at step {}: {}", steps_, error.what());
    }
    return "";
  }

  // Writes a checkpoint, keeps the last state in the results too, and raises Stopped.
  [[noreturn]] void stop(int signal, const RunFolder& folder, FlowCheckpoints& checkpoints, ResultsWriter& results,
                         HistoryWriter& history) {
    std::string checkpoint = writeCheckpoint(checkpoints, results, history);
    if (checkpoint.empty()) checkpoint = fmt::format("--restart goes on from {}", checkpoints.last().string());
    if (written_ != steps_) {
      history.row(historyValues(observe()));
      output(results);
    }
    history.writeTo(results);
    results.closePartial();
    const std::string kept = folder.partialResults().string();
    raiseStopped(
        comm_, signal,
        fmt::format("at t = {:.6g} s, step {}: the fields until then are in {}; {}", time_, steps_, kept, checkpoint));
  }

  void output(ResultsWriter& results) {
    const Timers::Scope scope(timers_, "output");
    written_ = steps_;
    writeFields(results, context_, case_, state_, operators_, steps_, time_);
  }

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
  std::vector<Operator*> operators_;
  std::vector<Stage> stages_;
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

class PreparedFlow : public PreparedRun {
 public:
  PreparedFlow(MPI_Comm comm, const Deck& deck) : comm_(comm), deck_(deck), start_(MPI_Wtime()) {
    int ranks = 1;
    MPI_Comm_size(comm, &ranks);
    FlowCase flowCase;
    collectively(comm, [&] {
      flowCase = readFlowCase(deck);
      const std::size_t cells = (flowCase.mesh.vertices[0].size() - 1) * (flowCase.mesh.vertices[1].size() - 1);
      if (cells < static_cast<std::size_t>(ranks))
        throw deck.error("mesh", fmt::format("{} cells cannot be spread over {} ranks", cells, ranks));
    });
    seed_ = flowCase.seed;
    notes_ = flowCase.notes;
    species_ = flowCase.mechanism->numSpecies();
    reactions_ = flowCase.mechanism->numReactions();
    run_ = std::make_unique<FlowRun>(comm, std::move(flowCase));
  }

  [[nodiscard]] std::string summary() const override {
    return fmt::format("{} cells, {} species, {} reactions", run_->cells(), species_, reactions_);
  }

  void run(const RunOptions& options) override {
    int rank = 0;
    MPI_Comm_rank(comm_, &rank);
    std::optional<WholeCheckpoint> restart;
    if (options.restart) {
      restart =
          options.restart->empty() ? newestCheckpoint(comm_, options.folder) : wholeCheckpoint(comm_, *options.restart);
      run_->load(*restart);
    }
    recordedRun(comm_, deck_, options, seed_, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
      if (rank == 0)
        for (const std::string& note : notes_) fmt::print("note: {}\n", note);
      if (restart) {
        record.restartedFrom = restart->file.string();
        printWarnings(restart->damaged);
        if (rank == 0) fmt::print("continues from {}\n", restart->file.string());
      }
      run_->run(folder, info);
      run_->report(MPI_Wtime() - start_, record);
    });
  }

 private:
  MPI_Comm comm_;
  const Deck& deck_;
  double start_;
  std::uint64_t seed_ = 0;
  std::vector<std::string> notes_;
  std::size_t species_ = 0, reactions_ = 0;
  std::unique_ptr<FlowRun> run_;
};

}  // namespace

std::unique_ptr<PreparedRun> prepareFlow(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedFlow>(comm, deck);
}

}  // namespace lampblack::app
