#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/problems/pah/pah_case.hpp"
#include "app/problems/pah/pah_checkpoint.hpp"
#include "app/problems/pah/pah_output.hpp"
#include "app/run/prepared_run.hpp"
#include "app/run/warnings.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "io/csv.hpp"
#include "io/history.hpp"
#include "io/progress.hpp"

namespace lampblack::app {
namespace {

constexpr std::uint64_t eventsAtATime = std::uint64_t{1} << 20U;  // before a request to stop is seen
constexpr double leastRound = 0.5, longestRound = 2;              // s of molecules that are begun together

// What random numbers are for: RandomStream.
constexpr std::uint32_t growthPurpose = 0x706168;

// Calls row(i, growth) at each row. False where the run is to stop before the end.
template <class Growth, class Row>
bool growMolecule(const PahCase& pah, Growth& growth, const Row& row, bool mayStop = true) {
  std::size_t next = 0;
  for (std::size_t i = 0; i <= pah.growth.intervals.size(); ++i) {
    for (; next < pah.growth.records.size() && pah.growth.records[next] == i; ++next) row(next, growth);
    if (i == pah.growth.intervals.size()) break;
    double left = pah.growth.intervals[i].duration;
    while ((left = growth.advance(pah.growth.intervals[i].rates, left, eventsAtATime)) > 0)
      if (mayStop && stopRequest() != 0) return false;
  }
  return true;
}

MoleculeGrowth newMolecule(const PahCase& pah, const Molecule& start, std::uint64_t repeat) {
  return {start, RandomStream(pah.seed, repeat, growthPurpose), pah.mostRings};
}

std::uint64_t sumOf(const auto& growth) {
  std::uint64_t sum = 0;
  for (const auto* counts : {&growth.events(), &growth.voids()})
    for (const std::uint64_t count : *counts) sum += count;
  return sum;
}

class PreparedPah : public PreparedRunOf<PahCase> {
 public:
  PreparedPah(MPI_Comm comm, const Deck& deck) : PreparedRunOf(comm, deck, readPahCase) { warnOfPressure(); }

  [[nodiscard]] std::string summary() const override {
    const Molecule start = case_.start();
    return fmt::format("{} molecules from C{}H{}, {:g} to {:g} s, {} rows, {} times of constant rates", case_.repeats,
                       start.carbon(), start.hydrogen(), case_.timeOf(0), case_.timeOf(case_.recorded.size() - 1),
                       case_.recorded.size(), case_.growth.intervals.size());
  }

  void run(const RunOptions& options) override {
    const std::optional<WholeCheckpoint> restart = chosenCheckpoint(comm_, options);
    PahProgress progress{0, GrowthSums(case_.recorded.size())};
    if (restart) progress = loadPahProgress(comm_, *restart, case_);
    recordedRun(comm_, deck_, options, case_.seed,
                [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
                  if (restart) {
                    recordRestart(*restart, record);
                    if (rank_ == 0)
                      fmt::print("continues from {}, {} molecules\n", restart->file.string(), progress.done);
                  }
                  const double begin = MPI_Wtime();
                  growAll(folder, progress);
                  const double seconds = MPI_Wtime() - begin;
                  record.stages = {{"molecules", seconds, seconds, seconds}};
                  record.simulatedTime = case_.timeOf(case_.recorded.size() - 1) - case_.timeOf(0);
                  record.steps = static_cast<std::int64_t>(progress.sums.events());
                  record.peakMemoryPerRank = peakMemory(comm_);
                  write(folder, info, progress.sums, record);
                });
  }

 private:
  // Rates of growth on free edges and zigzags, and of chains, are fits at one atmosphere.
  void warnOfPressure() const {
    constexpr double farFrom = 1.5;  // in either direction
    for (const char* key : {"rates.file", "rates.growth_free_edge", "rates.growth_zigzag", "rates.chain_zigzag"})
      if (deck_.isGiven(key)) return;
    const auto far = std::ranges::find_if(case_.path.points, [](const GasSample& sample) {
      return std::abs(std::log(sample.gas.pressure / constants::oneAtmosphere)) > std::log(farFrom);
    });
    if (far == case_.path.points.end()) return;
    printWarnings(
        {fmt::format("the gas has {:.3g} atm at {:.3g} s, and the rates growth_free_edge, growth_zigzag and "
                     "chain_zigzag are fits at 1 "
                     "atm; give those of your pressure (section rates)",
                     far->gas.pressure / constants::oneAtmosphere, far->time)});
  }

