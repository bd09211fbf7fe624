// Stochastic populations in a closed reactor, in stirred ones over time, or in a plug flow: repeats that each are
// a reactor, or a network, of their own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "app/reactor/reactor_driver.hpp"
#include "app/reactor/reactor_ensemble_gas.hpp"
#include "app/reactor/reactor_ensemble_summary.hpp"
#include "app/reactor/reactor_ensemble_tables.hpp"
#include "app/reactor/reactor_history.hpp"
#include "app/reactor/reactor_output.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "coupling/reactor_balance.hpp"
#include "coupling/reactor_population.hpp"
#include "io/progress.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

using Kept = SplitReactor::Gas::Kept;

constexpr std::size_t defaultRows = 100;

bool isOpen(const ReactorCase& reactorCase) {
  return reactorCase.type == ReactorType::Stirred || reactorCase.type == ReactorType::Network;
}

// Elements (kg/kg) of what stands in an open reactor as long as all that flows in has the same, and so has the start;
// empty where they differ.
std::vector<double> elementsOfInflow(const ReactorCase& reactorCase, const ReactorBalance& balance) {
  const std::vector<double> none(reactorCase.ensemble->elements.size() + numReactors(reactorCase), 0.0);
  constexpr double same = 1e-14;
  std::vector<double> first;
  const auto agrees = [&](const std::vector<double>& Y) {
    const std::vector<double> elements = balance.elements(Y, none);
    if (first.empty()) first = elements;
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (std::abs(elements[e] - first[e]) > same) return false;
    return true;
  };
  for (const InflowStream& stream : reactorCase.network.inflows)
    if (!agrees(stream.Y)) return {};
  if (reactorCase.start.given && !agrees(reactorCase.start.given->Y)) return {};
  return first;
}

class EnsembleReactorDriver : public ReactorDriver {
 public:
  explicit EnsembleReactorDriver(const ReactorCase& reactorCase)
      : case_(reactorCase),
        distributions_(reactorCase.ensemble->make(0)->distributions()),
        hasElements_(!isOpen(reactorCase) || !startElements(reactorCase).empty()),
        summary_(columnsOf(reactorCase, hasElements_)),
        history_(summary_.columnsWithErrors()),
        tables_(*reactorCase.ensemble, summary_.columns()) {}

  void compute(const RunFolder& folder) override {
    const double begin = MPI_Wtime();
    positions_ = rowPositions();
    Progress progress(MPI_COMM_SELF, 0, static_cast<double>(case_.ensemble->repeats), Progress::logInterval);
    for (std::size_t r = 0; r < case_.ensemble->repeats && stopRequest() == 0; ++r) runRepeat(r, progress);
    progress.finish();
    summary_.summarise(isOpen(case_) ? shown() : std::vector<std::size_t>{});
    history_.open(folder.history());
    for (const auto& row : summary_.rows()) history_.row(row);
    seconds_ = MPI_Wtime() - begin;
  }

  void write(ResultsWriter& results) const override {
    history_.writeTo(results);
    const std::vector<double> edges = case_.ensemble->bins.edges();
    std::vector<double> diameter;
    for (std::size_t b = 0; b + 1 < edges.size(); ++b) diameter.push_back(std::sqrt(edges[b] * edges[b + 1]));
    const auto bins = static_cast<std::int64_t>(diameter.size());
    results.dataset("/particles/diameter", {bins}, diameter, "m", "middles of the bins of the size distribution");
    std::int64_t place = 0;
    for (std::size_t r = 0; r < numReactors(case_); ++r) {
      for (const ReactorPopulation::Distribution& distribution : distributions_) {
        // Rank 0 alone has rows.
        const auto part = [&](const std::vector<std::vector<double>>& all) {
          std::vector<double> values;
          for (const auto& row : all)
            values.insert(values.end(), row.begin() + place * bins, row.begin() + (place + 1) * bins);
          return values;
        };
        const std::string path = "/particles/" + prefix(case_, r) + distribution.name + "size_distribution";
        const auto rows = static_cast<std::int64_t>(summary_.distributions().size());
        results.dataset(path, {rows, bins}, part(summary_.distributions()), "1/m^3",
                        "dN/dlog10 d of each row of the table, mean of the repeats, " + distribution.description);
        results.dataset(path + "_error", {rows, bins}, part(summary_.distributionErrors()), "1/m^3",
                        "standard error of that mean");
        ++place;
      }
    }
    tables_.write(results);
  }

