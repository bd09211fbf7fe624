#include "core/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "core/mesh_distribution.hpp"

namespace lampblack {
namespace {

// A face by its cells, before it has metrics.
struct FaceLink {
  int low, high, axis;  // local cells; high is -1 on the boundary
  double sign;
  std::int64_t key;  // the same on any number of ranks
};

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

void checkInput(const MeshSpec& spec, const std::vector<double>& cellWeight) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto& v = spec.vertices[at(axis)];
    if (v.size() < 2) throw InputError(fmt::format("mesh axis {} has no cells; at least 1 is needed", axis));
    for (std::size_t i = 1; i < v.size(); ++i)
      if (!(v[i] > v[i - 1])) throw InputError(fmt::format("the vertices of mesh axis {} do not increase", axis));
    if (!std::isfinite(v.front()) || !std::isfinite(v.back()))
      throw InputError(fmt::format("the vertices of mesh axis {} are not finite", axis));
  }
  for (int axis = 0; axis < 2; ++axis)
    if (spec.periodic[at(axis)] && spec.vertices[at(axis)].size() < 4)
      throw InputError(fmt::format("the periodic mesh axis {} has {} cells; at least 3 are needed", axis,
                                   spec.vertices[at(axis)].size() - 1));
  if (spec.geometry == Geometry::Axisymmetric && spec.periodic[0])
    throw InputError("the radius of an axisymmetric mesh cannot be periodic");
  if (spec.geometry == Geometry::Axisymmetric && spec.vertices[0].front() < 0.0)
    throw InputError("an axisymmetric mesh needs radii of zero or more");
  const std::size_t cells = (spec.vertices[0].size() - 1) * (spec.vertices[1].size() - 1);
  if (!cellWeight.empty() && cellWeight.size() != cells)
    throw std::invalid_argument(fmt::format("Mesh: {} cell weights for {} cells", cellWeight.size(), cells));
}

// (i, j) of a natural cell.
std::array<int, 2> indexOf(const Mesh& mesh, std::int64_t natural) {
  return {static_cast<int>(natural % mesh.cellsAlong[0]), static_cast<int>(natural / mesh.cellsAlong[0])};
}

// Local order: owned cells by natural index, then halo cells by (owner, natural index). Returns the local index of each
// of the box's cells.
std::vector<int> orderCells(Mesh& mesh, const LocalBox& box) {
  mesh.cells = static_cast<int>(box.cells.size());
  std::vector<int> order(box.cells.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto key = [&](const LocalBox::Cell& cell) {
      return std::make_pair(cell.owner == mesh.rank ? -1 : cell.owner, cell.natural);
    };
    return key(box.cells[at(a)]) < key(box.cells[at(b)]);
  });
  std::vector<int> localOf(box.cells.size());
  for (int local = 0; local < mesh.cells; ++local) {
    const int point = order[at(local)];
    const LocalBox::Cell& cell = box.cells[at(point)];
    localOf[at(point)] = local;
    mesh.naturalCell.push_back(cell.natural);
    if (cell.owner == mesh.rank)
      ++mesh.owned;
    else
      mesh.haloRank.push_back(cell.owner);
  }
  return localOf;
}

void measureCells(Mesh& mesh) {
  const auto& x = mesh.spec.vertices;
  for (std::int64_t natural : mesh.naturalCell) {
    const auto [column, row] = indexOf(mesh, natural);
    const std::size_t i = at(column);
    const std::size_t j = at(row);
    mesh.centre.push_back({0.5 * (x[0][i] + x[0][i + 1]), 0.5 * (x[1][j] + x[1][j + 1])});
    mesh.planarArea.push_back((x[0][i + 1] - x[0][i]) * (x[1][j + 1] - x[1][j]));
    mesh.volume.push_back(mesh.axisymmetric() ? mesh.planarArea.back() * mesh.centre.back()[0]
                                              : mesh.planarArea.back());
  }
}

