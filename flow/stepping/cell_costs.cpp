#include "flow/stepping/cell_costs.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace lampblack::flow {
namespace {

constexpr std::int64_t averagedSteps = 20;  // one that lies so far back counts 1/e

}  // namespace

CellCosts::CellCosts(const Mesh& mesh)
    : average_(mesh.owned),
      present_(static_cast<std::size_t>(mesh.owned), 1.0),
      ranks_(mesh.ranks),
      patience_(averagedSteps) {}

void CellCosts::addStep(const Mesh& mesh, std::span<Operator* const> operators) {
  CellCost step(mesh.owned);
  for (const Operator* op : operators) op->addCost(mesh, step);
  ++steps_;
  const double part = 1.0 / static_cast<double>(std::min(steps_, averagedSteps));
  const auto add = [part](std::vector<double>& mean, const std::vector<double>& last) {
    for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += part * (last[c] - mean[c]);
  };
  add(average_.own, step.own);
  add(average_.shared, step.shared);
}

void CellCosts::adopt(int ranks, std::vector<double> weights) {
  present_ = std::move(weights);
  ranks_ = ranks;
}

void CellCosts::recordRepartition(bool hasHelped) {
  lastTry_ = steps_;
  if (hasHelped) ++partitions_;
  patience_ = hasHelped ? averagedSteps : 2 * patience_;
}

void CellCosts::saveOrLoad(StateArchive& archive) {
  archive.cells("cell_cost_own", average_.own, 1);
  archive.cells("cell_cost_shared", average_.shared, 1);
  archive.cells("partition_weight", present_, 1);
  std::vector<double> numbers{static_cast<double>(ranks_), static_cast<double>(steps_), static_cast<double>(lastTry_),
                              static_cast<double>(patience_), static_cast<double>(partitions_)};
  archive.shared("partition", numbers);
  ranks_ = static_cast<int>(numbers.at(0));
  for (std::size_t i = 0; std::int64_t * number : {&steps_, &lastTry_, &patience_, &partitions_})
    *number = static_cast<std::int64_t>(numbers.at(++i));
}

double imbalanceOf(MPI_Comm comm, const CellCost& cost) {
  const auto sumOf = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  double most = sumOf(cost.own);
  std::array<double, 2> means{most, sumOf(cost.shared)};
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, comm);
  MPI_Allreduce(MPI_IN_PLACE, means.data(), 2, MPI_DOUBLE, MPI_SUM, comm);
  for (double& mean : means) mean /= ranks;
  const double mean = means[0] + means[1];
  return mean > 0.0 ? (most + means[1]) / mean : 1.0;
}

bool areEven(MPI_Comm comm, std::span<const double> weights) {
  std::array<double, 2> most{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double weight : weights) most = {std::max(most[0], weight), std::max(most[1], -weight)};
  MPI_Allreduce(MPI_IN_PLACE, most.data(), 2, MPI_DOUBLE, MPI_MAX, comm);
  return most[0] == -most[1];
}

}  // namespace lampblack::flow
