// Inside of integrateInTime: the equations of one time step as PETSc's TS puts them, for the Newton method of steady
// flames. x is the new state; rates of change follow from it and from old states.
#pragma once

#include <petscsnes.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/petsc_callbacks.hpp"
#include "numerics/newton_system.hpp"
#include "numerics/unsteady_system.hpp"

namespace lampblack::flow {

class UnsteadyStep : public NewtonSystem {
 public:
  explicit UnsteadyStep(UnsteadySystem& system) : system_(system), weights_(system.size()) {}

  // TS's own: its equations, and vectors and a matrix to call them with.
  void attach(SNES snes, Vec x, Vec F, Mat matrix);

  // NewtonSystem.
  [[nodiscard]] std::size_t size() const override { return system_.size(); }
  void residual(std::span<const double> x, std::span<double> F) override;
  void timeWeights(std::span<const double> x, std::span<double> M) override;
  [[nodiscard]] bool factorise(std::span<const double> x, double inverseTimeStep) override;
  void solve(std::span<double> b) override { system_.solve(b); }
  void bounds(std::span<double> lower, std::span<double> upper) const override { system_.bounds(lower, upper); }
  void scales(std::span<const double> x, std::span<double> scale) const override { system_.scales(x, scale); }
  [[nodiscard]] std::string nameOf(std::size_t unknown) const override { return system_.nameOf(unknown); }

  // Called back by TS. A NumericsError must not pass through PETSc as an error of PETSc: Newton's method steps back.
  PetscErrorCode function(Vec x, Vec rate, Vec F);
  PetscErrorCode matrix(Vec x, double shift);

 private:
  void copyIn(std::span<const double> x);

  UnsteadySystem& system_;
  SNES snes_ = nullptr;
  Vec x_ = nullptr, F_ = nullptr;
  Mat matrix_ = nullptr;
  std::vector<double> weights_;
  PetscExceptions exceptions_;
  std::optional<std::string> failure_;
  bool regular_ = false;
};

}  // namespace lampblack::flow
