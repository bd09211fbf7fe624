// A molecule as a jump process on the numbers of its sites (ARS-SC): rates as of the lattice (MoleculeGrowth), numbers
// of combined sites and neighbours by a closure. An event that lacks a neighbour is refused: it is counted, and nothing
// changes. docs/theory/site_counting.md.
#pragma once

#include <cstdint>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/pah/molecule_growth.hpp"
#include "particles/pah/pah_rates.hpp"
#include "particles/pah/site_closure.hpp"
#include "particles/pah/site_counts.hpp"

namespace lampblack::particles {

class SiteCounting {
 public:
  // Keeps a reference to the closure, which is prepared.
  SiteCounting(const SiteCounts& start, const SiteClosure& closure, RandomStream random,
               std::size_t mostRings = MoleculeGrowth::noLimit)
      : counts_(start), closure_(closure), random_(random), mostRings_(mostRings) {}

  // As MoleculeGrowth::advance().
  double advance(const PahRates& rates, double duration, std::uint64_t mostEvents);

  [[nodiscard]] const SiteCounts& counts() const { return counts_; }
  [[nodiscard]] bool hasLeft() const { return static_cast<std::size_t>(counts_.rings()) > mostRings_; }
  // By process: what happened, and what was refused.
  [[nodiscard]] const MoleculeEvents::Counts& events() const { return events_.happened; }
  [[nodiscard]] const MoleculeEvents::Counts& voids() const { return events_.voids; }

 private:
  bool happen(PahProcess process, std::size_t sizeClass);

  SiteCounts counts_;
  const SiteClosure& closure_;
  RandomStream random_;
  std::size_t mostRings_;
  MoleculeEvents events_;
};

}  // namespace lampblack::particles
