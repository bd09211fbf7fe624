// Species diffusion. Mixture-averaged (Wang 2025, eqs. 6-6 to 6-9), the fluxes go along gradients of mole fractions
//   j_k = -rho D_k (grad Y_k + Y_k grad ln W) + Y_k c,   c such that the fluxes sum to zero at every face,
// the first term implicit; with Lewis numbers along those of mass fractions, without the second. What multicomponent
// diffusion differs from that by, the Soret effect, and what goes along faces that the cells' steps are oblique to, are
// of the prepared state; sweeps correct them. The fluxes are
// evaluated from the implicit solution, so that what leaves one cell enters the next to the last bit, whatever the
// solver's tolerance.
//
// Fluxes here: kg/s, from low to high or outwards. None is kept for all species and faces: a face's stand in a row that
// is made where it is needed.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/implicit_diffusion.hpp"
#include "flow/discretisation/oblique_diffusion.hpp"
#include "flow/equations/detailed_diffusion.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class SpeciesDiffusion {
 public:
  SpeciesDiffusion(const FlowContext& context, ImplicitDiffusion& diffusion);

  // Collective. Takes the coefficients of the state, which everything below goes by; the properties have to stay.
  void prepare(const State& state, const GasProperties& properties);
  // Keeps the coefficients as those of the step's start, for steps of several sweeps.
  void keepStart();

  // Flux through a face from the mass fractions of all local cells; false, and zeros, where nothing diffuses.
  bool flux(int face, std::span<const double> Y, std::span<double> row) const;

  // kg/s, conductances of these species through a face; zero where nothing diffuses.
  void conductance(int face, std::span<const int> species, double* g) const;

  // A gas without the diffusion that is sought: mass (kg) of owned cells and content (kg, species a cell), which is
  // advanced by it. `guess`: mass fractions of all local cells, and `solution` room for as many. With those of the
  // step's start, `start`, the fluxes are the mean of the start's and the guess's, and what the guess's change.
  struct Gas {
    std::span<const double> guess;
    std::span<double> solution;
    std::span<const double> mass;
    std::span<double> content;
    std::span<const double> start = {};
  };
  // Takes each face's flux of the step.
  using Sink = std::function<void(int face, std::span<const double> row)>;
  // Collective. The most iterations of any species.
  int advance(const Gas& gas, double dt, const Sink& sink);

 private:
  struct Coefficients {
    std::vector<double> weightSlope;  // ln of the weights' ratio across a face
    // kg/s, species a face, what the detailed model and steps that are oblique to the faces add; empty without them.
    std::vector<double> ofDetails;
    std::vector<double> ofStart;        // kg/m/s, species a cell; empty: diffusivities are those of the properties
    std::vector<double> eddiesOfStart;  // kg/m/s, a cell; as these
  };

  [[nodiscard]] const double* diffusivity(const Coefficients& of, int cell) const;
  bool flux(const Coefficients& of, int face, std::span<const double> Y, std::span<double> row) const;
  bool molecularFlux(const Coefficients& of, int face, std::span<const double> Y, std::span<double> row) const;
  [[nodiscard]] double ofEddies(const std::vector<double>& eddies, int face) const;
  // Half of the flux of the start's mass fractions plus `present` times that of the guess, which `row` holds.
  void correct(std::span<const double> start, int face, double present, std::span<double> row) const;

  const FlowContext& context_;
  ImplicitDiffusion& diffusion_;
  std::optional<DetailedDiffusion> detailed_;
  std::optional<ObliqueDiffusion> oblique_;
  const GasProperties* properties_ = nullptr;
  Coefficients now_, start_;
  std::vector<double> inertia_;
  std::vector<double> row_;
  mutable std::vector<double> startRow_;
};

}  // namespace lampblack::flow
