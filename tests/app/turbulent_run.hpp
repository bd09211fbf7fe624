// Runs of turbulent flows, on any communicator, from a checkpoint, and moved onto other pieces of the mesh.
#pragma once

#include <optional>

#include "tests/app/flow_results.hpp"
#include "tests/app/flow_runs.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {

struct TurbulentRun {
  Deck deck;
  std::filesystem::path folder;
  std::optional<std::filesystem::path> restart = {};
  bool isMoved = false;  // onto other pieces, before the first step
  MPI_Comm comm = MPI_COMM_WORLD;
};

inline test::Ran resultsOf(const TurbulentRun& of) {
  if (of.comm != MPI_COMM_NULL) {
    FlowLoop loop(of.comm, readFlowCase(of.deck));
    if (of.restart) loop.load(newestCheckpoint(of.comm, *of.restart));
    if (of.isMoved) {
      const Mesh& mesh = loop.mesh();
      std::vector<double> costs(test::at(mesh.owned), 1.0);
      for (std::size_t c = 0; c < costs.size(); ++c)
        if (mesh.centre[c][0] > 0.1) costs[c] = 3.0;
      const std::vector<std::int64_t> before = mesh.naturalCell;
      loop.repartition(costs);
      if (mesh.ranks == 2) {
        EXPECT_NE(loop.mesh().naturalCell, before);
      }
    }
    loop.run(RunFolder::prepare(of.folder, false, of.comm), {"test", "none", of.deck.resolved(), "now"});
  }
  MPI_Barrier(MPI_COMM_WORLD);
  return test::readBack(of.folder / "results.h5");
}

}  // namespace lampblack::app
