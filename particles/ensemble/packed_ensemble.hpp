// What a packed Ensemble has in its rows (packed_rows.hpp), a particle each. Particles may be taken out, and where
// their numbers may differ put in: unpack() takes what it finds, merges what is too many, and asks for no order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/modules.hpp"
#include "core/packed_doubles.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/soot/soot_aggregate.hpp"

namespace lampblack::particles {

inline constexpr std::size_t packedHead =
    10 + sizeof(EnsembleExchange) / sizeof(double) + std::size(populationCounters) + 2;

[[nodiscard]] inline std::vector<GivenParticle> packedParticles(std::span<const double> state) {
  std::vector<GivenParticle> particles;
  if (state.size() <= packedHead) return particles;
  particles.reserve((state.size() - packedHead) / packedParticle);
  for (PackedDoubles rest(state.subspan(packedHead)); rest.left() > 0;) particles.push_back(rest.next<GivenParticle>());
  return particles;
}

// `d`: the diameter of the primaries, m.
inline void addTo(Ensemble::Totals& t, const GivenParticle& p, double d) {
  t.number += p.number;
  t.carbon += p.number * p.carbon;
  t.hydrogen += p.number * p.hydrogen;
  t.primaries += p.number * p.primaries;
  t.surface += p.number * p.primaries * constants::pi * d * d;
  t.diameters += p.number * d * SootAggregate::mobilityFactor(p.primaries);
}

inline void addTo(Ensemble::Totals& t, const SootAggregate& type, const GivenParticle& p) {
  addTo(t, p, cubeRoot(type.perVolume() * (p.carbon + p.hydrogen) / p.primaries));
}

}  // namespace lampblack::particles
