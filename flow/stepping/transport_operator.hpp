// One step of convection and diffusion of a low-Mach gas, in an open domain or a closed vessel.
//
// Densities (rho Y_k, rho h, carried scalars) are advanced in conservative form by one face mass flux. The flux comes
// from velocities projected onto the divergence that the equation of state demands (Expansion) of the very fluxes,
// implicit ones included, that the scalars are then advanced with.
//
// A step is `sweeps` sweeps of deferred correction (Pazner et al. 2016). With one it is of first order in time:
// convection explicit, diffusion implicit. In each further sweep convection is that of the mean of the step's start and
// of what the last sweep found as its end, diffusion the mean of both, and the divergence is corrected by the p_eos -
// p0 that the last sweep, reactions included, has left: two sweeps and more are of second order. Velocities stand half
// a step before the gas (Momentum). Second order in space. Mass, species and enthalpy are conserved to round-off.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "flow/boundaries/boundary_totals.hpp"
#include "flow/discretisation/implicit_diffusion.hpp"
#include "flow/equations/carried_transport.hpp"
#include "flow/equations/expansion.hpp"
#include "flow/equations/face_state.hpp"
#include "flow/equations/gas_fluxes.hpp"
#include "flow/equations/heat_conduction.hpp"
#include "flow/equations/momentum.hpp"
#include "flow/equations/species_diffusion.hpp"
#include "flow/flow_context.hpp"
#include "flow/models/coupled_cells.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/operator.hpp"
#include "flow/properties/gas_properties.hpp"

namespace lampblack::flow {

class TransportOperator : public Operator {
 public:
  struct Options {
    double courant = 0.5;  // share of a cell's volume that may flow out in a step
    int sweeps = 1;
    VelocityScheme velocityScheme = VelocityScheme::Limited;
  };
  struct Diagnostics {
    double continuityError = 0.0;  // 1/s
    int pressureIterations = 0;
    int speciesIterations = 0;
  };
  // What crossed the boundary in the last step, kg (or the scalar's unit times m^3) per metre depth or radian, of this
  // rank's faces: into the domain and out of it.
  struct BoundaryAmounts {
    std::vector<double> speciesIn, speciesOut;
    std::vector<double> carriedIn, carriedOut;
    double enthalpyIn = 0.0, enthalpyOut = 0.0;  // J, conduction included
    double time = 0.0;                           // s, of the step
  };

  TransportOperator(const FlowContext& context, const State& state, Options options);
  TransportOperator(const FlowContext& context, const State& state) : TransportOperator(context, state, Options{}) {}

  void advance(State& state, double time, double dt) override;
  void endSweep(State& state) override { state.balance.clear(); }
  void saveOrLoad(StateArchive& archive) override;
  [[nodiscard]] const char* name() const override { return "transport"; }
  [[nodiscard]] double largestStep(const State& state) override;
  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  void fields(const State& state, const FieldSink& sink) const override;
  void addCost(const Mesh& mesh, CellCost& cost) const override;

  // Cells whose reactions outrun a step go together with their neighbours (CoupledCells). The reactions, which stand
  // behind this operator in each sweep, have to live as long.
  void coupleWith(ReactionOperator& reactions) { reactions_ = &reactions; }

  // Is called at the end of each step's last sweep: budgets count what crossed the boundary.
  void watchBoundary(std::function<void(const BoundaryAmounts&)> watcher) { watchers_.push_back(std::move(watcher)); }

  [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }
  [[nodiscard]] const BoundaryAmounts& boundaryAmounts() const { return boundary_; }
  [[nodiscard]] const GasProperties& properties() const { return properties_; }
  // Of the last step, for who moves particles himself: CarriedTransport's.
  [[nodiscard]] std::span<const double> driftFlux() const { return carried_.driftFlux(); }
  [[nodiscard]] std::span<const double> faceDensity() const { return carried_.faceDensity(); }
  // CarriedTransport::flux(), of the last step; of one block's scalars through one face.
  [[nodiscard]] std::span<const double> carriedFlux() const { return carried_.flux(); }
  [[nodiscard]] std::span<const double> carriedFlux(const ScalarRange& block, int face) const {
    const std::size_t all = carried_.flux().size() / static_cast<std::size_t>(context_.mesh.faces);
    return carried_.flux().subspan(static_cast<std::size_t>(face) * all + static_cast<std::size_t>(block.first),
                                   static_cast<std::size_t>(block.count));
  }
  // Largest |p_eos - p0| / p0 of all cells. Collective.
  [[nodiscard]] double pressureDrift(const State& state);

