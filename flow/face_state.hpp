// The gas at the faces as convection sees it: temperature and mass fractions interpolated by the same limited scheme,
// the mass fractions rescaled to sum to one, density and enthalpy evaluated from them. A face between gases in pressure
// equilibrium is thereby in pressure equilibrium itself, and all species share one mass flux.
#pragma once

#include <span>
#include <vector>

#include "core/rooms.hpp"
#include "flow/flow_context.hpp"
#include "flow/gradient.hpp"
#include "flow/state.hpp"
#include "flow/upwind.hpp"

namespace lampblack::flow {

class FaceState {
 public:
  explicit FaceState(const FlowContext& context, int species, int carried);

  // Collective. Gradients and boundary values of the state's scalars.
  void prepare(const State& state);

  // Face values upwind of `direction` (any quantity with the sign of the flux, low to high or outwards).
  void interpolate(const State& state, std::span<const double> direction);

  std::vector<double> temperature;  // K, a face
  std::vector<double> density;      // kg/m^3
  std::vector<double> enthalpy;     // J/kg
  std::vector<double> Y;            // species a face

  // Limited value of a carried scalar per mass of gas at an interior face, upwind of `direction`.
  [[nodiscard]] double carriedPerMass(int face, int scalar, double direction) const;
  [[nodiscard]] std::span<const double> temperatureGradient() const { return temperatureGradient_; }
  // Temperature at a boundary face (faces - interiorFaces of them): given, or the cell's.
  [[nodiscard]] std::span<const double> boundaryTemperature() const { return boundaryTemperature_; }

 private:
  void setBoundaries(const State& state);

  const FlowContext& context_;
  int species_, carried_;
  Gradient gradient_;
  std::vector<BoundaryData> temperatureKnown_, YKnown_;  // of carried scalars as of Y
  UpwindGeometry temperatureUpwind_, YUpwind_;
  std::vector<double> boundaryTemperature_, boundaryY_, boundaryCarried_;
  std::vector<double> perMass_;
  std::vector<double> temperatureGradient_, YGradient_, carriedGradient_;
  std::vector<double> speciesEnthalpy_;
};

}  // namespace lampblack::flow
