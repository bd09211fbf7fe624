// The partitioners side by side, for as many parts as there are ranks. Run by hand:
//   mpirun --oversubscribe -n 64 partition_bench [cells]
#include <fmt/format.h>
#include <malloc.h>
#include <mpi.h>

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
#include "core/partition.hpp"
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

void measure(const Problem& p, const std::string& way, Partitioner partitioner) {
  malloc_trim(0);  // so that what was freed before does not serve unseen
  forgetPeakMemory();
  const double before = peakMemory();
  MPI_Barrier(comm);
  const double began = MPI_Wtime();
  const std::vector<int> owner = ownersOf(comm, p.cells, p.dimension, {partitioner, p.weight});
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
    measure(p, "curve", Partitioner::Curve);
    measure(p, "PT-Scotch", Partitioner::PtScotch);
    measure(p, "METIS", Partitioner::Metis);
  }
}

}  // namespace
}  // namespace lampblack::bench

int main(int argc, char** argv) {
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  lampblack::bench::compare(argc > 1 ? std::strtod(argv[1], nullptr) : 1.6e5);
  return PetscFinalize() == 0 ? 0 : 1;
}
