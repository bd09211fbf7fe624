// PETSc handles that destroy themselves, and the check that every PETSc call here goes through.
#pragma once

#include <petscdm.h>
#include <petscksp.h>
#include <petscsnes.h>
#include <petscsys.h>

#include <source_location>
#include <utility>

namespace lampblack {

// Throws NumericsError naming the PETSc call's place when `code` is not zero.
void checkPetsc(PetscErrorCode code, std::source_location where = std::source_location::current());

// Unique owner of a PETSc object; `Destroy` is its XxxDestroy function.
template <typename Handle, PetscErrorCode (*Destroy)(Handle*)>
class PetscOwner {
 public:
  PetscOwner() = default;
  explicit PetscOwner(Handle handle) : handle_(handle) {}
  PetscOwner(PetscOwner&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  PetscOwner& operator=(PetscOwner&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  PetscOwner(const PetscOwner&) = delete;
  PetscOwner& operator=(const PetscOwner&) = delete;
  ~PetscOwner() {
    // A destructor cannot report; PETSc itself prints what went wrong.
    if (handle_ != nullptr) static_cast<void>(Destroy(&handle_));
  }

  [[nodiscard]] Handle get() const { return handle_; }
  // For XxxCreate(comm, owner.put()).
  Handle* put() {
    if (handle_ != nullptr) checkPetsc(Destroy(&handle_));
    return &handle_;
  }

 private:
  Handle handle_ = nullptr;
};

using PetscDm = PetscOwner<DM, DMDestroy>;
using PetscVector = PetscOwner<Vec, VecDestroy>;
using PetscMatrix = PetscOwner<Mat, MatDestroy>;
using PetscSolver = PetscOwner<KSP, KSPDestroy>;
using PetscNonlinearSolver = PetscOwner<SNES, SNESDestroy>;

}  // namespace lampblack
