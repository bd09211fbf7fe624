#include "flow/equations/heat_conduction.hpp"

#include <cmath>

#include "core/errors.hpp"
#include "flow/discretisation/face_fluxes.hpp"

namespace lampblack::flow {
namespace {

constexpr double smallRise = 1e-3;  // K, over which a heat capacity does not change

}  // namespace

BoundaryData knownTemperature(const FlowContext& context, int face) {
  if (context.isTemperatureGiven(face)) return BoundaryData::Value;
  const BoundaryKind kind = context.boundaryOf(face).kind;
  const bool isTight =
      kind == BoundaryKind::Symmetry || (kind == BoundaryKind::Wall && context.boundaryHeatFlux(face) == 0.0);
  return isTight ? BoundaryData::ZeroSlope : BoundaryData::Nothing;
}

HeatConduction::HeatConduction(const FlowContext& context, ImplicitDiffusion& diffusion)
    : context_(context), diffusion_(diffusion), gradient_(context.mesh) {
  const Mesh& m = context.mesh;
  if (!m.isOblique()) return;
  known_.resize(static_cast<std::size_t>(m.boundaryFaces()));
  boundaryTemperature_.resize(known_.size());
  temperatureGradient_.resize(static_cast<std::size_t>(m.cells) * m.dimension);
  oblique_.resize(static_cast<std::size_t>(m.faces));
}

// Conduction along Mesh::oblique, from the cells' gradients (Jasak 1996, section 3.3.1.3).
void HeatConduction::findOblique(std::span<const double> temperature) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int b = face - m.interiorFaces;
    known_[b] = knownTemperature(context_, face);
    if (known_[b] == BoundaryData::Value) boundaryTemperature_[b] = context_.boundaryTemperature(face);
  }
  gradient_.compute(temperature, boundaryTemperature_, 1, temperatureGradient_, known_);
  context_.halo.update(temperatureGradient_, m.dimension);
  for (int face = 0; face < m.faces; ++face)
    oblique_[face] = -conductance_[face] * m.distance[face] * faceSlope(m, face, m.oblique[face], temperatureGradient_);
}

void HeatConduction::prepare(const State& state, const GasProperties& properties) {
  const Mesh& m = context_.mesh;
  const std::vector<double>&conductivity = properties.effectiveConductivity(),
        &atBoundary = properties.effectiveBoundaryConductivity();
  conductance_.assign(static_cast<std::size_t>(m.faces), 0.0);
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const double metric = m.area[face] / m.distance[face];
    if (m.high[face] >= 0) {
      const double w = m.lowWeight[face];
      conductance_[face] = metric * (w * conductivity[low] + (1.0 - w) * conductivity[m.high[face]]);
      continue;
    }
    if (context_.isTemperatureGiven(face)) conductance_[face] = metric * atBoundary[face - m.interiorFaces];
  }
  if (m.isOblique()) findOblique(state.temperature);
}

// W, through a wall into the gas.
double HeatConduction::givenFlux(int face) const {
  const BoundaryCondition& boundary = context_.boundaryOf(face);
  const bool isGiven = boundary.kind == BoundaryKind::Wall && !boundary.isothermal;
  return isGiven ? context_.boundaryHeatFlux(face) * context_.mesh.area[face] : 0.0;
}

void HeatConduction::evaluate(std::span<const double> temperature, std::span<double> flux) const {
  const Mesh& m = context_.mesh;
  for (int face = 0; face < m.faces; ++face) {
    const bool isInterior = m.high[face] >= 0;
    const double beyond = isInterior ? temperature[m.high[face]] : context_.boundaryTemperature(face);
    flux[face] = conductance_[face] * (temperature[m.low[face]] - beyond);
    if (!isInterior) flux[face] -= givenFlux(face);
    if (!oblique_.empty()) flux[face] += oblique_[face];
  }
}

void HeatConduction::implicitFlux(const State& guess, const Contents& contents, double dt, std::span<double> flux,
                                  const std::function<bool(int cell)>& atOnce) {
  const Mesh& m = context_.mesh;
  const auto n = static_cast<std::size_t>(guess.species);
  inertia_.resize(static_cast<std::size_t>(m.owned));
  temperature_.resize(static_cast<std::size_t>(m.cells));
  Y_.resize(n);
  // At what rate heat comes in by everything else and by the guess's conduction.
  collectively(m.comm, [&] {
    for (int c = 0; c < m.owned; ++c) {
      for (std::size_t k = 0; k < n; ++k) Y_[k] = contents.species[c * n + k] / contents.mass[c];
      const double T = guess.temperature[c], mass = contents.mass[c], h = contents.enthalpy[c] / mass;
      const double lacks = h - context_.thermo.enthalpyMass(T, Y_);
      double capacity = context_.thermo.cpMass(T, Y_);
      // Its mean up to the temperature that all this leads to.
      if (!(atOnce && atOnce(c)))
        if (const double rise = context_.thermo.temperatureFromEnthalpy(h, Y_, T) - T; std::abs(rise) > smallRise)
          capacity = lacks / rise;
      inertia_[c] = mass * capacity / dt;
      temperature_[c] = mass * lacks / dt;
    }
  });
  evaluate(guess.temperature, flux);
  addFaceFluxes(m, flux, 1, 1.0, temperature_);
  diffusion_.changes(
      1, inertia_, [this](int face, std::span<const int>, double* g) { *g = conductance_[face]; }, temperature_);
  for (int c = 0; c < m.cells; ++c) temperature_[c] += guess.temperature[c];
  evaluate(temperature_, flux);
}

}  // namespace lampblack::flow