  // Rounds of molecules, after each of which the run may stop or be saved.
  void growAll(const RunFolder& folder, PahProgress& progress) {
    SavedProgress checkpoints(comm_, folder.path(), pahFingerprint(case_), case_.checkpoints.wallTime);
    Progress said(comm_, 0, static_cast<double>(case_.repeats), Progress::logInterval);
    auto round = static_cast<std::uint64_t>(ranks_);
    GrowthSums own = progress.sums;
    const auto written = [&] {
      progress.sums = own.ofAllRanks(comm_);
      return checkpoints.save(static_cast<std::int64_t>(progress.done), pahOwners(comm_, progress));
    };
    const auto save = [&] {
      said.finish();
      return written();
    };
    while (progress.done < case_.repeats) {
      const double begin = MPI_Wtime();
      const std::uint64_t end = std::min(progress.done + round, case_.repeats);
      GrowthSums ofRound(case_.recorded.size());
      collectively(comm_, [&] { growRound(progress.done, end, ofRound); });
      int isDue = checkpoints.isDue();
      int isShort = rank_ == 0 && MPI_Wtime() - begin < leastRound ? 1 : 0;
      int isLong = rank_ == 0 && MPI_Wtime() - begin > longestRound ? 1 : 0;
      int others[] = {isDue, isShort, isLong};
      if (const int signal = agreedStopRequest(comm_, others); signal != 0) {
        const std::filesystem::path file = save();  // without the round, in which a molecule may have been cut off
        raiseStopped(comm_, signal, fmt::format("after {} molecules, which {} has", progress.done, file.string()));
      }
      collectively(comm_, [&] { own.add(ofRound); });
      progress.done = end;
      said.say(fmt::format("molecule {} of {}", progress.done, case_.repeats), static_cast<double>(progress.done));
      if (others[1] != 0) round *= 2;
      if (others[2] != 0) round = std::max(round / 2, static_cast<std::uint64_t>(ranks_));
      if (others[0] != 0) (void)save();
    }
    said.finish();
    if (case_.checkpoints.atEnd) (void)written();
    progress.sums = own.ofAllRanks(comm_);
  }

  // Those of this rank, from the first to before the end.
  void growRound(std::uint64_t first, std::uint64_t end, GrowthSums& sums) const {
    const Molecule start = case_.start();
    const auto ranks = static_cast<std::uint64_t>(ranks_), rank = static_cast<std::uint64_t>(rank_);
    for (std::uint64_t repeat = first; repeat < end; ++repeat) {
      if (repeat % ranks != rank) continue;
      if (stopRequest() != 0) return;
      bool isWhole = false;
      if (case_.closure) {
        SiteCounting growth(SiteCounts(start), *case_.closure, RandomStream(case_.seed, repeat, growthPurpose),
                            case_.mostRings);
        isWhole = growInto(growth, repeat, sums);
      } else {
        MoleculeGrowth growth = newMolecule(case_, start, repeat);
        isWhole = growInto(growth, repeat, sums);
      }
      if (!isWhole) return;
    }
  }

  // A molecule of either description. False where the run is to stop before its end.
  template <class Growth>
  bool growInto(Growth& growth, std::uint64_t repeat, GrowthSums& sums) const {
    try {
      const bool isWhole = growMolecule(case_, growth, [&](std::size_t row, const Growth& now) {
        if (now.hasLeft()) return;
        const GrowthValues values = valuesOf(now);
        sums.add(row, values);
        if (std::ranges::binary_search(case_.spectra, row)) sums.addFormula(row, values);
        if constexpr (requires { now.molecule(); })
          if (case_.writesClosure) sums.addNeighbours(now.molecule());
      });
      if (isWhole) sums.addEvents(sumOf(growth));
      return isWhole;
    } catch (const NumericsError& error) {
      throw NumericsError(fmt::format("molecule {}: {}", repeat, error.what()));
    }
  }

  void write(const RunFolder& folder, const RunInfo& info, const GrowthSums& sums, RunRecord& record) const {
    const Table history = pahHistory(case_, sums), spectrum = pahSpectrum(case_, sums), rates = pahRateTable(case_);
    // They grow again, as their random numbers say.
    std::vector<Molecule> drawn;
    collectively(comm_, [&] {
      const Molecule start = case_.start();
      for (std::uint64_t repeat = 0; rank_ == 0 && repeat < case_.drawn; ++repeat) {
        MoleculeGrowth growth = newMolecule(case_, start, repeat);
        (void)growMolecule(
            case_, growth, [](std::size_t, const MoleculeGrowth&) {}, false);
        drawn.push_back(growth.molecule());
      }
      if (rank_ == 0) writeFileAtomically(folder.file("spectrum.csv"), csvTable(spectrum.columns, spectrum.rows));
      if (rank_ == 0 && case_.writesClosure)
        writeFileAtomically(folder.file("closure.csv"), sums.closure().write(case_.title));
    });
    ResultsWriter results(comm_, folder.results(), info);
    history.writeHistory(comm_, folder.history(), results);
    spectrum.write(results, "/spectrum");
    rates.write(results, "/rates");
    writeMolecules(results, drawn);
    results.close();
    if (rank_ != 0) return;
    record.resultsJson = jsonObject([&](JsonWriter& json) {
      json.field("repeats", case_.repeats).field("events", sums.events());
      history.recordLast(json);
    });
    const std::size_t last = case_.recorded.size() - 1;
    fmt::print("C {:.5g} +- {:.2g}, H {:.5g} +- {:.2g}, {} of {} molecules, {:.4g} events\n", sums.mean(last, 0),
               sums.standardError(last, 0), sums.mean(last, 1), sums.standardError(last, 1), sums.count(last),
               case_.repeats, static_cast<double>(sums.events()));
  }
};

}  // namespace

std::unique_ptr<PreparedRun> preparePah(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedPah>(comm, deck);
}

}  // namespace lampblack::app
