// The linear algebra of CVODE for a reactor: its analytic Jacobian and the LU of NewtonMatrix, behind SUNDIALS'
// interfaces for matrices and linear solvers.
#pragma once

#include "chemistry/reactor/newton_matrix.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "core/modules.hpp"
#include "numerics/sundials_handles.hpp"

namespace lampblack::chemistry {

class ReactorLinearSolver {
 public:
  // Both arguments must outlive the object.
  ReactorLinearSolver(ReactorSystem& system, SUNContext context);
  ReactorLinearSolver(const ReactorLinearSolver&) = delete;
  ReactorLinearSolver& operator=(const ReactorLinearSolver&) = delete;

  // Makes a CVODE memory of system.size() unknowns use it. After CVodeInit; the object must outlive the memory. Whoever
  // owns the memory is free in the choice of its user data.
  void attach(void* cvodeMemory);

  const NewtonMatrix& matrix() const { return newton_; }

 private:
  static int linearSystem(sunrealtype t, N_Vector y, N_Vector f, SUNMatrix A, sunbooleantype jacobianOk,
                          sunbooleantype* current, sunrealtype gamma, void* data, N_Vector w1, N_Vector w2,
                          N_Vector w3);
  static int setUp(SUNLinearSolver solver, SUNMatrix A);
  static int solve(SUNLinearSolver solver, SUNMatrix A, N_Vector x, N_Vector b, sunrealtype tolerance);

  ReactorSystem& system_;
  NewtonMatrix newton_;
  double gamma_ = 0;
  sundials::Matrix matrix_;
  sundials::LinearSolver solver_;
};

}  // namespace lampblack::chemistry
