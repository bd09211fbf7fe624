// Ensembles of soot particles in a closed reactor, a stirred one over time, or a plug flow: repeats that each are a
// reactor of their own, and their means with the standard errors of these.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "app/reactor/reactor_driver.hpp"
#include "app/reactor/reactor_history.hpp"
#include "app/reactor/reactor_output.hpp"
#include "chemistry/reactor/plug_flow.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "coupling/reactor_balance.hpp"
#include "coupling/reactor_ensemble.hpp"
#include "coupling/split_reactor.hpp"
#include "io/progress.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

using Kept = SplitReactor::Gas::Kept;

constexpr std::size_t defaultRows = 100;

// The equations of the gas of a case, for one repeat.
class EnsembleGas {
 public:
  explicit EnsembleGas(const ReactorCase& reactorCase) : case_(reactorCase) {
    const Mechanism& mechanism = *case_.mechanism;
    const std::size_t atRest = ParticlesAtRest::count;
    gas_.timePerUnit = [](const double*) { return 1.0; };
    gas_.pressure = [p = pressureHeld()](const double*) { return p; };
    if (case_.type == ReactorType::PlugFlow) {
      plugFlow_.emplace(mechanism, case_.inlet, case_.massFlux, case_.length, case_.profile, &particles_);
      start_ = plugFlow_->initialState();
      gas_.system = &*plugFlow_;
      gas_.density = [this](const double* y) { return plugFlow_->density(y); };
      gas_.timePerUnit = [this](const double* y) { return 1 / plugFlow_->velocity(y); };
    } else if (case_.type == ReactorType::Stirred) {
      network_.emplace(mechanism, case_.network, &particles_);
      start_ = startUnknowns(mechanism, case_.network, case_.start, atRest);
      gas_.system = &*network_;
      gas_.density = [this](const double* y) { return network_->density(y); };
      gas_.kept = case_.network.reactors[0].temperature ? Kept::temperature : Kept::enthalpy;
    } else {
      const bool pressure = case_.type == ReactorType::ConstantPressure;
      closed_.emplace(mechanism, case_.initial, pressure ? ReactorSystem::Held::Pressure : ReactorSystem::Held::Density,
                      case_.profile, &particles_);
      start_ = closed_->initialState();
      gas_.system = &*closed_;
      gas_.density = [this](const double* y) { return closed_->density(y); };
      gas_.pressure = [this](const double* y) { return closed_->pressure(y); };
      if (!pressure) gas_.kept = Kept::internalEnergy;
    }
    if (!case_.profile) return;
    gas_.kept = Kept::temperature;
    gas_.nextStop = [this](double x) { return case_.profile->nextKink(x).value_or(INFINITY); };
  }
  EnsembleGas(const EnsembleGas&) = delete;
  EnsembleGas& operator=(const EnsembleGas&) = delete;

  [[nodiscard]] const SplitReactor::Gas& gas() const { return gas_; }
  [[nodiscard]] const std::vector<double>& start() const { return start_; }
  ParticlesAtRest& particles() { return particles_; }
  // s
  [[nodiscard]] double time(double x, std::span<const double> y) const {
    return plugFlow_ ? plugFlow_->residenceTime(y.data()) : x;
  }

 private:
  [[nodiscard]] double pressureHeld() const {
    return case_.type == ReactorType::PlugFlow  ? case_.inlet.pressure
           : case_.type == ReactorType::Stirred ? case_.network.pressure
                                                : case_.initial.pressure;
  }

  const ReactorCase& case_;
  ParticlesAtRest particles_;
  std::optional<ClosedReactor> closed_;
  std::optional<PlugFlow> plugFlow_;
  std::optional<NetworkSystem> network_;
  SplitReactor::Gas gas_;
  std::vector<double> start_;
};

class EnsembleReactorDriver : public ReactorDriver {
 public:
  explicit EnsembleReactorDriver(const ReactorCase& reactorCase)
      : case_(reactorCase), columns_(columnsOf(reactorCase)), history_(withErrors(columns_)) {}

