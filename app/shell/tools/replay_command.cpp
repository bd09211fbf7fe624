#include "app/shell/tools/replay_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "chemistry/reactor/reactor_replay.hpp"
#include "core/errors.hpp"
#include "core/parallel_session.hpp"

namespace lampblack::app {
namespace {

using Event = ConstantPressureReactor::Event;

void printEvent(const Event& event) {
  switch (event.kind) {
    case Event::Kind::Attempt:
      fmt::print(
          "attempt {} by {}: relative tolerance {:g}, absolute tolerance {:g}, first step {}, at most {} steps in each "
          "of {} "
          "part(s)\n{:>24} {:>12} {:>6} {:>14}\n",
          event.attempt, event.method == ConstantPressureReactor::Method::Bdf ? "CVODE" : "the Rosenbrock method",
          event.relativeTolerance, event.absoluteTolerance,
          event.firstStep > 0 ? fmt::format("{:g} s", event.firstStep) : "of the method's choice", event.maxSteps,
          event.parts, "time, s", "step, s", "order", "T, K");
      break;
    case Event::Kind::Step:
      fmt::print("{:24.17g} {:12.4e} {:6} {:14.6f}\n", event.time, event.stepSize, event.order, event.temperature);
      break;
    case Event::Kind::Failed:
      fmt::print("attempt {} failed at T = {:.6f} K: {}\n", event.attempt, event.temperature, event.reason);
      break;
    case Event::Kind::Done:
      fmt::print("attempt {} reached the end\n", event.attempt);
      break;
  }
}

void replay(const std::string& path, bool print) {
  auto [mechanism, failed] = readReplay(path);
  ConstantPressureReactor reactor(mechanism, failed.options);
  ConstantPressureReactor::Cell cell{failed.temperature, failed.pressure, failed.Y,         failed.source,
                                     failed.firstStep,   failed.heating,  failed.rateFactor};
  if (print)
    fmt::print("{}: {} species, T = {:.6g} K, p = {:.6g} Pa, dt = {:.6g} s\nit failed with: {}\n", mechanism.fileName(),
               mechanism.numSpecies(), failed.temperature, failed.pressure, failed.duration, failed.reason);
  const auto result = reactor.advance(cell, failed.duration, print ? printEvent : ConstantPressureReactor::Observer());
  if (!print) return;
  if (result.skipped) fmt::print("advanced without integration: the chemistry is negligible\n");
  fmt::print("end: T = {:.6f} K, {} steps, {} rate evaluations, {} Jacobians, {} retries\n", cell.temperature,
             result.steps, result.rhsEvaluations, result.jacobianEvaluations, result.retries);
}

}  // namespace

void addReplayCommand(CLI::App& app, Command& command) {
  const auto file = std::make_shared<std::string>();
  CLI::App* subcommand = app.add_subcommand("replay", "Advance a cell again whose chemistry failed in a run.");
  subcommand->add_option("file", *file, "failed_cell_<number>.yaml of that run.")->required();
  subcommand->callback([file, &command] {
    command = {[file] { collectively(MPI_COMM_WORLD, [&] { replay(*file, placeOfProcess().rank == 0); }); }};
  });
}

}  // namespace lampblack::app
