// Damped Newton's method on PETSc's SNES, with a line search that watches the size of the Newton step itself (the
// natural monotonicity test of Deuflhard 1974), which the scaling of equations does not change; and pseudo-transient
// continuation (Kelley and Keyes 1998) around it for starts that are too far away.
//
// Steps are measured in units of NewtonSystem::scales, in two ways: the root mean square over all unknowns decides
// about damping and about keeping old factors; the largest single unknown decides about convergence, so that the mean
// over hundreds of points cannot hide one that is still moving.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "numerics/newton_system.hpp"

namespace lampblack::numerics {

struct NewtonOptions {
  double stepTolerance = 1e-3;  // converged once the next step changes no unknown by more than this (scaled)
  std::size_t maximumSteps = 60;
  std::size_t jacobianAge = 8;  // steps with the same factors while they converge fast enough
  double fastEnough = 0.4;      // ratio of successive step sizes that still allows old factors
  double smallestDamping = 1e-3;
  // Where positive: a converged solution is improved with the factors at hand (a residual and a solve a step) until no
  // unknown changes by more than this, or until rounding stops it. Budgets close to about that accuracy.
  double polish = 0;
};

struct PseudoTransientOptions {
  double firstStep = 1e-5;      // s
  double largestStep = 1e3;     // s: beyond it the system is steady and Newton has to converge
  double smallestStep = 1e-15;  // s: below it the solution has failed
  double growth = 2, cut = 0.25;
  std::size_t stepsBetweenNewton = 10;  // tries the steady equations after so many steps
  std::size_t maximumSteps = 2000;
  std::size_t newtonSteps = 12;  // a time step that needs more has failed; with at most a third of them the next grows
  double stepTolerance = 0.1;    // as NewtonOptions::stepTolerance, of a time step
};

struct NewtonReport {
  bool converged = false;
  std::size_t steps = 0, factorisations = 0, residuals = 0, timeSteps = 0;
  double stepSize = 0;       // of the last Newton step: root mean square, scaled
  double worstResidual = 0;  // the same of its worst unknown, with which convergence is decided
  std::string worst;         // where it is: NewtonSystem::nameOf
  std::string reason;        // why it stopped where it did not converge
};

class NewtonSolver {
 public:
  explicit NewtonSolver(NewtonOptions options = {}, PseudoTransientOptions transient = {});
  ~NewtonSolver();

  // Newton's method alone, from x; x is the last iterate also where it failed. Throws NumericsError where the residual
  // cannot be evaluated at the start, or is not finite there; elsewhere such points are stepped back from.
  NewtonReport newton(NewtonSystem& system, std::span<double> x);
  // One implicit Euler step of length dt, with time weights of the old state. False (x unchanged) where Newton does not
  // converge. Counts are added to the report.
  bool timeStep(NewtonSystem& system, std::span<double> x, double dt, NewtonReport& report);
  // Newton; where it fails, pseudo-transient steps until Newton converges. x is the last state that was accepted: the
  // solution, or the last time step's. `between` is called where Newton's method failed, before time steps; it may
  // put the system and x on another grid.
  NewtonReport steady(NewtonSystem& system, std::vector<double>& x, const std::function<void()>& between = {});
  // Of the last steady(): also where an exception ended it.
  [[nodiscard]] const NewtonReport& report() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace lampblack::numerics
