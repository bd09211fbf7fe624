// Stochastic populations in a closed reactor, in stirred ones over time, or in a plug flow: repeats, spread over the
// ranks, that each are a reactor, or a network, of their own.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/problems/reactor/reactor_driver.hpp"
#include "app/problems/reactor/reactor_ensemble_classes.hpp"
#include "app/problems/reactor/reactor_ensemble_columns.hpp"
#include "app/problems/reactor/reactor_ensemble_distributions.hpp"
#include "app/problems/reactor/reactor_ensemble_repeat.hpp"
#include "app/problems/reactor/reactor_ensemble_summary.hpp"
#include "app/problems/reactor/reactor_ensemble_tables.hpp"
#include "app/problems/reactor/reactor_history.hpp"
#include "core/errors.hpp"
#include "core/repeats.hpp"
#include "core/stop_request.hpp"
#include "io/progress.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

constexpr std::size_t defaultRows = 100;

std::vector<double> rowPlaces(const ReactorCase& reactorCase) {
  const double end = reactorCase.kind->end();
  const double interval = reactorCase.output.interval.value_or(end / static_cast<double>(defaultRows));
  std::vector<double> places = reactorCase.kind->rows();
  if (places.empty()) {
    for (std::size_t i = 0; static_cast<double>(i) * interval < end * (1 - 1e-9); ++i)
      places.push_back(static_cast<double>(i) * interval);
    places.push_back(end);
  }
  // And where tables are wanted.
  for (const double x : reactorCase.ensemble->tablesAt) {
    const auto next = std::lower_bound(places.begin(), places.end(), x * (1 - 1e-9));
    if (next == places.end() || *next > x * (1 + 1e-9)) places.insert(next, x);
  }
  return places;
}

ReactorRepeatShape shapeOf(const ReactorCase& reactorCase, std::size_t rows, std::size_t columns) {
  const auto population = reactorCase.ensemble->make(0);
  ReactorRepeatShape shape;
  shape.rows = rows;
  shape.columns = columns;
  shape.densities =
      reactorCase.kind->reactors() *
      (population->distributions().size() * reactorCase.ensemble->bins.count + population->shares().size() * shareBins);
  shape.classes = EnsembleClasses::size(reactorCase);
  shape.counts = population->counts().size();
  return shape;
}

class EnsembleReactorDriver : public ReactorDriver {
 public:
  explicit EnsembleReactorDriver(const ReactorCase& reactorCase)
      : case_(reactorCase),
        places_(rowPlaces(reactorCase)),
        columns_(ensembleColumns(reactorCase, hasElementBalance(reactorCase))),
        shape_(shapeOf(reactorCase, places_.size(), columns_.size())),
        summary_(columns_, shape_, (reactorCase.kind->network() != nullptr) ? shown() : std::vector<std::size_t>{}),
        classes_(reactorCase, shape_),
        distributions_(reactorCase),
        tables_(*reactorCase.ensemble, columns_) {
    for (const auto& [name, value] : reactorCase.ensemble->make(0)->counts()) counts_.emplace_back(name, 0.0);
  }

  void run(MPI_Comm comm, const RunFolder& folder) override {
    const double begin = MPI_Wtime();
    int ranks = 1, rank = 0;
    MPI_Comm_size(comm, &ranks);
    MPI_Comm_rank(comm, &rank);
    const std::size_t repeats = case_.ensemble->repeats;
    Progress progress(comm, 0, std::ceil(static_cast<double>(repeats) / ranks), Progress::logInterval);
    const std::uint64_t most = repeatsAtATime(comm, shape_.size());
    for (std::uint64_t first = 0; first < repeats && agreedStopRequest(comm) == 0; first += most) {
      const std::vector<double> numbers =
          gatherRepeats(comm, first, std::min<std::uint64_t>(repeats, first + most), shape_.size(),
                        [&](std::uint64_t repeat, std::span<double> row) {
                          runRepeat(repeat, row, progress, std::floor(static_cast<double>(repeat) / ranks));
                        });
      for (std::size_t at = 0; at < numbers.size(); at += shape_.size())
        add(ReactorRepeatNumbers<const double>(shape_, std::span(numbers).subspan(at, shape_.size())));
    }
    progress.finish();
    collectively(comm, [&] {
      if (rank == 0) writeText(folder);
    });
    seconds_ = MPI_Wtime() - begin;
  }

  void write(ResultsWriter& results) const override {
    history_.writeTo(results);
    distributions_.write(results, summary_);
    classes_.write(results, places_);
    tables_.write(results);
  }

  void record(JsonWriter& json) const override {
    json.field("repeats", static_cast<std::int64_t>(summary_.repeats()));
    json.field("coupling_steps", whole(Shape::steps));
    json.field("coupling_steps_rejected", whole(Shape::rejected));
    if (work_[Shape::unchecked] > 0) json.field("coupling_steps_too_long", whole(Shape::unchecked));
    if (!counts_.empty()) {
      json.key("counts").beginObject();
      for (const auto& [name, value] : counts_) json.field(name, value);
      json.endObject();
    }
    std::vector<std::size_t> recorded;
    const std::size_t fractions = case_.output.species.size(), places = case_.kind->placeColumns().size();
    const std::size_t width = (columns_.size() - places) / case_.kind->reactors();
    for (std::size_t c = 1; c < columns_.size(); ++c)
      if (c < places || (c - places) % width + fractions < width) recorded.push_back(c);
    summary_.record(json, recorded);
  }

