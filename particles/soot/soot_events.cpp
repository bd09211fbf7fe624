#include "particles/soot/soot_events.hpp"

#include <algorithm>
#include <span>

#include "core/cube_root.hpp"
#include "core/poisson.hpp"
#include "numerics/lanes.hpp"
#include "particles/soot/soot_columns.hpp"

namespace lampblack::particles {
namespace {

constexpr std::size_t particlesAtATime = 128;
// Of one particle; more are drawn as numbers of each kind.
constexpr double manyEvents = 8;

// A batch of particles that each had at least one event. `number`: events of each kind.
struct EventBatch {
  std::size_t count = 0;
  std::uint32_t place[particlesAtATime];
  std::uint64_t few[particlesAtATime];  // 16 bits for each kind
  double number[sootEvents][particlesAtATime];
  double carbon[particlesAtATime], hydrogen[particlesAtATime], diameter[particlesAtATime];
  double gained[particlesAtATime], lost[particlesAtATime];  // kg
};

// `number` of those that have few events.
void unpack(EventBatch& batch, std::span<const std::uint32_t> many) {
  double kept[sootEvents][particlesAtATime];
  for (std::size_t m = 0; m < many.size(); ++m)
    for (std::size_t kind = 0; kind < sootEvents; ++kind) kept[kind][m] = batch.number[kind][many[m]];
  for (std::size_t kind = 0; kind < sootEvents; ++kind)
    for (std::size_t j = 0; j < batch.count; ++j)
      batch.number[kind][j] = static_cast<double>((batch.few[j] >> (16U * kind)) & 0xffffU);
  for (std::size_t m = 0; m < many.size(); ++m)
    for (std::size_t kind = 0; kind < sootEvents; ++kind) batch.number[kind][many[m]] = kept[kind][m];
}

// Applies the events of one particle in a random order, where their order matters. All orders are equally likely. False
// where the particle is oxidised away.
bool applyInRandomOrder(SootEvents& events, SootEventNumbers numbers, RandomStream& random, double& carbon,
                        double& hydrogen) {
  for (double left = sumOf(numbers); left > 0; --left) {
    const std::size_t kind = eventAt(numbers, left > 1 ? random.uniform() * left : 0.5);
    --numbers[kind];
    if (!events.applyEvents(kind, carbon, hydrogen)) return false;
  }
  return true;
}

// Applies all events of all particles of the batch. `sum`: transferred amounts, times the weight of the particle.
void applyAllEvents(EventBatch& batch, const SootColumns& all, const SootMedium& medium, double least,
                    RandomStream& random, SootTransfer& sum) {
  const double atom = medium.carbonAtom(), dimerCarbon = medium.dimerCarbon(), dimerHydrogen = medium.dimerHydrogen();
  using Row = double[particlesAtATime];
  Row inTurn, dimers, growth, byO2, byOH, hydrogenO2, hydrogenOH;
  const std::size_t n = batch.count;
  for (std::size_t j = 0; j < n; ++j) {
    const double w = all.weight[batch.place[j]], c = batch.carbon[j], h = batch.hydrogen[j];
    const double grown = 2 * batch.number[growthEvent][j] * atom;
    const double O2 = 2 * batch.number[oxidationByO2Event][j] * atom, OH = batch.number[oxidationByOHEvent][j] * atom;
    const bool risky = O2 + OH > 0 && c - (O2 + OH) < least;
    inTurn[j] = risky ? 1 : 0;
    // What comes in comes first; hydrogen leaves with its carbon.
    const double most = c + batch.number[dimerEvent][j] * dimerCarbon + grown;
    const double full = h + batch.number[dimerEvent][j] * dimerHydrogen, share = full / most;
    batch.carbon[j] = risky ? c : most - O2 - OH;
    batch.hydrogen[j] = risky ? h : full - share * (O2 + OH);
    const double counted = risky ? 0 : w;
    dimers[j] = counted * batch.number[dimerEvent][j];
    growth[j] = counted * grown;
    byO2[j] = counted * O2;
    byOH[j] = counted * OH;
    hydrogenO2[j] = counted * share * O2;
    hydrogenOH[j] = counted * share * OH;
    batch.gained[j] = most + full - c - h;
    batch.lost[j] = (1 + share) * (O2 + OH);
  }
  sum.dimers += numerics::sumOf(dimers, n);
  sum.growth += numerics::sumOf(growth, n);
  sum.oxidationO2 += numerics::sumOf(byO2, n);
  sum.oxidationOH += numerics::sumOf(byOH, n);
  sum.hydrogenO2 += numerics::sumOf(hydrogenO2, n);
  sum.hydrogenOH += numerics::sumOf(hydrogenOH, n);
  for (std::size_t j = 0; j < n; ++j) {
    if (inTurn[j] == 0) continue;
    SootEvents events(medium, least, all.weight[batch.place[j]], sum);
    applyInRandomOrder(events, {batch.number[0][j], batch.number[1][j], batch.number[2][j], batch.number[3][j]}, random,
                       batch.carbon[j], batch.hydrogen[j]);
  }
}

}  // namespace

void GrowthByEvents::grow(SootColumns& all, std::vector<std::uint32_t>& changed) {
  const SootGrowth law = law_;
  const double least = law.leastCarbon(), perVolume = type_.perVolume(), perAtom = 1 / medium_.carbonAtom(), dt = dt_;
  changed.clear();
  double expected[sootEvents][particlesAtATime], total[particlesAtATime];
  double d[particlesAtATime], shape[particlesAtATime];
  EventBatch batch;
  std::uint32_t many[particlesAtATime];  // which of them have their numbers already
  const bool spheres = type_.coalescing(), changesPrimaries = type_.shape() == SootShape::surfaceVolume;
  RandomStream& random = random_;
  double next = next_;
  for (std::size_t first = 0; first < all.size(); first += particlesAtATime) {
    const std::size_t n = std::min(particlesAtATime, all.size() - first);
    const double *c = &all.carbon[first], *h = &all.hydrogen[first];
    double* primaries = &all.primaries[first];
    const auto expect = [&](std::size_t i, double count, double factor, double diameter) {
      const SootEventNumbers e = expectedEvents(law, c[i], h[i], count, factor, diameter, dt, perAtom);
      for (std::size_t kind = 0; kind < sootEvents; ++kind) expected[kind][i] = e[kind];
      total[i] = sumOf(e);
    };
    if (spheres) {
      const double* diameter = &all.diameter[first];
      for (std::size_t i = 0; i < n; ++i) expect(i, 1, 1, diameter[i]);
    } else if (changesPrimaries) {
      for (std::size_t i = 0; i < n; ++i) {
        const GrowingShape middle = growingShape(law, type_, c[i] + h[i], primaries[i], dt);
        expect(i, middle.primaries, middle.factor, middle.diameter);
      }
    } else {
      for (std::size_t i = 0; i < n; ++i) {
        d[i] = normalCubeRoot(perVolume * (c[i] + h[i]) / primaries[i]);
        shape[i] = SootAggregate::collisionFactor(primaries[i]);
      }
      for (std::size_t i = 0; i < n; ++i) expect(i, primaries[i], shape[i], d[i]);
    }
    batch.count = 0;
    std::size_t manyOnes = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const bool areMany = total[i] > manyEvents;
      if (total[i] <= next && !areMany) {
        next -= total[i];
        continue;
      }
      const std::size_t k = first + i, j = batch.count++;
      batch.place[j] = static_cast<std::uint32_t>(k);
      batch.carbon[j] = all.carbon[k];
      batch.hydrogen[j] = all.hydrogen[k];
      if (areMany) {  // its piece of the line is left out
        many[manyOnes++] = static_cast<std::uint32_t>(j);
        for (std::size_t kind = 0; kind < sootEvents; ++kind)
          batch.number[kind][j] = poisson(random, expected[kind][i]);
        continue;
      }
      const double one = expected[0][i], two = one + expected[1][i], three = two + expected[2][i];
      double left = total[i];
      std::uint64_t few = 0;
      while (next < left) {
        left -= next;
        next = gaps_.next(random);
        const double at = random.uniform() * total[i];
        few += std::uint64_t{1} << (16U * ((at >= one) + (at >= two) + (at >= three)));
      }
      next -= left;
      batch.few[j] = few;
    }
    unpack(batch, {many, manyOnes});
    applyAllEvents(batch, all, medium_, least, random, moved_);
    if (changesPrimaries)
      for (std::size_t j = 0; j < batch.count; ++j) {
        const std::size_t i = batch.place[j] - first;
        primaries[i] = primariesAfter(primaries[i], c[i] + h[i], batch.gained[j], batch.lost[j]);
        shape[i] = type_.shapeFactor(primaries[i]);
      }
    for (std::size_t j = 0; j < batch.count; ++j)
      batch.diameter[j] = perVolume * (batch.carbon[j] + batch.hydrogen[j]) / all.primaries[batch.place[j]];
    for (std::size_t j = 0; j < batch.count; ++j) batch.diameter[j] = normalCubeRoot(batch.diameter[j]);
    for (std::size_t j = 0; j < batch.count; ++j) {
      const std::size_t k = batch.place[j];
      all.carbon[k] = batch.carbon[j];
      all.hydrogen[k] = batch.hydrogen[j];
      all.diameter[k] = spheres ? batch.diameter[j] : shape[k - first] * batch.diameter[j];
    }
    changed.insert(changed.end(), batch.place, batch.place + batch.count);
  }
  next_ = next;
}

SootTransfer growAllByEvents(SootColumns& all, const SootAggregate& type, const SootMedium& medium,
                             const SootFluxes& fluxes, double dt, RandomStream& random) {
  GrowthByEvents growth(type, medium, fluxes, dt, random);
  std::vector<std::uint32_t> changed;
  growth.grow(all, changed);
  return growth.moved();
}

}  // namespace lampblack::particles
