#include "core/mesh.hpp"

#include <fmt/format.h>
#include <petscdmplex.h>
#include <petscpartitioner.h>
#include <petscsf.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/errors.hpp"
#include "core/partition.hpp"
#include "core/petsc.hpp"

namespace lampblack {
namespace {

using IndexPair = std::array<PetscInt, 2>;

// A box whose vertices have whole-number coordinates, so that a point's natural index can be read off its position on
// any rank after distribution.
PetscDm createIndexBox(MPI_Comm comm, const std::array<int, 2>& cellsAlong) {
  const PetscInt faces[2] = {cellsAlong[0], cellsAlong[1]};
  const PetscReal lower[2] = {0.0, 0.0};
  const PetscReal upper[2] = {static_cast<PetscReal>(cellsAlong[0]), static_cast<PetscReal>(cellsAlong[1])};
  PetscDm dm;
  checkPetsc(DMPlexCreateBoxMesh(comm, 2, PETSC_FALSE, faces, lower, upper, nullptr, PETSC_TRUE, dm.put()));
  checkPetsc(DMSetBasicAdjacency(dm.get(), PETSC_TRUE, PETSC_FALSE));
  return dm;
}

IndexPair cellIndex(DM dm, PetscInt cell) {
  PetscReal centroid[3] = {0.0, 0.0, 0.0};
  checkPetsc(DMPlexComputeCellGeometryFVM(dm, cell, nullptr, centroid, nullptr));
  return {static_cast<PetscInt>(std::floor(centroid[0])), static_cast<PetscInt>(std::floor(centroid[1]))};
}

// Distributes the box by METIS through PETSc's shell partitioner, with one layer of halo cells.
PetscDm distribute(MPI_Comm comm, PetscDm dm, const std::array<int, 2>& cellsAlong, const std::vector<double>& weight) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  if (ranks == 1) return dm;

  PetscInt graphCells = 0;
  PetscInt* start = nullptr;
  PetscInt* neighbours = nullptr;
  checkPetsc(DMPlexCreatePartitionerGraph(dm.get(), 0, &graphCells, &start, &neighbours, nullptr));
  std::vector<PetscInt> sizes(static_cast<std::size_t>(ranks), 0);
  std::vector<PetscInt> points;
  collectively(comm, [&] {
    if (graphCells == 0) return;
    const std::vector<std::int64_t> rowStart(start, start + graphCells + 1);
    const std::vector<std::int64_t> adjacency(neighbours, neighbours + start[graphCells]);
    std::vector<double> graphWeight;
    if (!weight.empty()) {
      for (PetscInt c = 0; c < graphCells; ++c) {
        const IndexPair index = cellIndex(dm.get(), c);
        graphWeight.push_back(weight[static_cast<std::size_t>(index[0] + index[1] * cellsAlong[0])]);
      }
    }
    const std::vector<int> part = partitionGraph(rowStart, adjacency, graphWeight, ranks);
    for (int r = 0; r < ranks; ++r) {
      for (PetscInt c = 0; c < graphCells; ++c) {
        if (part[static_cast<std::size_t>(c)] != r) continue;
        points.push_back(c);
        ++sizes[static_cast<std::size_t>(r)];
      }
    }
  });
  checkPetsc(PetscFree(start));
  checkPetsc(PetscFree(neighbours));

  PetscPartitioner partitioner = nullptr;
  checkPetsc(DMPlexGetPartitioner(dm.get(), &partitioner));
  checkPetsc(PetscPartitionerSetType(partitioner, PETSCPARTITIONERSHELL));
  checkPetsc(PetscPartitionerShellSetPartition(partitioner, ranks, rank == 0 ? sizes.data() : nullptr,
                                               rank == 0 ? points.data() : nullptr));
  PetscDm distributed;
  checkPetsc(DMPlexDistribute(dm.get(), 1, nullptr, distributed.put()));
  if (distributed.get() == nullptr) throw NumericsError("DMPlex did not distribute the mesh");
  return distributed;
}

// Owner rank of each local cell point: this rank unless the point is a leaf of the point SF.
std::vector<int> ownerOfCells(DM dm, PetscInt cellStart, PetscInt cellEnd, int rank) {
  std::vector<int> owner(static_cast<std::size_t>(cellEnd - cellStart), rank);
  PetscSF sf = nullptr;
  PetscInt leaves = 0;
  const PetscInt* local = nullptr;
  const PetscSFNode* remote = nullptr;
  checkPetsc(DMGetPointSF(dm, &sf));
  checkPetsc(PetscSFGetGraph(sf, nullptr, &leaves, &local, &remote));
  for (PetscInt i = 0; i < leaves; ++i) {
    const PetscInt point = local != nullptr ? local[i] : i;
    if (point >= cellStart && point < cellEnd) owner[static_cast<std::size_t>(point - cellStart)] = static_cast<int>(remote[i].rank);
  }
  return owner;
}

void checkSpec(const MeshSpec& spec) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto& v = spec.vertices[static_cast<std::size_t>(axis)];
    if (v.size() < 2) throw InputError(fmt::format("mesh axis {} has no cells; at least 1 is needed", axis));
    for (std::size_t i = 1; i < v.size(); ++i)
      if (!(v[i] > v[i - 1])) throw InputError(fmt::format("the vertices of mesh axis {} do not increase", axis));
  }
  if (spec.geometry == Geometry::Axisymmetric && spec.vertices[0].front() < 0.0)
    throw InputError("an axisymmetric mesh needs radii of zero or more");
}

}  // namespace

