#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/problems/population/population_case.hpp"
#include "app/problems/population/population_output.hpp"
#include "app/problems/population/population_progress.hpp"
#include "app/run/prepared_run.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "io/table.hpp"
#include "particles/population/comparison/comparison.hpp"
#include "particles/population/gelation_error.hpp"

namespace lampblack::app {

namespace {

class PreparedPopulation : public PreparedRunOf<PopulationCase> {
 public:
  PreparedPopulation(MPI_Comm comm, const Deck& deck) : PreparedRunOf(comm, deck, readPopulationCase) {
    collectively(comm, [&] { exact_ = exactSolution(case_); });
    printWarnings(case_.warnings);
    if (exact_ && exact_->gelationTime() && *exact_->gelationTime() <= case_.times.end)
      printWarnings(
          {fmt::format("the population gels at t = {:.6g} s; time.end = {:g} s is later, and a run will stop at "
                       "the gelation",
                       *exact_->gelationTime(), case_.times.end)});
  }

  [[nodiscard]] std::string summary() const override {
    std::string methods;
    for (const PopulationMethod& method : case_.methods)
      methods += fmt::format("{}{}", methods.empty() ? "" : ", ", method.name);
    return fmt::format("{} method{} ({}), {} repeats, exact solution: {}", case_.methods.size(),
                       case_.methods.size() == 1 ? "" : "s", methods, case_.repeats,
                       exact_ ? exact_->name() : "none known");
  }

  void run(const RunOptions& options) override {
    int rank = 0;
    MPI_Comm_rank(comm_, &rank);
    recordedRun(
        comm_, deck_, options, case_.seed, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
          const PopulationStatistics statistics = runAndTell(comm_, case_);
          collectively(comm_, [&] {
            if (rank != 0) return;
            writeFileAtomically(folder.file("table.csv"), populationTable(statistics));
            record.resultsJson = jsonObject([&](JsonWriter& json) { recordPopulation(json, statistics); });
            record.simulatedTime = case_.times.end;
            for (const MethodStatistics& method : statistics.methods) {
              record.steps += static_cast<std::int64_t>(method.counters.events());
              record.stages.push_back({method.stage.name, method.stage.least, method.stage.mean, method.stage.most});
            }
          });
          ResultsWriter results(comm_, folder.results(), info);
          writePopulation(results, case_, statistics);
          record.peakMemoryPerRank = peakMemory(comm_);
          if (rank == 0) fmt::print("{}", populationSummary(case_, statistics));
          if (rank == 0) printWarnings(startsWithoutTruth(case_, statistics));
          if (statistics.stop != 0) {
            results.closePartial();
            raiseStopped(
                comm_, statistics.stop,
                "in the middle of the repeats: those that had ended are in " + folder.partialResults().string());
          }
          // What was computed until the gelation stays readable in the partial file.
          double gelation = statistics.gelation().value_or(std::numeric_limits<double>::infinity());
          MPI_Bcast(&gelation, 1, MPI_DOUBLE, 0, comm_);
          if (!std::isfinite(gelation)) {
            results.close();
            return;
          }
          results.closePartial();
          collectively(comm_, [&] { throw GelationError(gelation); });
        });
  }

 private:
  std::unique_ptr<ExactSolution> exact_;
};

}  // namespace

std::unique_ptr<PreparedRun> preparePopulation(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedPopulation>(comm, deck);
}

}  // namespace lampblack::app
