#include "numerics/newton_iteration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"

namespace lampblack::numerics {

NewtonIteration::NewtonIteration(NewtonSystem& system, NewtonOptions options) : system_(system), options_(options) {
  const std::size_t n = system.size();
  for (auto* v : {&old_, &weights_, &lower_, &upper_, &scale_, &trial_, &trialF_, &simplified_}) v->resize(n);
  createSolver();
}

void NewtonIteration::createSolver() {
  const auto n = static_cast<PetscInt>(system_.size());
  checkPetsc(VecCreateSeq(PETSC_COMM_SELF, n, x_.put()));
  checkPetsc(VecDuplicate(x_.get(), F_.put()));
  checkPetsc(VecDuplicate(x_.get(), work_.put()));
  checkPetsc(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, this, matrix_.put()));

  checkPetsc(SNESCreate(PETSC_COMM_SELF, snes_.put()));
  checkPetsc(SNESSetType(snes_.get(), SNESNEWTONLS));
  checkPetsc(SNESSetFunction(snes_.get(), work_.get(), functionCallback, this));
  checkPetsc(SNESSetJacobian(snes_.get(), matrix_.get(), matrix_.get(), jacobianCallback, this));
  checkPetsc(SNESSetCheckJacobianDomainError(snes_.get(), PETSC_TRUE));
  checkPetsc(SNESSetConvergenceTest(snes_.get(), convergedCallback, this, nullptr));
  // Steps are counted by decide(); a step that old factors spoil takes an iteration without being one.
  const auto iterations = static_cast<PetscInt>(2 * options_.maximumSteps + 10);
  checkPetsc(SNESSetTolerances(snes_.get(), 0, 0, 0, iterations, PETSC_DEFAULT));

  KSP linear = nullptr;
  checkPetsc(SNESGetKSP(snes_.get(), &linear));
  checkPetsc(KSPSetType(linear, KSPPREONLY));
  PC shell = nullptr;
  checkPetsc(KSPGetPC(linear, &shell));
  checkPetsc(PCSetType(shell, PCSHELL));
  checkPetsc(PCShellSetContext(shell, this));
  checkPetsc(PCShellSetApply(shell, solveCallback));

  SNESLineSearch lineSearch = nullptr;
  checkPetsc(SNESGetLineSearch(snes_.get(), &lineSearch));
  checkPetsc(SNESLineSearchSetType(lineSearch, SNESLINESEARCHSHELL));
#if PETSC_VERSION_GE(3, 21, 0)
  checkPetsc(SNESLineSearchShellSetApply(lineSearch, searchCallback, this));
#else
  checkPetsc(SNESLineSearchShellSetUserFunc(lineSearch, searchCallback, this));
#endif
}

void NewtonIteration::steady(std::span<double> x, NewtonReport& report) {
  inverseTimeStep_ = 0;
  run(x, report);
}

void NewtonIteration::eulerStep(std::span<const double> old, double dt, std::span<double> x, NewtonReport& report) {
  inverseTimeStep_ = 1 / dt;
  std::ranges::copy(old, old_.begin());
  system_.beginStep();
  system_.timeWeights(old, weights_);
  run(x, report);
}

void NewtonIteration::run(std::span<double> x, NewtonReport& report) {
  report_ = &report;
  report.converged = false;
  report.reason.clear();
  report.worst.clear();
  steps_ = polishRenewals_ = 0;
  haveSimplified_ = converged_ = finished_ = false;
  if (!haveFactors_ || inverseTimeStep_ != factorsInverseTimeStep_) renew_ = true;

  system_.bounds(lower_, upper_);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(x[i] >= lower_[i] && x[i] <= upper_[i])) {
      report.worst = system_.nameOf(i);
      report.reason = fmt::format("the start is out of bounds: {} = {:.6g} is not in [{:.6g}, {:.6g}]", report.worst,
                                  x[i], lower_[i], upper_[i]);
      return;
    }
  {
    const PetscMutableValues start(x_.get()), F(F_.get());
    std::ranges::copy(x, start.get().begin());
    evaluate(x, F.get());
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!std::isfinite(F.get()[i]))
        throw NumericsError(
            fmt::format("The equations are not finite at the start, first that of {}", system_.nameOf(i)));
  }
  checkPetsc(SNESSetInitialFunction(snes_.get(), F_.get()));
  exceptions_.run([&] { return SNESSolve(snes_.get(), nullptr, x_.get()); });

  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  checkPetsc(SNESGetConvergedReason(snes_.get(), &reason));
  report.converged = reason > 0;
  if (!report.converged && report.reason.empty())
    report.reason = fmt::format("SNES stopped: {}", SNESConvergedReasons[reason]);
  report.worst = system_.nameOf(worst_);
  const PetscValues end(x_.get());
  std::ranges::copy(end.get(), x.begin());
}

void NewtonIteration::evaluate(std::span<const double> x, std::span<double> F) {
  ++report_->residuals;
  system_.residual(x, F);
  if (inverseTimeStep_ > 0)
    for (std::size_t i = 0; i < x.size(); ++i) F[i] += weights_[i] * (x[i] - old_[i]) * inverseTimeStep_;
}

