// A molecule as a jump process: the waiting time is exponential with the sum of the rates of all sites; the process is
// drawn by its rate, the site evenly among those of its group. An event at a site where another ring is in the way is
// void: it is counted, and nothing changes. docs/theory/pah.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/pah/molecule.hpp"
#include "particles/pah/pah_rates.hpp"

namespace lampblack::particles {

// By process: what happened, and what was void.
struct MoleculeEvents {
  using Counts = std::array<std::uint64_t, pahProcessCount>;
  Counts happened{}, voids{};
};

// 1/s, of all that may happen to a molecule.
[[nodiscard]] double totalRate(const Molecule& molecule, const PahRates& rates);
// One jump, of a molecule with a rate above zero. NumericsError where it outgrows its lattice.
void jump(Molecule& molecule, const PahRates& rates, RandomStream& random, MoleculeEvents& events);

class MoleculeGrowth {
 public:
  using Counts = MoleculeEvents::Counts;
  static constexpr std::size_t noLimit = std::numeric_limits<std::size_t>::max();

  // A molecule of more rings than `mostRings` has left: nothing happens to it any more.
  MoleculeGrowth(Molecule start, RandomStream random, std::size_t mostRings = noLimit)
      : molecule_(std::move(start)), random_(random), mostRings_(mostRings) {}

  // Over a time (s) with rates that stay as they are, for so many events at most: returns the time that is left over,
  // zero but where these were not enough. NumericsError where the molecule outgrows its lattice.
  double advance(const PahRates& rates, double duration, std::uint64_t mostEvents);

  [[nodiscard]] const Molecule& molecule() const { return molecule_; }
  [[nodiscard]] bool hasLeft() const { return molecule_.rings() > mostRings_; }
  // By process: what happened, and what was void.
  [[nodiscard]] const Counts& events() const { return events_.happened; }
  [[nodiscard]] const Counts& voids() const { return events_.voids; }

 private:
  Molecule molecule_;
  RandomStream random_;
  std::size_t mostRings_;
  MoleculeEvents events_;
};

}  // namespace lampblack::particles
