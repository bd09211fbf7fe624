#include "app/reactor_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/reactor_case.hpp"
#include "app/reactor_output.hpp"
#include "chemistry/ignition_sensitivity.hpp"
#include "core/errors.hpp"
#include "io/history.hpp"
#include "io/json.hpp"
#include "io/report.hpp"

namespace lampblack {
namespace {

// What rank 0 found out about a closed reactor; the other ranks have an empty one.
struct ClosedResult {
  std::vector<std::optional<IgnitionEvent>> events;
  IgnitionSensitivities sensitivities;
  StiffIntegrator::Statistics statistics;
  double startTemperature = 0, endTemperature = 0, endPressure = 0;
  double seconds = 0, sensitivitySeconds = 0;
};

// Rows of the history: each step, or at regular times by interpolation, and the last state in any case.
class ClosedHistory {
 public:
  ClosedHistory(const ReactorCase& reactorCase, ClosedReactor& reactor, HistoryWriter& history)
      : case_(reactorCase), reactor_(reactor), history_(history), y_(reactor.size()) {}

  void start(std::span<const double> y) { row(0.0, y); }

  void step(const StiffIntegrator& integrator) {
    if (!case_.output.interval) {
      row(integrator.time(), integrator.state());
      return;
    }
    for (double next = nextTime(); next <= integrator.time(); next = nextTime()) {
      integrator.interpolate(next, y_);
      row(next, y_);
    }
    if (integrator.time() >= case_.end && last_ < case_.end) row(integrator.time(), integrator.state());
  }

 private:
  double nextTime() const { return static_cast<double>(rows_) * *case_.output.interval; }
  void row(double time, std::span<const double> y) {
    history_.row(closedRow(case_, reactor_, time, y));
    last_ = time;
    ++rows_;
  }

  const ReactorCase& case_;
  ClosedReactor& reactor_;
  HistoryWriter& history_;
  std::vector<double> y_;
  std::int64_t rows_ = 0;
  double last_ = 0;
};

ClosedResult runClosed(const ReactorCase& reactorCase, HistoryWriter& historyWriter) {
  const double begin = MPI_Wtime();
  ClosedResult result;
  ClosedReactor reactor(
      *reactorCase.mechanism, reactorCase.initial,
      reactorCase.type == ReactorType::ConstantPressure ? ReactorSystem::Held::Pressure : ReactorSystem::Held::Density,
      reactorCase.profile);
  StiffIntegrator integrator(reactor, reactorCase.integrator);
  IgnitionMonitor monitor(*reactorCase.mechanism, reactor, reactorCase.ignition);
  ClosedHistory history(reactorCase, reactor, historyWriter);
  const std::vector<double> start = reactor.initialState();
  integrator.start(0.0, start, reactorCase.end);
  monitor.begin(0.0, start.data());
  history.start(start);
  while (integrator.time() < reactorCase.end) {
    if (reactorCase.profile)
      integrator.stopAt(reactorCase.profile->nextKink(integrator.time()).value_or(reactorCase.end));
    integrator.step();
    monitor.observe(integrator);
    history.step(integrator);
  }
  result.events = monitor.events();
  result.statistics = integrator.statistics();
  result.startTemperature = start.back();
  result.endTemperature = integrator.state().back();
  result.endPressure = reactor.pressure(integrator.state().data());
  result.seconds = MPI_Wtime() - begin;
  if (!reactorCase.sensitivities.empty()) {
    reactor.setParameters(reactorCase.sensitivities);
    result.sensitivities = ignitionSensitivities(*reactorCase.mechanism, reactor, reactorCase.integrator,
                                                 reactorCase.ignition, result.events);
    result.sensitivitySeconds = MPI_Wtime() - begin - result.seconds;
  }
  return result;
}

std::string resultsJson(const ReactorCase& reactorCase, const ClosedResult& result) {
  JsonWriter json;
  json.beginObject();
  json.key("ignition_delays_s").beginObject();
  for (std::size_t i = 0; i < reactorCase.ignition.size(); ++i) {
    json.key(reactorCase.ignition[i].name);
    if (result.events[i])
      json.value(result.events[i]->time);
    else
      json.null();
  }
  json.endObject();
  json.field("final_temperature_K", result.endTemperature).field("final_pressure_Pa", result.endPressure);
  json.field("rate_evaluations", static_cast<std::int64_t>(result.statistics.rateEvaluations));
  json.field("jacobian_evaluations", static_cast<std::int64_t>(result.statistics.jacobianEvaluations));
  json.endObject();
  return json.text();
}

// The reactions the delay depends on most, for the console.
void printSensitivities(const ReactorCase& reactorCase, const IgnitionSensitivities& sensitivities) {
  constexpr std::size_t shown = 10;
  for (std::size_t i = 0; i < reactorCase.ignition.size(); ++i) {
    const auto& values = sensitivities.values[i];
    if (values.empty()) continue;
    std::vector<std::size_t> order(values.size());
    for (std::size_t p = 0; p < order.size(); ++p) order[p] = p;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return std::abs(values[a]) > std::abs(values[b]); });
    fmt::print("\nd ln tau / d ln k by {}\n", describe(reactorCase.ignition[i], *reactorCase.mechanism));
    for (std::size_t j = 0; j < std::min(shown, order.size()); ++j) {
      const std::size_t r = reactorCase.sensitivities[order[j]];
      fmt::print("  {:>5}  {:<40} {:>9.4f}\n", r + 1, reactorCase.mechanism->reaction(r).equation, values[order[j]]);
    }
    return;  // the first criterion that was met; all of them are in the files
  }
}

