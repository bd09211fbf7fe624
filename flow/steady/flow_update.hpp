// The implicit change of velocities, pressure and mass fluxes in an iteration towards the steady state
// (docs/theory/flow.md, "The steady state"): momentum by its forces, viscosity implicit and convection upwind of first
// order; then the pressure that takes what is left of the mass away.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/equations/projection.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"
#include "flow/steady/block_system.hpp"

namespace lampblack::flow {

class FlowUpdate {
 public:
  FlowUpdate(const FlowContext& context, const State& state, FlowResidual& residual);  // collective

  struct Result {
    int iterations = 0, pressureIterations = 0;  // of the linear solvers
  };
  // Collective. The residual has been evaluated of the state, its flow alone at least; `inertia` (kg/s, owned cells):
  // mass over the cell's pseudo-time.
  Result advance(State& state, std::span<const double> inertia);

  void saveOrLoad(StateArchive& archive) { projection_.saveOrLoad(archive, "steady_pressure"); }

 private:
  void assemble(const State& state, std::span<const double> inertia);
  void findResponses(const State& state, std::span<const double> inertia);

  const FlowContext& context_;
  FlowResidual& residual_;
  std::size_t d_, fields_;
  BlockSystem system_;
  Projection projection_;
  std::vector<double> right_;         // N, a velocity (swirl the last) and owned cell
  std::vector<double> rise_;          // m/s, a velocity and cell
  std::vector<double> change_;        // Pa, a cell
  std::vector<double> response_;      // s, a cell: momentum per volume that a slope of the pressure of one brings
  std::vector<double> share_;         // a cell: of what a mass flux has not settled, that an iteration takes up
  std::vector<double> faceResponse_;  // s
  std::vector<double> faceShare_;     // a face: the same of its own
  std::vector<double> faceFlux_;      // kg/m3: mass flux per area that a velocity through the face brings
  std::vector<double> inverse_;       // m3/kg, one over a cell's density
  double through_ = 0.0;              // kg/s, the largest mass flux of the state
  std::vector<double> flux_;          // kg/m2/s, a face
  std::vector<double> divergence_;    // kg/m3/s
};

}  // namespace lampblack::flow