// The faces of owned cells: interior ones by (low natural index, axis), then boundary ones by (natural index, side), so
// that a cell meets its faces in the same order on any number of ranks.
std::vector<FaceLink> orderFaces(Mesh& mesh, const LocalBox& box, const std::vector<int>& localOf) {
  std::vector<FaceLink> interior;
  for (const LocalBox::InteriorFace& face : box.interior) {
    int low = localOf[at(face.a)];
    int high = localOf[at(face.b)];
    if (low >= mesh.owned && high >= mesh.owned) continue;
    if (mesh.naturalCell[at(low)] > mesh.naturalCell[at(high)]) std::swap(low, high);
    const auto before = indexOf(mesh, mesh.naturalCell[at(low)]), after = indexOf(mesh, mesh.naturalCell[at(high)]);
    const int axis = before[0] != after[0] ? 0 : 1;
    const bool isAroundTheEnds = after[at(axis)] - before[at(axis)] > 1;
    if (isAroundTheEnds) std::swap(low, high);
    const std::int64_t natural = mesh.naturalCell[at(low)];
    interior.push_back({low, high, axis, 1.0, natural * 2 + axis});
  }
  std::vector<FaceLink> boundary;
  for (const LocalBox::BoundaryFace& face : box.boundary) {
    const int cell = localOf[at(face.cell)];
    if (cell >= mesh.owned) continue;
    const std::int64_t key = mesh.naturalCell[at(cell)] * 4 + face.axis * 2 + (face.atMax ? 1 : 0);
    boundary.push_back({cell, -1, face.axis, face.atMax ? 1.0 : -1.0, key});
  }
  const auto byKey = [](const FaceLink& a, const FaceLink& b) { return a.key < b.key; };
  std::sort(interior.begin(), interior.end(), byKey);
  std::sort(boundary.begin(), boundary.end(), byKey);
  mesh.interiorFaces = static_cast<int>(interior.size());
  mesh.faces = mesh.interiorFaces + static_cast<int>(boundary.size());
  interior.insert(interior.end(), boundary.begin(), boundary.end());
  return interior;
}

void measureFaces(Mesh& mesh, const std::vector<FaceLink>& links) {
  const auto& x = mesh.spec.vertices;
  for (const FaceLink& face : links) {
    const std::size_t normal = at(face.axis);
    const std::size_t along = 1 - normal;
    const auto index = indexOf(mesh, mesh.naturalCell[at(face.low)]);
    const std::size_t i = at(index[along]);
    const std::size_t layer = at(index[normal] + (face.sign > 0 ? 1 : 0));
    std::array<double, 2> middle{};
    middle[normal] = x[normal][layer];
    middle[along] = 0.5 * (x[along][i] + x[along][i + 1]);
    mesh.low.push_back(face.low);
    mesh.high.push_back(face.high);
    mesh.normalAxis.push_back(face.axis);
    mesh.normalSign.push_back(face.sign);
    mesh.faceCentre.push_back(middle);
    mesh.planarLength.push_back(x[along][i + 1] - x[along][i]);
    mesh.area.push_back(mesh.axisymmetric() ? mesh.planarLength.back() * middle[0] : mesh.planarLength.back());
    const double toLow = std::abs(middle[normal] - mesh.centre[at(face.low)][normal]);
    double toHigh = 0.0;
    if (face.high >= 0) {
      const double centre = mesh.centre[at(face.high)][normal];
      toHigh = centre > middle[normal] ? centre - middle[normal] : centre - x[normal].front();  // around the ends
    }
    mesh.distance.push_back(toLow + toHigh);
    mesh.lowWeight.push_back(toHigh / (toLow + toHigh));
  }
}

