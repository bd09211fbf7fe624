// No rank holds anything of the mesh as a whole: rank 3 is given a corner of a few cells, and what it takes from memory
// at once, while the mesh is set up and halos are exchanged, stays below one byte for each cell of the mesh.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <numeric>
#include <optional>

#include "core/halo_exchange.hpp"
#include "mpi_support.hpp"
#include "tests/gather.hpp"

namespace {

bool isWatching = false;
std::size_t largest = 0;

void* takeOrNull(std::size_t bytes) noexcept {
  if (isWatching && bytes > largest) largest = bytes;
  return std::malloc(bytes > 0 ? bytes : 1);
}

void* take(std::size_t bytes) {
  if (void* const memory = takeOrNull(bytes)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// What new and delete do in this program.
void* operator new(std::size_t bytes) {
  return take(bytes);
}
void* operator new[](std::size_t bytes) {
  return take(bytes);
}
// What algorithms sort and merge with.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return takeOrNull(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return takeOrNull(bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace lampblack::test {
namespace {

// Bytes: the most that `work` took at once.
template <typename Work>
std::size_t largestTaken(Work&& work) {
  largest = 0;
  isWatching = true;
  work();
  isWatching = false;
  return largest;
}

constexpr int smallRank = 3;

// A box in shares of which rank 3 has none.
struct CornerMesh {
  MeshBlock block;
  std::vector<double> weight;
};

CornerMesh cornerMesh(int dimension, int along) {
  MeshSpec spec;
  for (int axis = 0; axis < dimension; ++axis) {
    spec.vertices[at(axis)] = gradedAxis(0.0, {{1.0, along, 1.0}});
    for (const bool atMax : {false, true}) spec.patches.push_back({"surface", axis, atMax});
  }
  const MeshBlock whole = boxBlock(MPI_COMM_SELF, spec);
  const auto corners = static_cast<std::size_t>(cornersOf(whole.shapes[0]));
  const auto shareOfTotal = [](std::int64_t total) {
    const std::int64_t first = total * std::min(worldRank(), smallRank) / smallRank;
    return std::pair{first, total * std::min(worldRank() + 1, smallRank) / smallRank};
  };
  CornerMesh mesh;
  MeshBlock& block = mesh.block;
  block.dimension = dimension;
  block.patches = whole.patches;
  if (worldRank() == 0) block.named = whole.named;
  block.totalCells = whole.totalCells;
  block.totalVertices = whole.totalVertices;
  const auto [first, end] = shareOfTotal(whole.totalCells);
  block.firstCell = first;
  // The curve ends in the corner of the highest first coordinate and the lowest others: a few cells there weigh as much
  // as each of the other three ranks.
  const auto isInCorner = [&](std::size_t cell) {
    for (std::size_t c = 0; c < corners; ++c) {
      const Vector3& x = whole.vertices[static_cast<std::size_t>(whole.corners[cell * corners + c])];
      if (x[0] < 0.97 || x[1] > 0.03 || x[2] > 0.03) return false;
    }
    return true;
  };
  double inCorner = 0.0;
  for (std::size_t cell = 0; cell < whole.shapes.size(); ++cell) inCorner += isInCorner(cell) ? 1.0 : 0.0;
  for (auto cell = static_cast<std::size_t>(first); cell < static_cast<std::size_t>(end); ++cell) {
    block.shapes.push_back(whole.shapes[cell]);
    for (std::size_t c = 0; c < corners; ++c) block.corners.push_back(whole.corners[cell * corners + c]);
    mesh.weight.push_back(isInCorner(cell) ? (static_cast<double>(whole.totalCells) - inCorner) / smallRank / inCorner
                                           : 1.0);
  }
  const auto [firstVertex, endVertex] = shareOfTotal(whole.totalVertices);
  block.firstVertex = firstVertex;
  block.vertices.assign(whole.vertices.begin() + firstVertex, whole.vertices.begin() + endVertex);
  return mesh;
}

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
    mesh.emplace(MPI_COMM_WORLD, std::move(made.block), Geometry::Planar, made.weight);
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
  const Mesh mesh(MPI_COMM_WORLD, std::move(made.block), Geometry::Planar, made.weight);
  const std::vector<double> values(at(mesh.cells), 1.0);
  EXPECT_GE(largestTaken([&] { static_cast<void>(gatherNatural(mesh, values, 1)); }),
            at(static_cast<int>(mesh.totalCells)));
}

}  // namespace
}  // namespace lampblack::test
