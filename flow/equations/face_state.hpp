// The gas at the faces as convection sees it: temperature and mass fractions interpolated by the same limited scheme,
// the mass fractions rescaled to sum to one, density and enthalpy evaluated from them. A face between gases in pressure
// equilibrium is thereby in pressure equilibrium itself, and all species share one mass flux.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/discretisation/neighbour_bounds.hpp"
#include "flow/discretisation/row_gradient.hpp"
#include "flow/discretisation/upwind.hpp"
#include "flow/equations/scalar_boundaries.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class FaceState {
 public:
  FaceState(const FlowContext& context, const State& state);

  // Collective. Gradients and boundary values of the state's scalars, with these mass fractions of all local cells,
  // which have to stay.
  void prepare(const State& state, std::span<const double> Y);
  // Collective. Of what is carried alone, in the gas that was prepared.
  void prepareCarried(const State& state);

  // Temperature, density and enthalpy of a face, upwind of `direction` (any quantity with the sign of the flux, low to
  // high or outwards), and to `row` its mass fractions, `species` of them. `state`: the prepared.
  void interpolate(const State& state, int face, double direction, std::span<double> row);
  // The mass fractions alone.
  void massFractions(int face, double direction, std::span<double> row) const;

  std::vector<double> temperature;  // K, a face
  std::vector<double> density;      // kg/m^3
  std::vector<double> enthalpy;     // J/kg

  // Limited value of a carried scalar per mass of gas at an interior face, upwind of `direction`.
  [[nodiscard]] double carriedPerMass(int face, int scalar, double direction) const;
  [[nodiscard]] const ScalarBoundaries& carriedBoundaries() const { return carriedBoundaries_; }
  // What it is more at a wall than in the cell, as it changes in the cell on the other side: no more than its value.
  [[nodiscard]] double carriedRiseToWall(int face, int scalar) const;
  [[nodiscard]] std::span<const double> temperatureGradient() const { return temperatureGradient_; }
  // Temperature at a boundary face (faces - interiorFaces of them): given, or the cell's.
  [[nodiscard]] std::span<const double> boundaryTemperature() const { return boundaryTemperature_; }

 private:
  void setBoundaries(const State& state);
  void setCarriedBoundaries();
  void findPerMass(const State& state);
  void keepAmountsAtWalls();
  // Values at a face of what is fed with a given flux, where it is.
  void limitFed(const State& state, int face);
  // Limited value at an interior face of a field with its gradient in the cells.
  [[nodiscard]] double limited(const Upwind& u, int face, std::span<const double> values,
                               std::span<const double> gradient, const NeighbourBounds& bounds, int components = 1,
                               int component = 0) const;
  // Whether gas comes in from beyond the boundary at a face.
  [[nodiscard]] bool enters(int face, double direction) const;

  const FlowContext& context_;
  int species_, carried_;
  ScalarBoundaries carriedBoundaries_;
  std::span<const double> Y_;
  Gradient gradient_;
  std::vector<BoundaryData> temperatureKnown_, YKnown_;
  // As of Y, but at walls that hold a scalar; of each scalar, where not all are alike.
  std::vector<BoundaryData> carriedKnown_;
  std::vector<BoundaryData> temperatureHeld_, YHeld_;  // the same, without what is fed with a given flux alone
  UpwindGeometry temperatureUpwind_, YUpwind_;
  std::vector<double> boundaryTemperature_, boundaryY_, boundaryCarried_;
  std::vector<double> perMass_;
  std::vector<double> temperatureGradient_, carriedGradient_;
  RowGradient YGradient_;
  NeighbourBounds temperatureBounds_, YBounds_, carriedBounds_;  // where faces have offsets
  mutable std::vector<double> slope_, offsetSlope_;
  std::vector<double> feedSlope_;
};

}  // namespace lampblack::flow
