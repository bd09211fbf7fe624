// The rows of a reactor that one integrator follows along time or place: its table, and beside it that of the
// particles.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/problems/reactor/reactor_history.hpp"
#include "app/problems/reactor/reactor_output.hpp"
#include "app/problems/reactor/reactor_particle_output.hpp"
#include "core/modules.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

// What particles see of the gas in a row.
struct ReactorGas {
  double pressure = 0.0, density = 0.0;  // Pa, kg/m3
};

template <class System>
class ReactorRows {
 public:
  ReactorRows(const ReactorCase& reactorCase, ReactorParticleOutput::Kept kept, StateTable<System> table)
      : interval_(reactorCase.output.interval),
        particles_(reactorCase, kept),
        table_(std::move(table)),
        history_(table_.columns(), particles_.columns()) {}

  using GasAt = std::function<ReactorGas(double at, std::span<const double> y)>;

  // Rank 0. As ReactorHistory::follow, of a file that is made here.
  void follow(
      System& system, StiffIntegrator& integrator, const RunFolder& folder, double end, const GasAt& gasAt,
      const std::function<double(double at)>& nextStop = {}, const std::function<void()>& afterStep = [] {}) {
    history_.open(folder.history());
    history_.follow(
        integrator, interval_, end, nextStop,
        [&](double at, std::span<const double> y) {
          std::vector<double> row = table_.row(system, at, y);
          const ReactorGas gas = gasAt(at, y);
          particles_.append(gas.pressure, gas.density, y, row);
          return row;
        },
        afterStep);
  }

  // Collective.
  void writeTo(ResultsWriter& results) const {
    history_.writeTo(results);
    particles_.write(results);
  }
  [[nodiscard]] const ReactorParticleOutput& particles() const { return particles_; }

 private:
  std::optional<double> interval_;
  ReactorParticleOutput particles_;
  StateTable<System> table_;
  ReactorHistory history_;
};

}  // namespace lampblack::app
