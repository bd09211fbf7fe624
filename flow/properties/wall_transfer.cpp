#include "flow/properties/wall_transfer.hpp"

#include "flow/boundaries/wall_law.hpp"

namespace lampblack::flow {
namespace {

// rho u* y, Pa s, of a cell for which the law of the wall stands; else zero.
double lawExchange(const FlowContext& context, const State& state, int face) {
  const Mesh& m = context.mesh;
  if (state.wallEnergy < 0 || !context.boundaryOf(face).isNoSlipWall()) return 0.0;
  return walllaw::exchange(state, static_cast<std::size_t>(m.low[face]), m.distance[face]);
}

}  // namespace

WallEddies eddiesToWall(const FlowContext& context, const State& state, const GasProperties& properties, int face) {
  const Mesh& m = context.mesh;
  const double exchange = lawExchange(context, state, face);
  if (!(exchange > 0.0)) return {};
  const int b = face - m.interiorFaces;
  const double viscosity = properties.boundaryViscosity[b], yStar = exchange / viscosity;
  const double prandtl = viscosity * properties.heatCapacity[m.low[face]] / properties.boundaryConductivity[b];
  const auto [turbulentPrandtl, schmidt] = context.eddies;
  const double eddies = walllaw::eddyPart(yStar, prandtl, turbulentPrandtl);
  if (!(eddies > 0.0)) return {};
  return {eddies / walllaw::scalar(yStar, prandtl, turbulentPrandtl),
          eddies * schmidt / turbulentPrandtl * m.distance[face] / (exchange * m.area[face])};
}

double conductanceToWall(const FlowContext& context, const State& state, const GasProperties& properties, int face,
                         double density, double D) {
  const Mesh& m = context.mesh;
  const double metric = m.area[face] / m.distance[face], viscous = density * metric * D;
  const double exchange = D > 0.0 ? lawExchange(context, state, face) : 0.0;
  if (!(exchange > 0.0)) return viscous;
  const auto cell = static_cast<std::size_t>(m.low[face]);
  const double viscosity = properties.boundaryViscosity[face - m.interiorFaces];
  const double all =
      walllaw::scalar(exchange / viscosity, viscosity / (state.density[cell] * D), context.eddies.schmidt) /
      (metric * exchange);
  // Eddies are less than all: what conducts heat well enough to have them diffuses more than any particle.
  const double layer = all - eddiesToWall(context, state, properties, face).resistance;
  constexpr double least = 1e-3;
  return 1.0 / std::max(layer, least * all);
}

}  // namespace lampblack::flow
