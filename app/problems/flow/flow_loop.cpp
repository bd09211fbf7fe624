#include "app/problems/flow/flow_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "app/problems/flow/flow_mesh.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/wall_clock.hpp"

namespace lampblack::app {

FlowLoop::FlowLoop(MPI_Comm comm, FlowCase flowCase)
    : comm_(comm),
      case_(std::move(flowCase)),
      thermo_(*case_.mechanism),
      transport_(*case_.mechanism, case_.transport.averaged()),
      domain_(std::make_unique<FlowDomain>(makeMesh(comm, case_), case_, thermo_, transport_,
                                           withFailedCellFiles(case_.chemistry))),
      operators_(domain_->operators),
      closing_(closingStages(case_)),
      quality_(domain_->mesh),
      steadiness_(domain_->context, domain_->state,
                  {case_.time.steadyTime(), std::ranges::none_of(domain_->operators, &Operator::isStochastic)}),
      search_(case_.time.search),
      gases_(domain_->context, domain_->state, {.time = 1.0, .hasParticles = false}),
      costs_(domain_->mesh),
      repartitions_(case_.repartition.has_value() && domain_->mesh.ranks > 1),
      backup_(domain_->mesh.owned, domain_->mesh.faces),
      wallLimit_(case_.time.wallLimit) {
  if (search_ && case_.time.search->rounds) rounds_.emplace(*case_.time.search->rounds);
  domain_->setStart(case_);
  startsHot_ = isHot();
  beginNextStep();
  steadiness_.begin(domain_->state, time_);
  domain_->beginBudget(case_);
  tables_ = std::make_unique<FlowTables>(domain_->context, case_, tableSource());
  for (const auto& stage : closing_) stage->check(domain_->context);
  dt_ = case_.time.firstStep;
  nextOutput_ = case_.output.interval;
}

void FlowLoop::addOperator(Operator& added) {
  added_.push_back(&added);
  operators_.push_back(&added);
  tables_ = std::make_unique<FlowTables>(domain_->context, case_, tableSource());  // with what it has
}

void FlowLoop::load(const WholeCheckpoint& checkpoint) {
  const double start = secondsSinceStart();
  CheckpointReader reader(comm_, checkpoint.file, stateNumbers(domain_->mesh),
                          flowFingerprint(case_, domain_->state.scalars));
  // On as many ranks the same pieces, and the same bits; on others pieces by what cells have cost.
  CellCosts stored(domain_->mesh);
  stored.saveOrLoad(reader);
  const bool hasOtherRanks = stored.ranks() != domain_->mesh.ranks;
  const std::vector<double>& weights = hasOtherRanks ? stored.weights() : stored.present();
  if (domain_->mesh.ranks > 1 && !areEven(comm_, weights)) {
    replaceMesh(partitionedBy(weights));
    reader.renumber(stateNumbers(domain_->mesh));
  }
  saveOrLoad(reader, earlierRows_);
  tables_->load(reader);
  if (hasOtherRanks) costs_.adopt(domain_->mesh.ranks, costs_.weights());
  resumeFromLoadedState();
  const std::size_t width = columns().size();
  if (!earlierRows_.empty()) lastRow_ = static_cast<std::int64_t>(earlierRows_.at(earlierRows_.size() - width));
  earlierSteps_ = steps_;
  earlierRetried_ = retried_;
  restart_ = checkpoint;
  wallLimit_.recordCheckpoint(secondsSinceStart() - start);  // reading it; writing is no faster
  if (!search_ && time_ >= case_.time.end * (1.0 - 1e-12))
    printWarnings(
        {fmt::format("no step is left: the checkpoint is of t = {:.6g} s, and time.end is {:.6g} s; a later "
                     "time.end goes on",
                     time_, case_.time.end)});
}

void FlowLoop::run(const RunFolder& folder, const RunInfo& info) {
  folder_ = folder;
  for (Operator* op : operators_) op->beginRun();
  Outputs outputs{
      folder, ResultsWriter(comm_, folder.results(), info, meshOutput(domain_->mesh), case_.output.storage),
      HistoryWriter(comm_, folder.history(), columns()),
      search_ ? Progress(comm_, 0.0, 1.0) : Progress(comm_, time_, case_.time.end),
      FlowCheckpoints(comm_, case_.checkpoint, flowFingerprint(case_, domain_->state.scalars), folder.path())};
  auto& [_, results, history, progress, checkpoints] = outputs;
  tables_->open(folder);
  std::vector<std::string> species;
  for (std::size_t k = 0; k < case_.mechanism->numSpecies(); ++k) species.push_back(case_.mechanism->speciesName(k));
  results.texts("/species/name", species, "species of the mechanism");
  results.dataset("/species/molar_mass", {static_cast<std::int64_t>(species.size())},
                  case_.mechanism->molecularWeights(), "kg/mol", "molar masses of the species");
  for (const Operator* op : operators_)
    for (const auto& [quantity, values] : op->datasets())
      results.dataset(quantity.name, {static_cast<std::int64_t>(values.size())}, values, quantity.unit,
                      quantity.description);
  if (restart_) {
    restore(results, history);
    checkpoints.startedFrom(*restart_, steps_);
  } else {
    output(results);
  }
  checkStateAndRequests(checkpoints);
  while (!isAtEnd()) {
    if (requests_.signal != 0 || requests_.wallLimit) stop(outputs);
    if (requests_.checkpoint) {
      requests_.checkpoint = false;
      progress.finish();
      const std::string problem = writeCheckpoint(outputs);
      if (!problem.empty()) printWarnings({problem});
    }
    stepBegan_ = secondsSinceStart();
    if (rounds_)
      takeTurn(outputs);
    else if (search_)
      searchOn(outputs);
    else
      stepInTime(outputs);
    const bool due = time_ >= nextOutput_ * (1.0 - 1e-12) || isAtEnd();
    if (due || steps_ % case_.output.historySteps == 0) {
      const HistoryRow row = writeRow(history);
      if (search_)
        progress.say(searchPlace(), searchProgress(), status(row));
      else
        progress.update(steps_, time_, dt_, status(row));
    }
    if (due) {
      output(results);
      nextOutput_ += case_.output.interval;
    }
    repartitionIfUneven(outputs);
    wallLimit_.recordStep(secondsSinceStart() - stepBegan_);
  }
  progress.finish();
  warnOfRounds();
  if (case_.time.steady && !isSteady()) {
    printWarnings({fmt::format("time.end, {:.6g} s, has come before the flow is steady", case_.time.end)});
  }
  if (domain_->turbulence)
    if (const std::string warning = domain_->turbulence->warning(); !warning.empty()) printWarnings({warning});
  if (case_.checkpoint.atEnd) {
    const std::string problem = writeCheckpoint(outputs);
    if (!problem.empty()) printWarnings({problem});
  }
  writeLastState(outputs);  // of a restart with nothing to do
  findStability();
  followBranch(outputs);
  // What fails after the last step takes nothing from the flow: its results are closed first.
  std::exception_ptr failure;
  try {
    checkResult();
  } catch (const NumericsError&) {
    failure = std::current_exception();
  }
  for (const auto& stage : closing_) {
    const Timers::Scope scope(timers_, stage->name());
    try {
      stage->run(domain_->context, domain_->state, domain_->flow.properties(), results, &*folder_);
    } catch (const NumericsError&) {
      if (!failure) failure = std::current_exception();
    }
  }
  const Timers::Scope scope(timers_, "output");
  history.writeTo(results);
  tables_->writeTo(results);
  writeStability(results);
  writeBranch(results);
  results.close();
  if (failure) std::rethrow_exception(failure);
}

bool FlowLoop::isSteady() const {
  if (rounds_) return rounds_->isDone() && rounds_->agrees();
  if (search_) return search_->isSteady();
  const std::optional<SteadyControl>& steady = case_.time.steady;
  return steady && time_ >= steady->after && steadiness_.isSteady(steady->tolerance, steady->norm);
}

bool FlowLoop::isAtEnd() const {
  return time_ >= case_.time.end * (1.0 - 1e-12) || isSteady() || (rounds_ && rounds_->isDone());
}

void FlowLoop::watchSteadiness() {
  const Timers::Scope scope(timers_, "monitoring");
  steadiness_.add(
      domain_->state, domain_->flow.properties(), [this] { return heatRelease(); }, time_);
}

std::vector<double> FlowLoop::heatRelease() const {
  std::vector<double> heat;
  const auto keep = [&](const Quantity&, std::span<const double> values) { heat.assign(values.begin(), values.end()); };
  domain_->chemistry.fields(domain_->state, Operator::FieldSink(keep));
  return heat;
}

void FlowLoop::stepInTime(Outputs& outputs) {
  stepWithRetries(chooseStep(dt_, std::min(nextOutput_, case_.time.end)), outputs);
  watchSteadiness();
}

double FlowLoop::chooseStep(double previous, double until) {
  double dt = std::min(case_.time.maximumStep, previous * case_.time.growth);
  for (Operator* op : operators_) dt = std::min(dt, op->largestStep(domain_->state));
  if (steps_ == 0) dt = std::min(dt, case_.time.firstStep);
  // Land on the output without a sliver of a step before it.
  const double left = until - time_;
  if (dt >= left) return left;
  return left < 2.0 * dt ? 0.5 * left : dt;
}

// What the operators tell of the state: the rates of the last sweep, and that a step begins here.
void FlowLoop::beginNextStep() {
  for (Operator* op : operators_) op->endStep(domain_->state);
  for (Operator* op : operators_) op->endSweep(domain_->state);
}

void FlowLoop::resumeFromLoadedState() {
  domain_->state.updateHalo(domain_->halo);
  // Nothing else evaluates a gas that is held.
  if (holder() != nullptr && (rounds_ || domain_->turbulence)) domain_->adopt(case_);
  beginNextStep();
}

const Operator* FlowLoop::holder() const {
  const auto found = std::ranges::find_if(operators_, [this](const Operator* op) { return op->holdsOthers(time_); });
  return found == operators_.end() ? nullptr : *found;
}

void FlowLoop::step(double dt) {
  const Operator* alone = holder();
  for (int sweep = 0; sweep < case_.flow.sweeps; ++sweep) {
    for (Operator* op : operators_) {
      if (alone != nullptr && op != alone) continue;
      const Timers::Scope scope(timers_, op->name());
      op->advance(domain_->state, time_, dt);
    }
    if (sweep + 1 < case_.flow.sweeps)
      for (Operator* op : operators_) op->endSweep(domain_->state);
  }
  beginNextStep();
  time_ += dt;
  ++steps_;
}

}  // namespace lampblack::app
