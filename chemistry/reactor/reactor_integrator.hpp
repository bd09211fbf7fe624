// CVODE's BDF method (Hindmarsh et al. 2005) on the equations of a reactor, with our vectors and linear algebra under
// it. The result depends on the arguments alone, never on earlier calls.
#pragma once

#include <functional>
#include <string>

#include "chemistry/reactor/reactor_linear_solver.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "core/modules.hpp"
#include "numerics/sundials_handles.hpp"

namespace lampblack::chemistry {

class ReactorIntegrator {
 public:
  struct Interval {
    double duration = 0;   // s
    double firstStep = 0;  // s; 0: the solver's choice
    double relativeTolerance = 0;
    double absoluteTolerance = 0;  // of a mass fraction; that of the temperature is relativeTolerance K
    int maxSteps = 0;
  };
  struct Work {
    int steps = 0, rhsEvaluations = 0, jacobianEvaluations = 0;
  };
  struct Step {
    double time = 0, size = 0;  // s, at the end of the step and its length
    int order = 0;
    double temperature = 0;  // K
  };
  using Watcher = std::function<void(const Step&)>;

  // The system must outlive the object.
  explicit ReactorIntegrator(ReactorSystem& system);
  ReactorIntegrator(const ReactorIntegrator&) = delete;
  ReactorIntegrator& operator=(const ReactorIntegrator&) = delete;

  // The unknowns (Y, T): where an interval starts, and where it ended.
  double* state() { return N_VGetArrayPointer(y_.get()); }

  // Advances the state under the system's conditions. False with reason() if that fails; the state is then the last one
  // reached. What it did is added to `work`. A watcher is told of every step; the numbers are the same with and
  // without.
  bool advance(const Interval& interval, Work& work, const Watcher& watcher = {});

  double lastStep() const { return lastStep_; }  // s
  const std::string& reason() const { return reason_; }
  const NewtonMatrix& matrix() const { return linearSolver_.matrix(); }

 private:
  bool run(const Interval& interval, const Watcher& watcher);
  static int rates(sunrealtype t, N_Vector y, N_Vector f, void* data);
  static void keepMessage(const char* function, const char* message, void* integrator);

  ReactorSystem& system_;
  std::string reason_;
  double lastStep_ = 0;
  sundials::Context context_;
  sundials::Vector y_, tolerances_;
  ReactorLinearSolver linearSolver_;
  sundials::Cvode cvode_;
};

}  // namespace lampblack::chemistry
