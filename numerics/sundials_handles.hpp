// Owners of SUNDIALS objects, a check of its return codes, and what its versions 6 and 7 say differently.
#pragma once

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_types.h>

#include <memory>
#include <type_traits>

#include "core/modules.hpp"

namespace lampblack::numerics::sundials {

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

using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, ContextDeleter>;
using Vector = std::unique_ptr<_generic_N_Vector, VectorDeleter>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, MatrixDeleter>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, LinearSolverDeleter>;
using Cvode = std::unique_ptr<void, CvodeDeleter>;

Context makeContext();

// Throws NumericsError naming the call if a set-up call failed.
void check(int flag, const char* call);
void check(const void* made, const char* call);

// What our own parts of a solver return when all is well.
inline constexpr int succeeded = 0;

// From here on the errors of this integrator, which alone has the context, go to `keep`: the function that failed, its
// message, and `owner`.
template <void (*keep)(const char* function, const char* message, void* owner)>
void keepErrors(void* cvode, SUNContext context, void* owner) {
#if SUNDIALS_VERSION_MAJOR >= 7
  static_cast<void>(cvode);
  check(SUNContext_ClearErrHandlers(context), "SUNContext_ClearErrHandlers");
  const auto handler = [](int, const char* function, const char*, const char* message, SUNErrCode, void* data,
                          SUNContext) { keep(function, message, data); };
  check(SUNContext_PushErrHandler(context, handler, owner), "SUNContext_PushErrHandler");
#else
  static_cast<void>(context);
  const auto handler = [](int code, const char*, const char* function, char* message, void* data) {
    if (code < 0) keep(function, message, data);  // otherwise a warning
  };
  check(CVodeSetErrHandlerFn(cvode, handler, owner), "CVodeSetErrHandlerFn");
#endif
}

}  // namespace lampblack::numerics::sundials
