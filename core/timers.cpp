#include "core/timers.hpp"

#include <algorithm>

namespace lampblack {

std::size_t Timers::stage(const char* name) {
  const auto it = std::find(names_.begin(), names_.end(), name);
  if (it != names_.end()) return static_cast<std::size_t>(it - names_.begin());
  names_.emplace_back(name);
  seconds_.push_back(0.0);
  return names_.size() - 1;
}

double Timers::seconds(const char* name) const {
  const auto it = std::find(names_.begin(), names_.end(), name);
  return it == names_.end() ? 0.0 : seconds_[static_cast<std::size_t>(it - names_.begin())];
}

Timers::Stage Timers::overRanks(MPI_Comm comm, const std::string& name, double seconds) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  Stage stage{name, seconds, seconds, seconds};
  MPI_Allreduce(&seconds, &stage.least, 1, MPI_DOUBLE, MPI_MIN, comm);
  MPI_Allreduce(&seconds, &stage.mean, 1, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(&seconds, &stage.most, 1, MPI_DOUBLE, MPI_MAX, comm);
  stage.mean /= ranks;
  return stage;
}

std::vector<Timers::Stage> Timers::gather(MPI_Comm comm) const {
  // Ranks may have met the stages in another order, or not all of them: rank 0 lists them, each ended by a zero.
  std::string list;
  for (const std::string& name : names_) list.append(name).push_back('\0');
  int length = static_cast<int>(list.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, comm);
  list.resize(static_cast<std::size_t>(length));
  MPI_Bcast(list.data(), length, MPI_CHAR, 0, comm);

  std::vector<Stage> stages;
  for (std::size_t start = 0; start < list.size(); start += stages.back().name.size() + 1) {
    const char* name = list.c_str() + start;
    stages.push_back(overRanks(comm, name, seconds(name)));
  }
  return stages;
}

}  // namespace lampblack
