#include "app/problems/engine/engine_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/problems/engine/engine_case.hpp"
#include "app/problems/engine/engine_output.hpp"
#include "app/problems/engine/engine_repeat.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/repeats.hpp"
#include "core/stop_request.hpp"
#include "io/history.hpp"
#include "io/progress.hpp"

namespace lampblack::app {
namespace {

struct EngineCut {};

class PreparedEngine : public PreparedRun {
 public:
  PreparedEngine(MPI_Comm comm, const Deck& deck) : comm_(comm), deck_(deck) {
    MPI_Comm_rank(comm, &rank_);
    MPI_Comm_size(comm, &ranks_);
    collectively(comm, [&] {
      case_ = readEngineCase(deck);
      (void)deck_.at("charge", [&] { return engineCharge(case_, 0, {}); });
    });
  }

  [[nodiscard]] std::string summary() const override {
    return fmt::format("{} particles, {} species, {} reactions, {:g} to {:g} deg at {:g} rpm, {} repeats",
                       case_.particles, case_.mechanism->numSpecies(), case_.mechanism->numReactions(), case_.start,
                       case_.end, 60 * case_.speed, case_.repeats);
  }

  void run(const RunOptions& options) override {
    recordedRun(comm_, deck_, options, case_.seed,
                [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
                  const double begin = MPI_Wtime();
                  const std::vector<double> repeats = case_.repeats == 1 ? runOne() : runAll();
                  const double seconds = MPI_Wtime() - begin;
                  record.stages = {{"cycles", seconds, seconds, seconds}};
                  record.simulatedTime = case_.timeOf(case_.end);
                  record.peakMemoryPerRank = peakMemory(comm_);
                  write(folder, info, repeats, record);
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
  void keep(EngineRepeat&& done) {
    particles_ = std::move(done.particles);
    cycles_ = std::move(done.cycles);
  }

  // All ranks share the reactions.
  [[nodiscard]] std::vector<double> runOne() {
    Progress said(comm_, case_.start, case_.end, Progress::logInterval);
    EngineRepeat done = runEngine(comm_, case_, 0, [&](std::size_t cycle, double angle) {
      if (const int signal = agreedStopRequest(comm_); signal != 0) {
        said.finish();
        raiseStopped(comm_, signal, fmt::format("at {:g} deg of cycle {}, of which nothing is kept", angle, cycle + 1));
      }
      said.say(fmt::format("cycle {}, {:g} deg", cycle + 1, angle), angle);
    });
    said.finish();
    const std::vector<double> all = packed(done);
    keep(std::move(done));
    return all;
  }

  // Each rank has repeats of its own.
  [[nodiscard]] std::vector<double> runAll() {
    Progress said(comm_, 0, static_cast<double>(case_.repeats), Progress::logInterval);
    std::vector<double> all;
    for (std::uint64_t done = 0; done < case_.repeats;) {
      const std::uint64_t end = std::min(done + static_cast<std::uint64_t>(ranks_), case_.repeats);
      const std::vector<double> some = gatherRepeats(
          comm_, done, end, width(), [&](std::uint64_t repeat, std::span<double> row) { one(repeat, row); });
      all.insert(all.end(), some.begin(), some.end());
      if (const int signal = agreedStopRequest(comm_); signal != 0) {
        said.finish();
        raiseStopped(comm_, signal, "in the middle of the repeats, of which nothing is kept");
      }
      done = end;
      said.say(fmt::format("repeat {} of {}", done, case_.repeats), static_cast<double>(done));
    }
    said.finish();
    return all;
  }

  void one(std::uint64_t repeat, std::span<double> row) {
    try {
      EngineRepeat done = runEngine(MPI_COMM_SELF, case_, repeat, [](std::size_t, double) {
        if (stopRequest() != 0) throw EngineCut{};
      });
      std::ranges::copy(packed(done), row.begin());
      if (repeat == 0) keep(std::move(done));
    } catch (const EngineCut&) {
      std::ranges::fill(row, std::numeric_limits<double>::quiet_NaN());
    } catch (const NumericsError& error) {
      throw NumericsError(fmt::format("repeat {}, {}", repeat, error.what()));
    }
  }

  void write(const RunFolder& folder, const RunInfo& info, const std::vector<double>& repeats, RunRecord& record) {
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
    ResultsWriter results(comm_, folder.results(), info);
    HistoryWriter written(comm_, folder.history(), engineHistoryColumns(case_));
    written.row(history);
    written.writeTo(results);
    results.table("/repeats", summaryQuantities, summaries);
    results.table("/cycles", summaryQuantities, cycles_);
    std::vector<Quantity> columns{{"angle", "deg", "crank angle"}, {"particle", "1", "number of the particle"}};
    for (const Quantity& quantity : engineParticleQuantities(case_)) columns.push_back(quantity);
    results.table("/particles", columns, particles_);
    results.close();
    if (rank_ != 0) return;
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
    json.endObject();
    record.resultsJson = json.text();
    if (at("steps_too_large") > 0)
      printWarnings(
          {fmt::format("{:g} steps of the last cycle were larger than the section 'step' allows: raise "
                       "step.halvings, or give a smaller step.angle",
                       at("steps_too_large"))});
    if (!isConverged)
      printWarnings({fmt::format("after {} cycles the last two still differ by more than the section cycles says",
                                 case_.mostCycles)});
    fmt::print(
        "half of the heat at {:.4g} deg, 10 to 90 % in {:.3g} deg, {:.4g} bar at most, {:.3g} bar/deg, work {:.4g} J "
        "of {:.4g} J, energy balanced to {:.2g}\n",
        at("ca50"), at("burn_duration"), 1e-5 * at("largest_pressure"), 1e-5 * at("pressure_rise"), at("work"),
        at("chemical_heat"), at("energy_error"));
  }

  MPI_Comm comm_;
  const Deck& deck_;
  int rank_ = 0, ranks_ = 1;
  EngineCase case_;
  std::vector<double> particles_, cycles_;  // of rank 0, who has repeat 0
};

}  // namespace

std::unique_ptr<PreparedRun> prepareEngine(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedEngine>(comm, deck);
}

}  // namespace lampblack::app