bool NewtonIteration::tryEvaluate(std::span<const double> x, std::span<double> F) {
  try {
    evaluate(x, F);
  } catch (const NumericsError&) {
    return false;
  }
  return std::ranges::all_of(F, [](double f) { return std::isfinite(f); });
}

NewtonIteration::Size NewtonIteration::sizeOf(std::span<const double> step) const {
  Size size;
  double sum = 0;
  for (std::size_t i = 0; i < step.size(); ++i) {
    const double scaled = std::abs(step[i]) / scale_[i];
    if (!std::isfinite(scaled)) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      return {infinity, infinity, i};
    }
    sum += scaled * scaled;
    if (scaled > size.largest) {
      size.largest = scaled;
      size.worst = i;
    }
  }
  size.mean = std::sqrt(sum / static_cast<double>(step.size()));
  return size;
}

double NewtonIteration::distance(std::span<const double> a, double factor, std::span<const double> b) const {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double scaled = (a[i] - factor * b[i]) / scale_[i];
    sum += scaled * scaled;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

void NewtonIteration::note(const Size& size) {
  report_->stepSize = size.mean;
  report_->worstResidual = size.largest;
  worst_ = size.worst;
}

void NewtonIteration::renewFactors(std::span<const double> x) {
  ++report_->factorisations;
  haveFactors_ = false;
  try {
    if (!system_.factorise(x, inverseTimeStep_)) {
      report_->reason = "the Newton matrix is singular";
      return;
    }
  } catch (const NumericsError& error) {
    report_->reason = fmt::format("the Newton matrix cannot be evaluated: {}", error.what());
    return;
  }
  haveFactors_ = true;
  factorsInverseTimeStep_ = inverseTimeStep_;
  factorsAge_ = 0;
  renew_ = false;
}

void NewtonIteration::applyInverse(std::span<const double> F, std::span<double> inverse) {
  std::ranges::copy(F, inverse.begin());
  system_.solve(inverse);
}

void NewtonIteration::fail(SNESConvergedReason reason, std::string text) {
  report_->reason = std::move(text);
  checkPetsc(SNESSetConvergedReason(snes_.get(), reason));
}

SNESConvergedReason NewtonIteration::decide() {
  if (finished_ || (converged_ && steps_ >= options_.maximumSteps)) return SNES_CONVERGED_SNORM_RELATIVE;
  if (steps_ < options_.maximumSteps) return SNES_CONVERGED_ITERATING;
  report_->reason = fmt::format("no convergence in {} Newton steps", steps_);
  return SNES_DIVERGED_MAX_IT;
}

PetscErrorCode NewtonIteration::functionCallback(SNES, Vec x, Vec F, void* context) {
  auto* self = static_cast<NewtonIteration*>(context);
  return self->exceptions_.guard([&] {
    const PetscValues from(x);
    const PetscMutableValues to(F);
    self->evaluate(from.get(), to.get());
  });
}

PetscErrorCode NewtonIteration::jacobianCallback(SNES snes, Vec x, Mat, Mat, void* context) {
  auto* self = static_cast<NewtonIteration*>(context);
  return self->exceptions_.guard([&] {
    const PetscValues values(x);
    const bool old = self->factorsAge_ >= self->options_.jacobianAge;
    const bool renew = !self->haveFactors_ || self->renew_ || (old && !self->converged_);
    if (renew) self->renewFactors(values.get());
    if (!self->haveFactors_) checkPetsc(SNESSetJacobianDomainError(snes));
    self->simplifiedIsStep_ = self->haveSimplified_ && !renew;
  });
}

PetscErrorCode NewtonIteration::solveCallback(PC shell, Vec F, Vec inverse) {
  void* context = nullptr;
  if (const PetscErrorCode code = PCShellGetContext(shell, &context); code != 0) return code;
  auto* self = static_cast<NewtonIteration*>(context);
  return self->exceptions_.guard([&] {
    const PetscMutableValues to(inverse);
    if (self->simplifiedIsStep_) {
      std::ranges::copy(self->simplified_, to.get().begin());
      return;
    }
    const PetscValues from(F);
    self->applyInverse(from.get(), to.get());
  });
}

PetscErrorCode NewtonIteration::searchCallback(SNESLineSearch lineSearch, void* context) {
  auto* self = static_cast<NewtonIteration*>(context);
  return self->exceptions_.guard([&] { self->searchLine(lineSearch); });
}

PetscErrorCode NewtonIteration::convergedCallback(SNES, PetscInt iteration, PetscReal, PetscReal, PetscReal,
                                                  SNESConvergedReason* reason, void* context) {
  auto* self = static_cast<NewtonIteration*>(context);
  return self->exceptions_.guard([&] { *reason = iteration == 0 ? SNES_CONVERGED_ITERATING : self->decide(); });
}

}  // namespace lampblack::numerics
