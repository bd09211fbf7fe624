// The same reactor as ConstantPressureReactor, solved as a first program would: CVODE's BDF with its own dense
// difference-quotient Jacobian and SUNDIALS' dense LU. What the project's solver is compared with.
#pragma once

#include <cvodes/cvodes.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>

#include "chemistry/reactor/reactor_system.hpp"
#include "numerics/sundials_handles.hpp"
#include "tests/bench/reactor_states.hpp"
#include "tests/every_module.hpp"

namespace lampblack::bench {

class DifferenceQuotientReactor {
 public:
  DifferenceQuotientReactor(const Mechanism& mechanism, double relativeTolerance, double absoluteTolerance)
      : system_(mechanism), relative_(relativeTolerance), absolute_(absoluteTolerance) {
    using sundials::check;
    const auto size = static_cast<sunindextype>(system_.size());
    y_.reset(N_VNew_Serial(size, context_.get()));
    matrix_.reset(SUNDenseMatrix(size, size, context_.get()));
    solver_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_.get()));
    cvode_.reset(CVodeCreate(CV_BDF, context_.get()));
    void* memory = cvode_.get();
    check(CVodeInit(memory, rhs, 0.0, y_.get()), "CVodeInit");
    check(CVodeSStolerances(memory, relative_, absolute_), "CVodeSStolerances");
    check(CVodeSetUserData(memory, this), "CVodeSetUserData");
    check(CVodeSetLinearSolver(memory, solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
    check(CVodeSetMaxNumSteps(memory, 1000000), "CVodeSetMaxNumSteps");
  }

  // Number of steps.
  long advance(GasState& state, double dt) {
    using sundials::check;
    void* memory = cvode_.get();
    system_.setConditions(state.p, {});
    double* y = N_VGetArrayPointer(y_.get());
    std::copy(state.Y.begin(), state.Y.end(), y);
    y[state.Y.size()] = state.T;
    check(CVodeReInit(memory, 0.0, y_.get()), "CVodeReInit");
    check(CVodeSetStopTime(memory, dt), "CVodeSetStopTime");
    sunrealtype reached = 0;
    check(CVode(memory, dt, y_.get(), &reached, CV_NORMAL), "CVode");
    std::copy_n(y, state.Y.size(), state.Y.begin());
    state.T = y[state.Y.size()];
    long steps = 0;
    check(CVodeGetNumSteps(memory, &steps), "CVodeGetNumSteps");
    return steps;
  }

 private:
  static int rhs(sunrealtype /*t*/, N_Vector y, N_Vector f, void* data) {
    auto& self = *static_cast<DifferenceQuotientReactor*>(data);
    return self.system_.rates(N_VGetArrayPointer(y), N_VGetArrayPointer(f)) ? 0 : 1;
  }

  ReactorSystem system_;
  double relative_, absolute_;
  sundials::Context context_ = sundials::makeContext();
  sundials::Vector y_;
  sundials::Matrix matrix_;
  sundials::LinearSolver solver_;
  sundials::Cvode cvode_;
};

}  // namespace lampblack::bench
