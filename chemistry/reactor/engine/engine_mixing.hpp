// Mixing of the particles of a cylinder by turbulence, at constant pressure: composition and enthalpy alike, so that
// the variance of any conserved scalar decays as exp(-C t/tau) (docs/theory/engine.md).
#pragma once

#include "chemistry/reactor/engine/engine_gas.hpp"
#include "core/modules.hpp"
#include "core/random.hpp"

namespace lampblack::chemistry {

enum class EngineMixingModel { none, iem, curl, modifiedCurl };

class EngineMixing {
 public:
  EngineMixing(const Thermo& thermo, EngineMixingModel model, double constant)
      : thermo_(thermo), model_(model), constant_(constant) {}
  // Over a time (s) with the time scale tau (s) of the turbulence. Returned is by how much the volume has grown, m3.
  double advance(double duration, double tau, RandomStream& random, EngineGas& gas);

 private:
  void exchange(double part, EngineGas& gas);
  void pairs(double events, RandomStream& random, EngineGas& gas);

  const Thermo& thermo_;
  EngineMixingModel model_;
  double constant_;
  std::vector<double> mean_, enthalpy_;
  std::vector<char> isChanged_;
};

}  // namespace lampblack::chemistry
