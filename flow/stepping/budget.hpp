// Balance sheets of conserved quantities: what is in the domain against what came in and went out.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::flow {

// A linear combination of species masses and carried scalars, such as total mass or the mass of one element in gas and
// particles.
struct ConservedQuantity {
  std::string name;
  std::vector<double> perSpecies;  // per kg of each species
  std::vector<double> perCarried;  // per unit of each carried scalar
};

// Total mass and the mass of every element of the mechanism; `carriedMass[s][e]` is the mass of element e in one unit
// of carried scalar s.
std::vector<ConservedQuantity> massAndElements(const Mechanism& mechanism,
                                               const std::vector<std::vector<double>>& carriedMass);

class Budget {
 public:
  struct Line {
    std::string name;
    double content = 0.0;  // kg (per radian or metre depth) in the domain
    double inflow = 0.0;   // kg since the start, and out
    double outflow = 0.0;
    // |content now - content at the start - inflow + outflow| over the inflow (or over the content at the start where
    // that is larger than the inflow of an early step).
    double error = 0.0;
  };

  Budget(const FlowContext& context, std::vector<ConservedQuantity> quantities, const State& start);  // collective

  void begin(const State& start);          // collective; counts from this state on
  void saveOrLoad(StateArchive& archive);  // collective

  void addStep(const TransportOperator::BoundaryAmounts& amounts);  // local
  [[nodiscard]] std::vector<Line> lines(const State& state) const;  // collective

 private:
  [[nodiscard]] std::vector<double> contents(const State& state) const;
  const FlowContext& context_;
  std::vector<ConservedQuantity> quantities_;
  std::vector<double> start_, inflow_, outflow_;
};

// Extremes of the state that every history row reports. Collective.
struct StateExtremes {
  double maximumTemperature = 0.0;
  double minimumMassFraction = 0.0;   // most negative; limited interpolation keeps it near round-off
  double massFractionSumError = 0.0;  // largest |sum Y - 1|
};
StateExtremes extremesOf(const FlowContext& context, const State& state);

}  // namespace lampblack::flow