  void record(JsonWriter& json) const override {
    json.field("repeats", static_cast<std::int64_t>(summary_.repeats()));
    json.field("coupling_steps", static_cast<std::int64_t>(work_.steps));
    json.field("coupling_steps_rejected", static_cast<std::int64_t>(work_.rejected));
    if (work_.unchecked > 0) json.field("coupling_steps_too_long", static_cast<std::int64_t>(work_.unchecked));
    if (!counts_.empty()) {
      json.key("counts").beginObject();
      for (const auto& [name, value] : counts_) json.field(name, value);
      json.endObject();
    }
    std::vector<std::size_t> recorded;
    const std::size_t fractions = case_.output.species.size(), places = columnsOfPlace(case_).size();
    const std::size_t width = (summary_.columns().size() - places) / numReactors(case_);
    for (std::size_t c = 1; c < summary_.columns().size(); ++c)
      if (c < places || (c - places) % width + fractions < width) recorded.push_back(c);
    summary_.record(json, recorded);
  }

  void print() const override {
    summary_.print(shown());
    fmt::print("{} repeats, {} steps of gas and particles in turn, {} taken back, {} of the gas's integrator in {}\n",
               summary_.repeats(), work_.steps, work_.rejected, work_.gasSteps, formatDuration(seconds_));
    if (work_.unchecked > 0)
      fmt::print(
          "note: {} of these steps changed the gas by more than the deck's coupling_change allows and could not "
          "be taken back; a smaller one helps\n",
          work_.unchecked);
    for (const auto& [name, count] : counts_)
      if (name == "removals" && count > 0)
        fmt::print(
            "note: samples were full: {:g} numerical particles were removed at random, which keeps mass in the "
            "mean only; fewer are with a larger 'particles.number' or 'particles.full_at'\n",
            count);
  }

  long steps() const override { return work_.steps; }
  double simulatedTime() const override { return time_; }

 private:
  // Elements and energy, as they were in the first row or have to be.
  struct Balances {
    Balances(const Mechanism& mechanism, ParticlesAtRest& particles)
        : balance(mechanism, particles, particles.unitElements(mechanism)), thermo(mechanism) {}
    ReactorBalance balance;
    Thermo thermo;
    std::vector<double> elements;
    double energy = 0;
    bool hasEnergy = false;
  };

  static std::vector<double> startElements(const ReactorCase& reactorCase) {
    ParticlesAtRest particles(numReactors(reactorCase), reactorCase.ensemble->elements);
    return elementsOfInflow(reactorCase, Balances(*reactorCase.mechanism, particles).balance);
  }

  static std::vector<Quantity> columnsOfPlace(const ReactorCase& reactorCase) {
    if (reactorCase.type != ReactorType::PlugFlow) return {{"time", "s", "time"}};
    return {{"position", "m", "distance from the inlet"},
            {"time", "s", "residence time since the inlet"},
            {"velocity", "m/s", "velocity of gas and particles"}};
  }

  // Of the names of a reactor's columns: a network has several of each.
  static std::string prefix(const ReactorCase& reactorCase, std::size_t reactor) {
    return reactorCase.type == ReactorType::Network ? reactorCase.network.reactors[reactor].name + "_" : "";
  }

