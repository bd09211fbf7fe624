// What the particles of a cylinder's gas carry besides it, such as soot: amounts per kg of gas that mix as mass
// fractions do, and react with the gas. It has no volume, and no heat of its own in what else happens to the gas.
// coupling/ puts models of particles behind it.
#pragma once

#include <cstddef>
#include <vector>

#include "chemistry/reactor/engine/engine_gas.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

class EngineCarried {
 public:
  virtual ~EngineCarried() = default;

  [[nodiscard]] virtual std::size_t size() const = 0;
  // kg of each element of the mechanism in a unit of each scalar.
  [[nodiscard]] virtual const std::vector<std::vector<double>>& unitElements() const = 0;
  struct Work {
    double given = 0;  // J, enthalpy that the gas has given to it
    double heat = 0;   // J set free by the reactions of both, by enthalpies at formationTemperature
    double steps = 0;  // of the stiff solver
  };
  // Collective. Reactions of the gas and of what it carries, together, over a time (s) at the pressure as it is:
  // masses, compositions, temperatures and scalars change, of those particles of gas that have any or may get some.
  // `isDone` (a value a particle) says which. NumericsError.
  virtual Work react(double duration, EngineGas& gas, std::vector<char>& isDone) = 0;

 protected:
  EngineCarried() = default;
  EngineCarried(const EngineCarried&) = default;
  EngineCarried& operator=(const EngineCarried&) = default;
};

}  // namespace lampblack::chemistry
