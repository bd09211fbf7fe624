// What of a flow's run lies on the mesh as it is partitioned: mesh, state, operators, budget. Where the mesh is
// partitioned anew all of it is made again, and filled through a StateArchive.
#pragma once

#include <memory>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "app/problems/flow/flow_tables.hpp"
#include "core/halo_exchange.hpp"
#include "core/modules.hpp"
#include "coupling/ensemble_operator.hpp"
#include "flow/flow_context.hpp"
#include "flow/models/carried_operator.hpp"
#include "flow/models/combustion/combustion_operator.hpp"
#include "flow/models/deposition_operator.hpp"
#include "flow/models/radiation_operator.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow/stepping/budget.hpp"
#include "flow/stepping/step_control.hpp"
#include "flow/stepping/undershoot_correction.hpp"

namespace lampblack::app {

struct FlowDomain {
  // Collective. The case, thermo and transport have to live as long. The state is not a gas yet.
  FlowDomain(Mesh partitioned, const FlowCase& flowCase, const Thermo& thermo, Transport& transport,
             const ReactionOperator::Options& chemistryOptions);
  FlowDomain(const FlowDomain&) = delete;
  FlowDomain& operator=(const FlowDomain&) = delete;

  // Collective. The state that the deck begins with.
  void setStart(const FlowCase& flowCase);
  // Collective. Tells the user where cells beside walls are too thin for wall functions at the speeds of the present
  // state, before a run.
  void warnOfThinCells(const FlowCase& flowCase) const;
  // Collective. Counts from the present state on.
  void beginBudget(const FlowCase& flowCase);
  // After the gas has been replaced by another: face flows, rates and budgets as at a start.
  void beginAnew(const FlowCase& flowCase);
  // Collective. What transport and radiation tell becomes that of the state, to which no step has led.
  void adopt(const FlowCase& flowCase);
  // kg per metre depth or radian that each boundary face lets out of what the case's model carries, in the last step.
  [[nodiscard]] std::vector<double> carriedThroughFaces(const CarriedModel& model, double dt) const;

  // Of the case's operators and others.
  [[nodiscard]] FlowTables::Source tableSource(const std::vector<Operator*>& all) {
    return {state, flow, all, deposition.get()};
  }

  Mesh mesh;
  HaloExchange halo;
  FlowContext context;
  State state;
  TransportOperator flow;
  ReactionOperator chemistry;
  UndershootCorrection undershoots;
  StepControl stepControl;
  std::unique_ptr<CarriedOperator> carried;
  std::unique_ptr<EnsembleOperator> ensembles;
  std::unique_ptr<DepositionOperator> deposition;  // null without particles and without walls
  std::unique_ptr<RadiationOperator> radiation;
  std::unique_ptr<TurbulenceOperator> turbulence;
  std::unique_ptr<CombustionOperator> combustion;
  std::vector<Operator*> operators;  // of these, each advances over the step, one after the other
  std::unique_ptr<Budget> budget;
};

}  // namespace lampblack::app
