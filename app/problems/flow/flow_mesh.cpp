#include "app/problems/flow/flow_mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "app/problems/flow/flow_limits.hpp"
#include "app/problems/flow/mesh_patches.hpp"
#include "app/run/content_hash.hpp"
#include "core/errors.hpp"
#include "core/mesh_parts.hpp"
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

// Collective. Faces of each patch: those that are named, and those of the surface.
struct PatchFaces {
  std::vector<std::int64_t> named, surface;

  PatchFaces(MPI_Comm comm, const MeshBlock& block) : named(block.patches.size(), 0) {
    for (const MeshBlock::NamedFace& face : block.named) ++named[static_cast<std::size_t>(face.patch)];
    add(comm, named);
  }
  void count(const Mesh& mesh) {
    surface.assign(named.size(), 0);
    for (const int patch : mesh.patch) ++surface[static_cast<std::size_t>(patch)];
    add(mesh.comm, surface);
  }

 private:
  static void add(MPI_Comm comm, std::vector<std::int64_t>& counts) {
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(counts.size()), MPI_INT64_T, MPI_SUM, comm);
  }
};

// Collective. A group inside the gas that the deck does not name is passed over; one of the surface needs a boundary.
void dropOtherPatches(Mesh& mesh, const std::vector<std::string>& others, const std::vector<std::string>& names,
                      const PatchFaces& faces, FlowCase& flowCase, std::vector<std::string>& notes) {
  const MeshFile& file = *flowCase.meshFile;
  const std::size_t boundaries = flowCase.boundaries.size();
  collectively(mesh.comm, [&] {
    for (std::size_t i = 0; i < others.size(); ++i)
      if (faces.surface[boundaries + i] > 0)
        throw file.deck.error(
            "boundaries", fmt::format("'{}' has no boundary; {}", nameInDeck(others[i]), namesText(names, flowCase)));
  });
  for (const std::string& name : others)
    notes.push_back(
        fmt::format("the group '{}' is no part of the surface and has no boundary: it is passed over; inside the gas "
                    "'type: wall' makes it a wall of no thickness",
                    name));
  for (std::size_t b = 0; b < boundaries; ++b) {
    const std::int64_t named = faces.named[b], surface = faces.surface[b];
    const std::string& name = flowCase.boundaries[b].name;
    if (flowCase.boundaries[b].kind == BoundaryKind::Wall && surface > named)
      notes.push_back(
          fmt::format("{} of the {} faces of the wall '{}' have cells on both sides: a wall of no thickness",
                      surface - named, named, name));
    else if (surface > 0 && surface < named)
      notes.push_back(fmt::format("{} of the {} faces of '{}' are no part of the surface and are passed over",
                                  named - surface, named, name));
  }
  mesh.patches.resize(boundaries);
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
void checkSurface(const Mesh& mesh, const FlowCase& flowCase, const PatchFaces& faces) {
  collectively(mesh.comm, [&] {
    for (int face = mesh.interiorFaces; face < mesh.faces; ++face) checkFace(mesh, flowCase, face);
    for (std::size_t b = 0; b < flowCase.boundaries.size(); ++b)
      if (faces.surface[b] == 0)
        throw flowCase.meshFile->deck.error(
            "boundaries." + flowCase.boundaries[b].name,
            "there are cells on both sides of all its faces; expected a part of the surface, 'type: wall' (of no "
            "thickness) or 'type: periodic'. To part the cells there, run Gmsh's Plugin(Crack) on the group and save "
            "the mesh again");
  });
}

// Collective. A part without an outlet has no way to keep its pressure where others set it.
void checkParts(const Mesh& mesh, const FlowCase& flowCase) {
  const Deck& deck = flowCase.meshFile ? flowCase.meshFile->deck : *flowCase.output.tables.deck;
  const std::string key = flowCase.meshFile ? "mesh.file" : "mesh";
  const std::vector<MeshPart> parts = pointingAt(mesh.comm, deck, key, [&] { return partsOf(mesh); });
  if (parts.size() == 1) return;
  collectively(mesh.comm, [&] {
    std::vector<std::string> texts;
    std::size_t closed = 0;
    for (const MeshPart& part : parts) {
      bool isOpen = false;
      for (std::size_t b = 0; b < flowCase.boundaries.size(); ++b)
        isOpen = isOpen || (part.patches[b] != 0 && flowCase.boundaries[b].kind == BoundaryKind::Outlet);
      closed += isOpen ? 0 : 1;
      constexpr std::size_t partsTold = 10;
      if (texts.size() < partsTold)
        texts.push_back(fmt::format("{} cells, one at {}, {} an outlet", part.cells,
                                    placeText(part.place, mesh.dimension), isOpen ? "with" : "without"));
    }
    if (closed == 0) return;
    throw deck.error(
        key, fmt::format("the mesh has {} parts that do not touch, {} of them without an outlet, which "
                         "would each need a pressure of its own: {}{}; give each part an outlet, leave "
                         "the others out of the mesh, or run them by themselves",
                         parts.size(), closed, fmt::join(texts, "; "), texts.size() < parts.size() ? "; ..." : ""));
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

// Of a mesh file without `mesh.partition`: what cuts least, where one rank can hold the graph.
Partitioner usualPartitioner(std::int64_t cells) {
  return cells <= 10'000'000 ? Partitioner::Metis : Partitioner::Curve;
}

Mesh readMeshFile(MPI_Comm comm, FlowCase& flowCase, std::span<const double> weight) {
  MeshFile& file = *flowCase.meshFile;
  const std::string key = "mesh.file";
  std::vector<std::string> notes;
  MeshBlock block =
      pointingAt(comm, file.deck, key, [&] { return readGmsh(comm, file.path, file.unit, 1U << 17U, &notes); });
  const std::string before = file.content;
  const std::vector<std::string> names = block.patches;
  std::vector<std::string> others;
  file.content = pointingAt(comm, file.deck, key, [&] { return contentOf(comm, file.path); });
  collectively(comm, [&] {
    if (!before.empty() && file.content != before)
      throw file.deck.error(key, fmt::format("{} has changed since the run began", file.path.string()));
    requireGeometry(flowCase, block.dimension);
    others = orderPatches(block, flowCase);
    const auto cells = static_cast<double>(block.totalCells);
    requireCells(file.deck, cells, flowCase.mechanism->numSpecies());
    refuseExcess(file.deck, flowCase, cells);
  });
  PatchFaces faces(comm, block);
  const Partition partition{flowCase.partitioner.value_or(usualPartitioner(block.totalCells)), weight};
  Mesh mesh = pointingAt(comm, file.deck, key, [&] { return Mesh(comm, block, flowCase.mesh.geometry, partition); });
  faces.count(mesh);
  dropOtherPatches(mesh, others, names, faces, flowCase, notes);
  checkSurface(mesh, flowCase, faces);
  checkLayers(mesh, flowCase);
  if (before.empty()) flowCase.notes.insert(flowCase.notes.end(), notes.begin(), notes.end());
  return mesh;
}

}  // namespace

Mesh makeMesh(MPI_Comm comm, FlowCase& flowCase, std::span<const double> weight) {
  Mesh mesh = flowCase.meshFile
                  ? readMeshFile(comm, flowCase, weight)
                  : Mesh(comm, flowCase.mesh, {flowCase.partitioner.value_or(Partitioner::Curve), weight});
  checkParts(mesh, flowCase);
  return mesh;
}

}  // namespace lampblack::app
