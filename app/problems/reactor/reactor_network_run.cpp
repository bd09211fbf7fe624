// Stirred reactors: the transient of one, the steady state of one or of a network.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/problems/reactor/reactor_driver.hpp"
#include "app/problems/reactor/reactor_output.hpp"
#include "app/problems/reactor/reactor_particle_output.hpp"
#include "app/problems/reactor/reactor_rows.hpp"
#include "core/errors.hpp"
#include "io/csv.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

StateTable<NetworkSystem> stirredTable(const ReactorCase& reactorCase) {
  using State = std::span<const double>;
  StateTable<NetworkSystem> table{
      {{"time", "s", "time"}, [](NetworkSystem&, double t, State) { return t; }},
      temperatureColumn<NetworkSystem>(reactorCase),
      {{"density", "kg/m^3", "density"}, [](NetworkSystem& s, double, State y) { return s.density(y.data()); }},
      {{"residence_time", "s", "mass inside over mass flow in"},
       [](NetworkSystem& s, double, State y) { return s.residenceTime(y.data(), 0); }},
      {{"heat_release", "W/m^3", "heat set free by the reactions"},
       [](NetworkSystem& s, double, State y) { return s.heatRelease(y.data(), 0); }}};
  addSpecies(table, reactorCase);
  return table;
}

class StirredTransientDriver : public ReactorOfOneRank {
 public:
  StirredTransientDriver(const ReactorCase& reactorCase, const StirredKind& stirred)
      : case_(reactorCase),
        stirred_(stirred),
        rows_(reactorCase, ReactorParticleOutput::Kept::nothing, stirredTable(reactorCase)) {}

  void compute(const RunFolder& folder) override {
    const double begin = MPI_Wtime();
    NetworkSystem system(*case_.mechanism, stirred_.vessels, case_.particles.get());
    StiffIntegrator integrator(system, case_.integrator);
    integrator.start(0.0, startUnknowns(*case_.mechanism, stirred_.vessels, stirred_.start, system.numCarried()),
                     stirred_.duration);
    rows_.follow(system, integrator, folder, stirred_.duration, [&](double, std::span<const double> y) {
      return ReactorGas{stirred_.vessels.pressure, system.density(y.data())};
    });
    steps_ = integrator.statistics().steps;
    reached_ = integrator.time();
    temperature_ = integrator.state()[case_.mechanism->numSpecies()];
    seconds_ = MPI_Wtime() - begin;
    rows_.particles().requireSizeRangeCovered();
  }

  void write(ResultsWriter& results) const override { rows_.writeTo(results); }
  void record(JsonWriter& json) const override {
    json.field("final_temperature_K", temperature_);
    rows_.particles().record(json);
  }
  void print() const override {
    fmt::print("T = {:.4f} K after {:g} s\n", temperature_, stirred_.duration);
    rows_.particles().print();
    fmt::print("{} steps of the integrator in {}\n", steps_, formatDuration(seconds_));
  }
  long steps() const override { return steps_; }
  double simulatedTime() const override { return reached_; }

 private:
  const ReactorCase& case_;
  const StirredKind& stirred_;
  ReactorRows<NetworkSystem> rows_;
  long steps_ = 0;
  double reached_ = 0;  // s
  double temperature_ = 0, seconds_ = 0;
};

class SteadyNetworkDriver : public ReactorOfOneRank {
 public:
  SteadyNetworkDriver(const ReactorCase& reactorCase, const StirredKind& stirred)
      : case_(reactorCase), stirred_(stirred), particles_(reactorCase, ReactorParticleOutput::Kept::nothing) {}

  void compute(const RunFolder& folder) override {
    const double begin = MPI_Wtime();
    solve();
    makeRows();
    particles_.requireSizeRangeCovered();
    seconds_ = MPI_Wtime() - begin;
    std::string text = "name," + csvHeader(columns());
    for (std::size_t r = 0; r < reactors_.size(); ++r) {
      std::vector<std::string> fields{stirred_.vessels.reactors[r].name};
      for (const double value : rows_[r]) fields.push_back(fmt::format("{}", value));
      text += csvLine(fields);
    }
    writeFileAtomically(folder.file("reactors.csv"), text);
  }

  void write(ResultsWriter& results) const override {
    std::vector<double> rows;
    for (const auto& row : rows_) rows.insert(rows.end(), row.begin(), row.end());
    results.table("/reactors", columns(), rows);
    particles_.write(results);
    std::vector<std::string> names;
    for (const StirredReactor& reactor : stirred_.vessels.reactors) names.push_back(reactor.name);
    std::string line = csvLine(names);
    line.pop_back();
    results.attribute("/reactors", "names", line);
    for (std::size_t r = 0; r < reactors_.size(); ++r)
      if (reactors_[r].out)
        results.attribute("/reactors", "last_burning_residence_time_" + names[r],
                          reactors_[r].lastBurningTime.value_or(NAN));
  }

  void record(JsonWriter& json) const override {
    json.key("reactors").beginObject();
    for (std::size_t r = 0; r < reactors_.size(); ++r) {
      json.key(stirred_.vessels.reactors[r].name).beginObject();
      json.field("temperature_K", reactors_[r].state.temperature);
      json.field("residence_time_s", reactors_[r].residenceTime).field("residual", reactors_[r].residual);
      recordOut(json, reactors_[r]);
      if (case_.particles) {
        const std::string material = case_.soot->material() + "_";
        for (const auto& p : particlePropertyNames) json.field(material + p.name, properties_[r].*p.value);
        json.field("element_imbalance", balances_[r].elements).field("energy_imbalance", balances_[r].energy);
      }
      json.endObject();
    }
    json.endObject();
  }