Mesh::Mesh(MPI_Comm communicator, MeshSpec meshSpec, const std::vector<double>& cellWeight)
    : comm(communicator), spec(std::move(meshSpec)) {
  checkSpec(spec);
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  const auto& x = spec.vertices;
  cellsAlong = {static_cast<int>(x[0].size()) - 1, static_cast<int>(x[1].size()) - 1};
  totalCells = static_cast<std::int64_t>(cellsAlong[0]) * cellsAlong[1];

  const PetscDm dm = distribute(comm, createIndexBox(comm, cellsAlong), cellsAlong, cellWeight);
  PetscInt cellStart = 0;
  PetscInt cellEnd = 0;
  PetscInt faceBegin = 0;
  PetscInt faceEnd = 0;
  checkPetsc(DMPlexGetHeightStratum(dm.get(), 0, &cellStart, &cellEnd));
  checkPetsc(DMPlexGetHeightStratum(dm.get(), 1, &faceBegin, &faceEnd));

  // Local order: owned cells by natural index, then halo cells by (owner, natural index).
  cells = static_cast<int>(cellEnd - cellStart);
  const std::vector<int> owner = ownerOfCells(dm.get(), cellStart, cellEnd, rank);
  std::vector<std::int64_t> natural(static_cast<std::size_t>(cells));
  for (int c = 0; c < cells; ++c) {
    const IndexPair index = cellIndex(dm.get(), cellStart + c);
    natural[static_cast<std::size_t>(c)] = index[0] + static_cast<std::int64_t>(index[1]) * cellsAlong[0];
  }
  std::vector<int> order(static_cast<std::size_t>(cells));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto key = [&](int c) {
      const int o = owner[static_cast<std::size_t>(c)];
      return std::make_pair(o == rank ? -1 : o, natural[static_cast<std::size_t>(c)]);
    };
    return key(a) < key(b);
  });
  std::vector<int> localOf(static_cast<std::size_t>(cells));
  for (int l = 0; l < cells; ++l) {
    const auto point = static_cast<std::size_t>(order[static_cast<std::size_t>(l)]);
    localOf[point] = l;
    naturalCell.push_back(natural[point]);
    if (owner[point] == rank)
      ++owned;
    else
      haloRank.push_back(owner[point]);
  }

  const bool axisym = axisymmetric();
  std::vector<std::array<int, 2>> index;
  for (std::int64_t n : naturalCell) {
    const std::array<int, 2> ij{static_cast<int>(n % cellsAlong[0]), static_cast<int>(n / cellsAlong[0])};
    index.push_back(ij);
    const auto i = static_cast<std::size_t>(ij[0]);
    const auto j = static_cast<std::size_t>(ij[1]);
    centre.push_back({0.5 * (x[0][i] + x[0][i + 1]), 0.5 * (x[1][j] + x[1][j + 1])});
    planarArea.push_back((x[0][i + 1] - x[0][i]) * (x[1][j + 1] - x[1][j]));
    volume.push_back(axisym ? planarArea.back() * centre.back()[0] : planarArea.back());
  }

  struct Face {
    int low, high, axis;
    double sign;
    std::int64_t key;
  };
  std::vector<Face> interior;
  std::vector<Face> boundary;
  for (PetscInt f = faceBegin; f < faceEnd; ++f) {
    PetscInt supportSize = 0;
    const PetscInt* support = nullptr;
    checkPetsc(DMPlexGetSupportSize(dm.get(), f, &supportSize));
    checkPetsc(DMPlexGetSupport(dm.get(), f, &support));
    if (supportSize == 2) {
      int a = localOf[static_cast<std::size_t>(support[0] - cellStart)];
      int b = localOf[static_cast<std::size_t>(support[1] - cellStart)];
      if (a >= owned && b >= owned) continue;
      if (naturalCell[static_cast<std::size_t>(a)] > naturalCell[static_cast<std::size_t>(b)]) std::swap(a, b);
      const int axis = index[static_cast<std::size_t>(a)][0] != index[static_cast<std::size_t>(b)][0] ? 0 : 1;
      interior.push_back({a, b, axis, 1.0, naturalCell[static_cast<std::size_t>(a)] * 2 + axis});
    } else {
      const int c = localOf[static_cast<std::size_t>(support[0] - cellStart)];
      if (c >= owned) continue;
      PetscReal position[3] = {0.0, 0.0, 0.0};
      checkPetsc(DMPlexComputeCellGeometryFVM(dm.get(), f, nullptr, position, nullptr));
      const int axis = position[0] < 1e-6 || position[0] > cellsAlong[0] - 1e-6 ? 0 : 1;
      const double sign = position[axis] < 1e-6 ? -1.0 : 1.0;
      boundary.push_back({c, -1, axis, sign, naturalCell[static_cast<std::size_t>(c)] * 4 + axis * 2 + (sign > 0 ? 1 : 0)});
    }
  }
  const auto byKey = [](const Face& a, const Face& b) { return a.key < b.key; };
  std::sort(interior.begin(), interior.end(), byKey);
  std::sort(boundary.begin(), boundary.end(), byKey);
  interiorFaces = static_cast<int>(interior.size());
  faces = interiorFaces + static_cast<int>(boundary.size());
  interior.insert(interior.end(), boundary.begin(), boundary.end());

  std::string missingPatch;
  for (const Face& face : interior) {
    const auto c = static_cast<std::size_t>(face.low);
    const auto normal = static_cast<std::size_t>(face.axis);
    const std::size_t along = 1 - normal;
    const auto i = static_cast<std::size_t>(index[c][along]);
    const auto layer = static_cast<std::size_t>(index[c][normal] + (face.sign > 0 ? 1 : 0));
    std::array<double, 2> middle{};
    middle[normal] = x[normal][layer];
    middle[along] = 0.5 * (x[along][i] + x[along][i + 1]);
    low.push_back(face.low);
    high.push_back(face.high);
    normalAxis.push_back(face.axis);
    normalSign.push_back(face.sign);
    faceCentre.push_back(middle);
    planarLength.push_back(x[along][i + 1] - x[along][i]);
    area.push_back(axisym ? planarLength.back() * middle[0] : planarLength.back());
    const double toLow = std::abs(middle[normal] - centre[c][normal]);
    if (face.high >= 0) {
      const double toHigh = std::abs(centre[static_cast<std::size_t>(face.high)][normal] - middle[normal]);
      distance.push_back(toLow + toHigh);
      lowWeight.push_back(toHigh / (toLow + toHigh));
      continue;
    }
    distance.push_back(toLow);
    lowWeight.push_back(0.0);
    int found = -1;
    for (std::size_t p = 0; p < spec.patches.size() && found < 0; ++p) {
      const BoundaryPatch& candidate = spec.patches[p];
      if (candidate.axis == face.axis && candidate.atMax == (face.sign > 0) && middle[along] >= candidate.from &&
          middle[along] <= candidate.to)
        found = static_cast<int>(p);
    }
    if (found < 0 && missingPatch.empty())
      missingPatch = fmt::format("the boundary face at ({:.6g}, {:.6g}) m belongs to no boundary", middle[0], middle[1]);
    patch.push_back(found);
  }
  collectively(comm, [&] {
    if (!missingPatch.empty()) throw InputError(missingPatch);
  });

  std::vector<int> count(static_cast<std::size_t>(cells) + 1, 0);
  const auto eachSide = [&](auto&& visit) {
    for (int f = 0; f < faces; ++f) {
      visit(f, low[static_cast<std::size_t>(f)]);
      if (high[static_cast<std::size_t>(f)] >= 0) visit(f, high[static_cast<std::size_t>(f)]);
    }
  };
  eachSide([&](int, int c) { ++count[static_cast<std::size_t>(c) + 1]; });
  std::partial_sum(count.begin(), count.end(), count.begin());
  faceStart = count;
  faceOfCell.resize(static_cast<std::size_t>(count.back()));
  eachSide([&](int f, int c) { faceOfCell[static_cast<std::size_t>(count[static_cast<std::size_t>(c)]++)] = f; });

}

int Mesh::findOwned(std::int64_t natural) const {
  // Owned cells are ordered by natural index.
  const auto end = naturalCell.begin() + owned;
  const auto it = std::lower_bound(naturalCell.begin(), end, natural);
  return it == end || *it != natural ? -1 : static_cast<int>(it - naturalCell.begin());
}

}  // namespace lampblack
