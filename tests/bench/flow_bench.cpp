// What a cell and step of a flow costs on one core: chemistry and transport of the ethylene counterflow flame
// (cases/flow/counterflow_ethylene, gas alone), while it ignites and near its steady state, and the errors of the
// chemistry against tight tolerances.
//
//   build/release/tests/bench/flow_bench                           (configured with -DLAMPBLACK_BENCH=ON; two minutes)
//   build/release/tests/bench/flow_bench mesh.refinement=0.5       (any keys of the deck)
//   build/release/tests/bench/flow_bench transport                 (the last part alone; half a minute)
//   mpirun -n 2 build/release/tests/bench/flow_bench transport     (PETSc reduces there, too)
//
// The states are those of the run: at some moments the cells are kept as they are handed to the chemistry, and advanced
// again by each method. "one by one" is how cells were advanced before vector lanes; both are timed in turns, the least
// of five.
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "chemistry/reactor/reactor.hpp"
#include "core/halo_exchange.hpp"
#include "core/mesh.hpp"
#include "core/petsc.hpp"
#include "flow/mixing_layer.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "tests/every_module.hpp"
#include "tests/source_folder.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::app;
using Reactor = ConstantPressureReactor;

long reductions = 0;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

FlowCase ethyleneFlame(std::vector<std::string> sets) {
  sets.insert(sets.begin(), "soot.model=none");
  return readFlowCase(Deck::load(test::sourceFolder / "cases/flow/counterflow_ethylene/deck.yaml", sets, flowSchema()));
}

// The cells of a flow as they are handed to the chemistry: as ReactionOperator does.
struct Cells {
  double time = 0, dt = 0;  // s
  std::vector<double> T, Y, source, heating, firstStep;
  double pressure = 0;

  [[nodiscard]] std::size_t size() const { return T.size(); }
  // Y: where they are advanced.
  [[nodiscard]] std::vector<Reactor::Cell> list(std::vector<double>& mass) const {
    const std::size_t n = Y.size() / size();
    mass = Y;
    std::vector<Reactor::Cell> result;
    for (std::size_t i = 0; i < size(); ++i)
      result.push_back({T[i], pressure, {&mass[i * n], n}, {&source[i * n], n}, firstStep[i], heating[i]});
    return result;
  }
};

// A flow of transport and chemistry, with the time that each takes.
class Run {
 public:
  explicit Run(FlowCase flowCase)
      : case_(std::move(flowCase)),
        mesh_(MPI_COMM_WORLD, case_.mesh),
        halo_(mesh_),
        thermo_(*case_.mechanism),
        transportModel_(*case_.mechanism, case_.transport.averaged()),
        context_{mesh_,
                 halo_,
                 *case_.mechanism,
                 thermo_,
                 transportModel_,
                 case_.boundaries,
                 case_.gravity,
                 case_.referenceDensity,
                 nullptr,
                 case_.transport},
        state_(mesh_, case_.mechanism->numSpecies(), {}),
        transport_(context_, state_, case_.flow),
        chemistry_(context_, case_.chemistry) {
    state_.thermodynamicPressure = case_.pressure;
    setMixingLayer(context_, case_.initial, state_);
    transport_.initialise(state_, case_.time.firstStep);
    beginNext();
    dt_ = case_.time.firstStep;
  }

  struct Cost {
    double chemistry = 0, transport = 0;  // s
    long reductions = 0;                  // of transport
    int steps = 0;
  };

