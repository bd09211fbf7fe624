// What callbacks from PETSc need: exceptions that cross PETSc's C frames, and vectors of one process as spans.
#pragma once

#include <petscvec.h>

#include <cstddef>
#include <exception>
#include <span>
#include <type_traits>
#include <utility>

#include "core/petsc.hpp"

namespace lampblack {

// Every callback runs its work in guard(), the outer PETSc call in run(): what the callback throws comes out of run().
class PetscExceptions {
 public:
  template <typename Work>
  PetscErrorCode guard(Work&& work) noexcept {
    try {
      std::forward<Work>(work)();
      return 0;
    } catch (...) {
      if (!error_) error_ = std::current_exception();
      return PETSC_ERR_USER;
    }
  }

  template <typename Call>
  void run(Call&& call, std::source_location where = std::source_location::current()) {
    error_ = nullptr;
    // PETSc would print a trace of its own stack, which says nothing of the exception.
    checkPetsc(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr), where);
    const PetscErrorCode code = std::forward<Call>(call)();
    checkPetsc(PetscPopErrorHandler(), where);
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    checkPetsc(code, where);
  }

 private:
  std::exception_ptr error_;
};

// The values of a sequential vector while this lives: for reading (`const double`), or for writing, too.
template <typename Value>
class PetscArray {
 public:
  explicit PetscArray(Vec vector) : vector_(vector) {
    PetscInt size = 0;
    checkPetsc(VecGetLocalSize(vector_, &size));
    if constexpr (std::is_const_v<Value>)
      checkPetsc(VecGetArrayRead(vector_, &values_));
    else
      checkPetsc(VecGetArray(vector_, &values_));
    size_ = static_cast<std::size_t>(size);
  }
  PetscArray(const PetscArray&) = delete;
  PetscArray& operator=(const PetscArray&) = delete;
  ~PetscArray() {
    if constexpr (std::is_const_v<Value>)
      static_cast<void>(VecRestoreArrayRead(vector_, &values_));
    else
      static_cast<void>(VecRestoreArray(vector_, &values_));
  }
  [[nodiscard]] std::span<Value> get() const { return {values_, size_}; }

 private:
  Vec vector_;
  Value* values_ = nullptr;
  std::size_t size_ = 0;
};
using PetscValues = PetscArray<const double>;
using PetscMutableValues = PetscArray<double>;

}  // namespace lampblack