  void compute(const RunFolder& folder) override {
    const double begin = MPI_Wtime();
    positions_ = rowPositions();
    Progress progress(MPI_COMM_SELF, 0, static_cast<double>(case_.ensemble->repeats), Progress::logInterval);
    for (std::size_t r = 0; r < case_.ensemble->repeats && stopRequest() == 0; ++r) runRepeat(r, progress);
    progress.finish();
    summarise();
    history_.open(folder.history());
    for (const auto& row : rows_) history_.row(row);
    seconds_ = MPI_Wtime() - begin;
  }

  void write(ResultsWriter& results) const override {
    history_.writeTo(results);
    const std::vector<double> edges = case_.ensemble->bins.binEdges();
    std::vector<double> diameter;
    for (std::size_t b = 0; b + 1 < edges.size(); ++b) diameter.push_back(std::sqrt(edges[b] * edges[b + 1]));
    const auto bins = static_cast<std::int64_t>(diameter.size());
    const auto rows = static_cast<std::int64_t>(distribution_.size()) / bins;
    results.dataset("/particles/diameter", {bins}, diameter, "m", "middles of the bins of the size distribution");
    results.dataset("/particles/size_distribution", {rows, bins}, distribution_, "1/m^3",
                    "dN/dlog10 d of each row of the table, mean of the repeats");
    results.dataset("/particles/size_distribution_error", {rows, bins}, distributionError_, "1/m^3",
                    "standard error of that mean");
  }

  void record(JsonWriter& json) const override {
    json.field("repeats", static_cast<std::int64_t>(repeats_.size()));
    json.field("coupling_steps", static_cast<std::int64_t>(work_.steps));
    json.field("coupling_steps_rejected", static_cast<std::int64_t>(work_.rejected));
    if (rows_.empty()) return;
    const std::size_t n = columns_.size();
    for (std::size_t c = 1; c < n; ++c) {
      if (columns_[c].name.starts_with("X_") || columns_[c].name.starts_with("Y_")) continue;
      json.field("final_" + columns_[c].name, rows_.back()[c]);
      json.field("final_" + columns_[c].name + "_error", rows_.back()[n - 1 + c]);
    }
    for (const Late& late : late_)
      json.field("late_mean_" + late.name, late.mean)
          .field("late_mean_" + late.name + "_error", late.error)
          .field("late_drift_" + late.name, late.drift);
  }

  void print() const override {
    if (rows_.empty()) return;
    for (const char* name : {"temperature", "soot_volume_fraction", "soot_number_density", "soot_mean_diameter"}) {
      const std::size_t c = column(name);
      fmt::print("{:<24} {:.6g} +- {:.2g} {}\n", name, rows_.back()[c], rows_.back()[columns_.size() - 1 + c],
                 columns_[c].unit);
    }
    for (const Late& late : late_)
      fmt::print("second half: {:<24} {:.6g} +- {:.2g}, its last quarter less the one before {:.2g}\n", late.name,
                 late.mean, late.error, late.drift);
    fmt::print("{} repeats, {} steps of gas and particles in turn, {} taken back, {} of the gas's integrator in {}\n",
               repeats_.size(), work_.steps, work_.rejected, work_.gasSteps, formatDuration(seconds_));
  }

  long steps() const override { return work_.steps; }
  double simulatedTime() const override { return time_; }

 private:
  // A repeat: its rows, and their size distributions.
  struct Repeat {
    std::vector<std::vector<double>> rows, distributions;
  };
  // The mean over the second half of the time of a stirred reactor.
  struct Late {
    std::string name;
    double mean = 0, error = 0, drift = 0;
  };

  static bool isKept(const ReactorCase& reactorCase) { return reactorCase.type != ReactorType::Stirred; }

