// Where the particles of a packed Ensemble are, for owners of many populations, who keep them packed and move particles
// between them: behind a head of as many values for all, each as GivenParticle has it. Particles may be taken out, and
// where their numbers may differ put in: unpack() takes what it finds, merges what is too many, and asks for no order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "core/packed_doubles.hpp"
#include "core/rooms.hpp"
#include "particles/ensemble/ensemble.hpp"

namespace lampblack::particles {

// Whose random numbers a population draws (EnsembleOptions::owner), in two halves.
using PackedOwner = std::array<double, 2>;
inline constexpr std::size_t packedOwnerAt = 3;
[[nodiscard]] inline PackedOwner packedOwner(std::uint64_t owner) {
  return {static_cast<double>(owner >> 32U), static_cast<double>(owner & 0xffffffffU)};
}
[[nodiscard]] inline std::uint64_t ownerOf(const PackedOwner& packed) {
  return (static_cast<std::uint64_t>(packed[0]) << 32U) | static_cast<std::uint64_t>(packed[1]);
}

inline constexpr std::size_t packedParticle = sizeof(GivenParticle) / sizeof(double);
inline constexpr std::size_t packedHead =
    10 + sizeof(EnsembleExchange) / sizeof(double) + std::size(populationCounters) + 2;

[[nodiscard]] inline std::vector<GivenParticle> packedParticles(std::span<const double> state) {
  std::vector<GivenParticle> particles;
  if (state.size() <= packedHead) return particles;
  particles.reserve((state.size() - packedHead) / packedParticle);
  for (PackedDoubles rest(state.subspan(packedHead)); rest.left() > 0;) particles.push_back(rest.next<GivenParticle>());
  return particles;
}

}  // namespace lampblack::particles