  // One step; `cells`, if any, get what the chemistry of its last sweep was handed.
  void step(Cost& cost, Cells* cells = nullptr) {
    dt_ = std::min({case_.time.maximumStep, dt_ * case_.time.growth, transport_.largestStep(state_)});
    const State before = state_;
    for (int sweep = 0; sweep < case_.flow.sweeps; ++sweep) {
      const std::vector<double> rate = state_.balance.reactions;
      const long reductionsBefore = reductions;
      const double start = now();
      transport_.advance(state_, time_, dt_);
      const double middle = now();
      cost.transport += middle - start;
      cost.reductions += reductions - reductionsBefore;
      if (cells != nullptr) keep(*cells, before, rate);
      const double begin = now();
      chemistry_.advance(state_, time_, dt_);
      cost.chemistry += now() - begin;
      if (sweep + 1 < case_.flow.sweeps) endSweep();
    }
    beginNext();
    time_ += dt_;
    ++cost.steps;
  }

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] std::int64_t totalCells() const { return mesh_.totalCells; }
  [[nodiscard]] auto cells() const { return static_cast<std::size_t>(mesh_.owned); }
  [[nodiscard]] const FlowCase& flowCase() const { return case_; }
  ReactionOperator::Diagnostics diagnostics() { return chemistry_.takeDiagnostics(); }

 private:
  void endSweep() {
    transport_.endSweep(state_);
    chemistry_.endSweep(state_);
  }
  void beginNext() {
    transport_.endStep(state_);
    chemistry_.endStep(state_);
    endSweep();
  }

  void keep(Cells& cells, const State& before, const std::vector<double>& rate) const {
    const std::size_t n = case_.mechanism->numSpecies();
    cells = {time_,
             dt_,
             {},
             {},
             {},
             {},
             std::vector<double>(this->cells(), 0.0),
             0.5 * (before.thermodynamicPressure + state_.thermodynamicPressure)};
    for (std::size_t c = 0; c < this->cells(); ++c) {
      const std::span<const double> Y(&before.Y[c * n], n);
      cells.T.push_back(thermo_.temperatureFromEnthalpy(before.enthalpy[c], Y, before.temperature[c]));
      cells.heating.push_back((state_.enthalpy[c] - before.enthalpy[c]) / dt_);
      const double density = 0.5 * (before.density[c] + state_.density[c]);
      for (std::size_t k = 0; k < n; ++k) {
        cells.Y.push_back(Y[k]);
        cells.source.push_back((state_.Y[c * n + k] - Y[k]) / dt_ - rate[c * n + k] / density);
      }
    }
  }

  FlowCase case_;
  Mesh mesh_;
  HaloExchange halo_;
  Thermo thermo_;
  Transport transportModel_;
  FlowContext context_;
  State state_;
  TransportOperator transport_;
  ReactionOperator chemistry_;
  double time_ = 0, dt_ = 0;
};

// Largest and root-mean-square differences, of T in K and of mass fractions.
struct Errors {
  double largestT = 0, meanT = 0, largestY = 0, meanY = 0;
};

Errors difference(const std::vector<Reactor::Cell>& cells, const std::vector<Reactor::Cell>& exact) {
  Errors e;
  double values = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double byT = cells[i].temperature - exact[i].temperature;
    e.largestT = std::max(e.largestT, std::abs(byT));
    e.meanT += byT * byT;
    for (std::size_t k = 0; k < cells[i].Y.size(); ++k, ++values) {
      const double byY = cells[i].Y[k] - exact[i].Y[k];
      e.largestY = std::max(e.largestY, std::abs(byY));
      e.meanY += byY * byY;
    }
  }
  e.meanT = std::sqrt(e.meanT / static_cast<double>(cells.size()));
  e.meanY = std::sqrt(e.meanY / values);
  return e;
}

void compareMethods(const Mechanism& mechanism, Reactor::Options options, Cells cells) {
  const double count = static_cast<double>(cells.size());
  Reactor reactor(mechanism, options);
  options.rosenbrockSteps = 0;
  Reactor byCvode(mechanism, options), tight(mechanism, {1e-10, 1e-18, 1000000, 0.0, 0});
  std::vector<double> mass, exactMass;
  std::vector<Reactor::Result> results(cells.size());
  std::vector<Reactor::Cell> exact = cells.list(exactMass);
  for (auto& cell : exact) tight.advance(cell, cells.dt);
  const auto single = [&](Reactor& how) {
    return [&](std::vector<Reactor::Cell>& list) {
      for (std::size_t i = 0; i < list.size(); ++i) results[i] = how.advance(list[i], cells.dt);
    };
  };
  const auto together = [&](std::vector<Reactor::Cell>& list) { reactor.advance(list, cells.dt, results); };
  // First steps as in a run: those that the last interval asks for.
  auto list = cells.list(mass);
  together(list);
  for (std::size_t i = 0; i < cells.size(); ++i) cells.firstStep[i] = list[i].initialStep;
  struct Method {
    const char* name;
    std::function<void(std::vector<Reactor::Cell>&)> advance;
    double least = 1e9, steps = 0, handedOver = 0;
    Errors errors;
  };
  std::vector<Method> methods{{"together, in lanes", together, 1e9, 0, 0, {}},
                              {"one by one", single(reactor), 1e9, 0, 0, {}},
                              {"CVODE alone", single(byCvode), 1e9, 0, 0, {}}};
  for (int round = 0; round < 5; ++round)
    for (auto& method : methods) {
      list = cells.list(mass);
      const double start = now();
      method.advance(list);
      method.least = std::min(method.least, now() - start);
      method.errors = difference(list, exact);
      method.steps = method.handedOver = 0;
      for (const auto& result : results) {
        method.steps += result.steps;
        method.handedOver += result.handedOver;
      }
    }
  std::printf("  %-20s %10s %8s %8s   errors, largest / rms: %10s %21s\n", "method", "us a cell", "steps", "by CVODE",
              "T, K", "Y");
  for (const auto& method : methods)
    std::printf("  %-20s %10.2f %8.2f %8.0f %20s %8.1e / %7.1e  %8.1e / %7.1e\n", method.name,
                method.least / count * 1e6, method.steps / count, method.handedOver, "", method.errors.largestT,
                method.errors.meanT, method.errors.largestY, method.errors.meanY);
}

