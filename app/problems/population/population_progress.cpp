#include "app/problems/population/population_progress.hpp"

#include <fmt/format.h>

#include "app/run/warnings.hpp"

namespace lampblack::app {
namespace {

// Repeats of a rank, which share them evenly.
double shareOf(MPI_Comm comm, const PopulationCase& populationCase) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  double all = 0;
  for (const PopulationMethod& method : populationCase.methods)
    all += method.deterministic() ? 1.0 : static_cast<double>(populationCase.repeats);
  return all / ranks;
}

}  // namespace

PopulationProgress::PopulationProgress(MPI_Comm comm, const PopulationCase& populationCase)
    : case_(populationCase), progress_(comm, 0, shareOf(comm, populationCase), Progress::logInterval) {}

void PopulationProgress::at(const PopulationMethod& method, std::uint64_t repeat, double time) {
  if (!progress_.due()) return;
  const std::uint64_t repeats = method.deterministic() ? 1 : case_.repeats;
  progress_.say(fmt::format("{}, repeat {} of {}, t {:.4g} s", method.name, repeat + 1, repeats, time),
                static_cast<double>(ended_) + time / case_.times.end);
}

PopulationStatistics runAndTell(MPI_Comm comm, const PopulationCase& populationCase) {
  PopulationProgress progress(comm, populationCase);
  PopulationStatistics statistics = runPopulation(comm, populationCase, progress);
  progress.finish();
  if (!statistics.exact.limit.empty()) printWarnings({statistics.exact.limit});
  return statistics;
}

}  // namespace lampblack::app
