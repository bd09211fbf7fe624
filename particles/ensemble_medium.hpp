// Inside of Ensemble: the gas, digested once for an advance. Not for other rooms.
#pragma once

#include "particles/ensemble.hpp"

namespace lampblack {

struct Ensemble::Medium {
  const SootGasState& gas;
  SurfaceChemistry surface;
  DimerProduction dimer;
  double selfCollision;          // of dimers, zero with inception off
  double freeMolecular;          // prefactor of collisions with particles
  double dimerHydrogenFraction;  // by mass
  double nucleusMass, nucleusHydrogen, nucleusDiameter;
  bool condensing, surfaceActive;
  CollisionKernel kernel;  // as it is made, not tuned

  [[nodiscard]] double collision(double mass, double diameter) const {
    return DimerModel::particleCollision(dimer, freeMolecular, mass, diameter);
  }
};

}  // namespace lampblack
