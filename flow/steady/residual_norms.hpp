// How large the residual of a flow is, by equation: the sum over the cells of what is left of each equation's rates,
// over the equation's throughflow.
//
// The throughflow is what the gas that passes brings by the field's range in the domain, and what is made in the
// domain: mass M = (what is in the domain)/(the time that changes are told for, Steadiness::time()); of a species M
// times the range of its mass fraction, and what reactions and particles form of it where they do; of enthalpy M times
// the mean heat capacity times the range of the temperature, and what is radiated (what is left of it is without what
// the species that are left over carry: what would heat the cell); of momentum M times the largest velocity, no less
// than a thousandth of the domain's length over the time: a gas at rest has a residual too; of what is carried M times
// its range per mass of gas, and what is made of it. What mass is left over counts in the equation of mass alone.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

struct ResidualNorm {
  enum class Kind { Flow, Species, Carried };
  Kind kind = Kind::Flow;
  std::string equation;  // "mass", "mass fluxes", "momentum", "swirl", "enthalpy", a species, a carried scalar
  double value = 0.0;    // of the throughflow
  double largest = 0.0;  // of that, the part of the cell that has most; of the mass fluxes of the face
  Vector3 place{};       // m, its centre
};

// Collective. Of the state that was evaluated last; `time` in s.
[[nodiscard]] std::vector<ResidualNorm> residualNorms(const FlowContext& context, const State& state,
                                                      const FlowResidual& residual, double time);

// Of the flow each, then of the species the worst, then of what is carried.
[[nodiscard]] std::vector<ResidualNorm> worstOfEachKind(const std::vector<ResidualNorm>& norms);

// "mass 1.2e-07, ..., OH 3.1e-05 at (0.0012, 0.0034) m", of species and of what is carried the worst; empty where there
// is no throughflow.
[[nodiscard]] std::string residualText(const std::vector<ResidualNorm>& norms, int dimension);

}  // namespace lampblack::flow
