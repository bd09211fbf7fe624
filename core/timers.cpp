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

double Timers::seconds(const char* name) { return seconds_[stage(name)]; }

std::vector<Timers::Stage> Timers::gather(MPI_Comm comm) const {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const int count = static_cast<int>(seconds_.size());
  std::vector<double> least(seconds_.size());
  std::vector<double> sum(seconds_.size());
  std::vector<double> most(seconds_.size());
  MPI_Allreduce(seconds_.data(), least.data(), count, MPI_DOUBLE, MPI_MIN, comm);
  MPI_Allreduce(seconds_.data(), sum.data(), count, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(seconds_.data(), most.data(), count, MPI_DOUBLE, MPI_MAX, comm);
  std::vector<Stage> stages;
  for (std::size_t i = 0; i < seconds_.size(); ++i) stages.push_back({names_[i], least[i], sum[i] / ranks, most[i]});
  return stages;
}

}  // namespace lampblack
