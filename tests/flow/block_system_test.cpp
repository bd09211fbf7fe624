// Linear systems of several fields in every cell.
#include "flow/steady/block_system.hpp"

#include <gtest/gtest.h>

#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// A slot of so many cells across and along.
struct BlockBox {
  BlockBox(int across, int along, MPI_Comm comm) {
    MeshSpec spec;
    spec.geometry = Geometry::Planar;
    spec.vertices = {uniformAxis(0.006, across), uniformAxis(0.012, along), {}};
    Gas& gas = Gas::hydrogen();
    const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
    std::vector<BoundaryCondition> conditions;
    for (const Side& s : {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
                          opening(BoundaryKind::Inlet, 1, false, 0.5, 300.0, air),
                          opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)}) {
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
    box.emplace(spec, conditions, std::nullopt, comm);
  }
  std::optional<Box> box;
};

constexpr std::size_t blockFields = 3;

// Diffusion by other conductances for each field, convection, and a dense block that couples them; the right side.
std::vector<double> fillSystem(const Mesh& mesh, BlockSystem& system, double conductance) {
  system.clear();
  for (int face = 0; face < mesh.faces; ++face)
    for (std::size_t k = 0; k < blockFields; ++k)
      system.connect(face, k, conductance * (1.0 + static_cast<double>(k)), mesh.normal[face][1] > 0.5 ? 0.7 : 0.0);
  std::vector<double> right(at(mesh.owned) * blockFields);
  for (int c = 0; c < mesh.owned; ++c) {
    system.addInertia(c, 0.01);
    for (std::size_t i = 0; i < blockFields; ++i) {
      for (std::size_t j = 0; j < blockFields; ++j)
        system.block(c)[j * blockFields + i] +=
            i == j ? 0.02 : 0.01 * (static_cast<double>(i) - static_cast<double>(j));
      right[at(c) * blockFields + i] =
          std::sin(300.0 * mesh.centre[c][0] + 500.0 * mesh.centre[c][1] + static_cast<double>(i));
    }
  }
  return right;
}

// What a solution lacks of the right side, written out by the faces.
double lacks(const Mesh& mesh, BlockSystem& system, double conductance, const std::vector<double>& x,
             const std::vector<double>& right) {
  std::vector<double> left = right;
  for (int c = 0; c < mesh.owned; ++c)
    for (std::size_t i = 0; i < blockFields; ++i)
      for (std::size_t j = 0; j < blockFields; ++j)
        left[at(c) * blockFields + i] -= system.block(c)[j * blockFields + i] * x[at(c) * blockFields + j];
  for (int face = 0; face < mesh.interiorFaces; ++face)
    for (std::size_t k = 0; k < blockFields; ++k) {
      const double g = conductance * (1.0 + static_cast<double>(k)), flow = mesh.normal[face][1] > 0.5 ? 0.7 : 0.0;
      const std::size_t low = at(mesh.low[face]) * blockFields + k, high = at(mesh.high[face]) * blockFields + k;
      if (mesh.low[face] < mesh.owned) left[low] += g * x[high];
      if (mesh.high[face] < mesh.owned) left[high] += (g + flow) * x[low];
    }
  double most = 0.0;
  for (const double value : left) most = std::max(most, std::abs(value));
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, mesh.comm);
  return most;
}

// Along a line of cells the factors are those of elimination, to single precision.
TEST(BlockSystems, AreEliminatedAlongALine) {
  BlockBox line(1, 40, MPI_COMM_SELF);
  const Mesh& mesh = line.box->mesh;
  BlockSystem system(mesh, line.box->halo, blockFields);
  const std::vector<double> right = fillSystem(mesh, system, 3.0);
  std::vector<double> x(at(mesh.cells) * blockFields);
  system.factorise();
  const BlockSystem::Result result = system.solve(right, x, 1e-5, 10);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_LT(lacks(mesh, system, 3.0, x, right), 1e-4);
}

// In a plane, on any number of ranks.
TEST(BlockSystems, TakeFewIterationsInAPlane) {
  BlockBox plane(24, 24, MPI_COMM_WORLD);
  const Mesh& mesh = plane.box->mesh;
  BlockSystem system(mesh, plane.box->halo, blockFields);
  const std::vector<double> right = fillSystem(mesh, system, 3.0);
  std::vector<double> x(at(mesh.cells) * blockFields);
  system.factorise();
  const BlockSystem::Result result = system.solve(right, x, 1e-6, 200);
  report(fmt::format("{} iterations", result.iterations));
  EXPECT_TRUE(result.isConverged);
  EXPECT_LT(lacks(mesh, system, 3.0, x, right), 1e-4);
  if (mesh.ranks == 1) {
    EXPECT_LE(result.iterations, 20);
  }
}

// Where iterations do not suffice, how much of the right side is left, each cell's over its diagonal; factors that keep
// none of their fill lead to the same solution, more slowly.
TEST(BlockSystems, SayWhatIsLeftAndKeepAsMuchFillAsTold) {
  BlockBox plane(16, 16, MPI_COMM_SELF);
  const Mesh& mesh = plane.box->mesh;
  BlockSystem system(mesh, plane.box->halo, blockFields);
  const std::vector<double> right = fillSystem(mesh, system, 3.0);
  std::vector<double> x(at(mesh.cells) * blockFields);
  system.factorise();
  EXPECT_EQ(system.solve(std::vector<double>(right.size(), 0.0), x, 1e-6, 200).reached, 0.0);
  const double after1 = system.solve(right, x, 1e-10, 1).reached, after4 = system.solve(right, x, 1e-10, 4).reached;
  EXPECT_GT(after1, 0.01);
  EXPECT_LT(after1, 1.0);
  EXPECT_LT(after4, 0.5 * after1);
  const int withFill = system.solve(right, x, 1e-8, 200).iterations;
  EXPECT_LE(system.solve(right, x, 1e-8, 200).reached, 1e-8);
  const std::vector<double> first = x;
  system.setKeptFill(0.0);
  EXPECT_EQ(system.keptFill(), 0.0);
  system.factorise();
  EXPECT_GT(system.solve(right, x, 1e-8, 200).iterations, withFill);
  for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(x[i], first[i], 1e-5);
}

TEST(BlockSystems, KnowTheInverseOfABlock) {
  BlockBox line(1, 3, MPI_COMM_SELF);
  BlockSystem system(line.box->mesh, line.box->halo, 2);
  system.clear();
  std::copy_n(std::vector<double>{2.0, 1.0, 3.0, -4.0}.begin(), 4, system.block(1));
  EXPECT_NEAR(system.inverseDiagonal(1, 0), 4.0 / 11.0, 1e-14);
  EXPECT_NEAR(system.inverseDiagonal(1, 1), -2.0 / 11.0, 1e-14);
  EXPECT_EQ(system.inverseDiagonal(0, 0), 0.0);
}

}  // namespace
}  // namespace lampblack::test
