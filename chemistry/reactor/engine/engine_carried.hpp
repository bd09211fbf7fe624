// What the particles of a cylinder's gas carry besides it, such as soot: amounts per kg of gas that mix as mass
// fractions do, and exchange species and heat with the gas. It has no volume and no heat of its own in what else
// happens to the gas. coupling/ puts models of particles behind it.
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
  // Collective. Over a time (s) at the pressure as it is: the scalars change, and with them masses, compositions and
  // temperatures of the gas. Returned is the enthalpy that the gas has given, J. NumericsError.
  virtual double advance(double duration, EngineGas& gas) = 0;

 protected:
  EngineCarried() = default;
  EngineCarried(const EngineCarried&) = default;
  EngineCarried& operator=(const EngineCarried&) = default;
};

}  // namespace lampblack::chemistry
