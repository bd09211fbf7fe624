// Two opposed streams as a first guess: where they meet by their momentum, and across which distance they mix.
#pragma once

#include <functional>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::flow {

struct OpposedStreams {
  double length = 0;                                 // m
  double leftFlux = 0, rightFlux = 0;                // kg/m2/s, both into the domain; plug nozzles
  bool potential = false;                            // strain rate and stagnation plane are given instead
  double strainRate = 0;                             // 1/s, of the right stream
  double stagnationPlane = 0;                        // m
  std::function<double(double)> density;             // kg/m3 of the mixture with a share of the left stream
  std::function<double(double)> conductivityOverCp;  // kg/m/s of the same
};

struct MixingProfile {
  std::vector<double> z;       // m
  std::vector<double> share;   // of the left stream
  std::vector<double> spread;  // V, 1/s
  double lambda = 0;           // pressure gradient, N/m4
  double leftFlux = 0;         // rho u at z = 0, kg/m2/s

  [[nodiscard]] double shareAt(double at) const;
  [[nodiscard]] double spreadAt(double at) const;
};

// Without friction each stream spreads with rho V^2 = -Lambda at the stagnation plane, falling to none at a plug nozzle
// in proportion to the distance from it (u is a parabola there), and being constant in a potential flow. The share of
// the left stream is the solution of rho u dZ/dz = d/dz(lambda/cp dZ/dz) in that flow, an error function where the
// properties are constant. Density and flow are found from each other in turn.
[[nodiscard]] MixingProfile mixOpposedStreams(const OpposedStreams& streams);

}  // namespace lampblack::flow