  static std::vector<Quantity> columnsOf(const ReactorCase& reactorCase) {
    std::vector<Quantity> columns{{"time", "s", "time"}};
    if (reactorCase.type == ReactorType::PlugFlow)
      columns = {{"position", "m", "distance from the inlet"},
                 {"time", "s", "residence time since the inlet"},
                 {"velocity", "m/s", "velocity of gas and particles"}};
    for (const Quantity& more :
         {Quantity{"temperature", "K", "gas temperature"}, Quantity{"pressure", "Pa", "pressure"},
          Quantity{"density", "kg/m^3", "density of gas and particles"},
          Quantity{"soot_volume_fraction", "1", "particle volume per volume of gas"},
          Quantity{"soot_number_density", "1/m^3", "particles"},
          Quantity{"soot_mean_diameter", "m", "of the sphere of mean volume"},
          Quantity{"soot_mobility_diameter", "m", "mean mobility diameter"},
          Quantity{"soot_geometric_deviation", "1", "of the diameter of mobility, by number"},
          Quantity{"soot_surface_area", "m^2/m^3", "surface of all particles"},
          Quantity{"soot_carbon", "kg/m^3", "carbon in particles"},
          Quantity{"soot_hydrogen", "kg/m^3", "hydrogen in particles"},
          Quantity{"soot_mass_exchanged", "kg/m^3",
                   "mass of particles by what they exchanged with the gas; differs from carbon and "
                   "hydrogen by numerical particles that come and go, zero in the mean"}})
      columns.push_back(more);
    if (isKept(reactorCase)) {
      columns.push_back({"element_imbalance", "1", "largest relative change of an element in gas and particles"});
      if (!reactorCase.profile)
        columns.push_back({"energy_imbalance", "1", "change of the energy of gas and particles over cp T"});
    }
    for (auto& column : speciesColumns(*reactorCase.mechanism, reactorCase.output))
      columns.push_back(std::move(column));
    return columns;
  }

  static std::vector<Quantity> withErrors(const std::vector<Quantity>& columns) {
    std::vector<Quantity> all = columns;
    for (std::size_t c = 1; c < columns.size(); ++c)
      all.push_back({columns[c].name + "_error", columns[c].unit, "standard error of the mean of the repeats"});
    return all;
  }

