// Growth, condensation and oxidation of one soot particle, or of a part of it, in whole events: a dimer, two atoms of
// carbon by C2H2 or O2, one by OH.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "numerics/vector_math.hpp"
#include "particles/soot/soot_columns.hpp"
#include "particles/soot/soot_medium.hpp"

namespace lampblack::particles {

enum SootEvent : std::size_t { dimerEvent, growthEvent, oxidationByO2Event, oxidationByOHEvent, sootEvents };
using SootEventNumbers = std::array<double, sootEvents>;

// Expected numbers of events over dt (s) of a particle of `primaries` equal primaries of the diameter d (m), whose
// diameter of collision is `shape` times that: those of SootGrowth::step. A step that is too long for a particle says
// what happens in its beginning. `perAtom`: over the mass of a carbon atom, 1/kg.
[[gnu::always_inline, nodiscard]] inline SootEventNumbers expectedEvents(const SootGrowth& law, double carbon,
                                                                         double hydrogen, double primaries,
                                                                         double shape, double d, double dt,
                                                                         double perAtom) {
  const SootGrowth::Step s = law.step(carbon, hydrogen, primaries, shape, d, dt);
  const double longer = dt / s.length, each = longer * perAtom;
  return {longer * s.dimers, 0.5 * each * s.growth, 0.5 * each * s.oxidationO2, each * s.oxidationOH};
}

[[gnu::always_inline, nodiscard]] inline double sumOf(const SootEventNumbers& e) {
  return e[0] + e[1] + e[2] + e[3];
}

// The kind of an event that is due at this place of the row of expected numbers.
[[nodiscard]] inline std::size_t eventAt(const SootEventNumbers& expected, double at) {
  std::size_t kind = 0;
  while (kind + 1 < expected.size() && at >= expected[kind]) at -= expected[kind++];
  return kind;
}

// Applies events to one particle or one primary. The transferred amounts are summed in `sum`, times the weight.
class SootEvents {
 public:
  SootEvents(const SootMedium& medium, double least, double weight, SootTransfer& sum)
      : medium_(medium), atom_(medium.carbonAtom()), least_(least), weight_(weight), sum_(sum) {}

  // Applies `times` events of one kind to the masses of carbon and hydrogen (kg). False where the particle is oxidised
  // away: with less carbon than the smallest nucleus. Such particles are counted as `lost`.
  bool applyEvents(std::size_t kind, double& carbon, double& hydrogen, double times = 1) {
    if (kind == dimerEvent) {
      carbon += times * medium_.dimerCarbon();
      hydrogen += times * medium_.dimerHydrogen();
      sum_.dimers += times * weight_;
      return true;
    }
    if (kind == growthEvent) {
      carbon += 2 * times * atom_;
      sum_.growth += 2 * times * weight_ * atom_;
      return true;
    }
    const double wanted = (kind == oxidationByO2Event ? 2 : 1) * times * atom_;
    const bool gone = carbon - wanted < least_;
    const double C = gone ? carbon : wanted, H = hydrogen * (C / carbon);  // hydrogen leaves with its carbon
    (kind == oxidationByO2Event ? sum_.oxidationO2 : sum_.oxidationOH) += weight_ * C;
    (kind == oxidationByO2Event ? sum_.hydrogenO2 : sum_.hydrogenOH) += weight_ * H;
    carbon = gone ? 0 : carbon - C;
    hydrogen = gone ? 0 : hydrogen - H;
    if (gone) sum_.lost += weight_;
    return !gone;
  }

 private:
  const SootMedium& medium_;
  double atom_, least_, weight_;
  SootTransfer& sum_;
};

// Exponentially distributed numbers with the mean of one, made many at a time.
class ExponentialGaps {
 public:
  [[gnu::always_inline]] double next(RandomStream& random) {
    if (used_ == gaps_.size()) [[unlikely]]
      make(random);
    return gaps_[used_++];
  }

 private:
  void make(RandomStream& random) {
    for (double& gap : gaps_) gap = random.uniform();
    for (double& gap : gaps_) gap = -numerics::vectormath::logOne(gap);
    used_ = 0;
  }

  std::array<double, 64> gaps_{};
  std::size_t used_ = gaps_.size();
};

// Growth of a population over a time dt (s) in whole events, one group of particles after the other. The events of all
// are one Poisson process on a line: the expected numbers of one particle after the other. Numbers in pieces of the
// line are independent, so that only events cost random numbers, not particles.
class GrowthByEvents {
 public:
  GrowthByEvents(const SootAggregate& type, const SootMedium& medium, const SootFluxes& fluxes, double dt,
                 RandomStream& random)
      : type_(type),
        medium_(medium),
        law_(medium.growth(fluxes)),
        dt_(dt),
        random_(random),
        next_(gaps_.next(random)) {}

  // The particles that come next. `changed`: the places among them of those that had an event, ascending; who is left
  // without carbon is oxidised away.
  void grow(SootColumns& columns, std::vector<std::uint32_t>& changed);
  [[nodiscard]] const SootTransfer& moved() const { return moved_; }  // of all so far

 private:
  const SootAggregate& type_;
  const SootMedium& medium_;
  SootGrowth law_;
  double dt_;
  RandomStream& random_;
  ExponentialGaps gaps_;
  double next_;  // how far it is to the next event
  SootTransfer moved_;
};

}  // namespace lampblack::particles
