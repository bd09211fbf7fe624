#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/deck/sensitivity_deck.hpp"
#include "app/problems/flame/flame_branch.hpp"
#include "app/problems/flame/flame_case.hpp"
#include "app/problems/flame/flame_in_time.hpp"
#include "app/problems/flame/flame_output.hpp"
#include "app/problems/flame/flame_stochastic.hpp"
#include "app/run/prepared_run.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "core/timers.hpp"
#include "flow/flame/flame_from_lower_load.hpp"
#include "flow/flame/flame_sensitivity.hpp"

namespace lampblack::app {
namespace {

std::vector<FlameProfile> firstProfiles(const Deck& deck, const FlameCase& flame) {
  const std::vector<std::string> names = flame.scalarNames();
  try {
    if (flame.initial) return {startFrom(*flame.initial, *flame.mechanism, flame.problem, names)};
    return initialFlames(*flame.mechanism, flame.problem, names.size(), flame.start);
  } catch (const InputError& error) {
    const std::string what = error.what(), about = "flame: ";
    const bool counterflow = flame.problem.type == FlameType::Counterflow;
    throw deck.error(flame.initial ? "initial"
                     : counterflow ? "left"
                                   : "inlet",
                     what.starts_with(about) ? what.substr(about.size()) : what);
  }
}

std::vector<StageTime> stageTimes(MPI_Comm comm, const FlameEquations::Counters& counters) {
  std::vector<StageTime> stages;
  for (const auto& [name, seconds] : {std::pair{"residuals", counters.residualSeconds},
                                      {"matrices", counters.jacobianSeconds},
                                      {"factorisation", counters.factoriseSeconds},
                                      {"solution", counters.solveSeconds}}) {
    const Timers::Stage stage = Timers::overRanks(comm, name, seconds);
    stages.push_back({stage.name, stage.least, stage.mean, stage.most});
  }
  return stages;
}

// The solution, or how far it came and why it went no further; and what was followed from there.
struct Attempt {
  FlameResult result;
  std::optional<StochasticFlame> stochastic;
  std::optional<FlameBranchResult> branch;
  std::optional<FlameInTime> course;
  std::unique_ptr<HistoryWriter> history;  // of the course
  std::optional<double> extinctionLoad;    // of a flame that is out
  std::vector<Sensitivities> sensitivities;
  std::optional<std::string> failure;
};

// Where a warm start went out: the flame from lower velocities, if it burns.
void relight(MPI_Comm comm, const FlameCase& flame, FlameSolver& solver, FlameSolution& solution, Attempt& attempt) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank == 0) fmt::print("the flame went out; from lower velocities: load, largest temperature\n");
  const auto say = [rank](const std::string& line) {
    if (rank != 0) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  const RaisedFlame raised = flameFromLowerLoad(
      comm, flame.mechanism, flame.problem, flame.solver, flame.start,
      [&](double load, double peak) { say(fmt::format("  {:>12.6g} {:>10.2f} K", load, peak)); },
      [&](double load) { say(fmt::format("  {:>12.6g} is tried", load)); });
  attempt.extinctionLoad = raised.extinctionLoad;
  if (raised.profile) solution = solver.solve(withLayout(*raised.profile, solution.profile.layout));
}

Attempt solve(MPI_Comm comm, FlameCase& flame, const std::vector<FlameProfile>& starts) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const bool warm = isWarm(flame.problem, starts.front());
  FlameSolver solver(comm, flame.mechanism, flame.problem, flame.soot.get(), flame.solver);
  solver.onStage([rank](const FlameStage& stage, const FlameProfile&) {
    if (rank != 0) return;
    fmt::print("{}", stageLine(stage));
    std::fflush(stdout);
  });
  Attempt attempt;
  std::optional<FlameSolution> solution;
  try {
    solution = solver.solve(starts);
    if (warm && stateOf(*flame.mechanism, flame.problem, *solution) == FlameState::Out)
      relight(comm, flame, solver, *solution, attempt);
    if (flame.stochastic) {
      const FlameSolution alone = *solution;
      try {
        attempt.stochastic = runStochasticFlame(comm, *flame.mechanism, flame.problem.pressure, solver,
                                                flame.soot.get(), *solution, *flame.stochastic);
      } catch (const FlameFailure&) {
        throw;
      } catch (const NumericsError& error) {
        solution = alone;
        attempt.failure = error.what();
      } catch (const Stopped& stop) {
        solution = alone;
        attempt.failure = stop.what();
      }
    }
  } catch (const FlameFailure& failure) {
    solution = failure.last();
    attempt.failure = failure.what();
  } catch (const FlameStopped& stop) {
    // A flame that is there stays: what was searched from it may be of another load.
    if (!solution) solution = stop.last();
    attempt.failure = stop.what();
  } catch (const Stopped& stop) {
    attempt.failure = stop.what();
  }
  collectively(comm, [&] { attempt.result = flameResult(flame, std::move(*solution), !attempt.failure); });
  attempt.result.extinctionLoad = attempt.extinctionLoad;
  if (attempt.stochastic && !attempt.failure &&
      std::ranges::all_of(attempt.stochastic->paths,
                          [](const FlameEnsemblePath& path) { return path.path.path.points.empty(); }))
    attempt.failure =
        "no ensemble: nowhere do particles move into the flame faster than 'particles.minimum_velocity'; a smaller "
        "value, or a "
        "'particles.start' inside the flame";
  return attempt;
}

