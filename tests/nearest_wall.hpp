// Distances from walls against those from all faces of all walls.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/wall_distance.hpp"
#include "core/wall_tree.hpp"
#include "tests/core/mpi_support.hpp"

namespace lampblack::test {

inline std::vector<int> patchesCalled(const Mesh& mesh, const std::vector<std::string>& names) {
  std::vector<int> numbers;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    if (std::ranges::find(names, mesh.patches[p]) != names.end()) numbers.push_back(static_cast<int>(p));
  return numbers;
}

// Corners of all boundary faces of these patches of all ranks, by the face's number.
inline std::map<std::int64_t, std::vector<Vector3>> wallsOf(const Mesh& mesh, const std::vector<int>& patches) {
  std::vector<double> own;
  for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
    if (std::ranges::find(patches, mesh.patch[at(face - mesh.interiorFaces)]) == patches.end()) continue;
    const int cell = mesh.low[at(face)];
    const CellSide& side = sidesOf(mesh.shape[at(cell)])[at(mesh.lowSide[at(face)])];
    own.push_back(static_cast<double>(mesh.faceNumber[at(face)]));
    own.push_back(side.corners);
    for (int i = 0; i < 4; ++i) {
      const int corner = side.corner[at(std::min(i, side.corners - 1))];
      const Vector3& place = mesh.vertex[at(mesh.corner[at(mesh.cornerStart[at(cell)] + corner)])];
      own.insert(own.end(), place.begin(), place.end());
    }
  }
  const std::vector<double> all = gatherAll(own);
  std::map<std::int64_t, std::vector<Vector3>> walls;
  for (std::size_t i = 0; i < all.size(); i += 14) {
    std::vector<Vector3>& corners = walls[static_cast<std::int64_t>(all[i])];
    for (std::size_t k = 0; k < static_cast<std::size_t>(all[i + 1]); ++k)
      corners.push_back({all[i + 2 + 3 * k], all[i + 3 + 3 * k], all[i + 4 + 3 * k]});
  }
  return walls;
}

// Against all walls, each also moved by the shifts.
inline void expectNearestOfAll(const Mesh& mesh, const std::vector<int>& patches,
                               const std::vector<Vector3>& shifts = {{}}) {
  HaloExchange halo(mesh);
  const std::vector<double> found = wallDistance(mesh, halo, patches);
  const auto walls = wallsOf(mesh, patches);
  ASSERT_FALSE(walls.empty());
  ASSERT_EQ(found.size(), at(mesh.owned));
  int wrong = 0;
  for (int c = 0; c < mesh.owned; ++c) {
    double nearest = 1e300;
    for (const auto& [number, corners] : walls)
      for (const Vector3& shift : shifts)
        nearest = std::min(nearest, distanceToFace(sum(mesh.centre[at(c)], shift), corners));
    wrong += std::abs(found[at(c)] - nearest) <= 1e-13 ? 0 : 1;
  }
  EXPECT_EQ(sumOverRanks(wrong), 0.0) << "of " << mesh.totalCells;
}

}  // namespace lampblack::test
