// What callbacks from PETSc need: exceptions that cross PETSc's C frames, and vectors of one process as spans.
#pragma once

#include <petscvec.h>

#include <cstddef>
#include <exception>
#include <span>
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

// The values of a sequential vector, for reading.
class PetscValues {
 public:
  explicit PetscValues(Vec vector) : vector_(vector) {
    PetscInt size = 0;
    checkPetsc(VecGetLocalSize(vector_, &size));
    checkPetsc(VecGetArrayRead(vector_, &values_));
    size_ = static_cast<std::size_t>(size);
  }
  PetscValues(const PetscValues&) = delete;
  PetscValues& operator=(const PetscValues&) = delete;
  ~PetscValues() { static_cast<void>(VecRestoreArrayRead(vector_, &values_)); }
  [[nodiscard]] std::span<const double> get() const { return {values_, size_}; }

 private:
  Vec vector_;
  const PetscScalar* values_ = nullptr;
  std::size_t size_ = 0;
};

// The same for writing (and reading).
class PetscMutableValues {
 public:
  explicit PetscMutableValues(Vec vector) : vector_(vector) {
    PetscInt size = 0;
    checkPetsc(VecGetLocalSize(vector_, &size));
    checkPetsc(VecGetArray(vector_, &values_));
    size_ = static_cast<std::size_t>(size);
  }
  PetscMutableValues(const PetscMutableValues&) = delete;
  PetscMutableValues& operator=(const PetscMutableValues&) = delete;
  ~PetscMutableValues() { static_cast<void>(VecRestoreArray(vector_, &values_)); }
  [[nodiscard]] std::span<double> get() const { return {values_, size_}; }

 private:
  Vec vector_;
  PetscScalar* values_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace lampblack
