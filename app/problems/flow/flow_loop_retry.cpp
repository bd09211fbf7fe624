// A step of a flow that may fail: backup of the state, retries with shorter steps, and the end where they fail too.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/problems/flow/flow_loop.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "core/stop_request.hpp"
#include "core/system_error.hpp"
#include "core/wall_clock.hpp"
#include "flow/stepping/finite_state.hpp"

namespace lampblack::app {
namespace {

constexpr const char* stepBackup =
    "step backup";  // stage: copying the state at the start of a step, and the checks after it

constexpr double smaller = 0.25;           // of the step that has failed; a power of two, which rounds nothing
constexpr double shortest = 1e-9;          // of the first step: no chemistry and no flow that is resolved needs less
constexpr std::int64_t failuresTold = 20;  // failures with their reasons; the history counts the others

}  // namespace

void FlowLoop::checkStateAndRequests(FlowCheckpoints& checkpoints) {
  bool finite = true;
  {
    const Timers::Scope scope(timers_, stepBackup);
    finite = isFinite(domain_->mesh, domain_->state);
  }
  const bool limit = wallLimit_.isNear(secondsSinceStart());
  std::array<int, 3> found{checkpoints.wants(steps_) ? 1 : 0, limit ? 1 : 0, finite ? 0 : 1};
  requests_.signal = agreedStopRequest(comm_, found);
  if (found[0] != 0) requests_.checkpoint = true;
  if (found[1] != 0) requests_.wallLimit = true;
  if (found[2] != 0) raiseNotFinite(domain_->context, domain_->state);
}

void FlowLoop::restoreStepStart(double time, std::int64_t steps) {
  backup_.restore([this](StateArchive& archive) { saveOrLoadParts(archive); });
  time_ = time;
  steps_ = steps;
  resumeFromLoadedState();
}

void FlowLoop::stepWithRetries(double dt, Outputs& outputs) {
  if (dt < shortest * case_.time.firstStep) try {
      raiseStandstill(domain_->mesh, domain_->state, dt);
    } catch (const NumericsError&) {
      endAfterFailure(outputs, std::current_exception(), {dt});
    }
  {
    const Timers::Scope scope(timers_, stepBackup);
    backup_.save([this](StateArchive& archive) { saveOrLoadParts(archive); });
  }
  const double time = time_;
  const std::int64_t steps = steps_;
  const auto ofAllRanks = [this](const std::exception& error) {
    return domain_->mesh.ranks == 1 || isCollective(error);
  };
  for (std::vector<double> tried;; dt *= smaller) {
    std::exception_ptr failure;
    std::string reason;  // of what a smaller step may mend
    try {
      step(dt);
      wallLimit_.recordStep(secondsSinceStart() - stepBegan_);
      checkStateAndRequests(outputs.checkpoints);
      dt_ = dt;
      costs_.addStep(domain_->mesh, operators_);
      return;
    } catch (const NumericsError& error) {
      if (!ofAllRanks(error)) throw;
      failure = std::current_exception();
      reason = error.what();
    } catch (const InputError& error) {  // what a boundary gets from a formula
      if (!ofAllRanks(error)) throw;
      failure = std::current_exception();
    }
    restoreStepStart(time, steps);
    tried.push_back(dt);
    if (reason.empty() || static_cast<int>(tried.size()) > case_.time.retries) endAfterFailure(outputs, failure, tried);
    ++retried_;
    if (retried_ > failuresTold) continue;
    outputs.progress.finish();
    printWarnings(
        {fmt::format("step {} from t = {:.6g} s failed and is tried again with dt = {:.3g} s in place of "
                     "{:.3g} s: {}{}",
                     steps_ + 1, time_, smaller * dt, dt, reason,
                     retried_ < failuresTold ? "" : "; from here on such steps are counted in the history only")});
  }
}

void FlowLoop::endAfterFailure(Outputs& outputs, const std::exception_ptr& failure, const std::vector<double>& tried) {
  std::string kept;
  outputs.progress.finish();
  try {
    kept = saveLastState(outputs);
  } catch (const SystemError& error) {
    kept = fmt::format("the last state could not be kept: {}", error.what());
  }
  std::vector<std::string> steps;
  for (const double dt : tried) steps.push_back(fmt::format("{:.3g} s", dt));
  const std::string more = fmt::format("; this was step {} from t = {:.6g} s, tried with dt = {}{}; {}", steps_ + 1,
                                       time_, fmt::join(steps, ", "), mistakeAtWalls(), kept);
  try {
    std::rethrow_exception(failure);
  } catch (const InputError& error) {
    raiseTogether(comm_, InputError(error.what() + more));
  } catch (const NumericsError& error) {
    raiseTogether(comm_, NumericsError(error.what() + more));
  }
  throw std::logic_error("a failure of another kind");
}

}  // namespace lampblack::app
