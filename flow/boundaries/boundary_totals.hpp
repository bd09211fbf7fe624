// What passes through a boundary and presses on it, summed over its faces and face by face: per radian of an
// axisymmetric flow, per metre of depth of a plane one.
#pragma once

#include <cstdint>

#include "core/mesh.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

struct BoundaryTotals {
  double area = 0.0;          // m^2
  double massFlow = 0.0;      // kg/s, into the domain, mean of the last step
  double enthalpyFlow = 0.0;  // W, into the domain: convection, diffusion and conduction, formation included
  double heatFlow = 0.0;      // W, into the domain: the part of it that is conducted
  // N, of the gas on what lies beyond, along the mesh's axes: by the hydrodynamic pressure, and by friction.
  Vector3 pressureForce{}, viscousForce{};
  double torque = 0.0;  // N m, of the gas that swirls on what lies beyond, about the axis
};

// A face of a wall that the gas sticks to.
struct WallFace {
  std::int64_t number = 0;  // permanent
  Vector3 place{};          // m
  double area = 0.0;        // m^2, as above
  Vector3 friction{};       // Pa, of the gas along the wall; of a flow that swirls the third is about the axis
  double yPlus = 0.0;       // y+ of the centre of the cell beside, with the molecular viscosity
  double heatFlux = 0.0;    // W/m^2, conducted into the gas, mean of the last step
};

}  // namespace lampblack::flow