// From the start to each of the moments; the costs of the last 20 steps before it.
void chemistryAt(const std::vector<double>& moments, const std::vector<std::string>& sets) {
  Run run(ethyleneFlame(sets));
  std::printf("%zu cells, relative tolerance %g, absolute %g\n", run.cells(),
              run.flowCase().chemistry.reactor.relativeTolerance, run.flowCase().chemistry.reactor.absoluteTolerance);
  Run::Cost unused;
  for (const double moment : moments) {
    while (run.time() < moment) run.step(unused);
    (void)run.diagnostics();
    Run::Cost cost;
    for (int i = 0; i < 20; ++i) run.step(cost);
    const auto counts = run.diagnostics();
    Cells cells;
    run.step(unused, &cells);
    const double steps = static_cast<double>(run.cells()) * cost.steps;
    std::printf(
        "\nat %.3g ms, steps of %.3g us: chemistry %.2f, transport %.2f us a cell and step; %.2f steps a cell, %.1f %% "
        "by CVODE\n",
        cells.time * 1e3, cells.dt * 1e6, cost.chemistry / steps * 1e6, cost.transport / steps * 1e6,
        counts.solverSteps / steps, 100 * counts.handedOverCells / steps);
    compareMethods(*run.flowCase().mechanism, run.flowCase().chemistry.reactor, cells);
  }
}

// Of some steps after the first ones, as steps grow.
void transportOn(std::vector<std::string> sets, const char* refinement) {
  sets.push_back(std::string("mesh.refinement=") + refinement);
  Run run(ethyleneFlame(sets));
  Run::Cost start, cost;
  while (start.steps < 30) run.step(start);
  while (cost.steps < 10) run.step(cost);
  const auto cells = static_cast<std::size_t>(run.totalCells());
  const double steps = static_cast<double>(run.cells()) * cost.steps;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank > 0) return;
  std::printf("%6zu cells: transport %.2f, chemistry %.2f us a cell and step, %.1f reductions a step of transport\n",
              cells, cost.transport / steps * 1e6, cost.chemistry / steps * 1e6,
              static_cast<double>(cost.reductions) / cost.steps);
  std::fflush(stdout);
}

}  // namespace

// Counts what is reduced over all ranks, by PETSc as well, whose headers have macros of these names.
#undef MPI_Allreduce
#undef MPI_Iallreduce
extern "C" int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  ++reductions;
  return PMPI_Allreduce(in, out, count, type, op, comm);
}
extern "C" int MPI_Iallreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm,
                              MPI_Request* request) {
  ++reductions;
  return PMPI_Iallreduce(in, out, count, type, op, comm, request);
}

int main(int argc, char** argv) {
  checkPetsc(PetscInitializeNoArguments());
  std::vector<std::string> sets(argv + 1, argv + argc);
  const bool isShort = !sets.empty() && sets.front() == "transport";
  if (isShort)
    sets.erase(sets.begin());
  else
    chemistryAt({0.5e-3, 2e-3, 35e-3}, sets);
  std::printf("\nafter 30 steps, 10 steps on\n");
  transportOn(sets, "1");
  transportOn(sets, "4");
  checkPetsc(PetscFinalize());
  return 0;
}
