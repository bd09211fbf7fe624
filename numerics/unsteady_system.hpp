// What a time integrator sees of an unsteady flame (or of a test problem):
//   residual(x) + timeWeights(x) * dx/dt + storage(x, dx/dt) = 0,
// with a load that is a given function of time.
#pragma once

#include <span>

#include "core/modules.hpp"
#include "numerics/loaded_system.hpp"

namespace lampblack::numerics {

class UnsteadySystem : public LoadedSystem {
 public:
  // Adds to F what rates of change do in equations other than their own. Zero for held unknowns.
  virtual void storage(std::span<const double> x, std::span<const double> rate, std::span<double> F) = 0;
  // Builds and factorises dF/dx + shift * dF/d(dx/dt), storage included, at x. Terms that are small with the step (the
  // change of weights with x) may be left out. False where the matrix is singular.
  [[nodiscard]] virtual bool factoriseUnsteady(std::span<const double> x, double shift) = 0;
};

}  // namespace lampblack::numerics
