// Couples the dimer two-equation soot model to the flow: soot number and its carbon and hydrogen mass are scalars that
// the flow carries; what soot takes from or gives to the gas changes the gas's species, mass and enthalpy.
//
// Energy: gas and new soot together keep their enthalpy. Soot carbon has the enthalpy of graphite, soot hydrogen that
// of H2 at the same temperature. The soot's own sensible heat is not followed along its path.
#pragma once

#include <vector>

#include "flow/flow_context.hpp"
#include "flow/gas_properties.hpp"
#include "flow/state.hpp"
#include "particles/two_equation.hpp"

namespace lampblack {

class SootOperator : public Operator {
 public:
  // Positions of the model's scalars among State::scalars.
  enum Scalar { number = 0, carbon = 1, hydrogen = 2 };
  static std::vector<CarriedScalar> carriedScalars();
  // Mass of each element of the mechanism in one unit of each scalar, for budgets.
  static std::vector<std::vector<double>> elementMass(const Mechanism& mechanism);

  SootOperator(const FlowContext& context, SootModelOptions options);

  void advance(State& state, double time, double dt) override;
  void saveOrLoad(StateArchive& archive) override;
  [[nodiscard]] const char* name() const override { return "particles"; }

  [[nodiscard]] const TwoEquationSoot& model() const { return model_; }
  [[nodiscard]] TwoEquationSoot::Population populationOf(const State& state, int cell) const;
  // The gas of a cell as the model sees it; its concentrations are in `concentrations`.
  [[nodiscard]] ParticleGas gasOf(const State& state, int cell, double viscosity,
                                  std::vector<double>& concentrations) const;
  // The species that the model sees, by their indices of the mechanism.
  [[nodiscard]] const std::vector<std::size_t>& species() const { return species_; }

  // Sums over all owned cells and steps so far: sub-steps in which oxidation was limited by the oxidiser there was.
  [[nodiscard]] long limitedOxidations() const { return limitedOxidations_; }

 private:
  void advanceCell(State& state, int cell, double viscosity, double dt);

  const FlowContext& context_;
  TwoEquationSoot model_;
  std::vector<std::size_t> species_;
  std::vector<double> speciesEnthalpy_, partialDensity_, before_, after_;  // the latter two: concentrations
  long limitedOxidations_ = 0;
};

}  // namespace lampblack