  static std::vector<Quantity> columnsOf(const ReactorCase& reactorCase, bool hasElements) {
    std::vector<Quantity> ofReactor{{"temperature", "K", "gas temperature"},
                                    {"pressure", "Pa", "pressure"},
                                    {"density", "kg/m^3", "density of gas and particles"}};
    for (const ReactorPopulation::Column& c : reactorCase.ensemble->make(0)->columns())
      ofReactor.push_back({c.name, c.unit, c.description});
    ofReactor.push_back({reactorCase.ensemble->material + "_mass_exchanged", "kg/m^3",
                         "mass of particles by what they exchanged with the gas; differs from theirs by numerical "
                         "particles that come and go, zero in the mean"});
    if (hasElements)
      ofReactor.push_back({"element_imbalance", "1",
                           isOpen(reactorCase) ? "largest relative difference of an element in gas and particles from "
                                                 "what flows in"
                                               : "largest relative change of an element in gas and particles"});
    if (!isOpen(reactorCase) && !reactorCase.profile)
      ofReactor.push_back({"energy_imbalance", "1", "change of the energy of gas and particles over cp T"});
    for (auto& column : speciesColumns(*reactorCase.mechanism, reactorCase.output))
      ofReactor.push_back(std::move(column));
    std::vector<Quantity> columns = columnsOfPlace(reactorCase);
    for (std::size_t r = 0; r < numReactors(reactorCase); ++r)
      for (const Quantity& column : ofReactor)
        columns.push_back({prefix(reactorCase, r) + column.name, column.unit, column.description});
    return columns;
  }

  // Columns for the summary on the console, of each reactor.
  [[nodiscard]] std::vector<std::size_t> shown() const {
    std::vector<std::size_t> columns;
    const auto& all = summary_.columns();
    for (std::size_t r = 0; r < numReactors(case_); ++r)
      for (const std::string& name :
           {std::string("temperature"), case_.ensemble->material + "_volume_fraction",
            case_.ensemble->material + "_number_density", case_.ensemble->material + "_mean_diameter"})
        columns.push_back(static_cast<std::size_t>(
            std::find_if(all.begin(), all.end(), [&](const Quantity& c) { return c.name == prefix(case_, r) + name; }) -
            all.begin()));
    return columns;
  }

  [[nodiscard]] double end() const { return case_.type == ReactorType::PlugFlow ? case_.length : case_.end; }

  [[nodiscard]] std::vector<double> rowPositions() const {
    const double interval = case_.output.interval.value_or(end() / static_cast<double>(defaultRows));
    std::vector<double> positions;
    for (std::size_t i = 0; static_cast<double>(i) * interval < end() * (1 - 1e-9); ++i)
      positions.push_back(static_cast<double>(i) * interval);
    positions.push_back(end());
    // And where tables are wanted.
    for (const double x : case_.ensemble->tablesAt) {
      const auto next = std::lower_bound(positions.begin(), positions.end(), x * (1 - 1e-9));
      if (next == positions.end() || *next > x * (1 + 1e-9)) positions.insert(next, x);
    }
    return positions;
  }