  [[nodiscard]] std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(
        std::find_if(columns_.begin(), columns_.end(), [&](const Quantity& c) { return c.name == name; }) -
        columns_.begin());
  }

  [[nodiscard]] double end() const { return case_.type == ReactorType::PlugFlow ? case_.length : case_.end; }

  [[nodiscard]] std::vector<double> rowPositions() const {
    const double interval = case_.output.interval.value_or(end() / static_cast<double>(defaultRows));
    std::vector<double> positions;
    for (std::size_t i = 0; static_cast<double>(i) * interval < end() * (1 - 1e-9); ++i)
      positions.push_back(static_cast<double>(i) * interval);
    positions.push_back(end());
    return positions;
  }

  void runRepeat(std::size_t index, Progress& progress) {
    EnsembleGas gas(case_);
    EnsembleOptions options = case_.ensemble->soot;
    options.owner = index;
    ReactorEnsemble ensemble(*case_.mechanism, options);
    SplitReactor::Options split;
    split.integrator = case_.integrator;
    split.change = case_.couplingChange;
    SplitReactor reactor(*case_.mechanism, gas.gas(), ensemble, split);
    reactor.start(0, gas.start());
    Balances balances(*case_.mechanism, gas);
    Repeat repeat;
    for (const double x : positions_) {
      try {
        reactor.advance(x);
      } catch (const NumericsError& error) {
        throw NumericsError(fmt::format("ensemble, repeat {}: {}", index + 1, error.what()));
      }
      repeat.rows.push_back(row(reactor, gas, ensemble, balances));
      const EnsemblePathOptions& bins = case_.ensemble->bins;
      repeat.distributions.push_back(
          ensemble.population().sizeDistribution(bins.logDiameterMin, bins.logDiameterMax, bins.bins));
      if (stopRequest() != 0) return;
      progress.say(fmt::format("repeat {} of {}, {} {:.4g} {}", index + 1, case_.ensemble->repeats, columns_[0].name, x,
                               columns_[0].unit),
                   static_cast<double>(index) + x / end());
    }
    time_ = gas.time(positions_.back(), reactor.state());
    work_.steps += reactor.work().steps;
    work_.rejected += reactor.work().rejected;
    work_.gasSteps += reactor.work().gasSteps;
    repeats_.push_back(std::move(repeat));
  }

  struct Balances {
    Balances(const Mechanism& mechanism, EnsembleGas& gas)
        : balance(mechanism, gas.particles(), ParticlesAtRest::unitElements(mechanism)), thermo(mechanism) {}
    ReactorBalance balance;
    Thermo thermo;
    std::vector<double> elements;
    double energy = 0;
  };

  std::vector<double> row(SplitReactor& reactor, const EnsembleGas& gas, const ReactorEnsemble& ensemble,
                          Balances& kept) const {
    const std::span<const double> y = reactor.state();
    const std::size_t n = case_.mechanism->numSpecies();
    const std::span<const double> Y = y.first(n), amounts = y.subspan(n + 1, ParticlesAtRest::count);
    const double T = y[n], density = gas.gas().density(y.data());
    const Ensemble::Totals totals = ensemble.population().totals();
    const double fraction = ensemble.population().volumeFraction();
    std::vector<double> row{reactor.position()};
    if (case_.type == ReactorType::PlugFlow)
      row.insert(row.end(), {gas.time(reactor.position(), y), 1 / gas.gas().timePerUnit(y.data())});
    row.insert(row.end(),
               {T, gas.gas().pressure(y.data()), density, fraction, totals.number,
                totals.number > 0 ? std::cbrt(6 / constants::pi * fraction / totals.number) : 0.0,
                totals.meanDiameter(), ensemble.population().geometricDeviation(), totals.surface, totals.carbon,
                totals.hydrogen, density * (amounts[ParticlesAtRest::carbon] + amounts[ParticlesAtRest::hydrogen])});
    if (isKept(case_)) {
      const std::vector<double> elements = kept.balance.elements(Y, amounts);
      const bool isFirst = kept.elements.empty();
      if (isFirst) kept.elements = elements;
      row.push_back(largestImbalance(kept.elements, elements));
      if (!case_.profile) {
        const double energy = gas.gas().kept == Kept::enthalpy ? kept.balance.enthalpy(T, Y, amounts)
                                                               : kept.balance.internalEnergy(T, Y, amounts);
        if (isFirst) kept.energy = energy;
        row.push_back((energy - kept.energy) / (kept.thermo.cpMass(T, Y) * T));
      }
    }
    appendSpecies(*case_.mechanism, case_.output, Y, row);
    return row;
  }

  // Mean of the repeats and its standard error.
  template <typename Value>
  std::pair<double, double> meanAndError(const Value& value) const {
    const auto count = static_cast<double>(repeats_.size());
    double mean = 0, sum = 0;
    for (const Repeat& repeat : repeats_) mean += value(repeat) / count;
    for (const Repeat& repeat : repeats_) sum += std::pow(value(repeat) - mean, 2);
    return {mean, std::sqrt(sum / (count * (count - 1)))};
  }

  void summarise() {
    if (repeats_.size() < 2) return;  // stopped
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      std::vector<double> means, errors;
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        const auto [mean, error] = meanAndError([&](const Repeat& r) { return r.rows[i][c]; });
        means.push_back(mean);
        if (c > 0) errors.push_back(error);
      }
      means.insert(means.end(), errors.begin(), errors.end());
      rows_.push_back(std::move(means));
      for (std::size_t b = 0; b < case_.ensemble->bins.bins; ++b) {
        const auto [mean, error] = meanAndError([&](const Repeat& r) { return r.distributions[i][b]; });
        distribution_.push_back(mean);
        distributionError_.push_back(error);
      }
    }
    if (case_.type != ReactorType::Stirred) return;
    const std::size_t half = positions_.size() / 2, quarter = positions_.size() - half / 2;
    for (const char* name : {"temperature", "soot_volume_fraction", "soot_number_density", "soot_mean_diameter"}) {
      const std::size_t c = column(name);
      const auto over = [&](std::size_t first, std::size_t last) {
        return meanAndError([&](const Repeat& r) {
          double sum = 0;
          for (std::size_t i = first; i < last; ++i) sum += r.rows[i][c];
          return sum / static_cast<double>(last - first);
        });
      };
      const auto [mean, error] = over(half, positions_.size());
      late_.push_back({name, mean, error, over(quarter, positions_.size()).first - over(half, quarter).first});
    }
  }

  const ReactorCase& case_;
  std::vector<Quantity> columns_;
  ReactorHistory history_;
  std::vector<double> positions_;
  std::vector<Repeat> repeats_;
  std::vector<std::vector<double>> rows_;
  std::vector<double> distribution_, distributionError_;
  std::vector<Late> late_;
  SplitReactor::Work work_;
  double time_ = 0, seconds_ = 0;
};

}  // namespace

std::unique_ptr<ReactorDriver> ensembleReactorDriver(const ReactorCase& reactorCase) {
  return std::make_unique<EnsembleReactorDriver>(reactorCase);
}

}  // namespace lampblack::app
