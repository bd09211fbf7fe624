// Whole flames from their streams to a converged solution, and where the time goes: a freely propagating flame of
// methane in air (GRI-Mech 3.0) and counterflow flames of ethylene. Seconds are those of this run; repeat.
//
//   build/release/tests/bench/flame_bench [free|freeMulticomponent|methane|ethylene47|ethylene101]...   (mpiexec -n 2
//   for two ranks)
#include <fmt/format.h>
#include <mpi.h>
#include <petscsys.h>

#include <memory>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "flow/flame/flame_solver.hpp"
#include "flow/flame/initial_flame.hpp"
#include "tests/bench/processor_time.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flame/streams.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;
using MechanismPointer = std::shared_ptr<const Mechanism>;

struct Case {
  const char *name, *mechanism;
  FlameType type;
  double length;
  const char *left, *right;  // mole fractions
  double leftVelocity, rightVelocity, temperature;
  GridOptions grid;
  TransportModel transport;
};

// Those of the peers' timings: the free flame at ratio 3, slope 0.06, curve 0.12; others at slope 0.08.
const std::vector<Case> cases{
    {"free", "methane_gri30_53", FlameType::Free, 0.06, "CH4: 1, O2: 2, N2: 7.52", nullptr, 0.4, 0, 300, {}, {}},
    {"freeMulticomponent",
     "methane_gri30_53",
     FlameType::Free,
     0.06,
     "CH4: 1, O2: 2, N2: 7.52",
     nullptr,
     0.4,
     0,
     300,
     {},
     {.diffusion = TransportModel::Diffusion::Multicomponent, .soret = true, .lewisNumbers = {}}},
    {"methane",
     "methane_gri30_53",
     FlameType::Counterflow,
     0.02,
     "CH4: 1",
     "O2: 0.21, N2: 0.79",
     0.335,
     0.25,
     298,
     {.slope = 0.08},
     {}},
    {"ethylene47",
     "ethylene_bisetti2012_47",
     FlameType::Counterflow,
     0.008,
     "C2H4: 1",
     "O2: 0.25, N2: 0.75",
     0.2,
     0.2,
     298,
     {.slope = 0.08},
     {}},
    {"ethylene101",
     "ethylene_abf2000_101",
     FlameType::Counterflow,
     0.008,
     "C2H4: 1",
     "O2: 0.27, N2: 0.73",
     0.2,
     0.2,
     298,
     {.slope = 0.08},
     {}},
};

void solve(const Case& c) {
  const MechanismPointer mechanism =
      std::make_shared<const Mechanism>(shippedMechanism(std::string(c.mechanism) + ".yaml"));
  FlameProblem problem;
  problem.type = c.type;
  problem.length = c.length;
  problem.left = streamAt(*mechanism, c.left, c.temperature, c.leftVelocity);
  if (c.right != nullptr) problem.right = streamAt(*mechanism, c.right, c.temperature, c.rightVelocity);
  FlameSolverOptions options;
  options.grid = c.grid;
  problem.transport = c.transport;
  const double start = MPI_Wtime();
  const double started = bench::processorSeconds();
  FlameSolver solver(MPI_COMM_WORLD, mechanism, problem, nullptr, options);
  std::vector<double> stageEnds;
  solver.onStage(
      [&](const FlameStage&, const FlameProfile&) { stageEnds.push_back(bench::processorSeconds() - started); });
  const auto solution = solver.solve(initialFlame(*mechanism, problem, 0));
  const double seconds = MPI_Wtime() - start;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) return;
  const auto& n = solution.counters;
  fmt::print("{}: {:.2f} s, {} points, {} stages, hottest {:.1f} K, mass flux {:.5f} kg/m2/s\n", c.name, seconds,
             solution.profile.points(), solution.stages.size(), solution.profile.peakTemperature(),
             solution.profile.global(leftMassFlux));
  fmt::print("  {} residuals {:.2f} s, {} matrices (of {} points) {:.2f} s, factors {:.2f} s, solutions {:.2f} s\n",
             n.residuals, n.residualSeconds, n.jacobians, n.jacobianPoints, n.jacobianSeconds, n.factoriseSeconds,
             n.solveSeconds);
  for (std::size_t i = 0; i < solution.stages.size(); ++i) {
    const auto& stage = solution.stages[i];
    fmt::print("  {:<24} {:>4} points {:6.2f} s, processor time until here {:.2f} s\n", stage.name, stage.points,
               stage.seconds, stageEnds[i]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (PetscInitializeNoArguments() != 0) return 1;
  for (const auto& c : cases) {
    bool wanted = argc == 1;
    for (int i = 1; i < argc; ++i) wanted = wanted || argv[i] == std::string(c.name);
    if (wanted) solve(c);
  }
  return PetscFinalize() == 0 ? 0 : 1;
}
