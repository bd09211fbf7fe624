// Named stopwatches for the stages of a run, and their spread over the ranks for the closing report.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

namespace lampblack {

class Timers {
 public:
  // Adds the time until the scope ends to the stage `name` (created at first use).
  class Scope {
   public:
    Scope(Timers& timers, const char* name) : timers_(timers), stage_(timers.stage(name)), start_(MPI_Wtime()) {}
    ~Scope() { timers_.seconds_[stage_] += MPI_Wtime() - start_; }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timers& timers_;
    std::size_t stage_;
    double start_;
  };

  struct Stage {
    std::string name;
    double least, mean, most;  // s, over the ranks
  };
  // Collective. The stages of rank 0, in its order of first use; a rank that never entered one counts as zero.
  [[nodiscard]] std::vector<Stage> gather(MPI_Comm comm) const;
  // Collective: a time of each rank.
  [[nodiscard]] static Stage overRanks(MPI_Comm comm, const std::string& name, double seconds);
  [[nodiscard]] double seconds(const char* name) const;  // of this rank; zero for a stage never entered

 private:
  friend class Scope;
  std::size_t stage(const char* name);
  std::vector<std::string> names_;
  std::vector<double> seconds_;
};

}  // namespace lampblack