  void print() const override {
    fmt::print("{:<16} {:>10} {:>14} {:>12} {:>12} {:>12} {:>10}\n", "reactor", "T, K", "residence, s", "volume, m3",
               "flow, kg/s", "heat, W", "residual");
    for (std::size_t r = 0; r < reactors_.size(); ++r) {
      const ReactorSteadyState& s = reactors_[r];
      fmt::print("{:<16} {:>10.4f} {:>14.6e} {:>12.4e} {:>12.4e} {:>12.4e} {:>10.1e}\n",
                 stirred_.vessels.reactors[r].name, s.state.temperature, s.residenceTime, s.volume, s.massFlow,
                 s.heatRelease * s.volume, s.residual);
    }
    for (std::size_t r = 0; r < properties_.size(); ++r)
      fmt::print(
          "{:<16} {} volume fraction {:.4g}, mean diameter {:.4g} nm; elements balance to {:.1e}, energy to {:.1e}\n",
          stirred_.vessels.reactors[r].name, case_.soot->material(), properties_[r].volumeFraction,
          1e9 * properties_[r].meanDiameter, balances_[r].elements, balances_[r].energy);
    for (std::size_t r = 0; r < reactors_.size(); ++r)
      fmt::print("{}", outLine(stirred_.vessels.reactors[r].name, reactors_[r]));
    fmt::print("{} steps of the integrator in {}\n", steps(), formatDuration(seconds_));
  }

  long steps() const override {
    long sum = 0;
    for (const auto& group : solutionOrder(stirred_.vessels)) sum += reactors_[group.front()].steps;
    return sum;
  }
  double simulatedTime() const override { return 0.0; }

 private:
  static TableOf<const ReactorSteadyState&> steadyTable(const ReactorCase& reactorCase) {
    using Steady = ReactorSteadyState;
    TableOf<const Steady&> table{
        {{"temperature", "K", "gas temperature"}, [](const Steady& s) { return s.state.temperature; }},
        {{"density", "kg/m^3", "density"}, &Steady::density},
        {{"volume", "m^3", "volume"}, &Steady::volume},
        {{"residence_time", "s", "mass inside over mass flow"}, &Steady::residenceTime},
        {{"mass_flow", "kg/s", "mass flow through the reactor"}, &Steady::massFlow},
        {{"heat_release", "W/m^3", "heat set free by the reactions"}, &Steady::heatRelease}};
    table.add(speciesColumns(*reactorCase.mechanism, reactorCase.output),
              [&reactorCase](const Steady& s, std::vector<double>& row) {
                appendSpecies(*reactorCase.mechanism, reactorCase.output, s.state.Y, row);
              });
    return table;
  }
  std::vector<Quantity> columns() const {
    std::vector<Quantity> columns = table_.columns();
    for (auto& column : particles_.columns()) columns.push_back(std::move(column));
    if (!case_.particles) return columns;
    columns.push_back({"element_imbalance", "1", "largest difference of an element between what comes in and leaves"});
    columns.push_back({"energy_imbalance", "1", "the same of energy over cp T; zero where the temperature is given"});
    return columns;
  }

  void solve() {
    try {
      reactors_ = solveNetwork(*case_.mechanism, stirred_.vessels, stirred_.start, case_.particles.get());
    } catch (const NumericsError& error) {
      if (!case_.particles) throw;
      throw NumericsError(fmt::format(
          "{}. Particles in a stirred reactor may have no steady state: those there are take what new ones would be "
          "made of, and both rise and fall in turn; 'time.end' of a single reactor shows it",
          error.what()));
    }
  }

  void makeRows() {
    if (case_.particles) balances_ = steadyBalances(*case_.mechanism, *case_.particles, stirred_.vessels, reactors_);
    for (std::size_t r = 0; r < reactors_.size(); ++r) {
      const ReactorSteadyState& s = reactors_[r];
      rows_.push_back(table_.row(s));
      if (!case_.particles) continue;
      const std::vector<double> y = unknownsOf(s.state, case_.particles->size());
      particles_.append(s.state.pressure, s.density, y, rows_.back());
      properties_.push_back(particles_.last());
      rows_.back().insert(rows_.back().end(), {balances_[r].elements, balances_[r].energy});
    }
  }

  const ReactorCase& case_;
  const StirredKind& stirred_;
  ReactorParticleOutput particles_;
  TableOf<const ReactorSteadyState&> table_{steadyTable(case_)};
  std::vector<ReactorSteadyState> reactors_;
  std::vector<std::vector<double>> rows_;
  std::vector<ParticleProperties> properties_;  // empty without particles
  std::vector<SteadyBalance> balances_;
  double seconds_ = 0;
};

}  // namespace

std::unique_ptr<ReactorDriver> stirredTransientDriver(const ReactorCase& reactorCase, const StirredKind& stirred) {
  return std::make_unique<StirredTransientDriver>(reactorCase, stirred);
}

std::unique_ptr<ReactorDriver> steadyNetworkDriver(const ReactorCase& reactorCase, const StirredKind& stirred) {
  return std::make_unique<SteadyNetworkDriver>(reactorCase, stirred);
}

}  // namespace lampblack::app
