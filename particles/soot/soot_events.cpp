#include "particles/soot/soot_events.hpp"

#include <algorithm>

#include "core/cube_root.hpp"
#include "core/poisson.hpp"
#include "particles/soot/soot_columns.hpp"

namespace lampblack::particles {
namespace {

constexpr std::size_t particlesAtATime = 128;
// Of one particle; more are drawn as numbers of each kind.
constexpr double manyEvents = 64;

}  // namespace

// The events of all particles are one Poisson process on a line: the expected numbers of one particle after the other.
// Numbers in pieces of the line are independent, so that only events cost random numbers, not particles.
SootMoved growAllByEvents(SootColumns& all, const SootAggregate& type, const SootMedium& medium,
                          const SootFluxes& fluxes, double dt, RandomStream& random) {
  const SootGrowth law = medium.growth(fluxes);
  const double least = law.leastCarbon(), perVolume = type.perVolume(), perAtom = 1 / medium.carbonAtom();
  SootMoved sum;
  double total[particlesAtATime], d[particlesAtATime], shape[particlesAtATime];
  double next = random.exponential(1);  // how far it is to the next event
  for (std::size_t first = 0; first < all.size(); first += particlesAtATime) {
    const std::size_t n = std::min(particlesAtATime, all.size() - first);
    const double *c = &all.carbon[first], *h = &all.hydrogen[first], *primaries = &all.primaries[first];
    if (type.coalescing()) {
      const double* diameter = &all.diameter[first];
      for (std::size_t i = 0; i < n; ++i)
        total[i] = sumOf(expectedEvents(law, c[i], h[i], 1, 1, diameter[i], dt, perAtom));
    } else {
      for (std::size_t i = 0; i < n; ++i) {
        d[i] = normalCubeRoot(perVolume * (c[i] + h[i]) / primaries[i]);
        shape[i] = SootAggregate::collisionFactor(primaries[i]);
      }
      for (std::size_t i = 0; i < n; ++i)
        total[i] = sumOf(expectedEvents(law, c[i], h[i], primaries[i], shape[i], d[i], dt, perAtom));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const bool areMany = total[i] > manyEvents;
      if (total[i] <= next && !areMany) {
        next -= total[i];
        continue;
      }
      const std::size_t k = first + i;
      const double factor = type.coalescing() ? 1 : shape[i];
      const SootEventNumbers kinds = expectedEvents(law, c[i], h[i], primaries[i], factor,
                                                    type.coalescing() ? all.diameter[k] : d[i], dt, perAtom);
      SootEvents events(medium, least, all.weight[k], sum);
      bool stays = true;
      if (areMany) {  // its piece of the line is left out
        for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
          const double times = poisson(random, kinds[kind]);
          if (times > 0 && stays) stays = events.happens(kind, all.carbon[k], all.hydrogen[k], times);
        }
      } else {
        double left = total[i];
        while (next < left) {
          left -= next;
          next = random.exponential(1);
          if (!stays) continue;
          const std::size_t kind = eventAt(kinds, random.uniform() * total[i]);
          stays = events.happens(kind, all.carbon[k], all.hydrogen[k]);
        }
        next -= left;
      }
      if (stays) all.diameter[k] = factor * cubeRoot(perVolume * (all.carbon[k] + all.hydrogen[k]) / all.primaries[k]);
    }
  }
  return sum;
}

}  // namespace lampblack::particles
