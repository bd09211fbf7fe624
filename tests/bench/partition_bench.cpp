// Ways to give cells to ranks, side by side: pieces of the curve (what Mesh does), PT-Scotch on the spread graph, and
// METIS on the whole graph on one rank, for as many parts as there are ranks. Run by hand:
//   mpirun --oversubscribe -n 64 partition_bench [cells]
#include <fmt/format.h>
#include <malloc.h>
#include <metis.h>
#include <mpi.h>
#include <petscmat.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/grading.hpp"
#include "core/mesh_connect.hpp"
#include "core/mesh_distribution.hpp"
#include "core/petsc.hpp"
#include "core/rank_exchange.hpp"
#include "core/shares.hpp"
#include "core/vector3.hpp"
#include "tests/bench/memory_use.hpp"
#include "tests/every_module.hpp"
#include "tests/skewed_mesh.hpp"

namespace lampblack::bench {
namespace {

const MPI_Comm comm = MPI_COMM_WORLD;

template <typename T>
T reduced(T value, MPI_Datatype type, MPI_Op op) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, type, op, comm);
  return value;
}

// A mesh in shares with what it costs; rows of the graph are this rank's cells.
struct Problem {
  std::string name;
  int dimension = 2;
  CellSet cells;
  std::vector<double> weight;
  std::vector<std::int64_t> start{0}, neighbours;
  int ranks = 1;
};

MeshSpec box(int dimension, double cells) {
  MeshSpec spec;
  const int along = static_cast<int>(std::lround(std::pow(cells, 1.0 / dimension)));
  for (int i = 0; i < dimension; ++i) {
    spec.vertices[static_cast<std::size_t>(i)] = gradedAxis(0.0, {{1.0, along, 1.0}});
    for (const bool atMax : {false, true}) spec.patches.push_back({"surface", i, atMax});
  }
  return spec;
}

// `cost`: of a cell at a place.
Problem problem(const std::string& name, const MeshBlock& block, const std::function<double(const Vector3&)>& cost) {
  Problem p;
  p.name = name;
  p.dimension = block.dimension;
  p.cells = connect(comm, block).cells;
  MPI_Comm_size(comm, &p.ranks);
  for (std::size_t c = 0; c < p.cells.size(); ++c) {
    p.weight.push_back(cost(p.cells.placesOf(c)[0]));
    for (const CellSet::Side& side : p.cells.sidesOf(c))
      if (side.neighbour >= 0) p.neighbours.push_back(side.neighbour);
    p.start.push_back(static_cast<std::int64_t>(p.neighbours.size()));
  }
  return p;
}

// Whole numbers for the weights, of mean 1000 where that fits.
template <typename Integer>
void wholeWeights(const std::vector<double>& weight, double sum, double cells, Integer* whole) {
  const double scale = std::min(1000.0 * cells, 0x1p30) / sum;
  std::ranges::transform(weight, whole,
                         [&](double w) { return std::max<Integer>(1, static_cast<Integer>(std::lround(w * scale))); });
}

std::vector<int> byCurve(const Problem& p) {
  return partitionAlongCurve(comm, p.cells, p.dimension, p.weight);
}

std::vector<int> byPtScotch(const Problem& p) {
  const auto own = static_cast<std::int64_t>(p.cells.size());
  const double cells = reduced(static_cast<double>(own), MPI_DOUBLE, MPI_SUM);
  const double sum = reduced(std::accumulate(p.weight.begin(), p.weight.end(), 0.0), MPI_DOUBLE, MPI_SUM);
  // These arrays pass to PETSc.
  PetscInt *start = nullptr, *neighbours = nullptr, *weights = nullptr;
  checkPetsc(PetscMalloc1(p.start.size(), &start));
  checkPetsc(PetscMalloc1(p.neighbours.size() + 1, &neighbours));
  checkPetsc(PetscMalloc1(p.weight.size() + 1, &weights));
  std::ranges::copy(p.start, start);
  std::ranges::copy(p.neighbours, neighbours);
  wholeWeights(p.weight, sum, cells, weights);
  PetscMatrix graph;
  checkPetsc(MatCreateMPIAdj(comm, static_cast<PetscInt>(own), static_cast<PetscInt>(cells), start, neighbours, nullptr,
                             graph.put()));
  MatPartitioning partitioning = nullptr;
  checkPetsc(MatPartitioningCreate(comm, &partitioning));
  checkPetsc(MatPartitioningSetAdjacency(partitioning, graph.get()));
  checkPetsc(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  checkPetsc(MatPartitioningSetVertexWeights(partitioning, weights));
  checkPetsc(MatPartitioningSetFromOptions(partitioning));
  IS parts = nullptr;
  checkPetsc(MatPartitioningApply(partitioning, &parts));
  const PetscInt* part = nullptr;
  checkPetsc(ISGetIndices(parts, &part));
  std::vector<int> owner(part, part + own);
  checkPetsc(ISRestoreIndices(parts, &part));
  checkPetsc(ISDestroy(&parts));
  checkPetsc(MatPartitioningDestroy(&partitioning));
  return owner;
}

// All values on rank 0, by rank.
template <typename T>
std::vector<T> onFirst(const Problem& p, const std::vector<T>& own) {
  std::vector<std::vector<T>> toRank(static_cast<std::size_t>(p.ranks));
  toRank[0] = own;
  return sendToRanks(comm, toRank).values;
}

std::vector<int> byMetis(const Problem& p) {
  std::vector<std::int64_t> degree;
  for (std::size_t c = 0; c < p.cells.size(); ++c) degree.push_back(p.start[c + 1] - p.start[c]);
  const auto degrees = onFirst(p, degree), neighbours = onFirst(p, p.neighbours),
             counts = onFirst<std::int64_t>(p, {static_cast<std::int64_t>(p.cells.size())});
  const auto weight = onFirst(p, p.weight);
  std::vector<std::vector<int>> toRank(static_cast<std::size_t>(p.ranks));
  if (!counts.empty()) {
    std::vector<idx_t> start{0}, adjacency(neighbours.begin(), neighbours.end()), weights(weight.size());
    for (const std::int64_t d : degrees) start.push_back(start.back() + static_cast<idx_t>(d));
    wholeWeights(weight, std::accumulate(weight.begin(), weight.end(), 0.0), static_cast<double>(weight.size()),
                 weights.data());
    std::vector<idx_t> part(weight.size(), 0), options(METIS_NOPTIONS);
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_SEED] = 1;
    idx_t vertices = static_cast<idx_t>(weight.size()), constraints = 1, parts = p.ranks, cut = 0;
    if (METIS_PartGraphRecursive(&vertices, &constraints, start.data(), adjacency.data(), weights.data(), nullptr,
                                 nullptr, &parts, nullptr, nullptr, options.data(), &cut, part.data()) != METIS_OK)
      throw std::runtime_error("METIS failed");
    auto next = part.begin();
    for (std::size_t r = 0; r < toRank.size(); next += counts[r++]) toRank[r].assign(next, next + counts[r]);
  }
  return sendToRanks(comm, toRank).values;
}

