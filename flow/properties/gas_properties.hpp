// Transport and thermodynamic properties of the gas in every local cell, halo included, and beside the boundaries: of
// its molecules, and beside them what eddies add (State::eddyViscosity). Who means what molecules do (thermophoresis,
// particles, what happens at walls) reads the members; momentum, heat and species diffuse by the effective ones, which
// in a laminar flow are the very same arrays.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "chemistry/transport/multicomponent_transport.hpp"
#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

struct GasProperties {
  std::vector<double> viscosity;        // Pa s
  std::vector<double> conductivity;     // W/m/K
  std::vector<double> heatCapacity;     // J/kg/K
  std::vector<double> molecularWeight;  // kg/mol, of the mixture
  std::vector<double> massDiffusivity;  // kg/m/s, density times mixture-averaged coefficient, species a cell

  std::vector<double> thermalDiffusion;  // kg/m/s, species a cell; empty without the Soret effect

  // Between each boundary face and its cell: the mean of both where the face has a temperature of its own, else the
  // cell's. With the cell's alone half a cell of cold gas would conduct as if it were warm.
  std::vector<double> boundaryViscosity;     // Pa s
  std::vector<double> boundaryConductivity;  // W/m/K

  // kg/m/s, of every species alike: what eddies add; empty in laminar flow.
  std::vector<double> eddyDiffusivity;

  // Molecular and turbulent together: Pa s, W/m/K. Eddies end at walls that the gas sticks to, where
  // they are those of the law of the wall if the state has its energy; at other boundaries they are those of the cell.
  [[nodiscard]] const std::vector<double>& effectiveViscosity() const { return of(effectiveViscosity_, viscosity); }
  [[nodiscard]] const std::vector<double>& effectiveConductivity() const {
    return of(effectiveConductivity_, conductivity);
  }
  [[nodiscard]] const std::vector<double>& effectiveBoundaryViscosity() const {
    return of(effectiveBoundaryViscosity_, boundaryViscosity);
  }
  [[nodiscard]] const std::vector<double>& effectiveBoundaryConductivity() const {
    return of(effectiveBoundaryConductivity_, boundaryConductivity);
  }

  // Evaluates all of it from the state's T, Y, density and eddy viscosity. Mass fractions below zero, which advection
  // may leave at the size of its error, count as zero here.
  void update(const FlowContext& context, const State& state);

  // Sizes of what saveOrLoad() fills.
  void resize(const FlowContext& context, const State& state);
  // What is looked at between two steps; the rest is evaluated where a step begins. `heat`: W, of all faces, what is
  // conducted out of the gas by these properties; of it what boundaries have.
  void saveOrLoad(const FlowContext& context, StateArchive& archive, std::span<double> heat);

 private:
  struct Coefficients {
    double viscosity = 0.0, conductivity = 0.0;
  };
  // Of X_, which it finds from the mass fractions; D and DT_ receive the coefficients of diffusion.
  Coefficients evaluate(const FlowContext& context, double T, double p, std::span<const double> Y, std::span<double> D);
  void updateBoundary(const FlowContext& context, const State& state);
  void addEddies(const FlowContext& context, const State& state);
  void addWallLaw(const FlowContext& context, const State& state, int face);
  [[nodiscard]] const std::vector<double>& of(const std::vector<double>& effective,
                                              const std::vector<double>& molecular) const {
    return effective.empty() ? molecular : effective;
  }

  std::optional<MulticomponentTransport> multicomponent_;
  std::vector<double> X_, D_, DT_;
  // Empty in laminar flow.
  std::vector<double> effectiveViscosity_, effectiveConductivity_, effectiveBoundaryViscosity_,
      effectiveBoundaryConductivity_;
};

// m^2/s, of a local cell: by which eddies mix what the gas carries. The state has eddies.
[[nodiscard]] inline double eddyMixing(const FlowContext& context, const State& state, std::size_t cell) {
  return state.eddyViscosity[cell] / (context.eddies.schmidt * state.density[cell]);
}

}  // namespace lampblack::flow
