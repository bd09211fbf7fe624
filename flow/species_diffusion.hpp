// Species diffusion. Mixture-averaged (Wang 2025, eqs. 6-6 to 6-9), the fluxes go along gradients of mole fractions
//   j_k = -rho D_k (grad Y_k + Y_k grad ln W) + Y_k c,   c such that the fluxes sum to zero at every face,
// the first term implicit; with Lewis numbers along those of mass fractions, without the second. What multicomponent
// diffusion differs from that by, and the Soret effect, are of the prepared state; sweeps correct them. The fluxes are
// evaluated from the implicit solution, so that what leaves one cell enters the next to the last bit, whatever the
// linear solver's tolerance.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/rooms.hpp"
#include "flow/detailed_diffusion.hpp"
#include "flow/flow_context.hpp"
#include "flow/gas_properties.hpp"
#include "flow/implicit_diffusion.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class SpeciesDiffusion {
 public:
  explicit SpeciesDiffusion(const FlowContext& context) : context_(context), diffusion_(context.mesh, context.halo) {
    if (context.transportModel.isMulticomponent() || context.transportModel.soret) detailed_.emplace(context);
  }

  // Fluxes here: kg/s, species a face, low to high or outwards.

  // Takes the coefficients of the state, which everything below goes by.
  void prepare(const State& state, const GasProperties& properties);
  // Fluxes of that state.
  void presentFlux(const State& state, std::span<double> flux) const;
  // Collective. Fluxes at the end of a step, of which the state is the guess. `content` (kg, species a owned cell): rho
  // Y V there without them; `newMass` (kg, a owned cell): the gas's mass.
  ImplicitDiffusion::Result implicitFlux(const State& guess, std::span<const double> content,
                                         std::span<const double> newMass, double dt, std::span<double> flux);

 private:
  // Implicit systems are set up and solved for so many species at a time: the solver's fields are most of its memory.
  static constexpr int block = 16;

  const FlowContext& context_;
  ImplicitDiffusion diffusion_;
  std::vector<double> conductance_, weightSlope_, solution_;
  std::vector<double> blockDiagonal_, blockConductance_, blockSource_, blockSolution_;
  std::optional<DetailedDiffusion> detailed_;
  std::vector<double> explicit_;  // kg/s, species a face, what the detailed model adds; empty without one

  // Species [first, first + count) of the systems: from those of all, and to the solution of all.
  void setUpBlock(int first, int count, std::span<const double> content, std::span<const double> newMass, double dt,
                  std::span<const double> flux);
  void evaluate(std::span<const double> Y, bool gradientTerm, std::span<double> flux) const;
  // Flux of the implicit gradient (0 or 1 times) and explicit terms through a face, from mass fractions of both sides.
  void faceFlux(int face, bool gradientTerm, const double* low, const double* high, double lowWeight,
                double* flux) const;
};

}  // namespace lampblack::flow
