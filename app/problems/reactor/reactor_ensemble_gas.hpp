// The equations of the gas of a case whose particles are ensembles, for one repeat: a closed reactor, a plug flow, or
// stirred reactors, one or a network; or a gas whose history is given.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/problems/reactor/reactor_case.hpp"
#include "chemistry/reactor/plug_flow.hpp"
#include "core/modules.hpp"
#include "coupling/gas_along.hpp"
#include "coupling/split_reactor.hpp"

namespace lampblack::app {

class EnsembleGas {
 public:
  // The case has to live as long. `inlet`: of a plug flow, where it is not that of the case.
  explicit EnsembleGas(const ReactorCase& reactorCase, const std::optional<GasState>& inlet = std::nullopt);
  EnsembleGas(const EnsembleGas&) = delete;
  EnsembleGas& operator=(const EnsembleGas&) = delete;

  [[nodiscard]] const SplitReactor::Gas& gas() const { return gas_; }
  [[nodiscard]] const std::vector<double>& start() const { return start_; }
  [[nodiscard]] ParticlesAtRest& particles() { return *particles_; }
  // s, where the unknowns are y at x
  [[nodiscard]] double time(double x, std::span<const double> y) const {
    return plugFlow_ ? plugFlow_->residenceTime(y.data()) : x;
  }

 private:
  void carryByPlugFlow(const GasState& inlet);
  void carryByNetwork();
  void carryByClosedReactor();
  void carryByGivenGas();

  const ReactorCase& case_;
  std::unique_ptr<ParticlesAtRest> particles_;
  std::optional<ClosedReactor> closed_;
  std::optional<PlugFlow> plugFlow_;
  std::optional<NetworkSystem> network_;
  std::optional<GasAlong> along_;
  SplitReactor::Gas gas_;
  std::vector<double> start_;
};

}  // namespace lampblack::app
