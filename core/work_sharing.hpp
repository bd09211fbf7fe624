// Spreads work over the ranks: items with an estimated cost (the chemistry of a cell, an ensemble of particles) are
// packed, sent from busy ranks to idle ones, advanced there and sent back. What an item computes must depend on its
// packed input alone, so that results do not depend on where it ran.
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
    std::vector<double> cost;  // of each item, in seconds or any common unit; zero or more
    // Appends what the item needs to `input`, which comes empty: as many values as it likes, and other items others.
    std::function<void(std::size_t item, std::vector<double>& input)> pack;
    // Advances one item and appends to `output`, which comes empty; runs on any rank.
    std::function<void(std::span<const double> input, std::vector<double>& output)> advance;
    // Where it is set, it is called instead of `advance`, with up to groupSize items at a time: an input and an output
    // each. Which items share a group must not show in what they compute.
    std::size_t groupSize = 1;
    std::function<void(std::span<const std::span<const double>> inputs, std::span<std::vector<double>> outputs)>
        advanceGroup;
    std::function<void(std::size_t item, std::span<const double> output)> unpack;
    // What advancing an item has cost, in the unit of `cost`, as its output tells. Not set: seconds are measured.
    std::function<double(std::span<const double> output)> work;
  };
  struct Statistics {
    double imbalanceBefore = 1.0;  // of the estimated cost
    double imbalanceAfter = 1.0;   // of Items::work of what each rank has advanced, or of the time that took
    std::size_t itemsSent = 0;
  };

  explicit WorkSharing(MPI_Comm comm, bool enabled = true) : comm_(comm), enabled_(enabled) {}

  // Collective. Advances all items of all ranks. A failing item (in any of its functions) stops every rank with
  // its message, after the communication has been completed; some items have been unpacked by then, others not.
  // std::invalid_argument on all ranks when a cost is negative or not finite.
  Statistics run(const Items& items);

 private:
  MPI_Comm comm_;
  bool enabled_;
};

}  // namespace lampblack
