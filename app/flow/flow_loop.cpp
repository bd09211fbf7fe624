#include "app/flow/flow_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "app/flow/flow_mesh.hpp"
#include "app/flow/trajectories.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/wall_clock.hpp"

namespace lampblack::app {

FlowLoop::FlowLoop(MPI_Comm comm, FlowCase flowCase)
    : comm_(comm),
      case_(std::move(flowCase)),
      mesh_(makeMesh(comm, case_)),
      halo_(mesh_),
      thermo_(*case_.mechanism),
      transport_(*case_.mechanism, case_.transport.averaged()),
      context_{mesh_,
               halo_,
               *case_.mechanism,
               thermo_,
               transport_,
               case_.boundaries,
               case_.gravity,
               case_.referenceDensity,
               std::ranges::any_of(case_.boundaries, [](const BoundaryCondition& b) { return !b.varies.isEmpty(); })
                   ? std::make_shared<BoundaryValues>(mesh_, case_.boundaries, thermo_)
                   : nullptr,
               case_.transport},
      state_(mesh_, case_.mechanism->numSpecies(),
             case_.carried ? CarriedOperator::scalarsOf(*case_.carried) : std::vector<CarriedScalar>{}, case_.swirls),
      flow_(context_, state_, case_.flow),
      chemistry_(context_, keepingFailedCells(case_.chemistry)),
      kept_(mesh_.owned, mesh_.faces),
      wallLimit_(case_.time.wallLimit) {
  state_.thermodynamicPressure = case_.pressure;
  if (case_.carried) carried_ = std::make_unique<CarriedOperator>(context_, *case_.carried, 0, case_.carriedOptions);
  collectively(comm_, [&] {
    setMixingLayer(context_, case_.initial, state_);
    setInitialFields(context_, case_.initialFields, state_);
  });
  flow_.initialise(state_, case_.time.firstStep);
  operators_ = {&flow_, &chemistry_};
  if (carried_) operators_.push_back(carried_.get());
  if (case_.radiation.on) {
    radiation_ = std::make_unique<RadiationOperator>(context_, case_.radiation.surroundings, case_.carried.get());
    operators_.push_back(radiation_.get());
  }
  if (case_.time.tolerance) {
    stepControl_ = std::make_unique<StepControl>(context_, *case_.time.tolerance, case_.flow.sweeps);
    operators_.push_back(stepControl_.get());
  }
  beginNext();
  std::vector<std::vector<double>> carriedMass;
  if (case_.carried)
    for (const CarriedModel::Scalar& scalar : case_.carried->scalars()) carriedMass.push_back(scalar.elements);
  budget_ = std::make_unique<Budget>(context_, massAndElements(*case_.mechanism, carriedMass), state_);
  flow_.watchBoundary([this](const TransportOperator::BoundaryAmounts& amounts) { budget_->addStep(amounts); });
  tables_ = std::make_unique<FlowTables>(context_, case_, tableSource());
  dt_ = case_.time.firstStep;
  nextOutput_ = case_.output.interval;
}

std::vector<std::string> FlowLoop::notesOfMesh() const {
  if (mesh_.facesBeyond == 0) return {};
  return {
      fmt::format("{} of the mesh's {} faces are turned by more than 76 degrees from the steps between their cells: "
                  "what diffuses and presses along them counts as at 76 degrees; better shaped cells are more accurate",
                  mesh_.facesBeyond, mesh_.totalFaces)};
}

void FlowLoop::load(const WholeCheckpoint& checkpoint) {
  const double start = secondsSinceStart();
  CheckpointReader reader(comm_, checkpoint.file, stateNumbers(mesh_), flowFingerprint(case_, state_.scalars));
  saveOrLoad(reader, earlierRows_);
  tables_->load(reader);
  beginFromLoaded();
  restart_ = checkpoint;
  wallLimit_.checkpointTook(secondsSinceStart() - start);  // reading it; writing is no faster
}

void FlowLoop::run(const RunFolder& folder, const RunInfo& info) {
  folder_ = folder;
  Outputs outputs{folder, ResultsWriter(comm_, folder.results(), info, meshOutput(mesh_)),
                  HistoryWriter(comm_, folder.history(), historyColumns(operators_, budget_->lines(state_))),
                  Progress(comm_, time_, case_.time.end),
                  FlowCheckpoints(mesh_, case_.checkpoint, flowFingerprint(case_, state_.scalars), folder.path())};
  auto& [_, results, history, progress, checkpoints] = outputs;
  tables_->open(folder);
  if (restart_) {
    restore(results, history);
    checkpoints.startedFrom(*restart_, steps_);
  } else {
    output(results);
  }
  agree(checkpoints);
  while (time_ < case_.time.end * (1.0 - 1e-12)) {
    if (wishes_.signal != 0 || wishes_.wallLimit) stop(outputs);
    if (wishes_.checkpoint) {
      wishes_.checkpoint = false;
      progress.finish();
      const std::string problem = writeCheckpoint(outputs);
      if (!problem.empty()) printWarnings({problem});
    }
    stepBegan_ = secondsSinceStart();
    stepOrRetry(chooseStep(dt_, std::min(nextOutput_, case_.time.end)), outputs);
    const bool due = time_ >= nextOutput_ * (1.0 - 1e-12) || time_ >= case_.time.end * (1.0 - 1e-12);
    if (due || steps_ % case_.output.historySteps == 0) {
      const HistoryRow row = writeRow(history);
      progress.update(steps_, time_, dt_, status(row));
    }
    if (due) {
      output(results);
      nextOutput_ += case_.output.interval;
    }
    wallLimit_.stepTook(secondsSinceStart() - stepBegan_);
  }
  progress.finish();
  if (case_.checkpoint.atEnd) {
    const std::string problem = writeCheckpoint(outputs);
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
  tables_->writeTo(results);
  results.close();
  if (failure) std::rethrow_exception(failure);
}

double FlowLoop::chooseStep(double previous, double until) {
  double dt = std::min(case_.time.maximumStep, previous * case_.time.growth);
  for (Operator* op : operators_) dt = std::min(dt, op->largestStep(state_));
  if (steps_ == 0) dt = std::min(dt, case_.time.firstStep);
  // Land on the output without a sliver of a step before it.
  const double left = until - time_;
  if (dt >= left) return left;
  return left < 2.0 * dt ? 0.5 * left : dt;
}

// What the operators tell of the state: the rates of the last sweep, and that a step begins here.
void FlowLoop::beginNext() {
  for (Operator* op : operators_) op->endStep(state_);
  for (Operator* op : operators_) op->endSweep(state_);
}

void FlowLoop::beginFromLoaded() {
  state_.updateHalo(halo_);
  beginNext();
}

void FlowLoop::step(double dt) {
  for (int sweep = 0; sweep < case_.flow.sweeps; ++sweep) {
    for (Operator* op : operators_) {
      const Timers::Scope scope(timers_, op->name());
      op->advance(state_, time_, dt);
    }
    if (sweep + 1 < case_.flow.sweeps)
      for (Operator* op : operators_) op->endSweep(state_);
  }
  beginNext();
  time_ += dt;
  ++steps_;
}

}  // namespace lampblack::app
