// Where the particles of a packed Ensemble are, for owners of many populations, who keep them packed and move particles
// between them: behind a head of as many values for all, each as GivenParticle has it. Particles may be taken out, and
// where their numbers may differ put in: unpack() takes what it finds, merges what is too many, and asks for no order.
#pragma once

#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

#include "core/packed_doubles.hpp"
#include "core/rooms.hpp"
#include "particles/ensemble/ensemble.hpp"

namespace lampblack::particles {

inline constexpr std::size_t packedParticle = sizeof(GivenParticle) / sizeof(double);
inline constexpr std::size_t packedHead =
    8 + sizeof(EnsembleExchange) / sizeof(double) + std::size(populationCounters) + 2;

[[nodiscard]] inline std::vector<GivenParticle> packedParticles(std::span<const double> state) {
  std::vector<GivenParticle> particles;
  if (state.size() <= packedHead) return particles;
  particles.reserve((state.size() - packedHead) / packedParticle);
  for (PackedDoubles rest(state.subspan(packedHead)); rest.left() > 0;) particles.push_back(rest.next<GivenParticle>());
  return particles;
}

}  // namespace lampblack::particles