  // Over the domain, per radian or metre of depth: J, half of the density times the square of the velocity; kg/s^2,
  // half of the density times the square of the vorticity. Collective.
  struct Integrals {
    double kineticEnergy = 0.0, enstrophy = 0.0;
  };
  [[nodiscard]] Integrals integrals(const State& state);
  // Of the state's velocity, until the next step. Collective.
  [[nodiscard]] const VelocityGradient& velocityGradient(const State& state) {
    return momentum_.forces().velocityGradient(state);
  }
  // Pa at each boundary face: what presses on it (PressureForce::atBoundary).
  [[nodiscard]] std::vector<double> boundaryPressures(const State& state) {
    return momentum_.forces().boundaryPressures(state);
  }
  // Of each boundary, in the context's order. Collective.
  [[nodiscard]] std::vector<BoundaryTotals> boundaryTotals(const State& state);
  // The faces of a boundary that is a wall without slip, in the order of their numbers. Collective; on rank 0, none
  // elsewhere.
  [[nodiscard]] std::vector<WallFace> wallFaces(const State& state, int boundary);

  // Makes the mass fluxes of a new state consistent with its velocity, and its velocity with what its diffusion expands
  // the gas by: a projection without advancing anything. Collective.
  void initialise(State& state, double dt);

  // Collective. Properties, and what crosses the boundaries, become those of a state that no step has led to, such as
  // one that iterations have found; nothing of it is booked.
  void adopt(const State& state);

 private:
  [[nodiscard]] double frictionAboutAxis(int face, const State& state) const;
  void evaluateDiffusion(const State& state);
  void findCarriedFlux(const State& state);  // and the drift, of the properties and faces as they are
  void keepBoundaryFlux(int face, std::span<const double> row);
  void coupleReactions(const State& mean, State& state, double time, double dt);
  void markCoupled();
  [[nodiscard]] bool takesCoupled(int cell) const;
  void addTendency(const State& mean, const State& state, int cell, std::span<const double> conducted,
                   CoupledCells::Cell& to);
  void predictContents(const State& start, const State& mean, const State& state, double dt);
  void correctContents(const State& mean, State& state, double dt);
  void addCompression();
  void advanceDiffusion(const State& mean, State& state, double dt);
  void finish(State& state);
  void recordBoundary(const State& state, double dt);
  void keepStart(const State& state);
  void average(const State& state);

  const FlowContext& context_;
  Options options_;
  GasProperties properties_;
  FaceState faces_;
  ImplicitDiffusion diffusion_;
  SpeciesDiffusion speciesDiffusion_;
  HeatConduction heatConduction_;
  GasFluxes fluxes_;
  Expansion expansion_;
  Momentum momentum_;
  CarriedTransport carried_;
  Diagnostics diagnostics_;
  BoundaryAmounts boundary_;
  // Of each boundary into the domain in the last step, this rank's part: kg/s; W in all, and conducted.
  std::vector<double> boundaryFlows_;
  std::vector<std::function<void(const BoundaryAmounts&)>> watchers_;

  ReactionOperator* reactions_ = nullptr;
  bool couples_ = false;             // in the present step
  std::vector<double> coupledRing_;  // of the local cells: how many cells from one that outruns the step
  bool movesForOthers_;              // whether somebody else moves particles by what is found here
  int sweep_ = 0;                    // of the present step
  double lastStep_ = 0.0;            // s
  // Only of steps of several sweeps: the start; the mean of it and of what the last sweep found; conduction at the
  // start; what diffusion brought in the last sweep, kg/s of each species to the owned cells.
  std::optional<State> start_, mean_;
  std::vector<double> startHeatFlux_, diffused_;
  std::vector<double> solution_;                        // of the species' diffusion, species a cell
  std::vector<double> startViscosity_, meanViscosity_;  // Pa s, cells, molecular
  std::vector<double> startEffectiveViscosity_;         // Pa s, cells
  std::vector<double> startBoundaryViscosity_;          // Pa s, boundary faces, effective

  // Of the owned cells as they are being advanced: kg, rho Y V; J, rho h V; kg.
  std::vector<double> content_, heatContent_, newMass_;
  double compression_ = 0.0;          // Pa, rise of the thermodynamic pressure that heatContent_ has the work of
  HeatFluxes heat_;                   // of the sweep
  std::vector<double> boundaryFlux_;  // kg/s, species a boundary face: what diffuses in the sweep
  std::vector<double> faceVelocity_;  // m/s
  std::vector<double> row_;
};

}  // namespace lampblack::flow
