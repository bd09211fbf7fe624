#include "chemistry/reactor/reactor_linear_solver.hpp"

#include <cvodes/cvodes.h>

#include <algorithm>

namespace lampblack::chemistry {

// The matrix of the interface holds nothing but a pointer to us.
ReactorLinearSolver::ReactorLinearSolver(ReactorSystem& system, SUNContext context)
    : system_(system), newton_(system), matrix_(SUNMatNewEmpty(context)), solver_(SUNLinSolNewEmpty(context)) {
  sundials::check(matrix_.get(), "SUNMatNewEmpty");
  sundials::check(solver_.get(), "SUNLinSolNewEmpty");
  matrix_->content = this;
  matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix_->ops->destroy = [](SUNMatrix matrix) {
    matrix->content = nullptr;
    SUNMatFreeEmpty(matrix);
  };
  solver_->content = this;
  solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver_->ops->setup = setUp;
  solver_->ops->solve = solve;
  solver_->ops->free = [](SUNLinearSolver solver) {
    solver->content = nullptr;
    SUNLinSolFreeEmpty(solver);
    return int{sundials::succeeded};
  };
}

void ReactorLinearSolver::attach(void* cvodeMemory) {
  sundials::check(CVodeSetLinearSolver(cvodeMemory, solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
  sundials::check(CVodeSetLinSysFn(cvodeMemory, linearSystem), "CVodeSetLinSysFn");
}

int ReactorLinearSolver::linearSystem(sunrealtype /*t*/, N_Vector y, N_Vector /*f*/, SUNMatrix A,
                                      sunbooleantype jacobianOk, sunbooleantype* current, sunrealtype gamma,
                                      void* /*data*/, N_Vector w1, N_Vector /*w2*/, N_Vector /*w3*/) {
  auto& self = *static_cast<ReactorLinearSolver*>(A->content);
  self.gamma_ = gamma;
  *current = jacobianOk == SUNFALSE ? SUNTRUE : SUNFALSE;
  if (jacobianOk != SUNFALSE) return 0;
  return self.newton_.evaluate(self.system_, N_VGetArrayPointer(y), N_VGetArrayPointer(w1)) ? 0 : 1;
}

int ReactorLinearSolver::setUp(SUNLinearSolver solver, SUNMatrix /*A*/) {
  auto& self = *static_cast<ReactorLinearSolver*>(solver->content);
  return self.newton_.factorise(self.gamma_) ? sundials::succeeded : SUNLS_LUFACT_FAIL;
}

int ReactorLinearSolver::solve(SUNLinearSolver solver, SUNMatrix /*A*/, N_Vector x, N_Vector b,
                               sunrealtype /*tolerance*/) {
  auto& self = *static_cast<ReactorLinearSolver*>(solver->content);
  const double* from = N_VGetArrayPointer(b);
  double* to = N_VGetArrayPointer(x);
  if (from != to) std::copy_n(from, self.system_.size(), to);
  self.newton_.solve(to);
  return sundials::succeeded;
}

}  // namespace lampblack::chemistry
