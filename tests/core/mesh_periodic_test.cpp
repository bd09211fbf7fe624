// Meshes whose ends are one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/errors.hpp"
#include "core/grading.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

MeshSpec periodicBox(std::array<bool, 3> periodic) {
  MeshSpec spec;
  spec.vertices = {gradedAxis(0.0, {{3.0, 7, 2.0}}), gradedAxis(0.0, {{1.0, 5, 0.5}})};
  spec.periodic = periodic;
  for (int axis = 0; axis < 2; ++axis)
    for (const bool atMax : {false, true})
      if (!periodic[at(axis)]) spec.patches.push_back({"side", axis, atMax});
  return spec;
}

TEST(PeriodicMesh, LinksTheCellsAtItsEnds) {
  for (const auto& periodic :
       {std::array{true, false, false}, std::array{false, true, false}, std::array{true, true, false}}) {
    const Mesh mesh(MPI_COMM_WORLD, periodicBox(periodic));
    EXPECT_EQ(sumOverRanks(mesh.owned), 35.0);
    EXPECT_EQ(sumOverRanks(mesh.boundaryFaces()), (periodic[0] ? 0.0 : 10.0) + (periodic[1] ? 0.0 : 14.0));
    double around = 0.0;
    for (int f = 0; f < mesh.interiorFaces; ++f) {
      const int low = mesh.low[at(f)], high = mesh.high[at(f)], axis = axisOf(mesh, f);
      const std::int64_t stride = axis == 0 ? 1 : 7, cells = axis == 0 ? 7 : 5;
      const auto& x = mesh.box->vertices[at(axis)];
      EXPECT_EQ(signOf(mesh, f), 1.0);
      const std::int64_t step = mesh.naturalCell[at(high)] - mesh.naturalCell[at(low)];
      const double lowWidth = 2.0 * (mesh.faceCentre[at(f)][at(axis)] - mesh.centre[at(low)][at(axis)]);
      EXPECT_GT(lowWidth, 0.0);
      if (step == stride) {
        EXPECT_NEAR(mesh.distance[at(f)], mesh.centre[at(high)][at(axis)] - mesh.centre[at(low)][at(axis)], 1e-14);
        continue;
      }
      EXPECT_EQ(step, -stride * (cells - 1));
      EXPECT_EQ(mesh.faceCentre[at(f)][at(axis)], x.back());
      const double highWidth = x[1] - x[0];
      EXPECT_NEAR(mesh.distance[at(f)], 0.5 * (lowWidth + highWidth), 1e-14);
      EXPECT_NEAR(mesh.lowWeight[at(f)], highWidth / (lowWidth + highWidth), 1e-14);
      around += low < mesh.owned && high < mesh.owned ? 1.0 : 0.5;
    }
    EXPECT_EQ(sumOverRanks(around), (periodic[0] ? 5.0 : 0.0) + (periodic[1] ? 7.0 : 0.0));
    for (int c = 0; c < mesh.owned; ++c) EXPECT_EQ(mesh.faceStart[at(c) + 1] - mesh.faceStart[at(c)], 4);
    const auto& numbers = mesh.faceNumber;
    EXPECT_EQ(std::set<std::int64_t>(numbers.begin(), numbers.end()).size(), numbers.size());
  }
}

TEST(PeriodicMesh, NeedsThreeCellsAndNoRadius) {
  MeshSpec thin = periodicBox({true, false, false});
  thin.vertices[0] = {0.0, 1.0, 2.0};
  EXPECT_THROW(Mesh(MPI_COMM_WORLD, thin), InputError);
  MeshSpec round = periodicBox({true, false, false});
  round.geometry = Geometry::Axisymmetric;
  EXPECT_THROW(Mesh(MPI_COMM_WORLD, round), InputError);
}

}  // namespace
}  // namespace lampblack::test
