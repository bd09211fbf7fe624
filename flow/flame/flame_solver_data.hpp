// Inside of FlameSolver: what its stages and its grids share. Not for other modules.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/flame_stability.hpp"

namespace lampblack::flow {

struct FlameSolver::Data {
  MPI_Comm comm = MPI_COMM_NULL;
  std::shared_ptr<const Mechanism> mechanism;
  FlameProblem problem;
  CarriedModel* carried = nullptr;
  FlameSolverOptions options;
  std::function<void(const FlameStage&, const FlameProfile&)> report;
  std::optional<GivenExchange> exchange;

  FlameSolution solution;  // as far as it has come

  void solve();
  // From each of the starts in turn until one leads to a flame.
  void solveFromOneOf(const std::vector<FlameProfile>& starts);
  // One stage: the steady flame on the grid of the profile.
  void steady(FlameEquations& equations, NewtonSolver& solver, const std::string& name);
  // The end of a stage that began at `start` (MPI_Wtime). FlameFailure where it has not converged.
  void finish(FlameStage& stage, double start);
  [[noreturn]] void fail(const FlameStage& stage);
  // The work of a stage that began at `start`; one that is stopped is kept with what its solver counted.
  void inStage(FlameStage& stage, double start, NewtonSolver& solver, const std::function<void()>& work);
  // Stages on the way to the last grid, and Newton steps until budgets close.
  void toLastSteps(FlameEquations& equations, NewtonSolver& solver, const std::string& name);
  // Where the solution would not last, to the one that the flame goes to from there if it is disturbed towards higher
  // temperatures. What cannot be left stays, with its growth rate.
  void preferStable(FlameEquations& equations, NewtonSolver& solver, const std::string& name);
  void leaveUnstableFlame(FlameEquations& equations, NewtonSolver& solver, const GrowingMode& mode);
  // Stages on ever better grids until none is needed.
  void refine(FlameEquations& equations, NewtonSolver& solver, const std::string& name);
  void setGridAndAnchor(FlameEquations& equations);
  void moveGridToFlame(FlameEquations& equations);
  void reactAtFixedTemperature(FlameEquations& equations, NewtonSolver& solver);
  bool widen();
  [[nodiscard]] std::vector<std::size_t> anchorPoint() const;
  void anchorIn(const FlameProfile& profile);
  void gasAlone(const FlameProblem& flame, NewtonSolver& solver, const std::string& name);
  void scalarsAlone(FlameEquations& equations, NewtonSolver& solver);
  [[nodiscard]] double largestLoad() const;
  // What equations counted in some work, whatever ends it.
  void counted(const FlameEquations& equations, const std::function<void()>& work);
  void addCounters(const FlameEquations& equations);
  [[nodiscard]] bool withoutScalars() const {
    for (std::size_t i = 0; i < solution.profile.points(); ++i)
      for (double value : solution.profile.scalars(i))
        if (value != 0) return false;
    return true;
  }

  PseudoTransientOptions transient;  // of the present start
  // Of a free flame that can begin again from another start: its first mass flux, from which it may not go too far.
  std::optional<double> firstFlux;
  void watchFlux() const;

  double anchorZ = 0, anchorTemperature = 0;
};

}  // namespace lampblack::flow
