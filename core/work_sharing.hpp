// Spreads per-cell work over the ranks: items with an estimated cost are packed, sent from busy ranks to idle ones,
// advanced there and sent back. What an item computes must depend on its packed input alone, so that results do not
// depend on where it ran.
#pragma once

#include <mpi.h>

#include <functional>
#include <span>
#include <vector>

namespace lampblack {

// How much of each rank's items every other rank takes, decided alike on all ranks from everybody's cost.
struct SharingPlan {
  struct Transfer {
    int from, to;
    double cost;
  };
  std::vector<Transfer> transfers;
  double imbalanceBefore = 1.0;  // largest cost over mean cost
  double imbalancePlanned = 1.0;
};
// Greedy: the busiest rank gives its surplus over the mean to the idlest until no rank exceeds the mean by more than
// `tolerance` of it.
SharingPlan planSharing(const std::vector<double>& costOfRank, double tolerance = 0.02);

class WorkSharing {
 public:
  struct Items {
    std::vector<double> cost;   // of each item, in seconds or any common unit; zero or more
    std::size_t inputSize = 0;  // values an item, at least 1 and alike on all ranks, also where there are no items
    std::size_t outputSize = 0;
    std::function<void(std::size_t item, std::span<double> input)> pack;  // `input` comes zeroed
    // Advances one item; runs on any rank. `output` comes zeroed.
    std::function<void(std::span<const double> input, std::span<double> output)> advance;
    std::function<void(std::size_t item, std::span<const double> output)> unpack;
  };
  struct Statistics {
    double imbalanceBefore = 1.0;  // of the estimated cost
    double imbalanceAfter = 1.0;   // of the measured time spent in `advance`
    std::size_t itemsSent = 0;
  };

  explicit WorkSharing(MPI_Comm comm, bool enabled = true) : comm_(comm), enabled_(enabled) {}

  // Collective. Advances all items of all ranks. A failing item (in any of its three functions) stops every rank with
  // its message, after the communication has been completed; some items have been unpacked by then, others not.
  // std::invalid_argument on all ranks when inputSize is zero or a cost is negative or not finite.
  Statistics run(const Items& items);

 private:
  MPI_Comm comm_;
  bool enabled_;
};

}  // namespace lampblack
