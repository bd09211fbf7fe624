#include "particles/soot/soot_columns.hpp"

#include <algorithm>

#include "numerics/lanes.hpp"

namespace lampblack::particles {
namespace {

// Particles at a time: what a loop leaves for the next one stays in the fastest cache.
constexpr std::size_t block = 128;
using Block = double[block];

// Calls f(first, count) for all blocks of n.
template <class F>
void forEachBlock(std::size_t n, F f) {
  for (std::size_t first = 0; first < n; first += block) f(first, std::min(block, n - first));
}

// Diameters of the primaries, d^3 = perVolume * mass / primaries.
template <SootShape Shape>
void primaryDiameters(const double* carbon, const double* hydrogen, const double* primaries, double perVolume,
                      std::size_t n, double* d) {
  for (std::size_t i = 0; i < n; ++i) {
    const double volume = perVolume * (carbon[i] + hydrogen[i]);
    d[i] = normalCubeRoot(Shape == SootShape::spheres ? volume : volume / primaries[i]);
  }
}

template <SootShape Shape>
SootSums sums(const SootColumns& all, const SootAggregate& type, const SootMedium& medium) {
  constexpr bool areSpheres = Shape == SootShape::spheres;
  SootSums s;
  const bool condensing = medium.condensing();
  forEachBlock(all.size(), [&](std::size_t first, std::size_t n) {
    const double *c = &all.carbon[first], *h = &all.hydrogen[first], *primaries = &all.primaries[first];
    const double *diameter = &all.diameter[first], *w = &all.weight[first];
    Block carbon, hydrogen, count, area, diameters, rates, slopes, d;
    if (!areSpheres) primaryDiameters<Shape>(c, h, primaries, type.perVolume(), n, d);
    for (std::size_t i = 0; i < n; ++i) {
      const double primary = areSpheres ? diameter[i] : d[i];
      carbon[i] = w[i] * c[i];
      hydrogen[i] = w[i] * h[i];
      count[i] = w[i] * primaries[i];
      area[i] = count[i] * constants::pi * primary * primary;
      diameters[i] = w[i] * diameter[i];
    }
    s.number += numerics::sumOf(w, n);
    s.carbon += numerics::sumOf(carbon, n);
    s.hydrogen += numerics::sumOf(hydrogen, n);
    s.primaries += numerics::sumOf(count, n);
    s.area += numerics::sumOf(area, n);
    s.diameters += numerics::sumOf(diameters, n);
    if (!condensing) return;
    for (std::size_t i = 0; i < n; ++i) {
      const SootAggregate::Particle p{c[i], h[i], primaries[i], diameter[i]};
      rates[i] = w[i] * medium.condensingCollision(p);
    }
    s.collisions += numerics::sumOf(rates, n);
    if (medium.ofMonomers()) return;
    for (std::size_t i = 0; i < n; ++i)
      slopes[i] = medium.collisionSlope({c[i], h[i], primaries[i], diameter[i]}, rates[i],
                                        Shape == SootShape::surfaceVolume ? type.shapeGain(primaries[i]) : 1);
    s.slopes += numerics::sumOf(slopes, n);
  });
  return s;
}

constexpr std::size_t movedParts = 6;
constexpr double SootTransfer::*partsMoved[movedParts] = {&SootTransfer::dimers,      &SootTransfer::growth,
                                                          &SootTransfer::oxidationO2, &SootTransfer::oxidationOH,
                                                          &SootTransfer::hydrogenO2,  &SootTransfer::hydrogenOH};

// Particles of a block that a step takes too far, in as many shorter ones as each of them needs: those that are not
// through yet stand side by side and go on together. As SootMedium::grow of each.
template <SootShape Shape>
class StepsInTurn {
 public:
  StepsInTurn(const SootGrowth& law, const SootAggregate& type) : law_(law), type_(type) {}

