// A Rosenbrock method on the equations of a reactor (RosenbrockSolver), with the matrix and factors that CVODE has,
// too. In the cells of a flow, which transport keeps close to equilibrium with their reactions, one step does for most;
// CVODE, which starts at order one each time, takes several and as many iterations. The result depends on the arguments
// alone.
#pragma once

#include <span>

#include "chemistry/reactor/newton_matrix.hpp"
#include "chemistry/reactor/reactor_integrator.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "core/modules.hpp"
#include "numerics/rosenbrock_solver.hpp"

namespace lampblack::chemistry {

class ReactorRosenbrock {
 public:
  // The system, of a gas alone, must outlive the object.
  explicit ReactorRosenbrock(ReactorSystem& system);

  // Advances the unknowns (Y, T) under the system's conditions, at first by interval.firstStep (0: all of it at once).
  // False where that takes more than interval.maxSteps, steps rejected among them; `state` is then the last one
  // reached.
  bool advance(const ReactorIntegrator::Interval& interval, std::span<double> state, ReactorIntegrator::Work& work,
               const ReactorIntegrator::Watcher& watcher = {}) {
    return advance(interval, state, work, watcher, {});
  }
  // The same with the derivatives of the end by the start, column-major: to what `slopes` holds, derivatives of the
  // start by anything, the interval is applied, with the Jacobian of each step's start.
  bool advance(const ReactorIntegrator::Interval& interval, std::span<double> state, ReactorIntegrator::Work& work,
               const ReactorIntegrator::Watcher& watcher, std::span<double> slopes);

  // s, what the error of the last step asks of the next, in the same state or the next interval.
  double nextStep() const { return nextStep_; }

 private:
  class Counted;

  ReactorSystem& system_;
  NewtonMatrix matrix_;
  RosenbrockSolver solver_;
  std::vector<double> smallest_;
  double nextStep_ = 0;
};

}  // namespace lampblack::chemistry
