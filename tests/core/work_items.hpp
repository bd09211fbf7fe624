// A bag of work items for the tests of work sharing: what an item computes depends on its identity alone. Items have
// payloads of different lengths, some of no results.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/work_sharing.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

class Bag {
 public:
  // `counts`: items of each rank, item i of a rank costing 1 + i % spread.
  explicit Bag(const std::vector<int>& counts, int spread = 1, std::size_t leastInput = 2) {
    int first = 0;
    for (int r = 0; r < worldRank(); ++r) first += counts[at(r)];
    const int own = counts[at(worldRank())];
    results.assign(at(own), 0.0);
    unpacked.assign(at(own), 0);
    for (int i = 0; i < own; ++i) items.cost.push_back(1.0 + i % spread);
    items.pack = [this, first, leastInput](std::size_t item, std::vector<double>& input) {
      input.push_back(static_cast<double>(item) + first);  // identity in all ranks together
      input.resize(leastInput - 1 + item % 5, 0.25);
      input.push_back(items.cost[item]);
    };
    items.advance = [this](std::span<const double> input, std::vector<double>& output) {
      ++advanced;
      workDone += input.back();
      double x = 0.1 + 0.8 / (1.0 + input.front());
      for (int i = 0; i < 50; ++i) x = 3.9 * x * (1.0 - x);  // chaotic: the last bit shows
      const auto identity = static_cast<std::size_t>(input.front());
      for (std::size_t i = 0; i < identity % 4; ++i) output.push_back(x + static_cast<double>(input.size()));
    };
    items.unpack = [this, first](std::size_t item, std::span<const double> output) {
      const auto identity = item + static_cast<std::size_t>(first);
      if (output.size() != identity % 4) throw std::logic_error("an item got another's results");
      for (const double value : output) results[item] += value;
      ++unpacked[item];
    };
  }
  Bag(const Bag&) = delete;
  Bag& operator=(const Bag&) = delete;

  WorkSharing::Items items;
  std::vector<double> results;
  std::vector<int> unpacked;
  int advanced = 0;       // items this rank advanced, its own or others'
  double workDone = 0.0;  // their cost
};

// All items on rank `busy`, none elsewhere.
inline std::vector<int> allOn(int busy, int count) {
  std::vector<int> counts(at(worldSize()), 0);
  counts[at(busy)] = count;
  return counts;
}

// Ever fewer items on higher ranks.
inline std::vector<int> skewed() {
  std::vector<int> counts;
  for (int r = 0; r < worldSize(); ++r) counts.push_back(120 / (1 + r * r * 5) + 3);
  return counts;
}

inline int total(const std::vector<int>& counts) {
  int sum = 0;
  for (int c : counts) sum += c;
  return sum;
}

}  // namespace lampblack::test
