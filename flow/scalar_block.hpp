// What a flow carries besides its gas, in blocks that stand side by side in State::carried: each has one owner, who
// sets its diffusivities, adds its sources (State::balance) and says what its boundaries have. Transport moves all of
// them alike, without knowing what they mean.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/boundaries/boundary.hpp"

namespace lampblack::flow {

// What a boundary has of a carried scalar, per kg of gas.
struct ScalarBoundary {
  double value = 0.0;   // of the gas that flows in (Inlet, Outlet); at the face itself where that is held
  bool isHeld = false;  // Inlet, Wall: the face has the value, to which and from which the scalar diffuses and drifts
  FieldFunction varies = {};  // of the place, in place of the value; empty: it is the same everywhere

  [[nodiscard]] double at(const Vector3& place) const { return varies ? varies(place, 0.0) : value; }
};

// A quantity that the flow carries without knowing what it means (soot number, sections, moments): its density per
// volume is transported by the gas velocity, thermophoresis, and a diffusivity that its owner sets.
struct CarriedScalar {
  std::string name;
  std::string unit;
  std::string description;
  // Drift velocity -thermophoresis * (mu/rho) * grad T / T; 0: none.
  double thermophoresis = 0.0;
  // false: its owner moves what it stands for, and sets it anew in every step; transport leaves it as it is.
  bool isTransported = true;
  // Eddies spread it by the turbulent Schmidt number. false: its owner's diffusivity has all there is.
  bool isStirred = true;
  // Its diffusivity at walls that hold it, over the kinematic viscosity there; 0: it is that of the cell.
  double wallDiffusivity = 0.0;
  // In the order of FlowContext::boundaries. Empty: nothing comes in with the gas, and nothing passes through walls.
  std::vector<ScalarBoundary> boundaries = {};
  // Amount per kg of gas below which it counts as nothing where amounts are compared; 0: unknown.
  double negligible = 0.0;
};

// How gas meets walls whose layers are not resolved, by the turbulent energy beside them (wall_law.hpp). None: they are
// resolved.
enum class WallLaw : char {
  None,
  TwoLayers,  // viscous or logarithmic
  Blended,    // both, for cells of any thickness
};

struct ScalarBlock {
  std::string owner;
  std::vector<CarriedScalar> scalars;
  bool givesEddies = false;         // its owner sets State::eddyViscosity
  WallLaw wallLaw = WallLaw::None;  // not None: its first scalar is the turbulent energy
};

// Where the block of an owner stands among all carried scalars.
struct ScalarRange {
  std::string owner;
  int first = 0, count = 0;
};

// Particles: what touches a wall that takes particles stays there, so that there are none at its surface.
inline ScalarBlock takenByWalls(ScalarBlock block, const std::vector<BoundaryCondition>& boundaries) {
  for (CarriedScalar& scalar : block.scalars) {
    scalar.boundaries.resize(boundaries.size());
    for (std::size_t b = 0; b < boundaries.size(); ++b)
      if (boundaries[b].kind == BoundaryKind::Wall && boundaries[b].takesParticles)
        scalar.boundaries[b] = {.value = 0.0, .isHeld = true};
  }
  return block;
}

}  // namespace lampblack::flow
