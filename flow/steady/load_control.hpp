// The load of a flow as one more unknown of the iterations towards its steady state. The load is a factor on the
// velocities of all inlets, as that of a flame of one dimension is one on its strain. It is closed by a condition on
// the temperatures of all cells, which a flame that is followed goes through with no turning point: a sum over the
// cells has a given value (Nishioka, Law and Takeno 1996 give the temperatures of one or two points instead).
#pragma once

#include <functional>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class LoadControl {
 public:
  // Changes the load of the context, which has to live as long.
  explicit LoadControl(FlowContext& context) : context_(context) {}

  [[nodiscard]] double load() const { return context_.load; }
  void setLoad(double load) { context_.load = load; }
  // All that flows in the state becomes what a flow of another load would be if nothing but inertia acted on it.
  void scale(State& state, double load);

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
  FlowContext& context_;
  std::vector<double> from_, weights_;
  double length_ = 0.0;
};

}  // namespace lampblack::flow
