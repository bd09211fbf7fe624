// A nonlinear system whose last unknown is a load (the factor on the strain of a flame), fixed by the last equation or
// exchanged for a condition along which a branch of solutions is followed.
#pragma once

#include <optional>
#include <vector>

#include "core/modules.hpp"
#include "numerics/newton_system.hpp"

namespace lampblack::numerics {

// A condition  sum_i coefficients[i] x[i] = value  in place of `load = value` (arc length).
struct LoadConstraint {
  std::vector<double> coefficients;  // size() of the system
  double value = 0;
};

class LoadedSystem : public NewtonSystem {
 public:
  // The load of the last equation, `load = value`, where there is no constraint.
  virtual void setLoad(double load) = 0;
  virtual void setConstraint(std::optional<LoadConstraint> constraint) = 0;
};

}  // namespace lampblack::numerics
