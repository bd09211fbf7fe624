#include "app/flow/flow_mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "app/flow/content_hash.hpp"
#include "app/flow/flow_limits.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"
#include "io/gmsh_reader.hpp"

namespace lampblack::app {
namespace {

// Collective: what `make` returns; an InputError of all ranks points at this key.
template <typename Make>
auto pointingAt(MPI_Comm comm, const Deck& deck, const std::string& key, Make make) {
  try {
    return make();
  } catch (const InputError& wrong) {
    const InputError error = deck.error(key, wrong.what());
    collectively(comm, [&] { throw error; });
    throw;
  }
}

// Collective; rank 0 reads, in pieces.
std::string contentOf(MPI_Comm comm, const std::filesystem::path& path) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string text = ContentHash().text();
  collectively(comm, [&] {
    if (rank != 0) return;
    std::ifstream file(path, std::ios::binary);
    std::string piece(1U << 20U, '\0');
    ContentHash hash;
    while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0)
      hash.add({piece.data(), static_cast<std::size_t>(file.gcount())});
    if (file.bad()) throw InputError(fmt::format("{} cannot be read", path.string()));
    text = hash.text();
  });
  MPI_Bcast(text.data(), static_cast<int>(text.size()), MPI_CHAR, 0, comm);
  return text;
}

void requireGeometry(const FlowCase& flowCase, int dimension) {
  const MeshFile& file = *flowCase.meshFile;
  if (dimension == flowCase.dimension) return;
  throw file.deck.error("mesh.geometry",
                        fmt::format("the mesh of {} {}", file.path.string(),
                                    dimension == 3 ? "is three-dimensional; expected space"
                                                   : "lies in a plane; expected planar or axisymmetric"));
}

// The number of each of the file's patches among the boundaries; -1: periodic.
std::vector<int> numbersOf(const std::vector<std::string>& patches, const FlowCase& flowCase) {
  const MeshFile& file = *flowCase.meshFile;
  const std::string named = fmt::format("{} has these names: {}", file.path.string(),
                                        patches.empty() ? "none" : fmt::format("{}", fmt::join(patches, ", ")));
  std::vector<std::string> known = file.periodic;
  for (const BoundaryCondition& boundary : flowCase.boundaries) known.push_back(boundary.name);
  for (const std::string& name : known)
    if (std::ranges::find(patches, name) == patches.end())
      throw file.deck.error("boundaries." + name,
                            fmt::format("there is no such part of the mesh; {}{}", named, didYouMean(name, patches)));
  std::vector<int> numbers;
  for (const std::string& patch : patches) {
    if (std::ranges::find(known, patch) == known.end())
      throw file.deck.error("boundaries", fmt::format("'{}' has no boundary; {}", patch, named));
    const auto boundary = std::ranges::find(flowCase.boundaries, patch, &BoundaryCondition::name);
    numbers.push_back(boundary == flowCase.boundaries.end() ? -1
                                                            : static_cast<int>(boundary - flowCase.boundaries.begin()));
  }
  return numbers;
}

void orderPatches(MeshBlock& block, const FlowCase& flowCase) {
  const std::vector<int> boundaryOf = numbersOf(block.patches, flowCase);
  for (MeshBlock::NamedFace& face : block.named) face.patch = boundaryOf[static_cast<std::size_t>(face.patch)];
  std::erase_if(block.named, [](const MeshBlock::NamedFace& face) { return face.patch < 0; });
  block.patches.clear();
  for (const BoundaryCondition& boundary : flowCase.boundaries) block.patches.push_back(boundary.name);
}

