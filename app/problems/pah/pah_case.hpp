// What a deck with `problem: pah` asks for: a molecule, the gas it grows in, rates, how often, and what is written.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/deck/checkpoint_deck.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/gas/gas_path.hpp"
#include "particles/pah/growth_path.hpp"
#include "particles/pah/molecule.hpp"
#include "particles/pah/site_closure.hpp"

namespace lampblack::app {

class PreparedRun;

struct PahCase {
  std::string title;
  std::vector<LatticeCell> rings, fiveRings;  // of the molecule at the start
  std::size_t mostRings = 0;                  // a molecule with more has left
  ParticlePath path;
  std::vector<std::size_t> recorded;  // points of the path with a row
  std::vector<std::size_t> spectra;   // rows with a mass spectrum, the last one among them
  GrowthPath growth;
  PahRateConstants constants;
  std::uint64_t repeats = 0, seed = 0;
  std::shared_ptr<const SiteClosure> closure = {};  // where sites are counted
  bool writesClosure = false;
  std::size_t drawn = 0;  // molecules whose cells are written
  CheckpointTimes checkpoints;

  [[nodiscard]] Molecule start() const { return Molecule(rings, fiveRings); }
  [[nodiscard]] double timeOf(std::size_t row) const { return path.points[recorded[row]].time; }
};

// All keys such a deck may have.
DeckSchema pahSchema();

// InputError, pointing into the deck.
PahCase readPahCase(const Deck& deck);

// Collective; see Problem. Molecules are spread over the ranks.
std::unique_ptr<PreparedRun> preparePah(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
