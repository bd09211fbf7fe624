#include <fmt/format.h>

#include <algorithm>

#include "app/problems/aggregates/aggregates_case.hpp"
#include "app/problems/aggregates/aggregates_output.hpp"
#include "app/run/prepared_run.hpp"
#include "core/errors.hpp"
#include "core/repeats.hpp"
#include "core/stop_request.hpp"
#include "io/history.hpp"
#include "io/progress.hpp"
#include "particles/aggregates/aggregates_repeat.hpp"

namespace lampblack::app {
namespace {

class PreparedAggregates : public PreparedRunOf<AggregatesCase> {
 public:
  PreparedAggregates(MPI_Comm comm, const Deck& deck) : PreparedRunOf(comm, deck, readAggregatesCase) {}

  [[nodiscard]] std::string summary() const override {
    const std::string what = case_.build == AggregatesCase::Build::collisions
                                 ? fmt::format("a sample of {} particles", case_.population.particles)
                                 : fmt::format("{} aggregates of {} spheres", case_.aggregates, case_.sizes().back());
    return fmt::format("{}, {} repeats, {} rows, {:g} s in the gas", what, case_.repeats, case_.rows(),
                       case_.times.back());
  }

  void run(const RunOptions& options) override {
    recordedRun(comm_, deck_, options, case_.seed,
                [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
                  const double begin = MPI_Wtime();
                  const std::vector<double> repeats = runAll();
                  const double seconds = MPI_Wtime() - begin;
                  record.stages = {{"aggregates", seconds, seconds, seconds}};
                  record.simulatedTime = case_.times.back();
                  record.steps = static_cast<std::int64_t>(case_.repeats);
                  record.peakMemoryPerRank = peakMemory(comm_);
                  write(folder, info, repeats, record);
                });
  }

 private:
  [[nodiscard]] std::vector<double> runAll() {
    const std::size_t width = case_.rows() * aggregateQuantities().size();
    Progress said(comm_, 0, static_cast<double>(case_.repeats), Progress::logInterval);
    std::vector<double> all;
    for (std::uint64_t done = 0; done < case_.repeats;) {
      const std::uint64_t end = std::min(done + static_cast<std::uint64_t>(ranks_), case_.repeats);
      const std::vector<double> some =
          gatherRepeats(comm_, done, end, width, [&](std::uint64_t repeat, std::span<double> row) {
            runAggregates(case_, repeat, row, repeat == 0 ? &drawn_ : nullptr);
          });
      all.insert(all.end(), some.begin(), some.end());
      if (const int signal = agreedStopRequest(comm_); signal != 0) {
        said.finish();
        raiseStopped(comm_, signal, fmt::format("in the middle of the repeats, of which nothing is kept"));
      }
      done = end;
      said.say(fmt::format("repeat {} of {}", done, case_.repeats), static_cast<double>(done));
    }
    said.finish();
    return all;
  }

  void write(const RunFolder& folder, const RunInfo& info, const std::vector<double>& repeats, RunRecord& record) {
    const Table history = aggregateHistory(case_, rank_ == 0 ? std::span(repeats) : std::span<const double>());
    ResultsWriter results(comm_, folder.results(), info);
    history.writeHistory(comm_, folder.history(), results);
    writeAggregates(results, drawn_);
    results.close();
    if (rank_ != 0) return;
    record.resultsJson = jsonObject([&](JsonWriter& json) {
      json.field("repeats", case_.repeats);
      history.recordLast(json, 0);
    });
    const auto lastOf = [&](const char* name) {
      const auto at = std::ranges::find(history.columns, name, &Quantity::name) - history.columns.begin();
      return history.last(static_cast<std::size_t>(at));
    };
    fmt::print("{:.4g} spheres a particle, R_g {:.4g} m, D_f {:.4g} +- {:.2g}, projected area {:.4g} m^2\n",
               lastOf("spheres"), lastOf("gyration"), lastOf("fractal_dimension"), lastOf("fractal_dimension_error"),
               lastOf("shadow"));
  }

  std::vector<SphereAggregate> drawn_;  // of rank 0, who has repeat 0
};

}  // namespace

std::unique_ptr<PreparedRun> prepareAggregates(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedAggregates>(comm, deck);
}

}  // namespace lampblack::app
