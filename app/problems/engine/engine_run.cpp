#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/problems/engine/engine_along.hpp"
#include "app/problems/engine/engine_case.hpp"
#include "app/problems/engine/engine_checkpoint.hpp"
#include "app/problems/engine/engine_output.hpp"
#include "app/problems/engine/engine_repeat.hpp"
#include "app/run/prepared_run.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/repeats.hpp"
#include "core/stop_request.hpp"
#include "io/csv.hpp"
#include "io/history.hpp"
#include "io/progress.hpp"

namespace lampblack::app {
namespace {

// A repeat that was cut off by a request to stop.
struct EngineCut {};

class PreparedEngine : public PreparedRunOf<EngineCase> {
 public:
  PreparedEngine(MPI_Comm comm, const Deck& deck) : PreparedRunOf(comm, deck, readEngineCase) {
    collectively(comm, [&] { (void)deck_.at("charge", [&] { return engineCharge(case_, 0, {}); }); });
  }

  [[nodiscard]] std::string summary() const override {
    return fmt::format("{} particles, {} species, {} reactions, {:g} to {:g} deg at {:g} rpm, {} repeats",
                       case_.particles, case_.mechanism->numSpecies(), case_.mechanism->numReactions(), case_.start,
                       case_.end, 60 * case_.speed, case_.repeats);
  }

  void run(const RunOptions& options) override {
    const std::optional<WholeCheckpoint> restart = chosenCheckpoint(comm_, options);
    if (case_.repeats == 1) progress_.present.emplace(comm_, case_, 0);
    if (restart) loadProgress(comm_, *restart, engineFingerprint(deck_, case_), engineOwners(progress_));
    if (progress_.done > case_.repeats)
      throw InputError(fmt::format("{}: this checkpoint has {} repeats, more than 'sample.repeats: {}'",
                                   restart->file.string(), progress_.done, case_.repeats));
    recordedRun(comm_, deck_, options, case_.options.seed,
                [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
                  if (restart) recordRestart(*restart, record);
                  const double begin = MPI_Wtime();
                  SavedProgress checkpoints(comm_, folder.path(), engineFingerprint(deck_, case_),
                                            case_.checkpoints.wallTime);
                  if (progress_.present)
                    runOne(checkpoints);
                  else
                    runAll(checkpoints);
                  if (case_.checkpoints.atEnd) (void)save(checkpoints);
                  const double seconds = MPI_Wtime() - begin;
                  record.stages = {{"cycles", seconds, seconds, seconds}};
                  record.simulatedTime = case_.timeOf(case_.end);
                  record.peakMemoryPerRank = peakMemory(comm_);
                  write(folder, info, record);
                });
  }

 private:
  // Of a repeat: its rows, its summary, whether its cycles have come to an end.
  [[nodiscard]] std::size_t rowValues() const { return case_.angles().size() * engineQuantities(case_).size(); }
  [[nodiscard]] std::size_t width() const { return rowValues() + engineSummaryQuantities(case_).size() + 1; }
  static std::vector<double> packed(const EngineRepeat& done) {
    std::vector<double> all = done.rows;
    all.insert(all.end(), done.summary.begin(), done.summary.end());
    all.push_back(done.isConverged ? 1 : 0);
    return all;
  }
  void keep(const EngineRepeat& done) {
    progress_.particles = done.particles;
    progress_.cycles = done.cycles;
  }
  std::filesystem::path save(SavedProgress& checkpoints) {
    const std::size_t number = progress_.present ? progress_.present->stops() : progress_.done;
    return checkpoints.save(static_cast<std::int64_t>(number), engineOwners(progress_));
  }

  // All ranks share the reactions.
  void runOne(SavedProgress& checkpoints) {
    EngineCycles& cycles = *progress_.present;
    Progress said(comm_, case_.start, case_.end, Progress::logInterval);
    while (!cycles.isDone()) {
      cycles.advance();
      int isDue = checkpoints.isDue();
      const int signal = agreedStopRequest(comm_, {&isDue, 1});
      if (signal != 0 || isDue != 0) said.finish();
      if (signal != 0)
        raiseStopped(comm_, signal,
                     fmt::format("at {:g} deg of cycle {}, which {} has", cycles.angle(), cycles.cycle() + 1,
                                 save(checkpoints).string()));
      if (isDue != 0) (void)save(checkpoints);
      said.say(fmt::format("cycle {}, {:g} deg", cycles.cycle() + 1, cycles.angle()), cycles.angle());
    }
    said.finish();
    if (progress_.done > 0) return;
    progress_.repeats = packed(cycles.result());
    keep(cycles.result());
    progress_.done = 1;
  }

