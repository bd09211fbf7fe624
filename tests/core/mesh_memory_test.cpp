// No rank holds anything of the mesh as a whole: rank 3 is given a corner of a few cells, and what it takes from memory
// at once, while the mesh is set up and halos are exchanged, stays below one byte for each cell of the mesh.
#include <gtest/gtest.h>

#include <optional>

#include "core/halo_exchange.hpp"
#include "mpi_support.hpp"
#include "tests/corner_mesh.hpp"
#include "tests/gather.hpp"
#include "tests/watched_memory.hpp"

namespace lampblack::test {
namespace {

class MeshMemory : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  CornerMesh made = cornerMesh(GetParam().first, GetParam().second);
};

INSTANTIATE_TEST_SUITE_P(PlaneAndSpace, MeshMemory, testing::Values(std::pair{2, 200}, std::pair{3, 60}));

TEST_P(MeshMemory, ARankTakesNothingOfTheSizeOfTheMesh) {
  ASSERT_EQ(worldSize(), smallRank + 1);
  std::optional<Mesh> mesh;
  std::optional<HaloExchange> halo;
  const std::size_t taken = largestTaken([&] {
    mesh.emplace(MPI_COMM_WORLD, std::move(made.block), Geometry::Planar, Partition{.weight = made.weight});
    halo.emplace(*mesh);
    std::vector<double> values(5 * at(mesh->cells), 1.0);
    halo->update(values, 5);
  });
  const auto bound = static_cast<std::size_t>(mesh->totalCells);
  if (worldRank() == smallRank) {
    EXPECT_LT(mesh->cells, mesh->totalCells / 300);
    EXPECT_LT(taken, bound);
  } else {
    EXPECT_GE(taken, bound);  // ranks that have a third of the cells: the watch works
  }
}

TEST_P(MeshMemory, AGatheredFieldWouldBeNoticed) {
  const Mesh mesh(MPI_COMM_WORLD, std::move(made.block), Geometry::Planar, {.weight = made.weight});
  const std::vector<double> values(at(mesh.cells), 1.0);
  EXPECT_GE(largestTaken([&] { static_cast<void>(gatherNatural(mesh, values, 1)); }),
            at(static_cast<int>(mesh.totalCells)));
}

}  // namespace
}  // namespace lampblack::test
