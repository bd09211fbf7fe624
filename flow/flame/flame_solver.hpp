// From a first profile to a converged flame: Newton and pseudo-transient steps, grid refinement, and a domain that
// widens until a free flame is flat at both ends.
#pragma once

#include <mpi.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "core/stop_request.hpp"
#include "flow/flame/flame_equations.hpp"
#include "flow/flame/flame_grid.hpp"
#include "numerics/newton_solver.hpp"

namespace lampblack::flow {

struct FlameSolverOptions {
  GridOptions grid;
  FlameTolerances tolerances;
  // Fewest factorisations over the flames of cases/ (docs/verification.md).
  NewtonOptions newton{.stepTolerance = 0.1, .smallestDamping = 0.01};
  PseudoTransientOptions transient{.growth = 4, .stepsBetweenNewton = 12, .stepTolerance = 1};
  double polish = 1e-4;        // NewtonOptions::polish of the last stage, so that budgets close
  double scalarChange = 1e-3;  // the last stage is repeated until no scalar changes by more of its largest value
  bool refine = true;          // false: the given grid only
  std::size_t maximumGrids = 40;
  bool preferStable = true;      // a solution that would not last is left for the one that does
  double anchorTemperature = 0;  // K, free flames; 0: between unburnt and burnt
};

// One stage of the way: "gas on 40 points", "with soot", "grid 3".
struct FlameStage {
  std::string name;
  std::size_t points = 0;
  NewtonReport newton;
  double seconds = 0;
};

struct FlameSolution {
  FlameProfile profile;
  std::vector<FlameStage> stages;
  FlameEquations::Counters counters;
  std::vector<FlameBudget> budgets;
  // 1/s, of the disturbance by which the flame would leave this solution (flame_stability.hpp); empty: none was found.
  std::optional<double> growthRate;
  std::optional<double> burnerHeatFlux;      // W/m2, into the burner
  std::optional<WallDeposition> deposition;  // of a flame with scalars against a wall
  std::size_t starts = 1;                    // that were tried
  // Of a scalar in the last of the last steps, over its largest value. Above FlameSolverOptions::scalarChange: the
  // values of scalars at faces have not settled in the passes allowed, although the equations with these values are
  // solved.
  double scalarChange = 0;
};

// The flame did not converge: the message says at which stage and where the residual sits. The last profile goes along
// so that it can be kept.
class FlameFailure : public NumericsError {
 public:
  FlameFailure(const std::string& message, FlameSolution last) : NumericsError(message), last_(std::move(last)) {}
  [[nodiscard]] const FlameSolution& last() const { return last_; }

 private:
  FlameSolution last_;
};

// Asked to stop on the way to a flame. The last profile goes along so that it can be kept.
class FlameStopped : public Stopped {
 public:
  FlameStopped(const Stopped& stop, FlameSolution last) : Stopped(stop.signal(), stop.what()), last_(std::move(last)) {}
  [[nodiscard]] const FlameSolution& last() const { return last_; }

 private:
  FlameSolution last_;
};

class FlameSolver {
 public:
  FlameSolver(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism, FlameProblem problem, CarriedModel* carried,
              FlameSolverOptions options);
  ~FlameSolver();

  // Called after each stage, on all ranks.
  void onStage(std::function<void(const FlameStage&, const FlameProfile&)> report);
  // Exchange with something outside (two-way coupled stochastic particles); kept for the following solutions.
  void setExchange(std::optional<GivenExchange> exchange);

  // Collective. Throws FlameFailure, and FlameStopped where the run is asked to stop. `start` may be of any grid over
  // the problem's length.
  FlameSolution solve(FlameProfile start);
  // From the first of several starts (initialFlames) that leads to a flame.
  FlameSolution solve(const std::vector<FlameProfile>& starts);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace lampblack::flow
