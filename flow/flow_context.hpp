// What every flow operator of one run shares: mesh, halo exchange, gas models and boundary conditions.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/halo_exchange.hpp"
#include "core/mesh.hpp"
#include "core/rooms.hpp"
#include "flow/boundary.hpp"

namespace lampblack::flow {

struct FlowContext {
  const Mesh& mesh;
  HaloExchange& halo;
  const Mechanism& mechanism;
  const Thermo& thermo;
  Transport& transport;
  std::vector<BoundaryCondition> boundaries;  // index: patch of the mesh
  std::array<double, 2> gravity{0.0, 0.0};    // m/s^2
  // kg/m^3, whose weight the hydrodynamic pressure leaves out: that of the gas around the outlets, so that the pressure
  // there is zero at any height; in a closed vessel any will do.
  double referenceDensity = 0.0;

  [[nodiscard]] const BoundaryCondition& boundaryOf(int face) const {
    return boundaries[mesh.patch[face - mesh.interiorFaces]];
  }
  // N/m^3, weight less buoyancy of gas of that density, along an axis.
  [[nodiscard]] double bodyForce(double density, int axis) const {
    return (density - referenceDensity) * gravity[static_cast<std::size_t>(axis)];
  }
  // No outlet: the thermodynamic pressure changes with what comes in, of gas and of heat.
  [[nodiscard]] bool isClosed() const {
    return std::ranges::none_of(boundaries, [](const auto& b) { return b.kind == BoundaryKind::Outlet; });
  }
};

}  // namespace lampblack::flow
