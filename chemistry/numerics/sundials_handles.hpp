// Owners of SUNDIALS objects and a check of its return codes.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_types.h>

#include <memory>

#include "core/rooms.hpp"

namespace lampblack::chemistry::sundials {

struct ContextDeleter {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct VectorDeleter {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct MatrixDeleter {
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
};
struct LinearSolverDeleter {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
struct CvodeDeleter {
  void operator()(void* memory) const;
};

using Context = std::unique_ptr<_SUNContext, ContextDeleter>;
using Vector = std::unique_ptr<_generic_N_Vector, VectorDeleter>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, MatrixDeleter>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, LinearSolverDeleter>;
using Cvode = std::unique_ptr<void, CvodeDeleter>;

Context makeContext();

// Throws NumericsError naming the call if a set-up call failed.
void check(int flag, const char* call);
void check(const void* made, const char* call);

}  // namespace lampblack::chemistry::sundials
