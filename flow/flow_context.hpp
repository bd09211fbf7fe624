// What every flow operator of one run shares: mesh, halo exchange, gas models and boundary conditions.
#pragma once

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

  [[nodiscard]] const BoundaryCondition& boundaryOf(int face) const {
    return boundaries[mesh.patch[face - mesh.interiorFaces]];
  }
};

}  // namespace lampblack::flow
