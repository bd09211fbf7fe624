// A numerical particle with what it stands for.
#pragma once

#include "core/modules.hpp"

namespace lampblack::particles {

template <class Particle>
struct WeightedParticle {
  Particle particle;
  double weight;  // 1/m3: real ones
};

}  // namespace lampblack::particles