  void add(std::size_t place, double carbon, double hydrogen, double primaries, double dt) {
    place_[count_] = place;
    before_[count_] = carbon_[count_] = carbon;
    hydrogen_[count_] = hydrogen;
    primaries_[count_] = primaries;
    rest_[count_] = dt;
    for (auto& part : moved_) part[count_] = 0;
    ++count_;
  }
  // f(place, carbon, hydrogen, primaries, lost, moved): what is left of each of them, and what it took and lost.
  template <class F>
  void take(F f) {
    while (count_ > 0) {
      step();
      settle(f);
    }
  }

 private:
  void step() {
    for (std::size_t i = 0; i < count_; ++i) {
      if constexpr (Shape == SootShape::spheres) {
        shape_[i] = {primaries_[i], 1, normalCubeRoot(type_.perVolume() * (carbon_[i] + hydrogen_[i]))};
      } else {
        shape_[i] = growingShape(law_, type_, carbon_[i] + hydrogen_[i], primaries_[i], rest_[i]);
      }
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const auto [primaries, factor, d] = shape_[i];
      const SootGrowth::Step s = law_.step(carbon_[i], hydrogen_[i], primaries, factor, d, rest_[i]);
      if constexpr (Shape == SootShape::surfaceVolume)
        primaries_[i] = primariesAfter(primaries_[i], carbon_[i] + hydrogen_[i], law_.gained(s), law_.lost(s));
      carbon_[i] = s.carbon;
      hydrogen_[i] = s.hydrogen;
      moved_[0][i] += s.dimers;
      moved_[1][i] += s.growth;
      moved_[2][i] += s.oxidationO2;
      moved_[3][i] += s.oxidationOH;
      moved_[4][i] += s.hydrogenO2;
      moved_[5][i] += s.hydrogenOH;
      rest_[i] = s.length < rest_[i] ? rest_[i] - s.length : 0;
    }
  }
  // Those that are through, or burnt, go; the others move together.
  template <class F>
  void settle(const F& f) {
    const double share = law_.shareO2();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const bool isLost = carbon_[i] < before_[i] && carbon_[i] < law_.leastCarbon();
      if (!isLost && rest_[i] > 0) {
        for (double* column : {before_, carbon_, hydrogen_, primaries_, rest_}) column[kept] = column[i];
        for (auto& part : moved_) part[kept] = part[i];
        place_[kept++] = place_[i];
        continue;
      }
      double took[movedParts];
      for (std::size_t k = 0; k < movedParts; ++k) took[k] = moved_[k][i];
      if (isLost) {  // as a whole
        took[2] += share * carbon_[i];
        took[3] += (1 - share) * carbon_[i];
        took[4] += share * hydrogen_[i];
        took[5] += (1 - share) * hydrogen_[i];
      }
      f(place_[i], isLost ? 0 : carbon_[i], isLost ? 0 : hydrogen_[i], primaries_[i], isLost ? 1.0 : 0.0, took);
    }
    count_ = kept;
  }

