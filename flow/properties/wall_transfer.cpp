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

double prandtlAtWall(const Mesh& m, const GasProperties& properties, int face) {
  const int b = face - m.interiorFaces;
  return properties.boundaryViscosity[b] * properties.heatCapacity[m.low[face]] / properties.boundaryConductivity[b];
}

}  // namespace

WallEddies eddiesToWall(const FlowContext& context, const State& state, const GasProperties& properties, int face) {
  const Mesh& m = context.mesh;
  const double exchange = lawExchange(context, state, face);
  if (!(exchange > 0.0)) return {};
  const double yStar = exchange / properties.boundaryViscosity[face - m.interiorFaces];
  const double prandtl = prandtlAtWall(m, properties, face);
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
  const auto [turbulentPrandtl, turbulentSchmidt] = context.eddies;
  const double schmidt = viscosity / (state.density[cell] * D);
  const double eddies = eddiesToWall(context, state, properties, face).resistance;
  // What diffuses better than heat has no viscous layer but the still one, in which it differs from what only eddies
  // bring.
  if (eddies > 0.0 && schmidt / turbulentSchmidt < prandtlAtWall(m, properties, face) / turbulentPrandtl)
    return metric * exchange / (schmidt * walllaw::still);
  const double all = walllaw::scalar(exchange / viscosity, schmidt, turbulentSchmidt) / (metric * exchange);
  return 1.0 / (all - eddies);
}

}  // namespace lampblack::flow
