#include "app/population_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/population_case.hpp"
#include "app/population_output.hpp"
#include "app/population_statistics.hpp"
#include "app/warnings.hpp"
#include "core/errors.hpp"
#include "particles/population/gelation_error.hpp"

namespace lampblack {

std::string checkPopulation(MPI_Comm comm, const Deck& deck) {
  PopulationCase populationCase;
  std::unique_ptr<ExactSolution> exact;
  collectively(comm, [&] {
    populationCase = readPopulationCase(deck);
    exact = exactSolution(populationCase);
  });
  if (exact && exact->gelationTime() && *exact->gelationTime() <= populationCase.times.end)
    printWarnings(
        {fmt::format("the population gels at t = {:.6g} s; time.end = {:g} s is later, and a run will stop at "
                     "the gelation",
                     *exact->gelationTime(), populationCase.times.end)});
  std::string methods;
  for (const PopulationMethod& method : populationCase.methods)
    methods += fmt::format("{}{}", methods.empty() ? "" : ", ", method.name);
  return fmt::format("{} method{} ({}), {} repeats, exact solution: {}", populationCase.methods.size(),
                     populationCase.methods.size() == 1 ? "" : "s", methods, populationCase.repeats,
                     exact ? exact->name() : "none known");
}

void runPopulationBalance(MPI_Comm comm, const Deck& deck, const RunOptions& options) {
  PopulationCase populationCase;
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  collectively(comm, [&] { populationCase = readPopulationCase(deck); });
  recordedRun(comm, deck, options, populationCase.seed,
              [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
                const PopulationStatistics statistics = runPopulation(comm, populationCase);
                collectively(comm, [&] {
                  if (rank != 0) return;
                  writeFileAtomically(folder.file("table.csv"), populationTable(statistics));
                  JsonWriter json;
                  json.beginObject();
                  recordPopulation(json, statistics);
                  json.endObject();
                  record.resultsJson = json.text();
                  record.simulatedTime = populationCase.times.end;
                  for (const MethodStatistics& method : statistics.methods) {
                    record.steps += static_cast<std::int64_t>(method.counters.events());
                    record.stages.push_back(method.stage);
                  }
                });
                ResultsWriter results(comm, folder.results(), info);
                writePopulation(results, populationCase, statistics);
                record.peakMemoryPerRank = peakMemory(comm);
                if (rank == 0) fmt::print("{}", populationSummary(populationCase, statistics));
                // What was computed until the gelation stays readable in the partial file.
                double gelation = statistics.gelation().value_or(std::numeric_limits<double>::infinity());
                MPI_Bcast(&gelation, 1, MPI_DOUBLE, 0, comm);
                if (!std::isfinite(gelation)) {
                  results.close();
                  return;
                }
                results.closePartial();
                collectively(comm, [&] { throw GelationError(gelation); });
              });
}

}  // namespace lampblack
