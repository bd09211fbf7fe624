#include "core/mesh_distribution.hpp"

#include <petscdmplex.h>
#include <petscpartitioner.h>
#include <petscsf.h>

#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "core/partition.hpp"
#include "core/petsc.hpp"

namespace lampblack {
namespace {

// A box whose vertices have whole-number coordinates, so that a point's natural index can be read off its position on
// any rank after distribution. All of it is on rank 0.
PetscDm createIndexBox(MPI_Comm comm, const std::array<int, 2>& cellsAlong, const std::array<bool, 2>& periodic) {
  const PetscInt faces[2] = {cellsAlong[0], cellsAlong[1]};
  const PetscReal lower[2] = {0.0, 0.0};
  const PetscReal upper[2] = {static_cast<PetscReal>(cellsAlong[0]), static_cast<PetscReal>(cellsAlong[1])};
  const DMBoundaryType ends[2] = {periodic[0] ? DM_BOUNDARY_PERIODIC : DM_BOUNDARY_NONE,
                                  periodic[1] ? DM_BOUNDARY_PERIODIC : DM_BOUNDARY_NONE};
  PetscDm dm;
  checkPetsc(DMPlexCreateBoxMesh(comm, 2, PETSC_FALSE, faces, lower, upper, ends, PETSC_TRUE, dm.put()));
  checkPetsc(DMSetBasicAdjacency(dm.get(), PETSC_TRUE, PETSC_FALSE));
  return dm;
}

std::array<PetscReal, 3> position(DM dm, PetscInt point) {
  std::array<PetscReal, 3> centroid{};
  checkPetsc(DMPlexComputeCellGeometryFVM(dm, point, nullptr, centroid.data(), nullptr));
  return centroid;
}

std::int64_t naturalIndex(DM dm, PetscInt cell, const std::array<int, 2>& cellsAlong) {
  const auto at = position(dm, cell);
  return static_cast<std::int64_t>(std::floor(at[0])) + static_cast<std::int64_t>(std::floor(at[1])) * cellsAlong[0];
}

// The cells in a DMPlex's partitioning order, rank after rank, and how many each rank gets.
struct Assignment {
  std::vector<PetscInt> sizes, points;
};

// Collective; rank 0, which holds the box, decides.
Assignment assignCells(MPI_Comm comm, DM dm, const std::array<int, 2>& cellsAlong, const std::vector<double>& weight,
                       int ranks) {
  PetscInt graphCells = 0;
  PetscInt* start = nullptr;
  PetscInt* neighbours = nullptr;
  checkPetsc(DMPlexCreatePartitionerGraph(dm, 0, &graphCells, &start, &neighbours, nullptr));
  std::vector<std::int64_t> rowStart;
  std::vector<std::int64_t> adjacency;
  if (graphCells > 0) {
    rowStart.assign(start, start + graphCells + 1);
    adjacency.assign(neighbours, neighbours + start[graphCells]);
  }
  checkPetsc(PetscFree(start));
  checkPetsc(PetscFree(neighbours));

  Assignment assignment;
  assignment.sizes.assign(static_cast<std::size_t>(ranks), 0);
  collectively(comm, [&] {
    if (graphCells == 0) return;
    std::vector<double> graphWeight;
    if (!weight.empty()) {
      for (PetscInt c = 0; c < graphCells; ++c)
        graphWeight.push_back(weight[static_cast<std::size_t>(naturalIndex(dm, c, cellsAlong))]);
    }
    const std::vector<int> part = partitionGraph(rowStart, adjacency, graphWeight, ranks);
    for (int r = 0; r < ranks; ++r) {
      for (PetscInt c = 0; c < graphCells; ++c) {
        if (part[static_cast<std::size_t>(c)] != r) continue;
        assignment.points.push_back(c);
        ++assignment.sizes[static_cast<std::size_t>(r)];
      }
    }
  });
  return assignment;
}

// Moves the box's cells to their ranks through PETSc's shell partitioner, with one layer of halo cells.
PetscDm distribute(MPI_Comm comm, PetscDm dm, const std::array<int, 2>& cellsAlong, const std::vector<double>& weight) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  if (ranks == 1) return dm;

  const Assignment assignment = assignCells(comm, dm.get(), cellsAlong, weight, ranks);
  PetscPartitioner partitioner = nullptr;
  checkPetsc(DMPlexGetPartitioner(dm.get(), &partitioner));
  checkPetsc(PetscPartitionerSetType(partitioner, PETSCPARTITIONERSHELL));
  checkPetsc(PetscPartitionerShellSetPartition(partitioner, ranks, rank == 0 ? assignment.sizes.data() : nullptr,
                                               rank == 0 ? assignment.points.data() : nullptr));
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
    if (point >= cellStart && point < cellEnd)
      owner[static_cast<std::size_t>(point - cellStart)] = static_cast<int>(remote[i].rank);
  }
  return owner;
}

// A face with one cell: at the box's surface (or at the outer rim of the halo, of no use to this rank).
LocalBox::BoundaryFace describeBoundaryFace(DM dm, PetscInt face, int cell, const std::array<int, 2>& cellsAlong) {
  constexpr double tolerance = 1e-6;  // of a cell: centroids of a whole-number grid are exact
  const auto at = position(dm, face);
  const int axis = at[0] < tolerance || at[0] > cellsAlong[0] - tolerance ? 0 : 1;
  return {cell, axis, at[static_cast<std::size_t>(axis)] >= tolerance};
}

}  // namespace

LocalBox distributeBox(MPI_Comm comm, const std::array<int, 2>& cellsAlong, const std::array<bool, 2>& periodic,
                       const std::vector<double>& cellWeight) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const PetscDm dm = distribute(comm, createIndexBox(comm, cellsAlong, periodic), cellsAlong, cellWeight);
  PetscInt cellStart = 0;
  PetscInt cellEnd = 0;
  PetscInt faceStart = 0;
  PetscInt faceEnd = 0;
  checkPetsc(DMPlexGetHeightStratum(dm.get(), 0, &cellStart, &cellEnd));
  checkPetsc(DMPlexGetHeightStratum(dm.get(), 1, &faceStart, &faceEnd));

  LocalBox box;
  const std::vector<int> owner = ownerOfCells(dm.get(), cellStart, cellEnd, rank);
  for (PetscInt c = cellStart; c < cellEnd; ++c)
    box.cells.push_back({naturalIndex(dm.get(), c, cellsAlong), owner[static_cast<std::size_t>(c - cellStart)]});
  for (PetscInt f = faceStart; f < faceEnd; ++f) {
    PetscInt supportSize = 0;
    const PetscInt* support = nullptr;
    checkPetsc(DMPlexGetSupportSize(dm.get(), f, &supportSize));
    checkPetsc(DMPlexGetSupport(dm.get(), f, &support));
    const int a = static_cast<int>(support[0] - cellStart);
    if (supportSize == 2)
      box.interior.push_back({a, static_cast<int>(support[1] - cellStart)});
    else
      box.boundary.push_back(describeBoundaryFace(dm.get(), f, a, cellsAlong));
  }
  return box;
}

}  // namespace lampblack
