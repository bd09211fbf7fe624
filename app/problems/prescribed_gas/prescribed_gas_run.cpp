#include <fmt/format.h>

#include <algorithm>

#include "app/deck/soot_deck.hpp"
#include "app/problems/prescribed_gas/prescribed_gas_case.hpp"
#include "app/problems/prescribed_gas/prescribed_gas_output.hpp"
#include "app/problems/reactor/reactor_driver.hpp"
#include "app/run/prepared_run.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "io/history.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

class PreparedPrescribedGas : public PreparedRunOf<PrescribedGasCase> {
 public:
  PreparedPrescribedGas(MPI_Comm comm, const Deck& deck) : PreparedRunOf(comm, deck, readPrescribedGasCase) {
    collectively(comm, [&] {
      if (case_.coupled) driver_ = ensembleReactorDriver(*case_.coupled);
    });
  }

  [[nodiscard]] std::string summary() const override {
    if (case_.coupled)
      return fmt::format("{} repeats of {}, {:g} to {:g} s, {} rows", case_.coupled->ensemble->repeats,
                         case_.coupled->ensemble->material, case_.coupled->kind->begin(), case_.coupled->kind->end(),
                         case_.coupled->kind->rows().size());
    const auto& points = case_.path.points;
    const std::string what =
        case_.ensemble
            ? fmt::format("{} repeats of {}", case_.ensemble->repeats, case_.ensemble->material)
            : fmt::format("{} with {} scalars", deck_.choice("particles.description"), case_.model->scalars().size());
    return fmt::format("{}, {:g} to {:g} s, {} rows", what, points.front().time, points.back().time,
                       case_.recorded.size());
  }

  void run(const RunOptions& options) override {
    if (case_.coupled) {
      recordedRun(comm_, deck_, options, 0, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
        runDriver(comm_, *driver_, folder, info, record);
      });
      return;
    }
    recordedRun(comm_, deck_, options, case_.ensemble ? deck_.integer<std::uint64_t>("particles.seed") : 0,
                [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
                  const double begin = MPI_Wtime();
                  const auto measure = [&] {
                    const double seconds = MPI_Wtime() - begin;
                    record.stages = {{"particles", seconds, seconds, seconds}};
                  };
                  try {
                    if (case_.ensemble)
                      runEnsemble(folder, info, record);
                    else
                      runModel(folder, info, record);
                  } catch (const Stopped&) {
                    measure();
                    throw;
                  }
                  measure();
                  record.simulatedTime = case_.path.points.back().time - case_.path.points.front().time;
                  record.peakMemoryPerRank = peakMemory(comm_);
                });
  }

 private:
  void runEnsemble(const RunFolder& folder, const RunInfo& info, RunRecord& record) {
    const PopulationRequest& request = *case_.ensemble;
    PathMarch march;
    march.bins = request.bins;
    march.recorded = case_.recorded;
    const PathEnsemble ensemble =
        runPathEnsemble(comm_, case_.path, request.make, 0, request.repeats, march, "stochastic particles");
    ResultsWriter results(comm_, folder.results(), info);
    const Table history = historyOf(case_, ensemble), rates = ratesOf(case_, ensemble);
    history.writeHistory(comm_, folder.history(), results);
    rates.write(results, "/rates");
    writeDistributions(results, case_, ensemble);
    results.close();
    record.steps = static_cast<std::int64_t>(ensemble.count("split_steps"));
    finish(record, history, [&](JsonWriter& json) {
      json.field("repeats", static_cast<std::int64_t>(request.repeats));
      recordCounts(json, ensemble);
    });
    const RepeatedValue &fraction = ensemble.valuesOf("volume_fraction"), &number = ensemble.valuesOf("number_density");
    if (rank_ == 0)
      fmt::print(
          "volume fraction {:.5g} +- {:.2g}, {:.5g} +- {:.2g} particles a cubic metre, {} repeats, {} splitting "
          "steps, {}\n",
          fraction.mean.back(), fraction.error.back(), number.mean.back(), number.error.back(), request.repeats,
          record.steps, formatDuration(ensemble.seconds));
  }

  void runModel(const RunFolder& folder, const RunInfo& info, RunRecord& record) {
    ModelAlong model;
    Table history;
    collectively(comm_, [&] {
      if (rank_ == 0) model = marchModel(*case_.model, case_.path, case_.recorded, case_.depleted);
      if (rank_ == 0) requireSizeRangeCovered(model);
    });
    history = historyOf(case_, model);
    ResultsWriter results(comm_, folder.results(), info);
    history.writeHistory(comm_, folder.history(), results);
    int hasSizes = model.records.empty() ? 0 : static_cast<int>(!model.records[0].sizes.diameter.empty());
    MPI_Bcast(&hasSizes, 1, MPI_INT, 0, comm_);
    if (hasSizes != 0) writeDistributions(results, model);
    results.close();
    record.steps = model.steps;
    finish(record, history, [](JsonWriter&) {});
    if (rank_ != 0) return;
    const ParticleProperties& last = model.records.back().properties;
    fmt::print("volume fraction {:.5g}, {:.5g} particles a cubic metre, {} steps\n", last.volumeFraction,
               last.numberDensity, model.steps);
  }

  void requireSizeRangeCovered(const ModelAlong& model) const {
    double most = 0, atLimit = 0;
    for (const ModelRecord& record : model.records) {
      most = std::max(most, record.properties.volumeFraction);
      atLimit = std::max(atLimit, case_.model->volumeFractionAtLimit(record.densities));
    }
    if (atLimit > case_.sootAtLimit * most)
      throw NumericsError(
          fmt::format("a fraction {:.2g} of the largest volume fraction is in the largest particles of the model; "
                      "the limit is {:.2g}. {}",
                      atLimit / most, case_.sootAtLimit, tooFewSections));
  }

  template <class More>
  void finish(RunRecord& record, const Table& history, const More& more) const {
    if (rank_ != 0) return;
    record.resultsJson = jsonObject([&](JsonWriter& json) {
      more(json);
      history.recordLast(json);
    });
  }

  std::unique_ptr<ReactorDriver> driver_;  // where particles and gas are coupled
};

}  // namespace

std::unique_ptr<PreparedRun> preparePrescribedGas(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedPrescribedGas>(comm, deck);
}

}  // namespace lampblack::app
