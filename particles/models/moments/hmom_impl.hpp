// Inside of HmomSoot: the two delta functions at one state, and their rates. Not for other models.
#pragma once

#include <array>

#include "core/modules.hpp"
#include "particles/models/moments/hmom.hpp"

namespace lampblack::particles {

struct HmomSoot::Mode {
  // The scalars, at least zero.
  double number = 0;                // 1/m3
  double carbon = 0, hydrogen = 0;  // kg/m3
  // What the rates take.
  double mass = 0;                                // kg/m3
  double present = 0;                             // 1/m3, number that goes with the mass
  double particle = 0;                            // kg, mean mass
  double volume = 0, surface = 0, primaries = 1;  // m3, m2, of the mean particle
  double collisionDiameter = 0;                   // m
  double hydrogenToCarbon = 0;                    // atoms
};

struct HmomSoot::State {
  Mode nuclei, large;
  double surface = 0;  // m2/m3, the scalar, at least zero
};

struct HmomSoot::Rates {
  std::array<double, scalarCount> scalars{};
  DimerBalance dimers;
  SurfaceEvents onNuclei, onLarge;
  double condensedOnLarge = 0;          // kg/m3/s
  double hydrogenLost = 0;              // mol/m3/s
  double coagulated = 0, burntOut = 0;  // 1/m3/s

  // Particles of the nuclei mode that leave it at `rate` (1/s), with what they have.
  void leaveNuclei(const Mode& mode, double rate, bool toLarge) {
    scalars[nuclei] -= rate * mode.number;
    scalars[nucleiCarbon] -= rate * mode.carbon;
    scalars[nucleiHydrogen] -= rate * mode.hydrogen;
    if (!toLarge) return;
    scalars[carbon] += rate * mode.carbon;
    scalars[hydrogen] += rate * mode.hydrogen;
  }
};

}  // namespace lampblack::particles
