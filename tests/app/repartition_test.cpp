// A run whose mesh is partitioned anew, between two steps or where it goes on from a checkpoint: costly cells are
// spread evenly, and nothing else changes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>

#include "app/problems/flow/flow_loop.hpp"
#include "core/modules.hpp"
#include "io/checkpoint_folder.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/app/flow_results.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::app {
namespace {

using test::at;
using test::expectSameBits;
using test::expectSameFields;
using test::Ran;
using test::readBack;

// Cells where the fuel comes in cost their rank a hundred times what their transport does.
class CostlyBand final : public Operator {
 public:
  [[nodiscard]] const char* name() const override { return "band"; }
  void advance(State&, double, double) override { ++advanced; }
  int advanced = 0;
  void addCost(const Mesh& mesh, CellCost& cost) const override {
    for (int c = 0; c < mesh.owned; ++c)
      if (mesh.centre[at(c)][0] < 7e-3 && mesh.centre[at(c)][1] < 2.5e-3) cost.own[at(c)] += costOfCell;
  }
  static constexpr double costOfCell = 2e3;
};

// Some 30 steps of 135 cells, with what operators keep: swirl and soot. Its start is sudden, which is not looked at
// here.
std::vector<std::string> settings(const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{"time.end=50 us",
                               "time.maximum_step=2 us",
                               "output.interval=25 us",
                               "output.history_steps=4",
                               "mesh.refinement=1.5",
                               "boundaries.fuel.swirl_velocity=10 cm/s",
                               "output.species=[O2, OH]",
                               "output.boundaries=[all]",
                               "output.probes.flame.at=[5 mm, 2 mm]",
                               "time.temperature_change=5000 K"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// Never, as a run that looks for it.
const std::string steady = "time.steady={time: 12 us, tolerance: 1e-9}";

struct Task {
  std::filesystem::path folder;
  std::vector<std::string> overrides;
  std::optional<std::filesystem::path> restart = {};  // folder of a run, which goes on from its last checkpoint
  MPI_Comm comm = MPI_COMM_WORLD;
  std::function<void(FlowLoop&)> before = {}, after = {};
};

// Only ranks of its communicator run it; all read what came of it.
Ran run(const Task& task) {
  std::int64_t partitions = 0;
  if (task.comm != MPI_COMM_NULL) {
    FlowCase flowCase = readFlowCase(test::flameDeck(task.overrides));
    flowCase.trajectories.reset();
    CostlyBand band;
    FlowLoop loop(task.comm, std::move(flowCase));
    loop.addOperator(band);
    if (task.restart) loop.load(newestCheckpoint(task.comm, *task.restart));
    if (task.before) task.before(loop);
    loop.run(RunFolder::prepare(task.folder, false, task.comm), {"test", "none", {}, "now"});
    if (task.after) task.after(loop);
    RunRecord record;
    loop.count(record);
    if (!task.restart) {
      EXPECT_GE(band.advanced, record.steps) << "as every operator";
    }
    partitions = loop.costs().partitions();
  }
  MPI_Barrier(MPI_COMM_WORLD);
  Ran ran = readBack(task.folder / "results.h5");
  ran.partitions = partitions;
  return ran;
}

// Pieces of the curve end at cells: a rank is a cell off at most at either end.
void expectBalanced(const FlowLoop& loop) {
  const std::vector<double>& cost = loop.costs().average().own;
  ASSERT_EQ(cost.size(), at(loop.mesh().owned));
  double own = std::accumulate(cost.begin(), cost.end(), 0.0), sum = 0.0;
  MPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, loop.mesh().comm);
  EXPECT_NEAR(own, sum / loop.mesh().ranks, 1.1 * CostlyBand::costOfCell);
  EXPECT_EQ(loop.costs().ranks(), loop.mesh().ranks);
}

double imbalance(const FlowLoop& loop) {
  return imbalanceOf(loop.mesh().comm, loop.costs().average());
}

TEST(Repartition, CountsWhatIsSharedAsEven) {
  CellCost cost(1);
  cost.own = {test::worldRank() == 0 ? 4.0 : 1.0};
  cost.shared = {test::worldRank() == 0 ? 0.0 : 6.0};
  const double ranks = test::worldSize();
  const double shared = 6.0 * (ranks - 1.0) / ranks;
  EXPECT_DOUBLE_EQ(imbalanceOf(MPI_COMM_WORLD, cost), (4.0 + shared) / ((3.0 + ranks) / ranks + shared));
}

TEST(Repartition, BalancesABandOfCostlyCellsAndChangesNothingElse) {
  const test::SharedScratchFolder scratch;
  const Ran even = run({.folder = scratch.path() / "even",
                        .overrides = settings({steady, "mesh.repartition=10"}),
                        .after = [](const FlowLoop& loop) {
                          if (loop.mesh().ranks > 1) {
                            EXPECT_GT(imbalance(loop), 1.2);
                          }
                        }});
  EXPECT_EQ(even.partitions, 0);
  const Ran anew = run({.folder = scratch.path() / "anew",
                        .overrides = settings({steady, "mesh.repartition=1.2"}),
                        .after = expectBalanced});
  EXPECT_EQ(anew.partitions, test::worldSize() > 1 ? 1 : 0);
  if (test::worldSize() == 1) return expectSameBits(anew, even);
  expectSameFields(anew, even);
  EXPECT_NE(anew.fields, even.fields) << "sums in another order show in the last bits";
}

// The ensembles of the cells go along, each once.
TEST(Repartition, TakesEnsemblesAlong) {
  const test::SharedScratchFolder scratch;
  const std::vector<std::string> ensembles{"particles.description=ensemble", "particles.number=40",
                                           "particles.minimum_number_density=1e9 1/m^3", "particles.exchange=one_way"};
  const auto with = [&](const std::string& repartition) {
    std::vector<std::string> all = ensembles;
    all.push_back(repartition);
    return settings(all);
  };
  const Ran even = run({.folder = scratch.path() / "even", .overrides = with("mesh.repartition=10")});
  const Ran anew = run({.folder = scratch.path() / "anew", .overrides = with("mesh.repartition=1.2")});
  EXPECT_EQ(anew.partitions, test::worldSize() > 1 ? 1 : 0);
  EXPECT_GT(even.history.at("numerical_particles").back(), 100.0);
  EXPECT_EQ(anew.history.at("numerical_particles"), even.history.at("numerical_particles"));
  expectSameFields(anew, even);
}

TEST(Repartition, IntoTheSamePiecesKeepsEveryBit) {
  const test::SharedScratchFolder scratch;
  const auto overrides =
      settings({steady, "checkpoint.steps=16", "mesh.refinement=1", "time.sweeps=2", "time.tolerance=0.01"});
  const Ran whole = run({.folder = scratch.path() / "whole", .overrides = overrides});
  expectSameBits(run({.folder = scratch.path() / "rest", .overrides = overrides, .restart = scratch.path() / "whole"}),
                 whole);
  expectSameBits(run({.folder = scratch.path() / "moved",
                      .overrides = overrides,
                      .restart = scratch.path() / "whole",
                      .before =
                          [](FlowLoop& loop) {
                            const std::vector<std::int64_t> cells = loop.mesh().naturalCell;
                            loop.repartition(std::vector<double>(at(loop.mesh().owned), 1.0));
                            EXPECT_EQ(loop.mesh().naturalCell, cells);
                          }}),
                 whole);
}

TEST(Repartition, IsTakenUpByARestartToTheLastBit) {
  const test::SharedScratchFolder scratch;
  const auto overrides = settings({steady, "mesh.repartition=1.2", "checkpoint.steps=24"});
  const Ran whole = run({.folder = scratch.path() / "whole", .overrides = overrides});
  const Ran rest = run({.folder = scratch.path() / "rest",
                        .overrides = overrides,
                        .restart = scratch.path() / "whole",
                        .before = expectBalanced});
  expectSameBits(rest, whole);
  EXPECT_EQ(rest.partitions, whole.partitions);
}

// One rank fewer, and from one rank as many as there are.
TEST(Repartition, PartitionsARestartOnOtherRanksByWhatCellsHaveCost) {
  if (test::worldSize() == 1) GTEST_SKIP() << "needs more than one rank";
  const test::SharedScratchFolder scratch;
  MPI_Comm fewer = MPI_COMM_NULL, one = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, test::worldRank() + 1 < test::worldSize() ? 0 : MPI_UNDEFINED, 0, &fewer);
  MPI_Comm_split(MPI_COMM_WORLD, test::worldRank() == 0 ? 0 : MPI_UNDEFINED, 0, &one);
  const auto overrides = settings({"checkpoint.steps=16"});
  const Ran whole = run({.folder = scratch.path() / "whole", .overrides = overrides});
  expectSameFields(run({.folder = scratch.path() / "fewer",
                        .overrides = overrides,
                        .restart = scratch.path() / "whole",
                        .comm = fewer,
                        .before = expectBalanced}),
                   whole);
  run({.folder = scratch.path() / "one", .overrides = overrides, .comm = one});
  expectSameFields(run({.folder = scratch.path() / "more",
                        .overrides = overrides,
                        .restart = scratch.path() / "one",
                        .before = expectBalanced}),
                   whole);
  for (MPI_Comm* comm : {&fewer, &one})
    if (*comm != MPI_COMM_NULL) MPI_Comm_free(comm);
}

}  // namespace
}  // namespace lampblack::app
