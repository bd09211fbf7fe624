#include "flow/flame/unsteady_step.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/errors.hpp"

namespace lampblack::flow {

void UnsteadyStep::attach(SNES snes, Vec x, Vec F, Mat matrix) {
  snes_ = snes;
  x_ = x;
  F_ = F;
  matrix_ = matrix;
}

void UnsteadyStep::copyIn(std::span<const double> x) {
  std::ranges::copy(x, PetscMutableValues(x_).get().begin());
}

void UnsteadyStep::residual(std::span<const double> x, std::span<double> F) {
  copyIn(x);
  failure_.reset();
  exceptions_.run([&] { return SNESComputeFunction(snes_, x_, F_); });
  if (failure_) throw NumericsError(*failure_);
  std::ranges::copy(PetscValues(F_).get(), F.begin());
}

void UnsteadyStep::timeWeights(std::span<const double>, std::span<double>) {
  throw std::logic_error("time steps in a time step");
}

bool UnsteadyStep::factorise(std::span<const double> x, double) {
  copyIn(x);
  failure_.reset();
  exceptions_.run([&] { return SNESComputeJacobian(snes_, x_, matrix_, matrix_); });
  if (failure_) throw NumericsError(*failure_);
  return regular_;
}

PetscErrorCode UnsteadyStep::function(Vec x, Vec rate, Vec F) {
  return exceptions_.guard([&] {
    const PetscValues state(x), rates(rate);
    const PetscMutableValues out(F);
    try {
      system_.residual(state.get(), out.get());
      system_.timeWeights(state.get(), weights_);
      for (std::size_t i = 0; i < weights_.size(); ++i)
        // An algebraic unknown may not be finite in its rate.
        if (weights_[i] != 0) out.get()[i] += weights_[i] * rates.get()[i];
      system_.storage(state.get(), rates.get(), out.get());
    } catch (const NumericsError& error) {
      failure_ = error.what();
      std::ranges::fill(out.get(), 0.0);
    }
  });
}

PetscErrorCode UnsteadyStep::matrix(Vec x, double shift) {
  return exceptions_.guard([&] {
    try {
      regular_ = system_.factoriseUnsteady(PetscValues(x).get(), shift);
    } catch (const NumericsError& error) {
      failure_ = error.what();
    }
  });
}

}  // namespace lampblack::flow
