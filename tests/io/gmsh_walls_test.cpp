// Distances from walls on a mesh of another program: triangles around two lips.
#include <gtest/gtest.h>

#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "io/gmsh_reader.hpp"
#include "tests/nearest_wall.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::io {
namespace {

TEST(WallDistanceOfGmsh, IsThatFromTheNearestOfAllFaces) {
  const Mesh mesh(MPI_COMM_WORLD,
                  readGmsh(MPI_COMM_WORLD, test::sourcePath("cases/flow/burner_two_lips/burner.msh"), 1e-3),
                  Geometry::Axisymmetric);
  test::expectNearestOfAll(mesh, test::patchesCalled(mesh, {"fuel_tube", "air_tube"}));
  test::expectNearestOfAll(mesh, test::patchesCalled(mesh, {"air_tube", "side"}));
}

}  // namespace
}  // namespace lampblack::io
