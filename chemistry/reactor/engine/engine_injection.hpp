// Fuel that is sprayed into a cylinder: particles of vapour with the enthalpy that the liquid had, in a part of the gas
// around, and the nearest ones merged where there are too many.
#pragma once

#include <vector>

#include "chemistry/reactor/engine/engine_gas.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class EngineInjection {
 public:
  struct Options {
    std::vector<double> massFractions;  // of the fuel
    double enthalpy = 0;                // J/kg of the liquid, with that of formation
    double dilution = 1;                // kg of gas in which a kg evaporates, of all particles alike
    std::size_t mostParticles = 0;
  };
  struct Work {
    double mass = 0, enthalpy = 0;  // kg, J brought in
    double growth = 0;              // m3
  };
  EngineInjection(const Mechanism& mechanism, const Thermo& thermo, const Options& options);
  // At the pressure as it is. NumericsError where the vapour is too cold for the thermodynamics.
  Work inject(double mass, EngineGas& gas) const;
  // Two become one: masses, elements, enthalpies add. The nearest in the oxygen that they need and in enthalpy, each
  // by its standard deviation.
  void mergeNearest(EngineGas& gas) const;

 private:
  const Thermo& thermo_;
  Options options_;
  std::vector<double> need_;  // mol of oxygen atoms a kg of each species needs
};

// Mol of oxygen atoms that a kg of each species needs to burn; negative of those that have some to give.
[[nodiscard]] std::vector<double> oxygenNeedOf(const Mechanism& mechanism);
// Equivalence ratio of the elements: (2 C + H/2)/O. Infinite without oxygen.
[[nodiscard]] double equivalenceRatioOf(const Mechanism& mechanism, std::span<const double> Y);

}  // namespace lampblack::chemistry