  // Each rank has repeats of its own.
  void runAll(SavedProgress& checkpoints) {
    Progress said(comm_, 0, static_cast<double>(case_.repeats), Progress::logInterval);
    while (progress_.done < case_.repeats) {
      const std::uint64_t end = std::min(progress_.done + static_cast<std::uint64_t>(ranks_), case_.repeats);
      const std::vector<double> some = gatherRepeats(
          comm_, progress_.done, end, width(), [&](std::uint64_t repeat, std::span<double> row) { one(repeat, row); });
      int isDue = checkpoints.isDue();
      if (const int signal = agreedStopRequest(comm_, {&isDue, 1}); signal != 0) {
        said.finish();
        // Without those just done, of which one may have been cut off.
        raiseStopped(comm_, signal,
                     fmt::format("after {} repeats, which {} has", progress_.done, save(checkpoints).string()));
      }
      progress_.repeats.insert(progress_.repeats.end(), some.begin(), some.end());
      progress_.done = end;
      if (isDue != 0) {
        said.finish();
        (void)save(checkpoints);
      }
      said.say(fmt::format("repeat {} of {}", progress_.done, case_.repeats), static_cast<double>(progress_.done));
    }
    said.finish();
  }

  void one(std::uint64_t repeat, std::span<double> row) {
    try {
      EngineCycles cycles(MPI_COMM_SELF, case_, repeat);
      while (!cycles.isDone()) {
        cycles.advance();
        if (stopRequest() != 0) throw EngineCut{};
      }
      std::ranges::copy(packed(cycles.result()), row.begin());
      if (repeat == 0) keep(cycles.result());
    } catch (const EngineCut&) {
      std::ranges::fill(row, std::numeric_limits<double>::quiet_NaN());
    } catch (const NumericsError& error) {
      throw NumericsError(fmt::format("repeat {}, {}", repeat, error.what()));
    }
  }

  void write(const RunFolder& folder, const RunInfo& info, RunRecord& record) {
    const std::vector<double>& repeats = progress_.repeats;
    const std::vector<Quantity> summaryQuantities = engineSummaryQuantities(case_);
    std::vector<double> history, rows, summaries;
    bool isConverged = true;
    for (std::size_t r = 0; rank_ == 0 && r < case_.repeats; ++r) {
      const auto from = repeats.begin() + static_cast<std::ptrdiff_t>(r * width());
      const auto summary = from + static_cast<std::ptrdiff_t>(rowValues());
      rows.insert(rows.end(), from, summary);
      summaries.insert(summaries.end(), summary, summary + static_cast<std::ptrdiff_t>(summaryQuantities.size()));
      isConverged = isConverged && repeats[(r + 1) * width() - 1] != 0;
    }
    if (rank_ == 0) history = engineHistory(case_, rows);
    EngineSootTable soot;
    if (case_.soot || case_.population) soot = sootAlongMeanGas(comm_, case_, history);
    ResultsWriter results(comm_, folder.results(), info);
    HistoryWriter written(comm_, folder.history(), engineHistoryColumns(case_));
    written.row(history);
    written.writeTo(results);
    results.table("/repeats", summaryQuantities, summaries);
    results.table("/cycles", summaryQuantities, progress_.cycles);
    std::vector<Quantity> columns{{"angle", "deg", "crank angle"}, {"particle", "1", "number of the particle"}};
    for (const Quantity& quantity : engineParticleQuantities(case_)) columns.push_back(quantity);
    results.table("/particles", columns, progress_.particles);
    if (!soot.columns.empty()) results.table("/soot_along", soot.columns, soot.rows);
    results.close();
    if (rank_ != 0) return;
    if (!soot.columns.empty()) writeFileAtomically(folder.file("soot.csv"), csvTable(soot.columns, soot.rows));
    const auto at = [&](const char* name) {
      const auto place = std::ranges::find(summaryQuantities, name, &Quantity::name) - summaryQuantities.begin();
      double mean = 0;
      for (std::size_t r = 0; r < case_.repeats; ++r)
        mean += summaries[r * summaryQuantities.size() + static_cast<std::size_t>(place)] /
                static_cast<double>(case_.repeats);
      return mean;
    };
    record.steps = static_cast<std::int64_t>(at("steps"));
    JsonWriter json;
    json.beginObject();
    recordEngine(json, case_, summaries, isConverged);
    for (std::size_t c = 1; c < soot.columns.size(); ++c)
      json.field("final_" + soot.columns[c].name, soot.rows[soot.rows.size() - soot.columns.size() + c]);
    json.endObject();
    record.resultsJson = json.text();
    if (at("steps_too_large") > 0)
      printWarnings(
          {fmt::format("{:g} steps of the last cycle were larger than the section 'step' allows: raise "
                       "step.halvings, or give a smaller step.angle",
                       at("steps_too_large"))});
    if (!isConverged)
      printWarnings({fmt::format(
          "after {} cycles the last two still differ by more than the section cycles says; {} particles may be "
          "too few for it: take more (sample.particles) or larger tolerances",
          case_.mostCycles, case_.particles)});
    fmt::print(
        "half of the heat at {:.4g} deg, 10 to 90 % in {:.3g} deg, {:.4g} bar at most, {:.3g} bar/deg, work {:.4g} J "
        "of {:.4g} J, energy balanced to {:.2g}\n",
        at("ca50"), at("burn_duration"), 1e-5 * at("largest_pressure"), 1e-5 * at("pressure_rise"), at("work"),
        at("chemical_heat"), at("energy_error"));
  }

  EngineProgress progress_;
};

}  // namespace

std::unique_ptr<PreparedRun> prepareEngine(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedEngine>(comm, deck);
}

}  // namespace lampblack::app