// Soot that has outgrown its sections is not the soot that was asked for.
void refuseOverflow(const FlameCase& flame, Attempt& attempt) {
  const auto& soot = attempt.result.soot;
  if (attempt.failure || !soot || soot->partAtLimit <= flame.sootAtLimit) return;
  attempt.failure = fmt::format(
      "the sections of the soot end too early: a part {:.2g} of the largest volume fraction stands in the last one (as "
      "a "
      "sphere {:.3g} nm), which cannot grow; allowed is {:.2g}. More sections ('particles.sectional.sections') or a "
      "larger 'particles.sectional.factor'; 'particles.sectional.overflow: 1' only counts it",
      soot->partAtLimit, 1e9 * soot->diameter.back(), flame.sootAtLimit);
}

void followInTime(MPI_Comm comm, FlameCase& flame, const RunFolder& folder, Attempt& attempt) {
  collectively(comm, [&] {
    attempt.history = std::make_unique<HistoryWriter>(comm, folder.history(), flameHistoryColumns(flame));
  });
  FlameSolution last = std::move(attempt.result.solution);
  last.budgets.clear();  // those of a steady flame
  last.growthRate.reset();
  last.burnerHeatFlux.reset();
  last.deposition.reset();
  attempt.course = flameInTime(comm, flame, last.profile, *attempt.history);
  if (!attempt.course->failure.empty()) attempt.failure = attempt.course->failure;
  collectively(comm, [&] { attempt.result = flameResult(flame, std::move(last), !attempt.failure); });
}

void findSensitivities(MPI_Comm comm, const FlameCase& flame, Attempt& attempt) {
  try {
    const std::vector<double> all = speedSensitivities(comm, flame.mechanism, flame.problem, flame.soot.get(),
                                                       flame.solver.tolerances, attempt.result.solution.profile);
    Sensitivities& chosen = attempt.sensitivities.emplace_back();
    chosen.name = "flame_speed";
    for (const std::size_t r : flame.sensitivities) chosen.values.push_back(all[r]);
  } catch (const NumericsError& error) {
    attempt.failure = error.what();
  } catch (const Stopped& stop) {
    attempt.failure = stop.what();
  }
}

Attempt attemptFlame(MPI_Comm comm, FlameCase& flame, const std::vector<FlameProfile>& starts,
                     const RunFolder& folder) {
  Attempt attempt;
  if (flame.unsteady && flame.unsteady->fromInitial) {
    FlameSolution asItIs;
    asItIs.profile = starts.front();
    collectively(comm, [&] { attempt.result = flameResult(flame, std::move(asItIs), true); });
  } else {
    attempt = solve(comm, flame, starts);
  }
  if (attempt.failure) return attempt;
  if (flame.unsteady) followInTime(comm, flame, folder, attempt);
  refuseOverflow(flame, attempt);
  if (!attempt.failure && !flame.sensitivities.empty()) findSensitivities(comm, flame, attempt);
  if (!flame.continuation) return attempt;
  try {
    attempt.branch = followBranch(comm, flame, attempt.result.solution.profile, attempt.result.summary);
    if (!attempt.branch->branch.complete)
      attempt.failure = "the branch of flames ends early: " + attempt.branch->branch.reason;
  } catch (const NumericsError& error) {
    attempt.failure = error.what();
  } catch (const Stopped& stop) {
    attempt.failure = stop.what();
  }
  return attempt;
}

