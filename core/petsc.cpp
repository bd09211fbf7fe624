#include "core/petsc.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace lampblack {

void checkPetsc(PetscErrorCode code, std::source_location where) {
  if (code == 0) return;
  const char* text = nullptr;
  static_cast<void>(PetscErrorMessage(code, &text, nullptr));
  throw NumericsError(fmt::format("PETSc reports error {} ({}) at {}:{} in {}", static_cast<int>(code),
                                  text != nullptr ? text : "unknown", where.file_name(), where.line(),
                                  where.function_name()));
}

}  // namespace lampblack
