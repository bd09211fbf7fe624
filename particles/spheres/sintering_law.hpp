// How long primaries take to sinter: characteristic times of common mechanisms, all with the diameter below which
// primaries are as liquid (Tsantilis, Briesen, Pratsinis 2001).
#pragma once

#include <cmath>
#include <string_view>

#include "core/modules.hpp"

namespace lampblack::particles {

enum class SinteringMechanism {
  none,
  viscousFlow,       // A d: silica (Tsantilis, Briesen, Pratsinis 2001; Shekar et al. 2011, eq. 41)
  grainBoundary,     // A d^4 T: titania (Kobata, Kusakabe, Morooka 1991)
  surfaceDiffusion,  // A d^4 T
  volumeDiffusion,   // A d^3 T (Friedlander and Wu 1994)
  constant           // A
};

struct SinteringLaw {
  SinteringMechanism mechanism = SinteringMechanism::none;
  double prefactor = 0;    // A: s/m, s/(m4 K), s/(m3 K), s
  double temperature = 0;  // K, activation energy over the gas constant
  double critical = 0;     // m, diameter of liquid primaries
  // The size in the law: of the smaller neighbour (eq. 41), or 6 V/S of what sinters.
  enum class Size { smaller, volumeToSurface } size = Size::smaller;
  // What sinters: each pair of neighbours (eq. 40). Or the two parts of the aggregate that a collision joined, with
  // volume, surface and size of both whole parts, as in MOpS, where the tree is that of the collisions.
  enum class Between { neighbours, parts } between = Between::neighbours;
  // Parts within an aggregate lose their surface towards their sphere's; or towards none, as the public source of MOpS
  // has it, where they have no sphere.
  bool innerSpheres = true;

  [[nodiscard]] bool active() const { return mechanism != SinteringMechanism::none; }
  // s, at a temperature (K) for a size d (m).
  [[nodiscard]] double time(double T, double d) const {
    const double arrhenius =
        mechanism == SinteringMechanism::constant ? 1 : std::exp(temperature / T * (1 - critical / d));
    switch (mechanism) {
      case SinteringMechanism::viscousFlow:
        return prefactor * d * arrhenius;
      case SinteringMechanism::grainBoundary:
      case SinteringMechanism::surfaceDiffusion:
        return prefactor * d * d * d * d * T * arrhenius;
      case SinteringMechanism::volumeDiffusion:
        return prefactor * d * d * d * T * arrhenius;
      case SinteringMechanism::constant:
        return prefactor;
      case SinteringMechanism::none:
        break;
    }
    return HUGE_VAL;
  }
};

}  // namespace lampblack::particles
