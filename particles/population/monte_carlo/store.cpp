#include "particles/population/monte_carlo/store.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace lampblack::particles {

void boundExceeded(double rate, double bound) {
  throw NumericsError(fmt::format(
      "a pair of particles collides at a rate of {:.6g} that its bound {:.6g} does not cover", rate, bound));
}

}  // namespace lampblack::particles
