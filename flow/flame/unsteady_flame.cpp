#include "flow/flame/unsteady_flame.hpp"

#include <fmt/format.h>
#include <petscts.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/petsc.hpp"
#include "core/petsc_callbacks.hpp"
#include "flow/flame/unsteady_step.hpp"
#include "numerics/newton_iteration.hpp"

namespace lampblack::flow {
namespace {

using PetscTimeStepper = PetscOwner<TS, TSDestroy>;

class Integration {
 public:
  Integration(UnsteadySystem& system, const UnsteadyOptions& options,
              const std::function<void(double, std::span<const double>)>& output)
      : system_(system),
        options_(options),
        output_(output),
        equations_(system),
        iteration_(equations_, options.newton) {}

  UnsteadyReport run(std::span<double> x) {
    const auto n = static_cast<PetscInt>(x.size());
    checkPetsc(VecCreateSeq(PETSC_COMM_SELF, n, state_.put()));
    for (PetscVector* v : {&x_, &F_, &work_, &relative_, &absolute_}) checkPetsc(VecDuplicate(state_.get(), v->put()));
    checkPetsc(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, nullptr, matrix_.put()));
    std::ranges::copy(x, PetscMutableValues(state_.get()).get().begin());
    if (!options_.load) load_ = x.back();
    findAlgebraic(x);
    createStepper();
    exceptions_.run([&] { return TSSolve(ts_.get(), state_.get()); });

    TSConvergedReason reason = TS_CONVERGED_ITERATING;
    checkPetsc(TSGetConvergedReason(ts_.get(), &reason));
    if (reason < 0)
      throw NumericsError(
          fmt::format("time integration stopped at t = {:.6g} s: {}", time(), TSConvergedReasons[reason]));
    std::ranges::copy(PetscValues(state_.get()).get(), x.begin());
    PetscInt steps = 0, rejected = 0;
    checkPetsc(TSGetStepNumber(ts_.get(), &steps));
    checkPetsc(TSGetStepRejections(ts_.get(), &rejected));
    report_.steps = static_cast<std::size_t>(steps);
    report_.rejected = static_cast<std::size_t>(rejected);
    return report_;
  }

