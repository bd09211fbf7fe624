// What every flow operator of one run shares: mesh, halo exchange, gas models and boundary conditions.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/halo_exchange.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "flow/boundaries/boundary.hpp"
#include "flow/boundaries/boundary_values.hpp"
#include "flow/properties/transport_model.hpp"

namespace lampblack::flow {

// Numbers by which eddies mix heat, and species with what else the gas carries, less well than momentum.
struct EddyNumbers {
  double prandtl = 0.9, schmidt = 0.9;
};

struct FlowContext {
  const Mesh& mesh;
  HaloExchange& halo;
  const Mechanism& mechanism;
  const Thermo& thermo;
  Transport& transport;
  std::vector<BoundaryCondition> boundaries;  // index: patch of the mesh
  Vector3 gravity{0.0, 0.0, 0.0};             // m/s^2
  // kg/m^3, whose weight the hydrodynamic pressure leaves out: that of the gas around the outlets, so that the pressure
  // there is zero at any height; in a closed vessel any will do.
  double referenceDensity = 0.0;
  std::shared_ptr<BoundaryValues> varying = nullptr;  // null where no boundary varies over place or time
  TransportModel transportModel{};                    // `transport` has its averaged() options
  std::vector<double> wallDistance{};                 // m, of the owned cells; empty where nobody asks
  EddyNumbers eddies{};
  double load = 1.0;        // factor on the velocities that inlets are given
  int loadedBoundary = -1;  // the inlet that it is for; -1: all

  [[nodiscard]] const BoundaryCondition& boundaryOf(int face) const {
    return boundaries[mesh.patch[face - mesh.interiorFaces]];
  }
  // What a boundary face has, now where it varies.
  [[nodiscard]] double boundarySpeed(int face) const {  // m/s, into the domain
    const BoundaryValues::Face* values = varyingAt(face);
    return loadAt(face) * (values ? values->speed : boundaryOf(face).speed);
  }
  [[nodiscard]] double boundaryTemperature(int face) const {  // K
    const BoundaryValues::Face* values = varyingAt(face);
    return values ? values->temperature : boundaryOf(face).temperature;
  }
  [[nodiscard]] const std::vector<double>& boundaryY(int face) const {
    const BoundaryValues::Face* values = varyingAt(face);
    return values ? values->Y : boundaryOf(face).Y;
  }
  [[nodiscard]] double boundaryHeatFlux(int face) const {  // W/m^2, into the gas
    const BoundaryValues::Face* values = varyingAt(face);
    return values ? values->heatFlux : boundaryOf(face).heatFlux;
  }
  // Whether what is carried and touches this boundary face stays there.
  [[nodiscard]] bool takesParticles(int face) const {
    const BoundaryCondition& boundary = boundaryOf(face);
    return boundary.kind == BoundaryKind::Wall && boundary.takesParticles;
  }
  // Whether the mass fractions at this boundary face are given.
  [[nodiscard]] bool isCompositionGiven(int face) const {
    const BoundaryCondition& boundary = boundaryOf(face);
    return boundary.kind == BoundaryKind::Inlet && boundary.fixedComposition;
  }
  // Whether the gas at this boundary face has a temperature of its own, to which heat is conducted.
  [[nodiscard]] bool isTemperatureGiven(int face) const {
    const BoundaryCondition& boundary = boundaryOf(face);
    return (boundary.kind == BoundaryKind::Inlet && !isSuction(face)) ||
           (boundary.kind == BoundaryKind::Wall && boundary.isothermal);
  }
  // An inlet of negative velocity whose temperature and composition are not held: the gas leaves as it is.
  [[nodiscard]] bool isSuction(int face) const {
    const BoundaryCondition& boundary = boundaryOf(face);
    return boundary.kind == BoundaryKind::Inlet && !boundary.fixedComposition && boundarySpeed(face) < 0.0;
  }
  // m/s, what the momentum meets: into the domain, and along the boundary's axis.
  [[nodiscard]] std::array<double, 2> boundaryVelocity(int face) const {
    const BoundaryValues::Face* values = varyingAt(face);
    const BoundaryCondition& boundary = boundaryOf(face);
    const double factor = loadAt(face);
    return values ? std::array{factor * values->speedOfMomentum, factor * values->tangential}
                  : std::array{factor * boundary.speed, factor * boundary.tangential};
  }
  [[nodiscard]] double boundarySwirl(int face) const {  // m/s, what the swirl meets
    const BoundaryValues::Face* values = varyingAt(face);
    return loadAt(face) * (values ? values->swirl : boundaryOf(face).swirl);
  }
  [[nodiscard]] double loadAt(int face) const {
    const bool isLoaded = loadedBoundary < 0 || mesh.patch[face - mesh.interiorFaces] == loadedBoundary;
    return isLoaded && boundaryOf(face).kind == BoundaryKind::Inlet ? load : 1.0;
  }
  // N/m^3, weight less buoyancy of gas of that density, along an axis or a direction.
  [[nodiscard]] double bodyForce(double density, int axis) const {
    return (density - referenceDensity) * gravity[static_cast<std::size_t>(axis)];
  }
  [[nodiscard]] double bodyForce(double density, const Vector3& direction) const {
    return (density - referenceDensity) * dot(gravity, direction);
  }
  [[nodiscard]] const BoundaryValues::Face* varyingAt(int face) const {
    return varying ? varying->at(face - mesh.interiorFaces) : nullptr;
  }
  // No outlet: the thermodynamic pressure changes with what comes in, of gas and of heat.
  [[nodiscard]] bool isClosed() const {
    return std::ranges::none_of(boundaries, [](const auto& b) { return b.kind == BoundaryKind::Outlet; });
  }
};

// Of what is integrated over a mesh: "N/rad", "N/m" or "N".
inline std::string integralUnit(const Mesh& mesh, const std::string& unit) {
  return unit + (mesh.axisymmetric() ? "/rad" : mesh.dimension == 2 ? "/m" : "");
}

}  // namespace lampblack::flow
