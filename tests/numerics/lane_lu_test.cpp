#include "numerics/lane_lu.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "numerics/aligned_vector.hpp"
#include "numerics/lane_lu_kernel.hpp"
#include "numerics/simd_vectors.hpp"
#include "numerics/sparse_lu.hpp"

namespace {

using lampblack::numerics::AlignedVector;
using lampblack::numerics::Elimination;
using lampblack::numerics::LaneLu;
using lampblack::numerics::LaneLuWork;
using lampblack::numerics::MatrixEntry;
using lampblack::numerics::SparseLu;
using Vector =
    lampblack::numerics::Doubled<lampblack::numerics::Doubled<lampblack::numerics::PortableVector<16>>>;  // that of any
                                                                                                          // processor
using Kernel = lampblack::numerics::LaneLuKernel<Vector>;

constexpr std::size_t kLanes = Vector::lanes;

// Eight systems of one pattern: matrices by entry and lane, right-hand sides by unknown and lane.
struct Systems {
  std::size_t n, border;
  std::vector<MatrixEntry> entries;
  std::vector<double> values, right;

  // Diagonally dominant for I - matrix, apart from what a test adds.
  Systems(std::size_t unknowns, std::size_t fullOnes, double density, unsigned seed) : n(unknowns), border(fullOnes) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
        if (i == j || i >= n - border || j >= n - border || uniform(random) < 2 * density - 1)
          entries.push_back({i, j});
    const auto size = 0.9 / static_cast<double>(n);
    for (std::size_t e = 0; e < entries.size() * kLanes; ++e) values.push_back(size * uniform(random));
    for (std::size_t i = 0; i < n * kLanes; ++i) right.push_back(uniform(random));
  }
};

struct Solved {
  std::vector<double> x;
  std::vector<bool> isGood;
};

Solved inLanes(const Systems& systems, double factor) {
  const Elimination elimination(systems.n, systems.entries, systems.border);
  const LaneLu lu(elimination, kLanes);
  AlignedVector matrix(lu.numEntries() * kLanes, 0.0), lower(lu.numLower() * kLanes), upper(lu.numUpper() * kLanes),
      pivots(systems.n * kLanes), row(systems.n * kLanes), x(systems.n * kLanes), diagonal(systems.n * kLanes, 1.0),
      b(systems.right.begin(), systems.right.end());
  for (std::size_t e = 0; e < systems.entries.size(); ++e)
    std::copy_n(&systems.values[e * kLanes], kLanes,
                &matrix[lu.position(systems.entries[e].row, systems.entries[e].column)]);
  const LaneLuWork work{matrix.data(), lower.data(), upper.data(), pivots.data(), row.data(), x.data()};
  const auto quality = Kernel::factorise(lu.view(), work, Vector::all(factor), diagonal.data());
  Kernel::solve(lu.view(), work, b.data());
  Solved solved{{b.begin(), b.end()}, {}};
  AlignedVector largest(kLanes), finite(kLanes);
  Vector::store(largest.data(), quality.largestMultiplier);
  Vector::store(finite.data(), quality.finite);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    solved.isGood.push_back(largest[lane] <= SparseLu::largestMultiplier && finite[lane] == 0);
  return solved;
}

// The same of one lane by SparseLu.
Solved alone(const Systems& systems, double factor, std::size_t lane) {
  SparseLu lu(systems.n, systems.entries, systems.border);
  AlignedVector values(lu.storageSize(), 0.0);
  for (std::size_t e = 0; e < systems.entries.size(); ++e)
    values[lu.position(systems.entries[e].row, systems.entries[e].column)] = systems.values[e * kLanes + lane];
  const bool isGood = lu.factorise(values, factor, std::vector<double>(systems.n, 1.0));
  Solved solved{{}, {isGood}};
  for (std::size_t i = 0; i < systems.n; ++i) solved.x.push_back(systems.right[i * kLanes + lane]);
  if (isGood) lu.solve(solved.x.data());
  return solved;
}

// Diagonally dominant systems magnify round-off little: both ways are within some hundred of it.
TEST(LaneLu, SolvesWhatSparseLuSolves) {
  unsigned seed = 0;
  for (const std::size_t n : {1, 2, 3, 9, 20, 41})
    for (const double density : {0.0, 0.1, 0.4, 1.0}) {
      const Systems systems(n, std::min<std::size_t>(n, 2), density, ++seed);
      const Solved together = inLanes(systems, 0.7);
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Solved one = alone(systems, 0.7, lane);
        EXPECT_TRUE(together.isGood[lane]);
        for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(together.x[i * kLanes + lane], one.x[i], 1e-13);
      }
    }
}

// Matrices that want pivoting are found in their lanes, where SparseLu finds them, and the others keep every bit.
TEST(LaneLu, RefusesAMatrixInItsLaneOnly) {
  const Systems good(12, 2, 0.3, 7);
  const auto entry = static_cast<std::size_t>(
      std::ranges::find_if(good.entries, [](const auto& e) { return e.row == 4 && e.column == 4; }) -
      good.entries.begin());
  const Solved before = inLanes(good, 1.0);
  for (const double value : {1.0 - 1e-9, 1.0, std::nan("")}) {  // a pivot of 1e-9, of about zero, and none
    Systems bad = good;
    // Nothing else in its row and column but one entry each, so that elimination leaves the pivot as it is.
    for (std::size_t e = 0; e < bad.entries.size(); ++e) {
      const auto [i, j] = bad.entries[e];
      if ((i == 4) != (j == 4)) bad.values[e * kLanes + 3] = i < 10 && j < 10 ? (j == 4 ? 0.3 : 0.0) : 0.01;
    }
    bad.values[entry * kLanes + 3] = value;
    const Solved after = inLanes(bad, 1.0);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      EXPECT_EQ(after.isGood[lane], lane != 3) << value;
      if (lane == 3) continue;
      for (std::size_t i = 0; i < good.n; ++i)
        EXPECT_EQ(after.x[i * kLanes + lane], before.x[i * kLanes + lane]) << value;
    }
    EXPECT_FALSE(alone(bad, 1.0, 3).isGood[0]);
  }
}

TEST(LaneLu, AnEntryOutsideThePatternIsRefused) {
  const std::vector<MatrixEntry> entries{{0, 1}};
  const LaneLu lu(Elimination(3, entries, 0), kLanes);
  EXPECT_NO_THROW((void)lu.position(0, 1));
  EXPECT_THROW((void)lu.position(1, 0), std::logic_error);
}

}  // namespace
