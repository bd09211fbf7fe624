// Conduction of heat in the gas, implicit in the temperature. As of the species, the fluxes are evaluated from the
// implicit solution, so that what leaves one cell enters the next whatever the solver's tolerance.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/discretisation/implicit_diffusion.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

// What heat conduction knows of the temperature at a boundary face; a value is FlowContext::boundaryTemperature.
BoundaryData knownTemperature(const FlowContext& context, int face);

class HeatConduction {
 public:
  HeatConduction(const FlowContext& context, ImplicitDiffusion& diffusion);

  // Fluxes here: W a face, from low to high or outwards.

  // Collective. Takes the coefficients of the state, which everything below goes by, and of its temperature what goes
  // along faces that the cells' steps are oblique to.
  void prepare(const State& state, const GasProperties& properties);
  // W/K, through a face; zero where no heat passes.
  [[nodiscard]] double conductance(int face) const { return conductance_[static_cast<std::size_t>(face)]; }
  // Fluxes of that state.
  void presentFlux(const State& state, std::span<double> flux) const { evaluate(state.temperature, flux); }

  // A gas without the fluxes that are sought: mass (kg), species (kg, species a cell) and enthalpy (J) of owned cells.
  struct Contents {
    std::span<const double> mass, species, enthalpy;
  };
  // Collective. Fluxes at the end of a step, of which the state is the guess. Heat that comes in by everything else
  // counts by the enthalpy that the guess lacks, so that a guess which is the end is exactly that in steps of any
  // length, and by the mean heat capacity up to the temperature it leads to; in cells that `atOnce` says, which
  // reactions may heat beyond any temperature, by that of the guess.
  void implicitFlux(const State& guess, const Contents& contents, double dt, std::span<double> flux,
                    const std::function<bool(int cell)>& atOnce = {});

 private:
  [[nodiscard]] double givenFlux(int face) const;
  void findOblique(std::span<const double> temperature);
  void evaluate(std::span<const double> temperature, std::span<double> flux) const;

  const FlowContext& context_;
  ImplicitDiffusion& diffusion_;
  std::vector<double> conductance_;  // W/K, a face; zero where no heat passes
  std::vector<double> inertia_, temperature_, Y_;
  Gradient gradient_;
  std::vector<BoundaryData> known_;
  std::vector<double> boundaryTemperature_, temperatureGradient_;
  std::vector<double> oblique_;  // W, a face; empty where no step is oblique
};

}  // namespace lampblack::flow
