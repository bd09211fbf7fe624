// Closed reactors: history, ignition, sensitivities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "app/problems/reactor/reactor_driver.hpp"
#include "app/problems/reactor/reactor_output.hpp"
#include "app/problems/reactor/reactor_particle_output.hpp"
#include "app/problems/reactor/reactor_rows.hpp"
#include "chemistry/reactor/ignition_sensitivity.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/stop_request.hpp"
#include "io/progress.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

// A change of temperature (K) below which nobody would speak of ignition.
constexpr double kIgnited = 50;

StateTable<ClosedReactor> closedTable(const ReactorCase& reactorCase, const ClosedKind& closed) {
  using State = std::span<const double>;
  StateTable<ClosedReactor> table{
      {{"time", "s", "time"}, [](ClosedReactor&, double t, State) { return t; }},
      temperatureColumn<ClosedReactor>(reactorCase),
      {{"pressure", "Pa", "pressure"}, [](ClosedReactor& r, double t, State y) { return r.pressure(t, y.data()); }},
      {{"density", "kg/m^3", "density"}, [](ClosedReactor& r, double t, State y) { return r.density(t, y.data()); }},
      {{"temperature_rate", "K/s", "dT/dt"},
       [n = reactorCase.mechanism->numSpecies()](ClosedReactor& r, double t, State y) {
         std::vector<double> f(y.size());
         r.rates(t, y.data(), f.data());
         return f[n];
       }},
      {{"heat_release", "W/m^3", "heat set free by the reactions"},
       [](ClosedReactor& r, double t, State y) { return r.heatRelease(t, y.data()); }}};
  if (closed.volume)
    table.add({"volume_ratio", "1", "volume over that at time zero"},
              [&closed](ClosedReactor&, double t, State) { return closed.volume->ratio(t); });
  if (closed.startAngle)
    table.add({"crank_angle", "deg", "angle of the crank after top dead centre"},
              [&closed](ClosedReactor&, double t, State) {
                return (*closed.startAngle + *closed.angularSpeed * t) * 180 / std::numbers::pi;
              });
  addSpecies(table, reactorCase);
  return table;
}

class ClosedReactorDriver : public ReactorOfOneRank {
 public:
  ClosedReactorDriver(const ReactorCase& reactorCase, const ClosedKind& closed)
      : case_(reactorCase),
        closed_(closed),
        rows_(reactorCase, kept(reactorCase, closed), closedTable(reactorCase, closed)),
        events_(closed.ignition.size()) {}

  void compute(const RunFolder& folder) override {
    const double begin = MPI_Wtime();
    ClosedReactor reactor(*case_.mechanism, closed_.initial, closed_.held, case_.profile, case_.particles.get(),
                          closed_.volume);
    StiffIntegrator integrator(reactor, case_.integrator);
    IgnitionMonitor monitor(*case_.mechanism, reactor, closed_.ignition, closed_.volume ? &*closed_.volume : nullptr);
    const std::vector<double> start = reactor.initialState();
    startTemperature_ = start[case_.mechanism->numSpecies()];
    integrator.start(0.0, start, closed_.duration);
    if (closed_.ignitionFrom == 0) monitor.begin(0.0, start.data());
    rows_.follow(
        reactor, integrator, folder, closed_.duration,
        [&](double time, std::span<const double> y) {
          return ReactorGas{reactor.pressure(time, y.data()), reactor.density(time, y.data())};
        },
        [&](double time) { return nextStop(time); },
        [&] {
          if (integrator.time() == closed_.ignitionFrom) {
            const std::span<const double> y = integrator.state();
            compressed_ = {y[case_.mechanism->numSpecies()], reactor.pressure(integrator.time(), y.data()),
                           heatedByReactions(start, y)};
            monitor.begin(integrator.time(), y.data());
          } else if (integrator.time() > closed_.ignitionFrom) {
            monitor.observe(integrator);
          }
        });
    events_ = monitor.events();
    for (auto& event : events_)
      if (event) event->time -= closed_.ignitionFrom;
    statistics_ = integrator.statistics();
    endTemperature_ = integrator.state()[case_.mechanism->numSpecies()];
    endPressure_ = reactor.pressure(integrator.time(), integrator.state().data());
    reached_ = integrator.time();
    seconds_ = MPI_Wtime() - begin;
    rows_.particles().requireSizeRangeCovered();
    if (closed_.sensitivities.empty() || reached_ < closed_.duration) return;
    reactor.setParameters(closed_.sensitivities);
    Progress progress(MPI_COMM_SELF, 0, 1, Progress::logInterval);
    sensitivities_ = ignitionSensitivities(*case_.mechanism, reactor, case_.integrator, closed_.ignition, events_,
                                           [&](double time, double end) {
                                             if (progress.due())
                                               progress.say(fmt::format("sensitivities, t {:.4g} s", time), time / end);
                                             return stopRequest() == 0;
                                           });
    progress.finish();
    sensitivitySeconds_ = MPI_Wtime() - begin - seconds_;
    if (stopRequest() != 0) return;
    writeFileAtomically(
        folder.file("sensitivities.csv"),
        sensitivityTable(*case_.mechanism, closed_.sensitivities, namedSensitivities(closed_, sensitivities_)));
  }

  void write(ResultsWriter& results) const override {
    rows_.writeTo(results);
    writeIgnition(results, *case_.mechanism, closed_, events_);
    // Rank 0 alone knows how far it came; what it has not computed is NaN.
    if (!closed_.sensitivities.empty())
      writeSensitivities(results, closed_.sensitivities, namedSensitivities(closed_, sensitivities_),
                         "d ln(ignition delay) / d ln(rate constant)");
  }