  SootGrowth law_;
  SootAggregate type_;
  std::size_t count_ = 0;
  std::size_t place_[block];
  Block before_, carbon_, hydrogen_, primaries_, rest_, moved_[movedParts];
  GrowingShape shape_[block];
};

template <SootShape Shape>
SootTransfer grow(SootColumns& all, const SootAggregate& type, const SootMedium& medium, const SootFluxes& fluxes,
                  double dt) {
  constexpr bool areSpheres = Shape == SootShape::spheres, changesPrimaries = Shape == SootShape::surfaceVolume;
  const SootGrowth law = medium.growth(fluxes);
  const double perVolume = type.perVolume(), least = law.leastCarbon(), share = law.shareO2();
  SootTransfer sum;
  forEachBlock(all.size(), [&](std::size_t first, std::size_t n) {
    double *c = &all.carbon[first], *h = &all.hydrogen[first], *diameter = &all.diameter[first];
    double* primaries = &all.primaries[first];
    const double* w = &all.weight[first];
    Block carbon, hydrogen, d, shape, rest, lost, after, moved[movedParts];
    if (changesPrimaries) {
      for (std::size_t i = 0; i < n; ++i) {
        const GrowingShape middle = growingShape(law, type, c[i] + h[i], primaries[i], dt);
        after[i] = middle.primaries;
        shape[i] = middle.factor;
        d[i] = middle.diameter;
      }
    } else if (!areSpheres) {
      primaryDiameters<Shape>(c, h, primaries, perVolume, n, d);
      for (std::size_t i = 0; i < n; ++i) shape[i] = SootAggregate::collisionFactor(primaries[i]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double before = areSpheres ? diameter[i] : d[i];
      const SootGrowth::Step s =
          law.step(c[i], h[i], changesPrimaries ? after[i] : primaries[i], areSpheres ? 1 : shape[i], before, dt);
      if (changesPrimaries) after[i] = primariesAfter(primaries[i], c[i] + h[i], law.gained(s), law.lost(s));
      // What is too small to go on burning goes as a whole.
      const bool gone = s.carbon < std::min(c[i], least);
      const double C = gone ? s.carbon : 0, H = gone ? s.hydrogen : 0;
      rest[i] = s.length < dt ? 1 : 0;
      lost[i] = gone ? w[i] : 0;
      carbon[i] = s.carbon - C;
      hydrogen[i] = s.hydrogen - H;
      moved[0][i] = w[i] * s.dimers;
      moved[1][i] = w[i] * s.growth;
      moved[2][i] = w[i] * (s.oxidationO2 + share * C);
      moved[3][i] = w[i] * (s.oxidationOH + (1 - share) * C);
      moved[4][i] = w[i] * (s.hydrogenO2 + share * H);
      moved[5][i] = w[i] * (s.hydrogenOH + (1 - share) * H);
    }
    if (numerics::sumOf(rest, n) > 0) {
      StepsInTurn<Shape> more(law, type);
      for (std::size_t i = 0; i < n; ++i)
        if (rest[i] != 0) more.add(i, c[i], h[i], primaries[i], dt);
      more.take([&](std::size_t i, double C, double H, double count, double isLost, const double* took) {
        carbon[i] = C;
        hydrogen[i] = H;
        if (changesPrimaries) after[i] = count;
        lost[i] = w[i] * isLost;
        for (std::size_t k = 0; k < movedParts; ++k) moved[k][i] = w[i] * took[k];
      });
    }
    for (std::size_t k = 0; k < movedParts; ++k) sum.*partsMoved[k] += numerics::sumOf(moved[k], n);
    sum.lost += numerics::sumOf(lost, n);
    if (changesPrimaries)
      for (std::size_t i = 0; i < n; ++i) {
        primaries[i] = after[i];
        shape[i] = type.shapeFactor(after[i]);
      }
    primaryDiameters<Shape>(carbon, hydrogen, primaries, perVolume, n, d);
    for (std::size_t i = 0; i < n; ++i) {
      c[i] = carbon[i];
      h[i] = hydrogen[i];
      diameter[i] = areSpheres ? d[i] : shape[i] * d[i];
    }
  });
  return sum;
}

}  // namespace

SootSums sumsOf(const SootColumns& all, const SootAggregate& type, const SootMedium& medium) {
  switch (type.shape()) {
    case SootShape::spheres:
      return sums<SootShape::spheres>(all, type, medium);
    case SootShape::aggregates:
      return sums<SootShape::aggregates>(all, type, medium);
    case SootShape::surfaceVolume:
      break;
  }
  return sums<SootShape::surfaceVolume>(all, type, medium);
}

SootTransfer growAll(SootColumns& all, const SootAggregate& type, const SootMedium& medium, const SootFluxes& fluxes,
                     double dt) {
  switch (type.shape()) {
    case SootShape::spheres:
      return grow<SootShape::spheres>(all, type, medium, fluxes, dt);
    case SootShape::aggregates:
      return grow<SootShape::aggregates>(all, type, medium, fluxes, dt);
    case SootShape::surfaceVolume:
      break;
  }
  return grow<SootShape::surfaceVolume>(all, type, medium, fluxes, dt);
}

}  // namespace lampblack::particles
