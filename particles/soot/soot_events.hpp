// Growth, condensation and oxidation of one soot particle, or of a part of it, in whole events: a dimer, two atoms of
// carbon by C2H2 or O2, one by OH.
#pragma once

#include <array>
#include <cstddef>

#include "core/rooms.hpp"
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

// Of one particle, or one primary: its events, one after the other. What moves is added up, times the weight.
class SootEvents {
 public:
  SootEvents(const SootMedium& medium, double least, double weight, SootMoved& sum)
      : medium_(medium), atom_(medium.carbonAtom()), least_(least), weight_(weight), sum_(sum) {}

  // kg, for as many events of a kind. False where nothing is left of it: with less carbon than the smallest nucleus it
  // is oxidised away, which is counted as `lost`.
  bool happens(std::size_t kind, double& carbon, double& hydrogen, double times = 1) {
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
  SootMoved& sum_;
};

}  // namespace lampblack::particles
