#include "particles/population/model/pair_kernel.hpp"

namespace lampblack::particles {

PairKernel::PairKernel(const CollisionKernelOptions& options) : kernel_(options) {
  const CarrierGas& gas = options.gas;
  hasForm_ = !(options.efficiencyDiameter > 0) && options.type != CollisionKernelType::transitionFuchs &&
             options.type != CollisionKernelType::gravitational;
  switch (options.type) {
    case CollisionKernelType::constant:
    case CollisionKernelType::additive:
      root_ = options.efficiency * options.rate;
      return;
    case CollisionKernelType::multiplicative:
      root_ = std::sqrt(options.efficiency * options.rate);
      return;
    case CollisionKernelType::shear:
      root_ = std::cbrt(options.efficiency * options.shearRate / 6);
      return;
    case CollisionKernelType::continuum:
    case CollisionKernelType::transition:
      continuum_ = options.efficiency * continuumPrefactor(gas.temperature, gas.viscosity);
      [[fallthrough]];
    case CollisionKernelType::freeMolecular:
      freeMolecular_ = options.efficiency * freeMolecularPrefactor(gas.temperature, options.enhancement);
      return;
    case CollisionKernelType::transitionFuchs:
    case CollisionKernelType::gravitational:
      return;
  }
}

}  // namespace lampblack::particles
