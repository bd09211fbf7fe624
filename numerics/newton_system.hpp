// What the nonlinear solvers see of a flame (or of a test problem): a residual, a Newton matrix that factorises itself,
// bounds and scales. Vectors are alike on all ranks; all members are collective.
//
// Pseudo-transient and implicit time steps solve  residual(x) + timeWeights(x) * (x - old)/dt = 0.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/modules.hpp"

namespace lampblack::numerics {

class NewtonSystem {
 public:
  virtual ~NewtonSystem() = default;
  [[nodiscard]] virtual std::size_t size() const = 0;
  virtual void residual(std::span<const double> x, std::span<double> F) = 0;
  // A time step or a step along a branch begins, and the next residual is where it starts from: the moment for choices
  // that have to stay.
  virtual void beginStep() {}
  // Weights of the time derivative, zero for algebraic equations.
  virtual void timeWeights(std::span<const double> x, std::span<double> M) = 0;
  // Builds and factorises dF/dx + diag(M) * inverseTimeStep at x. False where the matrix is singular.
  [[nodiscard]] virtual bool factorise(std::span<const double> x, double inverseTimeStep) = 0;
  // Overwrites b by the solution with the factors of the last call of factorise.
  virtual void solve(std::span<double> b) = 0;
  // Bounds that no iterate may cross (a step is shortened so as to keep inside).
  virtual void bounds(std::span<double> lower, std::span<double> upper) const = 0;
  // Replaces entries of `trial`, to which a step from x leads, by others near them that are not senseless (an amount
  // that would turn negative becomes a part of what it was). What is done here does not change a solution, only the
  // way.
  virtual void correct(std::span<const double> x, std::span<double> trial) const {
    static_cast<void>(x);
    static_cast<void>(trial);
  }
  // Makes the best of a state between pseudo-transient steps, which need not be exact: amounts below zero become zero.
  virtual void clipNegativeAmounts(std::span<double> x) const { static_cast<void>(x); }
  // Size of a change of x that counts as 1: relative and absolute tolerances of each unknown.
  virtual void scales(std::span<const double> x, std::span<double> scale) const = 0;
  // "T at z = 3.2 mm (point 41)", for messages.
  [[nodiscard]] virtual std::string nameOf(std::size_t unknown) const = 0;
};

}  // namespace lampblack::numerics