// What a deck that names a side of a box is asked beforehand.
void checkFace(const Mesh& mesh, const FlowCase& flowCase, int face) {
  const Deck& deck = flowCase.meshFile->deck;
  const auto f = static_cast<std::size_t>(face);
  const BoundaryCondition& boundary =
      flowCase.boundaries[static_cast<std::size_t>(mesh.patch[f - static_cast<std::size_t>(mesh.interiorFaces)])];
  const std::string section = "boundaries." + boundary.name;
  if (boundary.kind != BoundaryKind::Symmetry) {
    if (!(mesh.area[f] > 0))
      throw deck.error(
          section + ".type",
          "a part of it lies on the axis, which has no area; expected symmetry, and a name of its own in the "
          "mesh file");
    return;
  }
  if (std::abs(dot(flowCase.gravity, mesh.normal[f])) > 1e-6 * length(flowCase.gravity))
    throw deck.error("gravity",
                     fmt::format("gravity would point through '{}', where the flow is symmetric", boundary.name));
}

// Collective.
void checkSurface(const Mesh& mesh, const FlowCase& flowCase) {
  std::vector<int> faces(flowCase.boundaries.size(), 0);
  collectively(mesh.comm, [&] {
    for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
      faces[static_cast<std::size_t>(mesh.patch[static_cast<std::size_t>(face - mesh.interiorFaces)])] = 1;
      checkFace(mesh, flowCase, face);
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, faces.data(), static_cast<int>(faces.size()), MPI_INT, MPI_MAX, mesh.comm);
  collectively(mesh.comm, [&] {
    for (std::size_t b = 0; b < faces.size(); ++b)
      if (faces[b] == 0)
        throw flowCase.meshFile->deck.error(
            "boundaries." + flowCase.boundaries[b].name,
            "there are cells on both sides of all its faces; expected a part of the surface, or 'type: periodic'");
  });
}

// Collective. Places of the start's layers along their axis, which a box is asked beforehand.
void checkLayers(const Mesh& mesh, const FlowCase& flowCase) {
  const Deck& deck = flowCase.meshFile->deck;
  const std::string layer = deck.choice("initial.layer");
  if (layer == "none") return;
  const MixingLayer& start = flowCase.initial;
  double ends[2] = {1e300, 1e300};  // lower, and upper with the other sign
  for (const Vector3& place : mesh.vertex) {
    const double along = place[static_cast<std::size_t>(start.axis)];
    ends[0] = std::min(ends[0], along);
    ends[1] = std::min(ends[1], -along);
  }
  MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MIN, mesh.comm);
  collectively(mesh.comm, [&] {
    const auto requireInside = [&](const char* key, double place) {
      if (place < ends[0] || place > -ends[1])
        throw deck.error(key, fmt::format("expected a place in the mesh, from {:g} to {:g} m, found {:g} m", ends[0],
                                          -ends[1], place));
    };
    requireInside("initial.position", start.position);
    if (!start.burnt) requireInside("initial.hot_position", start.hotPosition);
  });
}

Mesh readMeshFile(MPI_Comm comm, FlowCase& flowCase, std::span<const double> cellWeight) {
  MeshFile& file = *flowCase.meshFile;
  const std::string key = "mesh.file";
  MeshBlock block = pointingAt(comm, file.deck, key, [&] { return readGmsh(comm, file.path, file.unit); });
  const std::string before = file.content;
  file.content = pointingAt(comm, file.deck, key, [&] { return contentOf(comm, file.path); });
  collectively(comm, [&] {
    if (!before.empty() && file.content != before)
      throw file.deck.error(key, fmt::format("{} has changed since the run began", file.path.string()));
    requireGeometry(flowCase, block.dimension);
    orderPatches(block, flowCase);
    const auto cells = static_cast<double>(block.totalCells);
    requireCells(file.deck, cells, flowCase.mechanism->numSpecies());
    refuseExcess(file.deck, flowCase, cells);
  });
  return pointingAt(comm, file.deck, key, [&] { return Mesh(comm, block, flowCase.mesh.geometry, cellWeight); });
}

}  // namespace

Mesh makeMesh(MPI_Comm comm, FlowCase& flowCase, std::span<const double> cellWeight) {
  if (!flowCase.meshFile) return {comm, flowCase.mesh, cellWeight};
  Mesh mesh = readMeshFile(comm, flowCase, cellWeight);
  checkSurface(mesh, flowCase);
  checkLayers(mesh, flowCase);
  return mesh;
}

}  // namespace lampblack::app