  void runRepeat(std::size_t index, Progress& progress) {
    const std::size_t reactors = numReactors(case_);
    EnsembleGas gas(case_);
    std::vector<std::unique_ptr<ReactorPopulation>> ensembles;
    std::vector<SplitParticles*> particles;
    for (std::size_t r = 0; r < reactors; ++r) {
      ensembles.push_back(case_.ensemble->make(index * reactors + r));
      particles.push_back(ensembles.back().get());
    }
    SplitReactor::Options split;
    split.integrator = case_.integrator;
    split.change = case_.couplingChange;
    SplitReactor reactor(*case_.mechanism, gas.gas(), particles, split);
    reactor.start(0, gas.start());
    Balances balances(*case_.mechanism, gas.particles());
    if (isOpen(case_)) balances.elements = elementsOfInflow(case_, balances.balance);
    EnsembleSummary::Repeat repeat;
    for (const double x : positions_) {
      try {
        reactor.advance(x);
      } catch (const NumericsError& error) {
        throw NumericsError(fmt::format("ensemble, repeat {}: {}", index + 1, error.what()));
      }
      std::vector<double> row{reactor.position()};
      if (case_.type == ReactorType::PlugFlow)
        row.insert(row.end(),
                   {gas.time(reactor.position(), reactor.state()), 1 / gas.gas().timePerUnit(reactor.state().data())});
      repeat.distributions.emplace_back();
      for (std::size_t r = 0; r < reactors; ++r) {
        ReactorPopulation& population = *ensembles[r];
        population.settle();
        append(row, reactor.state(r), gas.gas(), r, population, balances);
        const SizeBins& bins = case_.ensemble->bins;
        for (std::size_t k = 0; k < distributions_.size(); ++k) {
          const auto sizes = population.distribution(k, bins.logMin, bins.logMax, bins.count);
          repeat.distributions.back().insert(repeat.distributions.back().end(), sizes.begin(), sizes.end());
        }
      }
      if (index == 0) tables_.take(*ensembles[0], row);
      repeat.rows.push_back(std::move(row));
      if (stopRequest() != 0) return;
      const Quantity& place = summary_.columns()[0];
      progress.say(
          fmt::format("repeat {} of {}, {} {:.4g} {}", index + 1, case_.ensemble->repeats, place.name, x, place.unit),
          static_cast<double>(index) + x / end());
    }
    time_ = gas.time(positions_.back(), reactor.state());
    work_.steps += reactor.work().steps;
    work_.rejected += reactor.work().rejected;
    work_.gasSteps += reactor.work().gasSteps;
    work_.unchecked += reactor.work().unchecked;
    for (const auto& ensemble : ensembles) {
      const auto counts = ensemble->counts();
      if (counts_.empty())
        for (const auto& [name, value] : counts) counts_.emplace_back(name, 0.0);
      for (std::size_t c = 0; c < counts.size(); ++c) counts_[c].second += counts[c].second;
    }
    summary_.add(std::move(repeat));
  }

  // What the row has of a reactor with the unknowns y.
  void append(std::vector<double>& row, std::span<const double> y, const SplitReactor::Gas& gas, std::size_t reactor,
              const ReactorPopulation& population, Balances& kept) const {
    const std::size_t n = case_.mechanism->numSpecies(), elements = case_.ensemble->elements.size();
    const std::span<const double> Y = y.first(n), amounts = y.subspan(n + 1, elements + numReactors(case_));
    const double T = y[n], density = gas.density(y.data());
    row.insert(row.end(), {T, gas.pressure(y.data()), density});
    const std::vector<double> values = population.values();
    row.insert(row.end(), values.begin(), values.end());
    row.push_back(density *
                  std::accumulate(amounts.begin(), amounts.begin() + static_cast<std::ptrdiff_t>(elements), 0.0));
    if (hasElements_) {
      const std::vector<double> now = kept.balance.elements(Y, amounts);
      if (kept.elements.empty()) kept.elements = now;
      row.push_back(largestImbalance(kept.elements, now));
    }
    if (!isOpen(case_) && !case_.profile) {
      const double energy = gas.kept[reactor] == Kept::enthalpy ? kept.balance.enthalpy(T, Y, amounts)
                                                                : kept.balance.internalEnergy(T, Y, amounts);
      if (!std::exchange(kept.hasEnergy, true)) kept.energy = energy;
      row.push_back((energy - kept.energy) / (kept.thermo.cpMass(T, Y) * T));
    }
    appendSpecies(*case_.mechanism, case_.output, Y, row);
  }

  const ReactorCase& case_;
  std::vector<ReactorPopulation::Distribution> distributions_;
  std::vector<std::pair<std::string, double>> counts_;  // of all repeats
  bool hasElements_;
  EnsembleSummary summary_;
  ReactorHistory history_;
  EnsembleTables tables_;
  std::vector<double> positions_;
  SplitReactor::Work work_;
  double time_ = 0, seconds_ = 0;
};

}  // namespace

std::unique_ptr<ReactorDriver> ensembleReactorDriver(const ReactorCase& reactorCase) {
  return std::make_unique<EnsembleReactorDriver>(reactorCase);
}

}  // namespace lampblack::app
