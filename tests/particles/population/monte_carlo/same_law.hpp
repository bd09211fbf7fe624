// Whether two ways to compute a population have the same law, judged by the means of moments and size distribution.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "../../statistics.hpp"
#include "particles/population/population_solver.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

using MakeSolver = std::function<std::unique_ptr<PopulationSolver>(std::uint64_t repeat)>;

// M_0 to M_3 at `end` (s), then the bins; samples over repeats.
inline std::vector<Sample> outcomes(const MakeSolver& make, int repeats, double end, const std::vector<double>& edges) {
  std::vector<std::vector<double>> values(4 + (edges.empty() ? 0 : edges.size() - 1));
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto solver = make(static_cast<std::uint64_t>(repeat));
    solver->advance(end);
    std::size_t k = 0;
    for (const double x : solver->moments()) values[k++].push_back(x);
    for (const double x : solver->numberInBins(edges)) values[k++].push_back(x);
  }
  std::vector<Sample> samples;
  for (const auto& column : values) samples.push_back(summarise(column));
  return samples;
}

// The two need different seeds. The limit is for all comparisons of the project together.
inline void expectSameLaw(const std::vector<Sample>& a, const std::vector<Sample>& b, double limit = zLimit) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double error = std::hypot(a[k].standardError, b[k].standardError);
    const double scale = std::max(std::abs(a[k].mean), std::abs(b[k].mean));
    if (error <= 1e-11 * scale) {
      EXPECT_NEAR(a[k].mean, b[k].mean, 1e-10 * scale) << "quantity " << k;
    } else {
      EXPECT_LT(std::abs(a[k].mean - b[k].mean) / error, limit)
          << "quantity " << k << ": " << a[k].mean << " and " << b[k].mean;
    }
  }
}

}  // namespace lampblack::test
