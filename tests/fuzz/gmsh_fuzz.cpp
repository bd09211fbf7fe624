// A mesh file of Gmsh is read or refused with InputError; nothing else. What is read is a mesh: every cell and every
// face has vertices that are there, every face a patch. How much is read at once depends on the input's length.
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "core/errors.hpp"
#include "io/gmsh_reader.hpp"
#include "tests/every_module.hpp"
#include "tests/scratch.hpp"

namespace {

struct MpiForFuzzing {
  MpiForFuzzing() { MPI_Init(nullptr, nullptr); }
  ~MpiForFuzzing() { MPI_Finalize(); }
};

void require(bool sound, const char* what) {
  if (!sound) throw std::runtime_error(what);
}

void check(const lampblack::MeshBlock& mesh) {
  const auto isVertex = [&](std::int64_t number) { return number >= 0 && number < mesh.totalVertices; };
  std::size_t corners = 0;
  for (const lampblack::CellShape shape : mesh.shapes) corners += static_cast<std::size_t>(cornersOf(shape));
  require(!mesh.shapes.empty() && static_cast<std::int64_t>(mesh.shapes.size()) == mesh.totalCells,
          "cells are missing");
  require(static_cast<std::int64_t>(mesh.vertices.size()) == mesh.totalVertices, "vertices are missing");
  require(corners == mesh.corners.size() && std::all_of(mesh.corners.begin(), mesh.corners.end(), isVertex),
          "a cell has a corner that is no vertex");
  for (const auto& x : mesh.vertices)
    require(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]), "a vertex is nowhere");
  for (const auto& face : mesh.named) {
    require(face.patch >= 0 && face.patch < static_cast<int>(mesh.patches.size()), "a face has no patch");
    require(isVertex(face.vertices[0]) && isVertex(face.vertices[1]), "a face has a corner that is no vertex");
  }
  for (const auto& [a, b] : mesh.periodic) require(isVertex(a) && isVertex(b) && a != b, "a periodic pair is none");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lampblack;
  static const MpiForFuzzing mpi;
  static const test::ScratchFolder folder;
  const std::string file = folder.file("mesh.msh", std::string(reinterpret_cast<const char*>(data), size));
  const std::size_t portions[] = {1, 30, 5000};
  try {
    check(io::readGmsh(MPI_COMM_SELF, file, 1.0, portions[size % 3]));
  } catch (const InputError&) {
  }
  return 0;
}
