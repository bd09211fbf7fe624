#include "particles/population/model/collision_kernel.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

using Type = CollisionKernelType;

void require(bool given, Type type, std::string_view what) {
  if (!given) throw InputError(fmt::format("the {} kernel needs {}", nameOf(type), what));
}

void requireGas(const CollisionKernelOptions& options) {
  const CarrierGas& gas = options.gas;
  require(gas.temperature > 0, options.type, "a temperature");
  if (options.type == Type::freeMolecular) return;
  require(gas.pressure > 0, options.type, "a pressure");
  require(gas.viscosity > 0, options.type, "a viscosity");
  require(gas.meanMolecularWeight > 0, options.type, "a mean molecular weight");
  if (!(gas.density >= 0)) throw InputError("coagulation: the density of the gas needs to be zero or above");
}

}  // namespace

std::string_view nameOf(CollisionKernelType type) {
  switch (type) {
    case Type::constant:
      return "constant";
    case Type::additive:
      return "additive";
    case Type::multiplicative:
      return "multiplicative";
    case Type::freeMolecular:
      return "free-molecular";
    case Type::continuum:
      return "continuum";
    case Type::transition:
      return "transition";
    case Type::transitionFuchs:
      return "Fuchs transition";
    case Type::shear:
      return "shear";
    case Type::gravitational:
      return "gravitational";
  }
  return "";
}

CollisionKernel::CollisionKernel(const CollisionKernelOptions& options) : options_(options) {
  const CarrierGas& gas = options.gas;
  const double efficiency = options.efficiency;
  if (!(efficiency > 0 && efficiency <= 1)) {
    throw InputError(fmt::format("coagulation: the efficiency needs to be in (0, 1], not {}", efficiency));
  }
  if (!(options.efficiencyDiameter >= 0) || !std::isfinite(options.efficiencyExponent)) {
    throw InputError("coagulation: the diameter of the efficiency needs to be zero or above");
  }
  if (!(options.enhancement > 0)) {
    throw InputError(fmt::format("coagulation: the enhancement needs to be above zero, not {}", options.enhancement));
  }
  needsDiameter_ = options.efficiencyDiameter > 0;
  switch (options.type) {
    case Type::constant:
    case Type::additive:
    case Type::multiplicative:
      if (!(options.rate >= 0) || !std::isfinite(options.rate)) {
        throw InputError(fmt::format("coagulation: the rate needs to be zero or above, not {}", options.rate));
      }
      scale_ = efficiency * options.rate * (options.type == Type::additive ? 1 : 0.5);
      gels_ = options.type == Type::multiplicative;
      return;
    case Type::shear:
      require(options.shearRate > 0, options.type, "a shear rate");
      rank_ = 2;
      scale_ = efficiency * options.shearRate / 6;
      break;
    case Type::freeMolecular:
    case Type::continuum:
    case Type::transition:
    case Type::transitionFuchs:
    case Type::gravitational:
      requireGas(options);
      rank_ = 2;
      break;
  }
  needsDiameter_ = true;
  if (options.type == Type::shear) return;
  freeMolecular_ = freeMolecularPrefactor(gas.temperature, options.enhancement);
  freeMolecularScale_ = 2 * efficiency * freeMolecular_;
  if (options.type == Type::freeMolecular) return;
  continuum_ = continuumPrefactor(gas.temperature, gas.viscosity);
  continuumScale_ = efficiency * continuum_;
  twiceMeanFreePath_ = slipLength(options.slip, gas);
  if (options.type == Type::continuum) return;
  rank_ = 3;
  fuchsPath_ = fuchsPathPrefactor(gas.temperature, gas.viscosity);
  settling_ = constants::standardGravity / (3 * constants::pi * gas.viscosity);
  if (options.type == Type::gravitational) {
    scale_ = 0.25 * constants::pi * efficiency;
    gels_ = true;
    return;
  }
  tunable_ = true;
  mix(1);
}

bool CollisionKernel::exact() const {
  const bool bounded = tunable_ || options_.type == Type::freeMolecular || options_.type == Type::gravitational;
  return !bounded && !(options_.efficiencyDiameter > 0);
}

void CollisionKernel::mix(double freeMolecularShare) {
  const double rest = 1 - freeMolecularShare;
  freeMolecularScale_ = 2 * options_.efficiency * freeMolecular_ * freeMolecularShare * freeMolecularShare;
  continuumScale_ = options_.efficiency * continuum_ * rest * rest;
}

}  // namespace lampblack::particles
