// What happens at each part of the domain's surface.
#pragma once

#include <string>
#include <vector>

#include "core/rooms.hpp"

namespace lampblack::flow {

enum class BoundaryKind {
  Inlet,     // given normal velocity, temperature and composition
  Outlet,    // pressure zero, total pressure zero for what flows back in at the given temperature and composition
  Wall,      // impermeable to flow and species
  Symmetry,  // the axis, or a plane of symmetry
};

struct BoundaryCondition {
  std::string name;
  BoundaryKind kind = BoundaryKind::Wall;
  double speed = 0.0;        // m/s, Inlet: normal velocity into the domain
  double tangential = 0.0;   // m/s, Inlet, Wall without slip: velocity along the boundary, along its axis
  double temperature = 0.0;  // K, Inlet, Outlet (entrained gas), isothermal Wall
  std::vector<double> Y;     // mass fractions, Inlet and Outlet (entrained gas)
  // Inlet: true fixes the mass fractions at the face; false fixes the total species flux, convection and diffusion
  // together, at the fed flux (no diffusive loss into the nozzle).
  bool fixedComposition = false;
  bool isothermal = false;  // Wall: at `temperature`; otherwise adiabatic
  bool slip = false;        // Wall
};

}  // namespace lampblack::flow
