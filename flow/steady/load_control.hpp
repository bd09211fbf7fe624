// The load of a flow (Load) as one more unknown of the iterations towards its steady state. It is closed by a condition
// on the temperatures of all cells, which a flame that is followed goes through with no turning point: a sum over the
// cells has a given value (Nishioka, Law and Takeno 1996 give the temperatures of one or two points instead).
#pragma once

#include <functional>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"
#include "flow/steady/load.hpp"

namespace lampblack::flow {

class LoadControl {
 public:
  // Of a flow that has a load of one; changes what the context and the states are given, which has to live as long.
  LoadControl(FlowContext& context, const State& state, const Load& load = {});

  [[nodiscard]] double load() const { return value_; }
  // What the flow is given becomes that of the load, the state's pressure too. Collective. NumericsError where the load
  // leads to a mole fraction above one.
  void setLoad(State& state, double load);
  // The same, and the state becomes what it would be if nothing but that acted on it: what flows goes in proportion to
  // the velocities that come in, the gas's density to the pressure.
  void scale(State& state, double load);
  // Whether it acts on all of the gas, or on what comes in or is heated at one place.
  [[nodiscard]] bool isOfAllCells() const { return load_.of == Load::Of::Velocities || load_.of == Load::Of::Pressure; }
  // By how much more gas passes than at a load of one, with which residuals are told.
  [[nodiscard]] double quickens() const { return load_.of == Load::Of::Velocities ? value_ : 1.0; }

  // The condition: the temperatures have gone from `from` by a length (K, see lengthOf) in the direction of `along`,
  // both K, of the owned cells. Collective.
  void require(const std::vector<double>& from, const std::vector<double>& along, double length);
  // K, the root of the mean square over the domain of a difference of temperatures. Collective.
  [[nodiscard]] double lengthOf(const std::vector<double>& difference) const;

  // K, by how much the condition is not met. Collective.
  [[nodiscard]] double left(const State& state) const;
  // K, what values of the owned cells (K) count in the condition. Collective.
  [[nodiscard]] double weighed(const std::function<double(std::size_t cell)>& value) const;
  // The change of the load that is to change the condition by so much (K), where a load larger by one changes it by
  // `slope`; a tenth of the load at most.
  [[nodiscard]] double change(double wanted, double slope) const;

 private:
  void setBoundary();
  [[nodiscard]] double shareOfMomentum(const State& state) const;

  FlowContext& context_;
  Load load_;
  double value_ = 1.0;
  double pressure_, referenceDensity_;  // of a load of one: Pa, kg/m^3
  double temperature_ = 0.0;            // the same: K
  std::vector<double> Y_;               // the same: mass fractions of the inlet
  std::vector<double> from_, weights_;
  double length_ = 0.0;
};

}  // namespace lampblack::flow
