#include "numerics/sundials_handles.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace lampblack::numerics::sundials {

void CvodeDeleter::operator()(void* memory) const {
  CVodeFree(&memory);
}

Context makeContext() {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR >= 7
  check(SUNContext_Create(SUN_COMM_NULL, &context), "SUNContext_Create");
#else
  check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
#endif
  return Context(context);
}

void check(int flag, const char* call) {
  if (flag < 0) throw NumericsError(fmt::format("SUNDIALS call {} failed with code {}", call, flag));
}

void check(const void* made, const char* call) {
  if (made == nullptr) throw NumericsError(fmt::format("SUNDIALS call {} returned nothing", call));
}

}  // namespace lampblack::numerics::sundials