// Rank 0: profile.csv, branch.csv and the numbers of the record.
std::string writeTexts(const RunFolder& folder, const FlameCase& flame, const Attempt& attempt) {
  writeFileAtomically(folder.file("profile.csv"), flameTable(flame, attempt.result));
  JsonWriter json;
  json.beginObject();
  recordFlame(json, flame, attempt.result);
  if (attempt.stochastic) recordStochasticFlame(json, *attempt.stochastic);
  if (!attempt.sensitivities.empty())
    writeFileAtomically(folder.file("sensitivities.csv"),
                        sensitivityTable(*flame.mechanism, flame.sensitivities, attempt.sensitivities));
  if (attempt.branch) {
    writeFileAtomically(folder.file("branch.csv"), branchTable(*attempt.branch));
    recordNumbers(json, namedBranchNumbers(*attempt.branch));
  }
  if (attempt.course) recordNumbers(json, {{"steps_in_time", "1", static_cast<double>(attempt.course->report.steps)}});
  json.endObject();
  return json.text();
}

class PreparedFlame : public PreparedRun {
 public:
  PreparedFlame(MPI_Comm comm, const Deck& deck) : comm_(comm), deck_(deck) {
    collectively(comm, [&] {
      flame_ = readFlameCase(deck);
      starts_ = firstProfiles(deck, flame_);
    });
  }

  [[nodiscard]] std::string summary() const override {
    std::string text = fmt::format("{} flame, {} species, {} reactions", nameOf(flame_.problem.type),
                                   flame_.mechanism->numSpecies(), flame_.mechanism->numReactions());
    if (flame_.soot) text += fmt::format(", {} scalars of soot", flame_.soot->scalars().size());
    if (flame_.initial) text += fmt::format(", from an earlier flame of {} points", flame_.initial->profile.points());
    return text;
  }

  void run(const RunOptions& options) override {
    int rank = 0;
    MPI_Comm_rank(comm_, &rank);
    recordedRun(comm_, deck_, options, 0, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
      const Attempt attempt = attemptFlame(comm_, flame_, starts_, folder);
      const FlameResult& result = attempt.result;
      collectively(comm_, [&] {
        if (rank == 0) record.resultsJson = writeTexts(folder, flame_, attempt);
      });
      record.cells = static_cast<std::int64_t>(result.solution.profile.points());
      for (const FlameStage& stage : result.solution.stages)
        record.steps += static_cast<std::int64_t>(stage.newton.steps + stage.newton.timeSteps);
      record.stages = stageTimes(comm_, result.solution.counters);
      record.peakMemoryPerRank = peakMemory(comm_);
      ResultsWriter results(comm_, folder.results(), info);
      writeFlame(results, flame_, result);
      if (attempt.stochastic) writeStochasticFlame(results, *flame_.stochastic, *attempt.stochastic);
      if (attempt.branch) writeBranch(results, *attempt.branch);
      if (!attempt.sensitivities.empty())
        writeSensitivities(results, flame_.sensitivities, attempt.sensitivities,
                           "d ln(flame speed) / d ln(rate constant)");
      if (attempt.course) writeFlameInTime(results, flame_, *attempt.course);
      if (attempt.history) attempt.history->writeTo(results);
      if (!attempt.failure) {
        results.close();
        if (rank == 0) fmt::print("\n{}", flameReport(flame_, result));
        if (rank == 0 && attempt.stochastic) fmt::print("{}", stochasticFlameReport(*attempt.stochastic));
        if (rank == 0 && !attempt.sensitivities.empty())
          fmt::print("\nd ln S_u / d ln k\n{}",
                     largestSensitivities(*flame_.mechanism, flame_.sensitivities, attempt.sensitivities.front().values,
                                          "0.5 but for the grid"));
        if (rank == 0 && attempt.branch) fmt::print("\n{}", numbersText(namedBranchNumbers(*attempt.branch)));
        return;
      }
      results.closePartial();
      const std::string kept = fmt::format("last grid and profile are in {}; a deck can start from it by 'initial'",
                                           folder.partialResults().string());
      if (const int signal = agreedStopRequest(comm_); signal != 0)
        raiseStopped(comm_, signal, "before the end of the flame's solution: the " + kept);
      collectively(comm_, [&] { throw NumericsError(fmt::format("{}\nThe {}", *attempt.failure, kept)); });
    });
  }

 private:
  MPI_Comm comm_;
  const Deck& deck_;
  FlameCase flame_;
  std::vector<FlameProfile> starts_;
};

}  // namespace

std::unique_ptr<PreparedRun> prepareFlame(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedFlame>(comm, deck);
}

}  // namespace lampblack::app
