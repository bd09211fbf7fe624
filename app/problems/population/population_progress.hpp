// How far the repeats of a population have come: a line now and then from rank 0, of its own share of them.
#pragma once

#include <mpi.h>

#include <cstdint>

#include "core/modules.hpp"
#include "io/progress.hpp"
#include "particles/population/comparison/comparison.hpp"

namespace lampblack::app {

class PopulationProgress : public RepeatProgress {
 public:
  PopulationProgress(MPI_Comm comm, const PopulationCase& populationCase);

  void at(const PopulationMethod& method, std::uint64_t repeat, double time) override;
  void repeatEnded() override { ++ended_; }
  // Before other output.
  void finish() { progress_.finish(); }

 private:
  const PopulationCase& case_;
  Progress progress_;
  std::uint64_t ended_ = 0;  // repeats of this rank
};

// Collective: runPopulation() that says how far it is, and warns of what is not compared.
PopulationStatistics runAndTell(MPI_Comm comm, const PopulationCase& populationCase);

}  // namespace lampblack::app