// Index of the first patch that holds a boundary face, or -1.
int findPatch(const Mesh& mesh, int face) {
  const int axis = mesh.normalAxis[at(face)];
  const bool atMax = mesh.normalSign[at(face)] > 0;
  const double along = mesh.faceCentre[at(face)][at(1 - axis)];
  const auto& patches = mesh.spec.patches;
  const auto holds = [&](const BoundaryPatch& patch) {
    return patch.axis == axis && patch.atMax == atMax && along >= patch.from && along <= patch.to;
  };
  const auto found = std::find_if(patches.begin(), patches.end(), holds);
  return found == patches.end() ? -1 : static_cast<int>(found - patches.begin());
}

// Collective, as a patch may be missing on one rank only.
void assignPatches(Mesh& mesh) {
  collectively(mesh.comm, [&] {
    for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
      const int found = findPatch(mesh, face);
      if (found < 0)
        throw InputError(fmt::format("the boundary face at ({:.6g}, {:.6g}) m belongs to no boundary",
                                     mesh.faceCentre[at(face)][0], mesh.faceCentre[at(face)][1]));
      mesh.patch.push_back(found);
    }
  });
}

// The rows of faceOfCell, each in face order.
void linkCellsToFaces(Mesh& mesh) {
  const auto eachSide = [&](auto&& visit) {
    for (int face = 0; face < mesh.faces; ++face) {
      visit(face, mesh.low[at(face)]);
      if (mesh.high[at(face)] >= 0) visit(face, mesh.high[at(face)]);
    }
  };
  std::vector<int> next(at(mesh.cells) + 1, 0);
  eachSide([&](int, int cell) { ++next[at(cell) + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  mesh.faceStart = next;
  mesh.faceOfCell.resize(at(next.back()));
  eachSide([&](int face, int cell) { mesh.faceOfCell[at(next[at(cell)]++)] = face; });
}

}  // namespace

Mesh::Mesh(MPI_Comm communicator, MeshSpec meshSpec, const std::vector<double>& cellWeight)
    : comm(communicator), spec(std::move(meshSpec)) {
  collectively(comm, [&] { checkInput(spec, cellWeight); });
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  cellsAlong = {static_cast<int>(spec.vertices[0].size()) - 1, static_cast<int>(spec.vertices[1].size()) - 1};
  totalCells = static_cast<std::int64_t>(cellsAlong[0]) * cellsAlong[1];

  const LocalBox box = distributeBox(comm, cellsAlong, spec.periodic, cellWeight);
  const std::vector<int> localOf = orderCells(*this, box);
  measureCells(*this);
  measureFaces(*this, orderFaces(*this, box, localOf));
  assignPatches(*this);
  linkCellsToFaces(*this);
}

std::int64_t Mesh::totalFaces() const {
  const auto n0 = static_cast<std::int64_t>(cellsAlong[0]);
  const auto n1 = static_cast<std::int64_t>(cellsAlong[1]);
  return (n0 + 1) * n1 + n0 * (n1 + 1);
}

std::vector<std::int64_t> Mesh::naturalFaces() const {
  const auto n0 = static_cast<std::int64_t>(cellsAlong[0]);
  const auto n1 = static_cast<std::int64_t>(cellsAlong[1]);
  std::vector<std::int64_t> numbers;
  for (std::size_t face = 0; face < static_cast<std::size_t>(faces); ++face) {
    const std::int64_t cell = naturalCell[static_cast<std::size_t>(low[face])];
    const std::int64_t beyond = normalSign[face] > 0.0 ? 1 : 0;  // whether the face is at the cell's upper side
    const std::int64_t i = cell % n0;
    const std::int64_t j = cell / n0;
    numbers.push_back(normalAxis[face] == 0 ? i + beyond + j * (n0 + 1) : (n0 + 1) * n1 + i + (j + beyond) * n0);
  }
  return numbers;
}

int Mesh::findOwned(std::int64_t natural) const {
  // Owned cells are ordered by natural index.
  const auto end = naturalCell.begin() + owned;
  const auto it = std::lower_bound(naturalCell.begin(), end, natural);
  return it == end || *it != natural ? -1 : static_cast<int>(it - naturalCell.begin());
}

}  // namespace lampblack