void printSummary(const ReactorCase& reactorCase, const ClosedResult& result) {
  for (std::size_t i = 0; i < reactorCase.ignition.size(); ++i) {
    const std::string what = describe(reactorCase.ignition[i], *reactorCase.mechanism);
    if (result.events[i])
      fmt::print("ignition delay, {:<32} {:.6e} s\n", what, result.events[i]->time);
    else
      fmt::print("ignition delay, {:<32} none in {:g} s\n", what, reactorCase.end);
  }
  if (!reactorCase.profile && std::abs(result.endTemperature - result.startTemperature) < 50)
    fmt::print("note: the temperature changed by {:.2g} K only; this gas has not ignited\n",
               result.endTemperature - result.startTemperature);
  fmt::print("T = {:.4f} K, p = {:.6g} Pa after {:g} s\n", result.endTemperature, result.endPressure, reactorCase.end);
  fmt::print("{} steps, {} rate and {} Jacobian evaluations of the integrator in {}\n", result.statistics.steps,
             result.statistics.rateEvaluations, result.statistics.jacobianEvaluations, formatDuration(result.seconds));
  if (reactorCase.sensitivities.empty()) return;
  fmt::print("sensitivities to {} reactions: {} steps in {}\n", reactorCase.sensitivities.size(),
             result.sensitivities.statistics.steps, formatDuration(result.sensitivitySeconds));
  printSensitivities(reactorCase, result.sensitivities);
}

}  // namespace

std::string checkReactor(MPI_Comm comm, const Deck& deck) {
  ReactorCase reactorCase;
  collectively(comm, [&] { reactorCase = readReactorCase(deck); });
  return fmt::format("{}, {} species, {} reactions", deck.choice("reactor.type"), reactorCase.mechanism->numSpecies(),
                     reactorCase.mechanism->numReactions());
}

void runReactor(MPI_Comm comm, const Deck& deck, const RunOptions& options) {
  ReactorCase reactorCase;
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  collectively(comm, [&] { reactorCase = readReactorCase(deck); });
  recordedRun(comm, deck, options, 0, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
    ClosedResult result;
    std::optional<HistoryWriter> history;
    collectively(comm, [&] {
      history.emplace(comm, folder.history(), closedColumns(reactorCase));
      if (rank != 0) return;
      result = runClosed(reactorCase, *history);
      if (!reactorCase.sensitivities.empty())
        writeSensitivityTable(folder.file("sensitivities.csv"), reactorCase, result.sensitivities);
      record.resultsJson = resultsJson(reactorCase, result);
      record.steps = result.statistics.steps;
      record.stages = {{"integration", result.seconds, result.seconds, result.seconds}};
    });
    ResultsWriter results(comm, folder.results(), info);
    history->writeTo(results);
    writeIgnition(results, reactorCase, result.events);
    if (!reactorCase.sensitivities.empty()) writeSensitivities(results, reactorCase, result.sensitivities);
    results.close();
    record.simulatedTime = reactorCase.end;
    record.peakMemoryPerRank = peakMemory(comm);
    if (rank == 0) printSummary(reactorCase, result);
  });
}

}  // namespace lampblack