void measure(const Problem& p, const std::string& way,
             const std::function<std::vector<int>(const Problem&)>& partition) {
  malloc_trim(0);  // so that what was freed before does not serve unseen
  forgetPeakMemory();
  const double before = peakMemory();
  MPI_Barrier(comm);
  const double began = MPI_Wtime();
  const std::vector<int> owner = partition(p);
  MPI_Barrier(comm);
  const double seconds = MPI_Wtime() - began;
  const double memory = reduced(peakMemory() - before, MPI_DOUBLE, MPI_MAX);

  const Shares shares(comm, p.cells.numbers.empty() ? 0 : p.cells.numbers.front(),
                      reduced(static_cast<std::int64_t>(p.cells.size()), MPI_INT64_T, MPI_SUM));
  const auto beyond = ask<int>(comm, shares, p.neighbours, [&](std::int64_t number) {
    return owner[static_cast<std::size_t>(number - p.cells.numbers.front())];
  });
  const auto ranks = static_cast<std::size_t>(p.ranks);
  std::vector<double> weight(ranks, 0.0), seen(ranks, 0.0);
  std::vector<int> meets(ranks * ranks, 0);
  double cut = 0.0;
  for (std::size_t c = 0; c < p.cells.size(); ++c) {
    const auto own = static_cast<std::size_t>(owner[c]);
    weight[own] += p.weight[c];
    std::set<int> others;
    for (auto i = static_cast<std::size_t>(p.start[c]); i < static_cast<std::size_t>(p.start[c + 1]); ++i) {
      if (beyond[i] == owner[c]) continue;
      cut += 0.5;
      others.insert(beyond[i]);
      meets[own * ranks + static_cast<std::size_t>(beyond[i])] = 1;
    }
    seen[own] += static_cast<double>(others.size());
  }
  MPI_Allreduce(MPI_IN_PLACE, weight.data(), p.ranks, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, seen.data(), p.ranks, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, meets.data(), static_cast<int>(meets.size()), MPI_INT, MPI_MAX, comm);
  cut = reduced(cut, MPI_DOUBLE, MPI_SUM);
  int mostNeighbours = 0, rank = 0;
  for (std::size_t r = 0; r < ranks; ++r)
    mostNeighbours = std::max(
        mostNeighbours, static_cast<int>(std::count(meets.begin() + static_cast<std::ptrdiff_t>(r * ranks),
                                                    meets.begin() + static_cast<std::ptrdiff_t>((r + 1) * ranks), 1)));
  MPI_Comm_rank(comm, &rank);
  const double mean = std::accumulate(weight.begin(), weight.end(), 0.0) / p.ranks;
  if (rank == 0)
    fmt::print("| {} | {} | {} | {:.0f} | {:.0f} | {} | {:.3f} | {:.2f} | {:.1f} |\n", p.name, p.ranks, way, cut,
               *std::ranges::max_element(seen), mostNeighbours, *std::ranges::max_element(weight) / mean, seconds,
               memory / 0x1p20);
}

void compare(double cells) {
  std::vector<Problem> problems;
  const MeshSpec plane = box(2, cells), space = box(3, cells), triangles = box(2, 0.5 * cells);
  problems.push_back(problem("plane, flame band", boxBlock(comm, plane),
                             [](const Vector3& x) { return std::abs(x[1] - 0.45) < 0.05 ? 20.0 : 1.0; }));
  problems.push_back(problem("hexahedra", boxBlock(comm, space), [](const Vector3&) { return 1.0; }));
  problems.push_back(
      problem("skewed triangles, flame ring", test::SkewedMesh(comm, triangles, test::Cells::Triangles, 0.3).block(),
              [](const Vector3& x) { return std::abs(std::hypot(x[0] - 0.4, x[1] - 0.5) - 0.3) < 0.03 ? 20.0 : 1.0; }));
  for (const Problem& p : problems) {
    measure(p, "curve", byCurve);
    measure(p, "PT-Scotch", byPtScotch);
    measure(p, "METIS", byMetis);
  }
}

}  // namespace
}  // namespace lampblack::bench

int main(int argc, char** argv) {
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  lampblack::bench::compare(argc > 1 ? std::strtod(argv[1], nullptr) : 1.6e5);
  return PetscFinalize() == 0 ? 0 : 1;
}
