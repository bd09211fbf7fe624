// Reactions of the particles of a cylinder, each at constant pressure and enthalpy, in vector lanes and shared by the
// ranks. All ranks hold all particles, and the same ones afterwards.
#pragma once

#include <mpi.h>

#include "chemistry/reactor/engine/engine_gas.hpp"
#include "chemistry/reactor/reactor.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class EngineReactions {
 public:
  struct Work {
    double heat = 0;   // J set free, by the enthalpies of the species at formationTemperature
    double steps = 0;  // of the stiff solver, of all particles
  };
  EngineReactions(MPI_Comm comm, const Mechanism& mechanism, const Thermo& thermo,
                  const ConstantPressureReactor::Options& options);

  // Collective, over a time in s, but of those particles that are done already (a value each). ReactorFailure on all
  // ranks.
  Work advance(double duration, EngineGas& gas, const std::vector<char>& isDone);

 private:
  MPI_Comm comm_;
  int rank_ = 0, ranks_ = 1;
  ConstantPressureReactor reactor_;
  std::vector<double> formation_;  // J/kg at 298.15 K
  std::vector<double> rows_;
};

}  // namespace lampblack::chemistry