 private:
  void createStepper() {
    TS ts = nullptr;
    checkPetsc(TSCreate(PETSC_COMM_SELF, ts_.put()));
    ts = ts_.get();
    checkPetsc(TSSetProblemType(ts, TS_NONLINEAR));
    checkPetsc(TSSetEquationType(ts, TS_EQ_DAE_IMPLICIT_INDEX2));
    checkPetsc(TSSetType(ts, TSBDF));
    checkPetsc(TSBDFSetOrder(ts, options_.order));
    checkPetsc(TSSetIFunction(ts, work_.get(), functionCallback, this));
    checkPetsc(TSSetIJacobian(ts, matrix_.get(), matrix_.get(), matrixCallback, this));
    checkPetsc(TSSetTime(ts, options_.start));
    checkPetsc(TSSetMaxTime(ts, options_.end));
    checkPetsc(TSSetTimeStep(ts, options_.firstStep));
    checkPetsc(TSSetMaxSteps(ts, PETSC_MAX_INT));
    checkPetsc(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
    // Failures end at smallestStep.
    checkPetsc(TSSetMaxSNESFailures(ts, -1));
    checkPetsc(TSSetMaxStepRejections(ts, -1));
    checkPetsc(TSMonitorSet(ts, stepCallback, this, nullptr));
    setTolerances();

    TSAdapt adapt = nullptr;
    checkPetsc(TSGetAdapt(ts, &adapt));
    checkPetsc(TSAdaptSetType(adapt, TSADAPTBASIC));
    const double largest = std::min(options_.largestStep, options_.end - options_.start);
    checkPetsc(TSAdaptSetStepLimits(adapt, 1e-3 * options_.smallestStep, largest));

    SNES snes = nullptr;
    checkPetsc(TSGetSNES(ts, &snes));
    checkPetsc(SNESSetType(snes, SNESSHELL));
    checkPetsc(SNESShellSetContext(snes, this));
    checkPetsc(SNESShellSetSolve(snes, solveCallback));
    equations_.attach(snes, x_.get(), F_.get(), matrix_.get());
  }

  void findAlgebraic(std::span<const double> x) {
    std::vector<double> weights(x.size());
    system_.timeWeights(x, weights);
    algebraic_.resize(x.size());
    for (std::size_t i = 0; i < weights.size(); ++i) algebraic_[i] = weights[i] == 0;
    const auto dynamic = static_cast<double>(std::ranges::count(algebraic_, false));
    if (dynamic == 0) throw InputError("nothing in these equations changes with time");
    // TS takes the mean over all unknowns.
    share_ = std::sqrt(dynamic / static_cast<double>(x.size()));
  }

  void setTolerances() {
    std::vector<double> scale(algebraic_.size());
    {
      const PetscValues x(state_.get());
      const PetscMutableValues absolute(absolute_.get()), relative(relative_.get());
      system_.scales(x.get(), scale);
      for (std::size_t i = 0; i < scale.size(); ++i) {
        absolute.get()[i] = algebraic_[i] ? 1e200 : scale[i] * options_.accuracy * share_;
        relative.get()[i] = 0;
      }
    }
    checkPetsc(TSSetTolerances(ts_.get(), 0, absolute_.get(), 0, relative_.get()));
  }

  [[nodiscard]] double time() const {
    PetscReal t = 0;
    checkPetsc(TSGetTime(ts_.get(), &t));
    return t;
  }

  // One step: Newton's method, from the extrapolated state in x.
  void solve(SNES snes, Vec x) {
    PetscReal dt = 0;
    checkPetsc(TSGetTimeStep(ts_.get(), &dt));
    if (dt < options_.smallestStep)
      throw NumericsError(fmt::format("time steps became shorter than {:g} s at t = {:.6g} s: {}",
                                      options_.smallestStep, time(), lastFailure_));
    const PetscMutableValues state(x);
    std::vector<double> candidate(state.get().begin(), state.get().end());
    std::vector<double> lower(candidate.size()), upper(candidate.size());
    // Extrapolation is where the search begins: it may have left the bounds.
    system_.bounds(lower, upper);
    for (std::size_t i = 0; i < candidate.size(); ++i) candidate[i] = std::clamp(candidate[i], lower[i], upper[i]);
    // Factors of a step that was much longer or shorter are of little use. The shift of BDF is between 1/dt and 3/dt.
    if (std::abs(std::log(dt / stepOfFactors_)) > 0.25) iteration_.forgetFactors();
    const std::size_t before = report_.newton.factorisations;
    NewtonReport counts = std::move(report_.newton);
    try {
      iteration_.steady(candidate, counts);
    } catch (const NumericsError& error) {
      counts.converged = false;
      counts.reason = error.what();
    }
    report_.newton = std::move(counts);
    if (report_.newton.factorisations > before) stepOfFactors_ = dt;
    if (!report_.newton.converged)
      lastFailure_ = report_.newton.reason;
    else
      lastFailure_ = "the error of the step is too large";
    std::ranges::copy(candidate, state.get().begin());
    checkPetsc(SNESSetConvergedReason(
        snes, report_.newton.converged ? SNES_CONVERGED_SNORM_RELATIVE : SNES_DIVERGED_LINE_SEARCH));
  }

  void afterStep(double t) {
    while (nextOutput_ < options_.outputTimes.size() && options_.outputTimes[nextOutput_] <= t) {
      const double when = options_.outputTimes[nextOutput_++];
      if (!output_) continue;
      if (when == t) {
        output_(t, PetscValues(state_.get()).get());
      } else {
        checkPetsc(TSInterpolate(ts_.get(), when, x_.get()));
        output_(when, PetscValues(x_.get()).get());
      }
    }
    setTolerances();
  }

  void setLoad(double t) { system_.setLoad(options_.load ? options_.load(t) : load_); }

  static PetscErrorCode functionCallback(TS, PetscReal t, Vec x, Vec rate, Vec F, void* context) {
    auto* self = static_cast<Integration*>(context);
    self->setLoad(t);
    return self->equations_.function(x, rate, F);
  }
  static PetscErrorCode matrixCallback(TS, PetscReal, Vec x, Vec, PetscReal shift, Mat, Mat, void* context) {
    return static_cast<Integration*>(context)->equations_.matrix(x, shift);
  }
  static PetscErrorCode solveCallback(SNES snes, Vec x) {
    void* context = nullptr;
    if (const PetscErrorCode code = SNESShellGetContext(snes, static_cast<void*>(&context)); code != 0) return code;
    auto* self = static_cast<Integration*>(context);
    return self->exceptions_.guard([&] { self->solve(snes, x); });
  }
  static PetscErrorCode stepCallback(TS, PetscInt, PetscReal t, Vec, void* context) {
    auto* self = static_cast<Integration*>(context);
    return self->exceptions_.guard([&] {
      self->system_.beginStep();
      self->afterStep(t);
    });
  }

  UnsteadySystem& system_;
  const UnsteadyOptions& options_;
  const std::function<void(double, std::span<const double>)>& output_;
  UnsteadyStep equations_;
  NewtonIteration iteration_;
  PetscTimeStepper ts_;
  PetscMatrix matrix_;
  PetscVector state_, x_, F_, work_, relative_, absolute_;
  PetscExceptions exceptions_;
  std::vector<bool> algebraic_;
  double share_ = 1, load_ = 0, stepOfFactors_ = 1;
  std::size_t nextOutput_ = 0;
  std::string lastFailure_;
  UnsteadyReport report_;
};

}  // namespace

UnsteadyReport integrateInTime(UnsteadySystem& system, std::span<double> x, const UnsteadyOptions& options,
                               const std::function<void(double, std::span<const double>)>& output) {
  if (!(options.end > options.start)) throw InputError("an unsteady flame needs an end of time after its start");
  if (options.order < 1 || options.order > 5)
    throw InputError(fmt::format("backward differences have orders from 1 to 5, not {}", options.order));
  if (!(options.firstStep > 0) || !(options.accuracy > 0))
    throw InputError("the first time step and the accuracy of time steps have to be positive");
  if (!std::ranges::is_sorted(options.outputTimes) ||
      (!options.outputTimes.empty() &&
       (options.outputTimes.front() < options.start || options.outputTimes.back() > options.end)))
    throw InputError("output times have to rise, within the time of the flame");
  return Integration(system, options, output).run(x);
}

}  // namespace lampblack::flow
