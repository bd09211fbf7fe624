// One step of convection and diffusion of a low-Mach gas in an open domain at constant thermodynamic pressure p0.
//
// Densities (rho Y_k, rho h, carried scalars) are advanced in conservative form by one face mass flux. The flux comes
// from velocities projected onto the divergence that the equation of state demands (Day and Bell 2000),
//   div u = (1/(rho cp T)) (E - sum_k h_k M_k) + sum_k (W/W_k) M_k / rho + (p_eos/p0 - 1)/max(dt, driftTime),
// with E and M_k the enthalpy and mass that diffusion and State::balance bring into a cell - evaluated from the very
// fluxes, implicit ones included, that the scalars are then advanced with. The last term takes away what remains of
// p_eos - p0 after a step (volume discrepancy; Nonaka et al. 2012).
//
// Order: first in time, second in space. Mass, species and enthalpy are conserved to round-off.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/rooms.hpp"
#include "flow/carried_transport.hpp"
#include "flow/face_state.hpp"
#include "flow/flow_context.hpp"
#include "flow/gas_properties.hpp"
#include "flow/implicit_diffusion.hpp"
#include "flow/momentum.hpp"
#include "flow/operator.hpp"
#include "flow/species_diffusion.hpp"

namespace lampblack::flow {

class TransportOperator : public Operator {
 public:
  struct Options {
    // s, in which p_eos - p0 is taken away, but at least a step: a start's very short steps would otherwise turn a
    // drift of a per cent into a gust.
    double driftTime = 2e-5;
    double courant = 0.5;  // share of a cell's volume that may flow out in a step
  };
  struct Diagnostics {
    double continuityError = 0.0;  // 1/s
    double pressureDrift = 0.0;    // largest |p_eos - p0| / p0 after the step
    int pressureIterations = 0;
    int speciesIterations = 0;
  };
  // What crossed the boundary in the last step, kg (or the scalar's unit times m^3) per metre depth or radian, of this
  // rank's faces: into the domain and out of it.
  struct BoundaryAmounts {
    std::vector<double> speciesIn, speciesOut;
    std::vector<double> carriedIn, carriedOut;
    double enthalpyIn = 0.0, enthalpyOut = 0.0;  // J, conduction included
  };

  TransportOperator(const FlowContext& context, const State& state, Options options);
  TransportOperator(const FlowContext& context, const State& state) : TransportOperator(context, state, Options{}) {}

  void advance(State& state, double time, double dt) override;
  void endStep(State& state) override { state.balance.clear(); }
  void saveOrLoad(StateArchive& archive) override;
  [[nodiscard]] const char* name() const override { return "transport"; }
  [[nodiscard]] double largestStep(const State& state) override;
  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  void fields(const State& state, const FieldSink& sink) const override;

  // Is called at the end of each `advance`: budgets count what crossed the boundary.
  void watchBoundary(std::function<void(const BoundaryAmounts&)> watcher) { watchers_.push_back(std::move(watcher)); }

  [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }
  [[nodiscard]] const BoundaryAmounts& boundaryAmounts() const { return boundary_; }
  [[nodiscard]] const GasProperties& properties() const { return properties_; }

  // Makes the mass fluxes of a new state consistent with its velocity, and its velocity with its density: a projection
  // without advancing anything. Collective.
  void initialise(State& state, double dt);

 private:
  void addConvection(const State& state, double dt);
  void computeHeatFlux(const State& state, double dt);
  void computeDivergence(const State& state, double dt);
  void updateFluxes(State& state);
  void finish(State& state, double dt);
  void recordBoundary(const State& state, double dt);

  const FlowContext& context_;
  Options options_;
  GasProperties properties_;
  FaceState faces_;
  SpeciesDiffusion speciesDiffusion_;
  ImplicitDiffusion heatDiffusion_;
  Momentum momentum_;
  CarriedTransport carried_;
  Diagnostics diagnostics_;
  BoundaryAmounts boundary_;
  std::vector<std::function<void(const BoundaryAmounts&)>> watchers_;

  std::vector<double> content_;       // kg, rho Y V of the owned cells as it is being advanced
  std::vector<double> heatContent_;   // J, rho h V
  std::vector<double> newMass_;       // kg
  std::vector<double> newDensity_;    // kg/m^3, cells
  std::vector<double> speciesFlux_;   // kg/s, diffusion, species a face
  std::vector<double> enthalpyFlux_;  // W, of the diffusing species, a face
  std::vector<double> heatFlux_;      // W, conduction, a face
  std::vector<double> divergence_;    // 1/s, owned cells
  std::vector<double> faceVelocity_;  // m/s
  std::vector<double> temperature_;   // K, cells, implicit
};

}  // namespace lampblack::flow
