// METIS partitions of grid graphs.
#include "core/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "core/errors.hpp"
#include "core/rooms.hpp"

namespace lampblack {
namespace {

struct Graph {
  std::vector<std::int64_t> start{0}, neighbours;
  [[nodiscard]] std::size_t vertices() const { return start.size() - 1; }
};

Graph grid(int columns, int rows) {
  Graph graph;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if (j > 0) graph.neighbours.push_back(i + (j - 1) * columns);
      if (i > 0) graph.neighbours.push_back(i - 1 + j * columns);
      if (i + 1 < columns) graph.neighbours.push_back(i + 1 + j * columns);
      if (j + 1 < rows) graph.neighbours.push_back(i + (j + 1) * columns);
      graph.start.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
    }
  }
  return graph;
}

std::vector<int> partition(const Graph& graph, const std::vector<double>& weight, int parts) {
  return partitionGraph(graph.start, graph.neighbours, weight, parts);
}

std::vector<double> weightOfParts(const std::vector<int>& part, const std::vector<double>& weight, int parts) {
  std::vector<double> sum(static_cast<std::size_t>(parts), 0.0);
  for (std::size_t v = 0; v < part.size(); ++v)
    sum[static_cast<std::size_t>(part[v])] += weight.empty() ? 1.0 : weight[v];
  return sum;
}

// Largest part over the mean that recursive bisection may leave: METIS allows 0.1 % a bisection (its default ufactor of
// 1), a bisection cannot split a vertex, and whole weights are rounded by at most 0.5 in 1000.
double allowedImbalance(double heaviest, double meanPart, int parts) {
  int bisections = 0;
  while ((1 << bisections) < parts) ++bisections;
  return 1.0 + bisections * (0.001 + heaviest / meanPart) + 0.001;
}

TEST(PartitionGraph, EqualWeightsGivePartsOfEqualSize) {
  const Graph graph = grid(30, 20);
  for (const int parts : {2, 3, 4, 7}) {
    const auto size = weightOfParts(partition(graph, {}, parts), {}, parts);
    const double mean = 600.0 / parts;
    EXPECT_LE(*std::max_element(size.begin(), size.end()) / mean, allowedImbalance(1.0, mean, parts))
        << parts << " parts";
  }
}

TEST(PartitionGraph, PartsBalanceWeightsNotVertices) {
  const Graph graph = grid(40, 40);
  std::vector<double> weight(graph.vertices(), 1e-4);  // seconds: any scale will do
  for (std::size_t v = 0; v < 400; ++v) weight[v] = 9e-4;
  for (const int parts : {2, 3, 4, 5}) {
    const auto part = partition(graph, weight, parts);
    const auto cost = weightOfParts(part, weight, parts);
    const double mean = std::accumulate(cost.begin(), cost.end(), 0.0) / parts;
    EXPECT_LE(*std::max_element(cost.begin(), cost.end()) / mean, allowedImbalance(9e-4, mean, parts))
        << parts << " parts";
    const auto size = weightOfParts(part, {}, parts);
    EXPECT_GT(*std::max_element(size.begin(), size.end()), 1.2 * 1600.0 / parts) << parts << " parts";
  }
}

TEST(PartitionGraph, BisectedGridIsCutNearItsShortestLine) {
  const Graph graph = grid(40, 10);
  const auto part = partition(graph, {}, 2);
  int cut = 0;
  for (std::size_t v = 0; v < graph.vertices(); ++v)
    for (auto k = graph.start[v]; k < graph.start[v + 1]; ++k)
      cut += part[v] != part[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(k)])] ? 1 : 0;
  EXPECT_LE(cut / 2, 2 * 10);  // the best cut is 10 edges; the heuristic is not held to it
}

TEST(PartitionGraph, IsDeterministic) {
  const Graph graph = grid(25, 31);
  EXPECT_EQ(partition(graph, {}, 5), partition(graph, {}, 5));
}

TEST(PartitionGraph, OnePartTakesAll) {
  EXPECT_EQ(partition(grid(3, 3), {}, 1), std::vector<int>(9, 0));
}

TEST(PartitionGraph, EveryPartGetsAVertexWhateverTheSizesAndWeights) {
  for (int columns = 1; columns <= 9; ++columns) {
    for (int rows = 1; rows <= 4; ++rows) {
      const Graph graph = grid(columns, rows);
      std::vector<double> lopsided(graph.vertices(), 1.0);
      lopsided[graph.vertices() / 2] = 1e6;
      for (int parts = 1; parts <= columns * rows; ++parts) {
        for (const auto& weight : {std::vector<double>{}, lopsided}) {
          const auto size = weightOfParts(partition(graph, weight, parts), {}, parts);
          EXPECT_GE(*std::min_element(size.begin(), size.end()), 1.0)
              << columns << " x " << rows << " in " << parts << (weight.empty() ? "" : ", lopsided");
        }
      }
    }
  }
}

TEST(PartitionGraph, FewerVerticesThanPartsIsAnInputError) {
  EXPECT_THROW(partition(grid(2, 1), {}, 3), InputError);
}

TEST(PartitionGraph, WeightsWithoutAFinitePositiveSumCountAsEqual) {
  const Graph graph = grid(12, 12);
  const auto equal = partition(graph, {}, 3);
  for (const double w : {0.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(partition(graph, std::vector<double>(graph.vertices(), w), 3), equal) << "weight " << w;
}

}  // namespace
}  // namespace lampblack
