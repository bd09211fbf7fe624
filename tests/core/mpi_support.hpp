// What the MPI tests of core share: reductions and a mesh whose every metric is known.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/grading.hpp"
#include "core/mesh.hpp"
#include "core/shares.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"
#include "tests/world.hpp"

namespace lampblack::test {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

inline double sumOverRanks(double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return value;
}

inline double maxOverRanks(double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return value;
}

// All ranks' bytes, rank after rank, on every rank.
template <typename T>
std::vector<T> gatherAll(const std::vector<T>& own) {
  const auto ranks = static_cast<std::size_t>(worldSize());
  const int bytes = static_cast<int>(own.size() * sizeof(T));
  std::vector<int> count(ranks);
  MPI_Allgather(&bytes, 1, MPI_INT, count.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::vector<int> start(ranks + 1, 0);
  for (std::size_t r = 0; r < ranks; ++r) start[r + 1] = start[r] + count[r];
  std::vector<T> all(static_cast<std::size_t>(start.back()) / sizeof(T));
  MPI_Allgatherv(own.data(), bytes, MPI_BYTE, all.data(), count.data(), start.data(), MPI_BYTE, MPI_COMM_WORLD);
  return all;
}

// True on all ranks when all ranks have the same text.
inline bool sameOnAllRanks(const std::string& text) {
  const auto all = gatherAll(std::vector<char>(text.begin(), text.end()));
  std::string repeated;
  for (int r = 0; r < worldSize(); ++r) repeated += text;
  return maxOverRanks(std::string(all.begin(), all.end()) == repeated ? 0.0 : 1.0) == 0.0;
}

// 15 x 11 cells graded along both axes, from 0 to 0.02 m along the first (from the axis, when axisymmetric) and from
// -0.01 to 0.03 m along the second; the low end of the second axis is split into two patches at 0.01 m.
inline MeshSpec gradedBox(Geometry geometry) {
  MeshSpec spec;
  spec.geometry = geometry;
  spec.vertices = {gradedAxis(0.0, {{0.01, 9, 3.0}, {0.02, 6, 0.5}}), gradedAxis(-0.01, {{0.03, 11, 0.25}})};
  spec.patches = {{"fuel", 1, false, -1.0, 0.01},
                  {"coflow", 1, false},
                  {"outlet", 1, true},
                  {"inner", 0, false},
                  {"outer", 0, true}};
  return spec;
}

// Unit cells, one patch a side.
inline MeshSpec unitBox(int columns, int rows) {
  MeshSpec spec;
  spec.vertices = {gradedAxis(0.0, {{static_cast<double>(columns), columns, 1.0}}),
                   gradedAxis(0.0, {{static_cast<double>(rows), rows, 1.0}})};
  spec.patches = {{"left", 0, false}, {"right", 0, true}, {"bottom", 1, false}, {"top", 1, true}};
  return spec;
}

// The axis that a face of a box is normal to, and the direction along it.
inline int axisOf(const Mesh& mesh, int face) {
  const Vector3& n = mesh.normal[static_cast<std::size_t>(face)];
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(n[static_cast<std::size_t>(axis)]) == 1.0) return axis;
  return -1;
}
inline double signOf(const Mesh& mesh, int face) {
  return mesh.normal[static_cast<std::size_t>(face)][static_cast<std::size_t>(axisOf(mesh, face))];
}

// Of values of all cells those of this rank's share of a box that is not made yet.
inline std::vector<double> shareOf(const std::vector<double>& all) {
  const Shares shares(static_cast<std::int64_t>(all.size()), worldSize());
  const auto first = all.begin() + shares.first(worldRank());
  return {first, first + shares.count(worldRank())};
}

inline std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace lampblack::test
