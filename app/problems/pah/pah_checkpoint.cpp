#include "app/problems/pah/pah_checkpoint.hpp"

#include <fmt/format.h>

#include "app/run/content_hash.hpp"
#include "core/errors.hpp"

namespace lampblack::app {
namespace {

std::string cellsText(const std::vector<LatticeCell>& cells) {
  std::string text;
  for (const LatticeCell& cell : cells) text += fmt::format("({}, {})", cell.q, cell.r);
  return text;
}

// Both ways; all ranks learn how many are done.
void saveOrLoad(StateArchive& archive, int rank, PahProgress& progress) {
  archive.shared("repeats", progress.done);
  progress.sums.saveOrLoad(archive, rank);
}

}  // namespace

Fingerprint pahFingerprint(const PahCase& pah) {
  ContentHash molecule, growth, closure;
  if (pah.closure)
    for (const std::uint64_t number : pah.closure->numbers()) closure.add(fmt::format("{} ", number));
  molecule.add(cellsText(pah.rings) + "|" + cellsText(pah.fiveRings));
  for (const GrowthInterval& interval : pah.growth.intervals) {
    growth.add(fmt::format("{} ", interval.duration));
    for (const double rate : interval.rates) growth.add(fmt::format("{} ", rate));
  }
  for (const std::size_t record : pah.growth.records) growth.add(fmt::format("{} ", record));
  for (const std::size_t row : pah.spectra) growth.add(fmt::format("{} ", row));
  return {{"problem", "pah"},
          {"molecule", fmt::format("{} rings, {}", pah.rings.size() + pah.fiveRings.size(), molecule.text())},
          {"gas, rates or rows", growth.text()},
          {"description, closure", pah.closure ? closure.text() : "lattice"},
          {"limit of rings", fmt::format("{}", pah.mostRings)},
          {"seed", fmt::format("{}", pah.seed)}};
}

ArchiveOwners pahOwners(MPI_Comm comm, PahProgress& progress) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return [rank, &progress](StateArchive& archive) { saveOrLoad(archive, rank, progress); };
}

PahProgress loadPahProgress(MPI_Comm comm, const WholeCheckpoint& checkpoint, const PahCase& pah) {
  PahProgress progress{0, GrowthSums(pah.recorded.size())};
  loadProgress(comm, checkpoint, pahFingerprint(pah), pahOwners(comm, progress));
  if (progress.done > pah.repeats)
    throw InputError(fmt::format("{}: this checkpoint has {} molecules, more than 'repeats: {}'",
                                 checkpoint.file.string(), progress.done, pah.repeats));
  return progress;
}

}  // namespace lampblack::app
