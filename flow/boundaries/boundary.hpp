// What happens at each part of the domain's surface.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/boundaries/gas_variation.hpp"

namespace lampblack::flow {

enum class BoundaryKind {
  Inlet,     // given normal velocity, temperature and composition
  Outlet,    // pressure zero, total pressure zero for what flows back in at the given temperature and composition
  Wall,      // impermeable to flow and species
  Symmetry,  // the axis, or a plane of symmetry
};

// What of a boundary depends on place or time; an empty function: nothing of that kind.
struct BoundaryVariation {
  FieldFunction speed, tangential, swirl, heatFlux;
  GasVariation gas;
  FieldFunction turbulentEnergy, turbulentDissipation;  // m^2/s^2, m^2/s^3: Inlet, not in time; for FreeStream
  bool inTime = false;                                  // whether any of them depends on time

  [[nodiscard]] bool isEmpty() const { return !speed && !tangential && !swirl && !heatFlux && gas.isEmpty(); }
};

struct BoundaryCondition {
  std::string name;
  BoundaryKind kind = BoundaryKind::Wall;
  double speed = 0.0;        // m/s, Inlet: normal velocity into the domain; below zero: out of it
  double tangential = 0.0;   // m/s, Inlet, Wall without slip: velocity along the boundary, along its axis
  double swirl = 0.0;        // m/s, Inlet, Wall without slip: velocity about the axis
  double temperature = 0.0;  // K, Inlet, Outlet (entrained gas), isothermal Wall
  std::vector<double> Y;     // mass fractions, Inlet and Outlet (entrained gas)
  // Inlet: true fixes the mass fractions at the face; false fixes the total species flux, convection and diffusion
  // together, at the fed flux (no diffusive loss into the nozzle), and lets gas that leaves go as it is.
  bool fixedComposition = false;
  bool isothermal = false;      // Wall: at `temperature`; otherwise `heatFlux` comes through it
  double heatFlux = 0.0;        // W/m^2, Wall: into the gas; zero: adiabatic
  bool slip = false;            // Wall
  bool takesParticles = false;  // Wall: what is carried and touches it stays there (flow/boundaries/wall_flux.hpp)
  BoundaryVariation varies;     // in place of the values above

  // A wall at which the gas has the velocity of the wall.
  [[nodiscard]] bool isNoSlipWall() const { return kind == BoundaryKind::Wall && !slip; }
};

}  // namespace lampblack::flow
