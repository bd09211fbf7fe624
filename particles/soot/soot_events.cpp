#include <algorithm>
#include <array>

#include "core/cube_root.hpp"
#include "particles/soot/soot_columns.hpp"

namespace lampblack::particles {
namespace {

constexpr std::size_t particlesAtATime = 128;
using Expected = std::array<double, 4>;  // numbers of events: dimers, growth, oxidation by O2, by OH

// A step that is too long for a particle says what happens in its beginning.
[[gnu::always_inline]] inline Expected expected(const SootGrowth& law, double carbon, double hydrogen, double primaries,
                                                double shape, double d, double dt, double perAtom) {
  const SootGrowth::Step s = law.step(carbon, hydrogen, primaries, shape, d, dt);
  const double longer = dt / s.length, each = longer * perAtom;
  return {longer * s.dimers, 0.5 * each * s.growth, 0.5 * each * s.oxidationO2, each * s.oxidationOH};
}

[[gnu::always_inline]] inline double sumOf(const Expected& e) {
  return e[0] + e[1] + e[2] + e[3];
}

// Of one particle: its events, one after the other.
class Events {
 public:
  Events(const SootMedium& medium, double carbonAtom, double least, double weight, SootMoved& sum)
      : medium_(medium), atom_(carbonAtom), least_(least), weight_(weight), sum_(sum) {}

  // False where nothing is left of it.
  bool happens(std::size_t kind, double& carbon, double& hydrogen) {
    if (kind == 0) {
      carbon += medium_.dimerCarbon();
      hydrogen += medium_.dimerHydrogen();
      sum_.dimers += weight_;
      return true;
    }
    if (kind == 1) {
      carbon += 2 * atom_;
      sum_.growth += 2 * weight_ * atom_;
      return true;
    }
    const double wanted = (kind == 2 ? 2 : 1) * atom_;
    const bool gone = carbon - wanted < least_;
    const double C = gone ? carbon : wanted, H = hydrogen * (C / carbon);  // hydrogen leaves with its carbon
    (kind == 2 ? sum_.oxidationO2 : sum_.oxidationOH) += weight_ * C;
    (kind == 2 ? sum_.hydrogenO2 : sum_.hydrogenOH) += weight_ * H;
    carbon = gone ? 0 : carbon - C;
    hydrogen = gone ? 0 : hydrogen - H;
    if (gone) sum_.lost += weight_;
    return !gone;
  }

 private:
  const SootMedium& medium_;
  double atom_, least_, weight_;
  SootMoved& sum_;
};

}  // namespace

// The events of all particles are one Poisson process on a line: the expected numbers of one particle after the other.
// Numbers in pieces of the line are independent, so that only events cost random numbers, not particles.
SootMoved growAllByEvents(SootColumns& all, const SootAggregate& type, const SootMedium& medium,
                          const SootFluxes& fluxes, double dt, RandomStream& random) {
  const SootGrowth law = medium.growth(fluxes);
  const double atom = medium.carbonAtom(), least = law.leastCarbon(), perVolume = type.perVolume(), perAtom = 1 / atom;
  SootMoved sum;
  double total[particlesAtATime], d[particlesAtATime], shape[particlesAtATime];
  double next = random.exponential(1);  // how far it is to the next event
  for (std::size_t first = 0; first < all.size(); first += particlesAtATime) {
    const std::size_t n = std::min(particlesAtATime, all.size() - first);
    const double *c = &all.carbon[first], *h = &all.hydrogen[first], *primaries = &all.primaries[first];
    if (type.coalescing()) {
      const double* diameter = &all.diameter[first];
      for (std::size_t i = 0; i < n; ++i) total[i] = sumOf(expected(law, c[i], h[i], 1, 1, diameter[i], dt, perAtom));
    } else {
      for (std::size_t i = 0; i < n; ++i) {
        d[i] = normalCubeRoot(perVolume * (c[i] + h[i]) / primaries[i]);
        shape[i] = SootAggregate::collisionFactor(primaries[i]);
      }
      for (std::size_t i = 0; i < n; ++i)
        total[i] = sumOf(expected(law, c[i], h[i], primaries[i], shape[i], d[i], dt, perAtom));
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (total[i] <= next) {
        next -= total[i];
        continue;
      }
      const std::size_t k = first + i;
      const double factor = type.coalescing() ? 1 : shape[i];
      const Expected kinds =
          expected(law, c[i], h[i], primaries[i], factor, type.coalescing() ? all.diameter[k] : d[i], dt, perAtom);
      Events events(medium, atom, least, all.weight[k], sum);
      double left = total[i];
      bool stays = true;
      while (next < left) {
        left -= next;
        next = random.exponential(1);
        if (!stays) continue;
        double at = random.uniform() * total[i];
        std::size_t kind = 0;
        while (kind + 1 < kinds.size() && at >= kinds[kind]) at -= kinds[kind++];
        stays = events.happens(kind, all.carbon[k], all.hydrogen[k]);
      }
      next -= left;
      if (stays) all.diameter[k] = factor * cubeRoot(perVolume * (all.carbon[k] + all.hydrogen[k]) / all.primaries[k]);
    }
  }
  return sum;
}

}  // namespace lampblack::particles
