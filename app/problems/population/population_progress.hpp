// How far the repeats of a population have come: a line now and then from rank 0, of its own share of them.
#pragma once

#include <mpi.h>

#include <cstdint>

#include "app/problems/population/population_case.hpp"
#include "core/modules.hpp"
#include "io/progress.hpp"

namespace lampblack::app {

class PopulationProgress {
 public:
  PopulationProgress(MPI_Comm comm, const PopulationCase& populationCase);

  // Where a repeat is, at a time in s.
  void at(const PopulationMethod& method, std::uint64_t repeat, double time);
  void repeatEnded() { ++ended_; }
  // Before other output.
  void finish() { progress_.finish(); }

 private:
  const PopulationCase& case_;
  Progress progress_;
  std::uint64_t ended_ = 0;  // repeats of this rank
};

}  // namespace lampblack::app
