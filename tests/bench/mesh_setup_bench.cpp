// What the set-up of a mesh takes, stage by stage: seconds and memory. Run by hand, on any number of ranks:
//   mpirun -n 2 mesh_setup_bench plane 1000000
//   mpirun -n 2 mesh_setup_bench space 1000000
// A stage's memory is the highest that a rank had in it, all that was kept from earlier stages included, without what
// the program had when it began.
#include <fmt/format.h>
#include <malloc.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "core/box_mesh.hpp"
#include "core/mesh.hpp"
#include "core/mesh_connect.hpp"
#include "core/mesh_distribution.hpp"
#include "tests/bench/memory_use.hpp"
#include "tests/bench/processor_time.hpp"
#include "tests/every_module.hpp"

namespace lampblack::bench {
namespace {

std::vector<double> axis(int cells) {
  std::vector<double> places;
  for (int i = 0; i <= cells; ++i) places.push_back(static_cast<double>(i) / cells);
  return places;
}

MeshSpec box(bool isSpace, double cells) {
  MeshSpec spec;
  const int along = static_cast<int>(std::lround(std::pow(cells, isSpace ? 1.0 / 3.0 : 0.5)));
  for (int i = 0; i < (isSpace ? 3 : 2); ++i) {
    spec.vertices[static_cast<std::size_t>(i)] = axis(along);
    for (const bool atMax : {false, true})
      spec.patches.push_back({std::string(1, "xyz"[i]) + (atMax ? "-max" : "-min"), i, atMax});
  }
  return spec;
}

class Stages {
 public:
  explicit Stages(std::int64_t cells) : cells_(static_cast<double>(cells)) {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    if (rank_ == 0)
      fmt::print("{:.0f} cells on {} ranks\n{:12} {:>9} {:>11} {:>14} {:>12}\n", cells_, ranks_, "stage", "s",
                 "processor s", "MiB a rank", "B a cell");
  }

  template <typename Work>
  auto run(const std::string& name, Work&& work) {
    malloc_trim(0);
    forgetPeakMemory();
    MPI_Barrier(MPI_COMM_WORLD);
    const double start = MPI_Wtime();
    const double worked = processorSeconds();
    auto result = work();
    double processor = processorSeconds() - worked;
    MPI_Allreduce(MPI_IN_PLACE, &processor, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    const double seconds = MPI_Wtime() - start;
    const double own = peakMemory() - base_;
    std::array<double, 2> memory{own, own};
    MPI_Allreduce(MPI_IN_PLACE, memory.data(), 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &memory[1], 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    if (rank_ == 0)
      fmt::print("{:12} {:9.3f} {:11.3f} {:14.1f} {:12.0f}\n", name, seconds, processor, memory[0] / 0x1p20,
                 memory[1] / cells_);
    return result;
  }

 private:
  double cells_;
  double base_ = peakMemory();
  int rank_ = 0, ranks_ = 1;
};

void measure(bool isSpace, double wanted) {
  const MeshSpec spec = box(isSpace, wanted);
  std::int64_t cells = 1;
  for (const auto& places : spec.vertices)
    cells *= std::max<std::int64_t>(1, static_cast<std::int64_t>(places.size()) - 1);
  Stages stages(cells);
  {
    auto block = std::make_unique<MeshBlock>(stages.run("box", [&] { return boxBlock(MPI_COMM_WORLD, spec); }));
    ConnectedCells connected = stages.run("connect", [&] { return connect(MPI_COMM_WORLD, *block); });
    block.reset();
    const auto owner =
        stages.run("partition", [&] { return ownersOf(MPI_COMM_WORLD, connected.cells, spec.dimension(), {}); });
    stages.run("distribute", [&] { return distribute(MPI_COMM_WORLD, std::move(connected.cells), cells, owner); });
  }
  const auto mesh = stages.run("all", [&] { return std::make_unique<Mesh>(MPI_COMM_WORLD, spec); });
  stages.run("kept", [&] { return 0; });
}

}  // namespace
}  // namespace lampblack::bench

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const std::string shape = argc == 3 ? argv[1] : "";
  if (shape != "plane" && shape != "space") {
    fmt::print(stderr, "usage: mesh_setup_bench plane|space <cells>\n");
    MPI_Abort(MPI_COMM_WORLD, 2);
  }
  lampblack::bench::measure(shape == "space", std::strtod(argv[2], nullptr));
  MPI_Finalize();
}
