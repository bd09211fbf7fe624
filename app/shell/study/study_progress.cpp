#include "app/shell/study/study_progress.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <cstdio>

#include "io/report.hpp"

namespace lampblack::app {

StudyProgress::StudyProgress(bool speaks, std::size_t runs, std::size_t own)
    : speaks_(speaks && runs > 1), runs_(runs), own_(own), begun_(MPI_Wtime()) {}

void StudyProgress::ended(bool isTaken) {
  ++done_;
  taken_ += isTaken ? 1 : 0;
  if (!speaks_ || isTaken || done_ == own_) return;
  const double pace = (MPI_Wtime() - begun_) / static_cast<double>(done_ - taken_);
  fmt::print("study: about {} of {} runs behind, to go {}\n", done_ * runs_ / own_, runs_,
             formatDuration(pace * static_cast<double>(own_ - done_)));
  std::fflush(stdout);
}

}  // namespace lampblack::app
