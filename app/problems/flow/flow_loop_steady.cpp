// The search for the steady state of a flow: what of it is steps in time and what iterations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "app/problems/flow/coarser_meshes.hpp"
#include "app/problems/flow/flow_loop.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "core/system_error.hpp"

namespace lampblack::app {
namespace {

// Adds the processor time of this rank until the end of the scope.
class ProcessorTime {
 public:
  explicit ProcessorTime(double& seconds) : seconds_(seconds), start_(std::clock()) {}
  ~ProcessorTime() { seconds_ += static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }
  ProcessorTime(const ProcessorTime&) = delete;
  ProcessorTime& operator=(const ProcessorTime&) = delete;

 private:
  double& seconds_;
  std::clock_t start_;
};

constexpr double firstStepBack = 0.1;  // of the last step in time, after iterations that are kept

}  // namespace

double FlowLoop::totalHeatRelease() const {
  double total = 0.0;
  const std::vector<double> heat = heatRelease();
  for (std::size_t c = 0; c < heat.size(); ++c) total += heat[c] * domain_->mesh.volume[c];
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return std::abs(total) < steadiness_.leastHeat() ? 0.0 : total;
}

bool FlowLoop::burnsOrCannot() const {
  return case_.mechanism->numReactions() == 0 || flow::flameSteepness(domain_->context, domain_->state).has_value();
}

void FlowLoop::findNorms(const FlowResidual& residual) {
  norms_ = residualNorms(domain_->context, domain_->state, residual, steadiness_.time());
  normsOf_ = steps_;
}

double FlowLoop::largestNorm() const {
  return residualOfSearch().largest;
}

SteadySearch::Residual FlowLoop::residualOfSearch() const {
  SteadySearch::Residual found(0.0);
  const auto raise = [](double& to, double value) { to = std::isfinite(value) ? std::max(to, value) : INFINITY; };
  for (const ResidualNorm& norm : norms_) {
    raise(found.largest, norm.value);
    if (norm.equation == "momentum" || norm.equation == "swirl") raise(found.ofMomentum, norm.value);
    if (norm.equation == "enthalpy") raise(found.ofEnthalpy, norm.value);
  }
  return found;
}

SteadySearch::Residual FlowLoop::evaluateForSearch() {
  const Timers::Scope timer(timers_, "monitoring");
  if (!residual_)
    residual_ = std::make_unique<FlowResidual>(domain_->context, domain_->state, case_.flow.velocityScheme, operators_);
  residual_->evaluate(domain_->state);
  findNorms(*residual_);
  return residualOfSearch();
}

void FlowLoop::searchOn(Outputs& outputs) {
  if (search_->phase() == SteadySearch::Phase::Iterations) {
    iterate(outputs);
    if (search_->isSteady()) lightIfDark(outputs);
  } else {
    const ProcessorTime scope(processorTime(ProcessorTimeOf::Steps));
    const std::int64_t retried = retried_;
    stepInTime(outputs);
    search_->addStep(totalHeatRelease(), retried_ != retried);
    if (search_->wantsResidual()) {
      const SteadySearch::Residual residual = evaluateForSearch();
      search_->addResidualOfStep(residual, mayAttempt());
    }
    lightIfDark(outputs);
  }
  if (search_->isGivenUp()) giveUp(outputs);
}

// Every other time velocities and pressure have their quickest pace at once.
void FlowLoop::makeIteration() {
  SteadyIteration::Options options{.scheme = case_.flow.velocityScheme};
  const int before = search_->isAttempt() ? search_->attempts() : search_->returns();
  options.oneTime = case_.time.search->oneTime;
  if (before % 2 == 1) options.leastFlowCourant = options.mostFlowCourant;
  backup_.save([this](StateArchive& archive) { saveOrLoadParts(archive); });
  beforeIterations_ = steadiness_;
  evaluateForEddies();
  // What is a function of the state becomes it, such as an eddy viscosity that lags behind in time.
  for (Operator* op : operators_) op->setDiffusivities(domain_->state);
  domain_->state.updateHalo(domain_->halo);
  iteration_ = std::make_unique<SteadyIteration>(domain_->context, domain_->state, options, operators_);
}

void FlowLoop::evaluateForEddies() {
  if (domain_->turbulence) domain_->adopt(case_);
}

void FlowLoop::iterate(Outputs& outputs) {
  const ProcessorTime scope(processorTime(ProcessorTimeOf::Iterations));
  if (!iteration_) makeIteration();
  const int attemptsBefore = search_->attempts();
  try {
    SteadyIteration::Outcome outcome;
    {
      const Timers::Scope timer(timers_, "steady iterations");
      outcome = iteration_->iterate(domain_->state,
                                    {.combined = search_->mayAccelerate(), .newtons = search_->mayBeNewtons()});
    }
    ++steps_;
    heldCells_ = outcome.held;
    heldCellsOf_ = steps_;
    if (outcome.taken) {
      checkStateAndRequests(outputs.checkpoints);
      const FlowResidual& residual = iteration_->residual();
      domain_->chemistry.setRates(domain_->state, residual.rates().made.reactions);
      domain_->stepControl.setHeatRelease(heatRelease());
      domain_->budget->begin(domain_->state);
      evaluateForEddies();
      if (domain_->turbulence) domain_->turbulence->checkEddies(domain_->state);
      steadiness_.adopt(domain_->state, domain_->flow.properties(), time_);
      findNorms(residual);
      const SteadySearch::Residual left = residualOfSearch();
      search_->addIteration(left, totalHeatRelease(), left.largest > search_->options().residual || burnsOrCannot());
    } else {
      search_->addFailure(outcome.why);
    }
  } catch (const NumericsError& error) {
    if (domain_->mesh.ranks > 1 && !isCollective(error)) throw;
    search_->endIterations(error.what());
  }
  if (search_->phase() == SteadySearch::Phase::Steps) goBack(outputs, attemptsBefore);
}

void FlowLoop::goBack(Outputs& outputs, int attemptsBefore) {
  iteration_.reset();
  const bool wasAttempt = attemptsBefore != search_->attempts();
  if (search_->takesBack()) {
    restoreStepStart(time_, steps_);
    steadiness_ = *beforeIterations_;
  } else {
    steadiness_.begin(domain_->state, time_);
    domain_->adopt(case_);
    resumeFromLoadedState();
    dt_ *= firstStepBack;
  }
  normsOf_ = -1;
  heldCells_ = 0;
  outputs.progress.finish();
  if (!search_->isGivenUp() && !wasAttempt)
    printWarnings({fmt::format("step {}: iterations end and steps in time go on{}: {}", steps_,
                               search_->takesBack() ? " from where they were" : "", search_->whyNot())});
}

void FlowLoop::giveUp(Outputs& outputs) {
  std::string kept;
  outputs.progress.finish();
  if (steps_ % case_.output.historySteps == 0) writeRow(outputs.history);  // a row of the way, which the checkpoint has
  try {
    kept = saveLastState(outputs);
  } catch (const SystemError& error) {
    kept = fmt::format("the last state could not be kept: {}", error.what());
  }
  std::string rest = "its residual is not known";
  const auto worst = std::ranges::max_element(norms_, {}, &ResidualNorm::value);
  if (worst != norms_.end())
    rest = fmt::format(
        "the largest residual is that of {}, {:.2e} of what goes through, of which the cell at {} has "
        "{:.2e}",
        worst->equation, worst->value, placeText(worst->place, domain_->mesh.dimension), worst->largest);
  raiseTogether(
      comm_,
      NumericsError(fmt::format(
          "no steady state with residuals below {:.2g} was found in {} steps in time and {} iterations{}: {}. A "
          "flow that moves by itself has none or one that steps in time pass by: look at it in time (--restart with "
          "'time.mode: transient' and 'time.end'), and start from a later moment of that (initial.flow.results, "
          "with time.steady.steps: 30); else more iterations (time.steady.iterations, time.steady.returns) may "
          "find it, or smaller cells at that place, or it is small enough as it is (time.steady.residual){}; {}",
          search_->options().residual, search_->steps(), search_->iterations(),
          search_->whyNot().empty() ? "" : " (the last of which: " + search_->whyNot() + ")", rest, mistakeAtWalls(),
          kept)));
}

void FlowLoop::saveOrLoadSearch(StateArchive& archive) {
  if (case_.time.search->coarserMeshes > 0) {
    saveOrLoadCoarserMeshes(*case_.time.search, archive);
    if (archive.loading()) search_.emplace(*case_.time.search);
  }
  search_->saveOrLoad(archive);
  archive.shared("steady_held_cells", heldCells_);
  archive.shared("steady_held_cells_of", heldCellsOf_);
  if (rounds_) {
    rounds_->saveOrLoad(archive);
    gases_.saveOrLoad(archive, "gases_");
    if (isTurnOfParticles()) return;
  }
  if (search_->phase() != SteadySearch::Phase::Iterations) return;
  if (archive.loading()) domain_->state.updateHalo(domain_->halo);
  if (!iteration_) {
    // What is a function of the state stays as it was loaded: viscosities of the molecules have followed since.
    const State loaded = domain_->state;
    makeIteration();
    domain_->state = loaded;
  }
  iteration_->saveOrLoad(domain_->state, archive);
  backup_.saveOrLoad(archive, "steady_begin_");
  beforeIterations_->saveOrLoad(archive, "before_iterations_");
}

}  // namespace lampblack::app
