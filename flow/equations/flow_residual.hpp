// The flow as equations: the rates at which everything changes in a state, by what a step evaluates at the faces
// (FaceState, GasFluxes, HeatConduction, CarriedTransport, MomentumForces, FaceVelocity) and by what acts in the cells
// (Operator::addRates). A steady flow has none, whatever the steps that led to it. Of the state alone: the pressure is
// the state's, and so is the mass flux of the faces; the thermodynamic pressure is held.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/implicit_diffusion.hpp"
#include "flow/equations/carried_transport.hpp"
#include "flow/equations/face_state.hpp"
#include "flow/equations/face_velocity.hpp"
#include "flow/equations/gas_fluxes.hpp"
#include "flow/equations/heat_conduction.hpp"
#include "flow/equations/momentum_forces.hpp"
#include "flow/equations/species_diffusion.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class FlowResidual {
 public:
  // Collective. `operators`: whose rates act in the cells; transport has none. All have to live as long.
  FlowResidual(const FlowContext& context, const State& state, VelocityScheme scheme, std::vector<Operator*> operators);

  // Of the owned cells, volumes times rates (per metre of depth or radian).
  struct Rates {
    std::vector<double> mass;             // kg/s
    std::vector<double> species;          // kg/s, species a cell
    std::vector<double> enthalpy;         // W
    std::vector<double> carried;          // the scalar's unit times m^3/s, scalars a cell; zero where not transported
    std::vector<double> momentum;         // N, a component and cell
    std::vector<double> angularMomentum;  // N m, of the swirl; empty where nothing swirls
    // kg/s, of all local faces: what would go through in a steady flow of these velocities and pressures, less what
    // does.
    std::vector<double> massFlux;
    State::Balance made;  // the part of what acts in the cells, per volume
  };
  // Collective. The state's halo is filled. NumericsError where the gas has no properties or rates.
  const Rates& evaluate(const State& state);

  // Whether temperature and composition of the gas are those of the last state.
  enum class Gas { Same, Changed };

  // Collective. The same of mass, mass fluxes and momenta alone, where a gas of about the last state has moved or
  // changed: its properties, and all other rates, are those of the last state.
  const Rates& evaluateFlow(const State& state, Gas gas = Gas::Changed);

  // Collective. The same of what is carried alone, where it or a gas of about the last state has changed; the same gas
  // flows as it did, too.
  const Rates& evaluateCarried(const State& state, Gas gas = Gas::Changed);

  // Of the last state that was evaluated.
  [[nodiscard]] const Rates& rates() const { return rates_; }
  [[nodiscard]] const GasProperties& properties() const { return properties_; }
  [[nodiscard]] const FaceState& faces() const { return faces_; }
  [[nodiscard]] const SpeciesDiffusion& speciesDiffusion() const { return speciesDiffusion_; }
  [[nodiscard]] const HeatConduction& heatConduction() const { return heatConduction_; }
  [[nodiscard]] const CarriedTransport& carried() const { return carried_; }
  [[nodiscard]] MomentumForces& forces() { return forces_; }

 private:
  void addGas(const State& state);
  void addMade(const State& state);
  void addCarried(const State& state);
  void addMadeOfCarried(const State& state);
  void findForces(const State& state);
  [[nodiscard]] static char directionOf(double flux) { return static_cast<char>((flux > 0.0) - (flux < 0.0)); }
  [[nodiscard]] bool turnsAtBoundary(const State& state) const;

  const FlowContext& context_;
  std::vector<Operator*> operators_;
  GasProperties properties_;
  FaceState faces_;
  ImplicitDiffusion diffusion_;
  SpeciesDiffusion speciesDiffusion_;
  HeatConduction heatConduction_;
  GasFluxes fluxes_;
  CarriedTransport carried_;
  MomentumForces forces_;
  FaceVelocity faceVelocity_;
  Rates rates_;
  State::Balance carriedMade_;                          // of the operators that act on what is carried
  std::vector<double> conducted_;                       // W, a face
  std::vector<double> acceleration_, velocityOfFaces_;  // m/s2, a component and cell; m/s
  std::vector<double> row_;
  std::vector<char> direction_;  // of the mass fluxes for which the faces have their gas
};

}  // namespace lampblack::flow
