#include "particles/population/model/pair_kernel.hpp"

#include <algorithm>

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
      slipLength_ = slipLength(options.slip, gas);
      if (options.slip == SlipLaw::davies) {
        slow_ = DaviesSlip::slow;
        fallPerDiameter_ = DaviesSlip::fall / slipLength_;
      }
      [[fallthrough]];
    case CollisionKernelType::freeMolecular:
      freeMolecular_ = options.efficiency * freeMolecularPrefactor(gas.temperature, options.enhancement);
      return;
    case CollisionKernelType::transitionFuchs:
    case CollisionKernelType::gravitational:
      return;
  }
}

void PairKernel::terms(const double* volume, const double* mass, const double* diameter, std::size_t n,
                       Terms* all) const {
  if (kernel_.options().type != CollisionKernelType::transition) {
    for (std::size_t k = 0; k < n; ++k) all[k] = terms({volume[k], mass[k], diameter[k]});
    return;
  }
  // Columns first: the loop is compiled to vector instructions.
  constexpr std::size_t block = 128;
  float mobilities[block], inverses[block];
  for (std::size_t first = 0; first < n; first += block) {
    const std::size_t count = std::min(block, n - first);
    for (std::size_t k = 0; k < count; ++k) {
      mobilities[k] = mobility(diameter[first + k]);
      inverses[k] = inverseMass(mass[first + k]);
    }
    for (std::size_t k = 0; k < count; ++k)
      all[first + k] = {static_cast<float>(diameter[first + k]), mobilities[k], inverses[k]};
  }
}

}  // namespace lampblack::particles