  void print() const override {
    summary_.print(shown());
    fmt::print(
        "{} repeats, {} coupling steps of gas and particles, {} rejected, {} integrator steps of the gas in {}\n",
        summary_.repeats(), whole(Shape::steps), whole(Shape::rejected), whole(Shape::gasSteps),
        formatDuration(seconds_));
    if (work_[Shape::unchecked] > 0)
      fmt::print(
          "note: {} of these steps changed the gas by more than the deck's coupling_change allows and could not "
          "be rejected; choose a smaller coupling_change\n",
          whole(Shape::unchecked));
    if (const double pairs = count("collision_pairs"); pairs > 0)
      fmt::print("{:g} of {:g} pairs of particles above the majorant\n", count("collision_pairs_above_majorant"),
                 pairs);
    if (const double removals = count("removals"); removals > 0 && counts("samples_never_full"))
      fmt::print(
          "note: samples were full: {:g} numerical particles were removed at random, which keeps mass in the "
          "mean only; choose a larger 'particles.number' or 'particles.expected_number'\n",
          removals);
    if (const double starved = count("samples_never_full"); starved > 0) {
      double largest = 0;
      for (std::size_t r = 0; r < case_.kind->reactors(); ++r)
        largest =
            std::max(largest, summary_.largest(case_.kind->prefix(r) + case_.ensemble->material + "_number_density"));
      fmt::print(
          "note: {:g} samples were never three quarters full, so that they were not doubled as particles became few: "
          "noise grows with time; choose 'particles.expected_number' near the largest number density, {:.2g} 1/m^3 "
          "in this run\n",
          starved, largest);
    }
  }

  long steps() const override { return static_cast<long>(whole(Shape::steps)); }
  double simulatedTime() const override { return time_; }

 private:
  using Shape = ReactorRepeatShape;

  [[nodiscard]] std::vector<std::size_t> shown() const { return shownColumns(case_, columns_); }
  [[nodiscard]] std::int64_t whole(Shape::Work which) const { return static_cast<std::int64_t>(work_[which]); }
  [[nodiscard]] bool counts(const std::string& name) const {
    return std::ranges::any_of(counts_, [&](const auto& count) { return count.first == name; });
  }
  [[nodiscard]] double count(const std::string& name) const {
    for (const auto& [known, value] : counts_)
      if (known == name) return value;
    return 0;
  }

  // Any rank, of those repeats that are its own; `before`: how many it has had.
  void runRepeat(std::uint64_t repeat, std::span<double> row, Progress& progress, double before) {
    EnsembleRepeat run(case_, repeat);
    const ReactorRepeatNumbers<double> numbers(shape_, row);
    run.run(places_, numbers, [&](std::size_t at, double x) {
      if (repeat == 0) tables_.take(run.population(0), numbers.columns(at));
      if (stopRequest() != 0) return false;
      if (progress.due())
        progress.say(fmt::format("repeat {} of {}, {} {:.4g} {}", repeat + 1, case_.ensemble->repeats, columns_[0].name,
                                 x, columns_[0].unit),
                     before + x / case_.kind->end());
      return true;
    });
  }

  // On rank 0, in the order of the repeats. One that was stopped does not count.
  void add(const ReactorRepeatNumbers<const double>& repeat) {
    if (repeat.work(Shape::isWhole) == 0) return;
    summary_.add(repeat);
    classes_.add(repeat);
    for (const auto which : {Shape::steps, Shape::rejected, Shape::gasSteps, Shape::unchecked})
      work_[which] += repeat.work(which);
    time_ = repeat.work(Shape::time);
    for (std::size_t c = 0; c < counts_.size(); ++c) counts_[c].second += repeat.counts()[c];
  }

  void writeText(const RunFolder& folder) {
    history_.open(folder.history());
    for (std::size_t row = 0; row < summary_.rows(); ++row) history_.row(summary_.row(row));
    distributions_.writeTables(folder, summary_);
    classes_.writeTables(folder, places_);
  }

  const ReactorCase& case_;
  std::vector<double> places_;
  std::vector<Quantity> columns_;
  ReactorRepeatShape shape_;
  EnsembleSummary summary_;
  EnsembleClasses classes_;
  EnsembleDistributions distributions_;
  EnsembleTables tables_;
  ReactorHistory history_{summary_.columnsWithErrors()};
  std::vector<std::pair<std::string, double>> counts_;  // of all repeats
  std::array<double, Shape::works> work_{};
  double time_ = 0, seconds_ = 0;
};

}  // namespace

std::unique_ptr<ReactorDriver> ensembleReactorDriver(const ReactorCase& reactorCase) {
  return std::make_unique<EnsembleReactorDriver>(reactorCase);
}

}  // namespace lampblack::app
