// Plug flow: the history along the duct.
#include <fmt/format.h>

#include <optional>

#include "app/problems/reactor/reactor_driver.hpp"
#include "app/problems/reactor/reactor_output.hpp"
#include "app/problems/reactor/reactor_particle_output.hpp"
#include "app/problems/reactor/reactor_rows.hpp"
#include "app/problems/reactor/reactor_upstream.hpp"
#include "chemistry/reactor/plug_flow.hpp"
#include "io/report.hpp"

namespace lampblack::app {
namespace {

StateTable<PlugFlow> plugFlowTable(const ReactorCase& reactorCase) {
  using State = std::span<const double>;
  StateTable<PlugFlow> table{
      {{"position", "m", "distance from the inlet"}, [](PlugFlow&, double z, State) { return z; }},
      {{"time", "s", "residence time since the inlet"},
       [](PlugFlow& flow, double, State y) { return flow.residenceTime(y.data()); }},
      {{"velocity", "m/s", "velocity of the gas"},
       [](PlugFlow& flow, double, State y) { return flow.velocity(y.data()); }},
      temperatureColumn<PlugFlow>(reactorCase),
      {{"density", "kg/m^3", "density"}, [](PlugFlow& flow, double, State y) { return flow.density(y.data()); }}};
  addSpecies(table, reactorCase);
  return table;
}

class PlugFlowDriver : public ReactorOfOneRank {
 public:
  PlugFlowDriver(const ReactorCase& reactorCase, const PlugFlowKind& duct)
      : case_(reactorCase),
        duct_(duct),
        rows_(reactorCase,
              reactorCase.profile ? ReactorParticleOutput::Kept::elements : ReactorParticleOutput::Kept::enthalpy,
              plugFlowTable(reactorCase)) {}

  void compute(const RunFolder& folder) override {
    const double begin = MPI_Wtime();
    if (duct_.upstream) upstream_ = steadyUpstream(*case_.mechanism, duct_, case_.particles.get());
    const GasState& inlet = upstream_ ? upstream_->state : duct_.inlet;
    PlugFlow flow(*case_.mechanism, inlet, duct_.massFlux, duct_.length, case_.profile, case_.particles.get());
    StiffIntegrator integrator(flow, case_.integrator);
    integrator.start(0.0, flow.initialState(), duct_.length);
    std::function<double(double)> nextStop;
    if (case_.profile) nextStop = [&](double z) { return case_.profile->nextKink(z).value_or(duct_.length); };
    rows_.follow(
        flow, integrator, folder, duct_.length,
        [&](double, std::span<const double> y) {
          return ReactorGas{duct_.inlet.pressure, flow.density(y.data())};
        },
        nextStop);
    steps_ = integrator.statistics().steps;
    temperature_ = integrator.state()[case_.mechanism->numSpecies()];
    velocity_ = flow.velocity(integrator.state().data());
    time_ = flow.residenceTime(integrator.state().data());
    seconds_ = MPI_Wtime() - begin;
    rows_.particles().requireSizeRangeCovered();
  }

  void write(ResultsWriter& results) const override { rows_.writeTo(results); }

  void record(JsonWriter& json) const override {
    json.field("final_temperature_K", temperature_).field("final_velocity_m_per_s", velocity_);
    json.field("residence_time_s", time_);
    if (upstream_) {
      json.key("upstream").beginObject();
      json.field("temperature_K", upstream_->state.temperature);
      recordOut(json, *upstream_);
      json.endObject();
    }
    rows_.particles().record(json);
  }

  void print() const override {
    fmt::print("T = {:.4f} K, u = {:.6g} m/s at z = {:g} m, {:.6e} s after the inlet\n", temperature_, velocity_,
               duct_.length, time_);
    rows_.particles().print();
    if (upstream_) fmt::print("{}", outLine("upstream", *upstream_));
    fmt::print("{} steps of the integrator in {}\n", steps_, formatDuration(seconds_));
  }

  long steps() const override { return steps_; }
  double simulatedTime() const override { return time_; }

 private:
  const ReactorCase& case_;
  const PlugFlowKind& duct_;
  ReactorRows<PlugFlow> rows_;
  std::optional<ReactorSteadyState> upstream_;
  long steps_ = 0;
  double temperature_ = 0, velocity_ = 0, time_ = 0, seconds_ = 0;
};

}  // namespace

std::unique_ptr<ReactorDriver> plugFlowDriver(const ReactorCase& reactorCase, const PlugFlowKind& duct) {
  return std::make_unique<PlugFlowDriver>(reactorCase, duct);
}

}  // namespace lampblack::app
