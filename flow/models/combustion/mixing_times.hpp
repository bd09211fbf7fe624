// The times and shares that the models of combustion make of the turbulence in a cell.
// Sources of the equations: docs/theory/combustion.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/modules.hpp"
#include "flow/models/turbulence/eddies.hpp"

namespace lampblack::flow {

enum class MixingTime { Effective, Kolmogorov, Geometric, Integral };

// s; infinity where nothing is dissipated. `constant`: of the effective and the integral time.
[[nodiscard]] inline double mixingTime(const Eddies& eddies, MixingTime kind, double constant) {
  if (!(eddies.dissipation > 0.0)) return std::numeric_limits<double>::infinity();
  const double small = std::sqrt(eddies.viscosity / eddies.dissipation);
  const double large = std::max(eddies.energy, 0.0) / eddies.dissipation;
  switch (kind) {
    case MixingTime::Kolmogorov:
      return small;
    case MixingTime::Geometric:
      return std::sqrt(large * small);
    case MixingTime::Integral:
      return constant * large;
    case MixingTime::Effective:
      break;
  }
  return constant * std::sqrt((eddies.viscosity + eddies.eddyViscosity) / eddies.dissipation);
}

// kappa, the share of a partially stirred reactor that reacts: one where mixing takes no time, zero where it takes for
// ever.
[[nodiscard]] inline double stirredShare(double chemicalTime, double mixingTime) {
  return 1.0 / (1.0 + mixingTime / chemicalTime);
}

// The fine structures of the eddy dissipation concept.
struct FineStructures {
  double length = 2.1377, time = 0.4083;      // C_gamma and C_tau
  double powerAbove = 2.0, powerBelow = 2.0;  // a and b of chi = gamma^a/(1 - gamma^b)

  // gamma, a length over that of the large eddies.
  [[nodiscard]] double size(const Eddies& eddies) const {
    if (!(eddies.energy > 0.0)) return std::numeric_limits<double>::infinity();
    return length *
           std::pow(eddies.viscosity * std::max(eddies.dissipation, 0.0) / (eddies.energy * eddies.energy), 0.25);
  }
  // chi, of the gas that reacts. Not above one: the structures would hold more than there is.
  [[nodiscard]] double share(double size) const {
    if (!(size < 1.0)) return 1.0;
    return std::min(std::pow(size, powerAbove) / (1.0 - std::pow(size, powerBelow)), 1.0);
  }
  // s, in which they mix with what is around them.
  [[nodiscard]] double mixing(const Eddies& eddies) const {
    return time * mixingTime(eddies, MixingTime::Kolmogorov, 1.0);
  }
};

}  // namespace lampblack::flow
