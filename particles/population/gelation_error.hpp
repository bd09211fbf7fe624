// The population has gelled: one particle holds a part of the mass that does not vanish with the size of the sample,
// and the population balance as written does not hold any more. An honest end of a computation, with its time.
#pragma once

#include <fmt/format.h>

#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {

class GelationError : public NumericsError {
 public:
  explicit GelationError(double time)
      : NumericsError(fmt::format("the population gels at t = {:.6g} s: from there on one particle holds a finite part "
                                  "of the mass and the population balance has no solution that conserves it",
                                  time)),
        time_(time) {}
  [[nodiscard]] double time() const { return time_; }  // s

 private:
  double time_;
};

}  // namespace lampblack::particles