  void record(JsonWriter& json) const override {
    json.key("ignition_delays_s").beginObject();
    for (std::size_t i = 0; i < closed_.ignition.size(); ++i) {
      json.key(closed_.ignition[i].name);
      if (events_[i])
        json.value(events_[i]->time);
      else
        json.null();
    }
    json.endObject();
    if (compressed_)
      json.field("end_of_compression_s", closed_.ignitionFrom)
          .field("heated_until_then_K", compressed_->heated)
          .field("compressed_temperature_K", compressed_->temperature)
          .field("compressed_pressure_Pa", compressed_->pressure);
    json.field("final_temperature_K", endTemperature_).field("final_pressure_Pa", endPressure_);
    rows_.particles().record(json);
    json.field("rate_evaluations", static_cast<std::int64_t>(statistics_.rateEvaluations));
    json.field("jacobian_evaluations", static_cast<std::int64_t>(statistics_.jacobianEvaluations));
  }

  void print() const override {
    if (compressed_)
      fmt::print("compressed at {:.6e} s to {:.2f} K and {:.6g} Pa; delays count from there\n", closed_.ignitionFrom,
                 compressed_->temperature, compressed_->pressure);
    if (compressed_ && compressed_->heated > kHeated)
      fmt::print(
          "note: reactions heated the gas by {:.0f} K before the end of compression; 'ignition.from: start' counts "
          "delays from the start\n",
          compressed_->heated);
    for (std::size_t i = 0; i < closed_.ignition.size(); ++i) {
      const std::string what = describe(closed_.ignition[i], *case_.mechanism);
      if (events_[i])
        fmt::print("ignition delay, {:<32} {:.6e} s\n", what, events_[i]->time);
      else
        fmt::print("ignition delay, {:<32} none in {:g} s\n", what, closed_.duration);
    }
    if (!case_.profile && !closed_.ignition.empty() && std::abs(endTemperature_ - startTemperature_) < kIgnited)
      fmt::print("note: the temperature changed by {:.2g} K only; this gas has not ignited\n",
                 endTemperature_ - startTemperature_);
    fmt::print("T = {:.4f} K, p = {:.6g} Pa after {:g} s\n", endTemperature_, endPressure_, closed_.duration);
    rows_.particles().print();
    fmt::print("{} steps, {} rate and {} Jacobian evaluations of the integrator in {}\n", statistics_.steps,
               statistics_.rateEvaluations, statistics_.jacobianEvaluations, formatDuration(seconds_));
    if (!closed_.sensitivities.empty()) printSensitivities();
  }

  long steps() const override { return statistics_.steps; }
  double simulatedTime() const override { return reached_; }

 private:
  // The reactions the delay depends on most, by the first criterion that was met; all are in the files.
  void printSensitivities() const {
    fmt::print("sensitivities to {} reactions: {} steps in {}\n", closed_.sensitivities.size(),
               sensitivities_.statistics.steps, formatDuration(sensitivitySeconds_));
    for (std::size_t i = 0; i < closed_.ignition.size(); ++i) {
      const auto& values = sensitivities_.values[i];
      if (values.empty()) continue;
      fmt::print("\nd ln tau / d ln k by {}\n", describe(closed_.ignition[i], *case_.mechanism));
      fmt::print("{}", largestSensitivities(*case_.mechanism, closed_.sensitivities, values, "exactly -1"));
      return;
    }
  }

  static ReactorParticleOutput::Kept kept(const ReactorCase& reactorCase, const ClosedKind& closed) {
    using Kept = ReactorParticleOutput::Kept;
    if (reactorCase.profile || closed.volume) return Kept::elements;
    return closed.held == ReactorSystem::Held::Pressure ? Kept::enthalpy : Kept::internalEnergy;
  }

  // Kinks of what is given in time, and the end of a compression.
  double nextStop(double time) const {
    double next = closed_.duration;
    if (case_.profile) next = std::min(next, case_.profile->nextKink(time).value_or(next));
    if (closed_.ignitionFrom > time) next = std::min(next, closed_.ignitionFrom);
    if (closed_.volume)
      for (const double kink : closed_.volume->kinks())
        if (kink > time) next = std::min(next, kink);
    return next;
  }

  struct Compressed {
    double temperature = 0, pressure = 0;  // K, Pa
    double heated = 0;                     // K, what the reactions until then give at the temperature of the start
  };
  static constexpr double kHeated = 50;  // K, of a gas that is igniting

  double heatedByReactions(std::span<const double> start, std::span<const double> y) const {
    const std::size_t n = case_.mechanism->numSpecies();
    const Thermo thermo(*case_.mechanism);
    const double T = start[n];
    return (thermo.enthalpyMass(T, start.first(n)) - thermo.enthalpyMass(T, y.first(n))) / thermo.cpMass(T, y.first(n));
  }

  const ReactorCase& case_;
  const ClosedKind& closed_;
  std::optional<Compressed> compressed_;  // where delays count from the end of a compression
  ReactorRows<ClosedReactor> rows_;
  std::vector<std::optional<IgnitionEvent>> events_;
  IgnitionSensitivities sensitivities_;
  StiffIntegrator::Statistics statistics_;
  double reached_ = 0;  // s
  double startTemperature_ = 0, endTemperature_ = 0, endPressure_ = 0;
  double seconds_ = 0, sensitivitySeconds_ = 0;
};

}  // namespace

std::unique_ptr<ReactorDriver> closedReactorDriver(const ReactorCase& reactorCase, const ClosedKind& closed) {
  return std::make_unique<ClosedReactorDriver>(reactorCase, closed);
}

}  // namespace lampblack::app
