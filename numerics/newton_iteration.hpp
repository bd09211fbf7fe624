// One nonlinear solve of NewtonSolver: PETSc's SNES runs the loop; the linear solver, the line search and the decision
// to keep old factors are ours (shells).
//
// Line search: the error-oriented Newton method NLEQ-ERR (Deuflhard 2004,
// section 3.3.3). With s the Newton step at x and s' = -J(x)^-1 F(x + lambda s) the simplified one after it, a damping
// lambda is accepted where |s'| <= (1 - lambda/4) |s|, or where s' is below the tolerance. s' serves as the next step
// while the factors are kept, so that it costs nothing then.
//
// SNES runs on PETSC_COMM_SELF: all ranks have the same vectors, see the same bits and take the same decisions.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/petsc.hpp"
#include "core/petsc_callbacks.hpp"
#include "numerics/newton_solver.hpp"
#include "numerics/newton_system.hpp"

namespace lampblack::numerics {

class NewtonIteration {
 public:
  // `system` has to live as long, and to stay the same equations.
  NewtonIteration(NewtonSystem& system, NewtonOptions options);

  // Solves residual(x) = 0. Counts are added to the report.
  void steady(std::span<double> x, NewtonReport& report);
  // Solves residual(x) + timeWeights(old) (x - old)/dt = 0, with the factors of the last call where dt is the same.
  void eulerStep(std::span<const double> old, double dt, std::span<double> x, NewtonReport& report);
  // The next call begins with new factors.
  void forgetFactors() { haveFactors_ = false; }

 private:
  struct Size {
    double mean = 0, largest = 0;
    std::size_t worst = 0;
  };

  void run(std::span<double> x, NewtonReport& report);
  void createSolver();
  void evaluate(std::span<const double> x, std::span<double> F);
  [[nodiscard]] bool tryEvaluate(std::span<const double> x, std::span<double> F);
  [[nodiscard]] Size sizeOf(std::span<const double> step) const;
  // Mean size of a - factor b.
  [[nodiscard]] double distance(std::span<const double> a, double factor, std::span<const double> b) const;
  void note(const Size& size);
  void renewFactors(std::span<const double> x);
  void applyInverse(std::span<const double> F, std::span<double> inverse);
  void fail(SNESConvergedReason reason, std::string text);
  [[nodiscard]] SNESConvergedReason decide();

  void searchLine(SNESLineSearch lineSearch);
  [[nodiscard]] bool search(std::span<const double> x, std::span<const double> inverse, const Size& size);
  [[nodiscard]] double roomInBounds(std::span<const double> x, std::span<const double> inverse,
                                    std::size_t& limit) const;
  [[nodiscard]] double predictedDamping(std::span<const double> inverse, double size) const;
  void accept(const Size& size, const Size& next, double damping);
  void stopPolishing(bool fresh);

  static PetscErrorCode functionCallback(SNES snes, Vec x, Vec F, void* self);
  static PetscErrorCode jacobianCallback(SNES snes, Vec x, Mat matrix, Mat preconditioner, void* self);
  static PetscErrorCode solveCallback(PC shell, Vec F, Vec inverse);
  static PetscErrorCode searchCallback(SNESLineSearch lineSearch, void* self);
  static PetscErrorCode convergedCallback(SNES snes, PetscInt step, PetscReal x, PetscReal g, PetscReal f,
                                          SNESConvergedReason* reason, void* self);

  NewtonSystem& system_;
  NewtonOptions options_;
  PetscNonlinearSolver snes_;
  PetscMatrix matrix_;
  PetscVector x_, F_, work_;
  PetscExceptions exceptions_;

  NewtonReport* report_ = nullptr;
  double inverseTimeStep_ = 0;
  std::vector<double> old_, weights_;
  std::vector<double> lower_, upper_, scale_;

  // Factors: those of matrix_ at some earlier x.
  bool haveFactors_ = false;
  double factorsInverseTimeStep_ = 0;
  std::size_t factorsAge_ = 0;  // steps taken with them
  bool renew_ = true;           // before the next step

  // Of the line search. simplified_ is J^-1 F at the point that was accepted last.
  std::vector<double> trial_, trialF_, simplified_;
  bool haveSimplified_ = false, simplifiedIsStep_ = false;
  double lastStep_ = 0, lastDamping_ = 1;
  bool lastFresh_ = false;
  bool converged_ = false;  // within stepTolerance; from then on polishing
  bool finished_ = false;
  std::size_t steps_ = 0, polishRenewals_ = 0, worst_ = 0;
};

}  // namespace lampblack::numerics
