// Gases and particles for the tests of the kernels.
#pragma once

#include <vector>

#include "core/random.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Air at 298 K and one atmosphere.
inline CarrierGas air() {
  return {
      .temperature = 298, .pressure = 101325, .density = 1.184, .viscosity = 1.837e-5, .meanMolecularWeight = 0.028964};
}

inline CollisionKernel::Properties sphere(double diameter, double density = 1000) {
  const double volume = constants::pi / 6 * diameter * diameter * diameter;
  return {volume, density * volume, diameter};
}

// Log-uniform between 1 nm and 10 um.
inline CollisionKernel::Properties randomSphere(RandomStream& random) {
  return sphere(std::pow(10, -9 + 4 * random.uniform()));
}

inline CollisionKernelOptions kernelOptions(CollisionKernelType type) {
  CollisionKernelOptions options;
  options.type = type;
  options.rate = 2.5;
  options.gas = air();
  options.shearRate = 30;
  return options;
}

inline const std::vector<CollisionKernelType> allKernels = {
    CollisionKernelType::constant,        CollisionKernelType::additive,  CollisionKernelType::multiplicative,
    CollisionKernelType::freeMolecular,   CollisionKernelType::continuum, CollisionKernelType::transition,
    CollisionKernelType::transitionFuchs, CollisionKernelType::shear,     CollisionKernelType::gravitational};

}  // namespace lampblack::test
