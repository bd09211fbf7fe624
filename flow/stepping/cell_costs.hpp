// What the cells of a flow cost, on average over steps, and what the partition of the mesh makes of it. Costs are
// counted (Operator::addCost), so that partitions, and with them results to the last bit, are the same in every run.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/operator.hpp"

namespace lampblack::flow {

class CellCosts {
 public:
  explicit CellCosts(const Mesh& mesh);

  // The operators have made a step.
  void addStep(const Mesh& mesh, std::span<Operator* const> operators);
  [[nodiscard]] const CellCost& average() const { return average_; }

  // What a partition has to balance, of each owned cell: what costs its owner. What work sharing spreads counts
  // nothing, for it is even already, and a partition by it would leave the transport uneven.
  [[nodiscard]] const std::vector<double>& weights() const { return average_.own; }
  // What the present partition has balanced, and among how many ranks.
  [[nodiscard]] const std::vector<double>& present() const { return present_; }
  [[nodiscard]] int ranks() const { return ranks_; }
  // The mesh is now partitioned among so many ranks, by these weights of its owned cells.
  void adopt(int ranks, std::vector<double> weights);

  // Whether it is time to look at the imbalance: some steps after the last partition, or after one that would not have
  // helped, more and more of them then.
  [[nodiscard]] bool isDue() const { return steps_ - lastTry_ >= patience_; }
  void recordRepartition(bool hasHelped);
  [[nodiscard]] std::int64_t partitions() const { return partitions_; }  // since the run's start

  void saveOrLoad(StateArchive& archive);

 private:
  CellCost average_;
  std::vector<double> present_;
  int ranks_;
  std::int64_t steps_ = 0, lastTry_ = 0, patience_, partitions_ = 0;
};

// Collective. The busiest rank's cost over the mean, with what is shared spread evenly.
[[nodiscard]] double imbalanceOf(MPI_Comm comm, const CellCost& cost);

// Collective. Whether all cells of all ranks have the same weight.
[[nodiscard]] bool areEven(MPI_Comm comm, std::span<const double> weights);

}  // namespace lampblack::flow
