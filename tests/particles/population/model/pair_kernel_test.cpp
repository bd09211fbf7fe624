#include "particles/population/model/pair_kernel.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/sphere.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

using enum CollisionKernelType;

CollisionKernelOptions kernelIn(CollisionKernelType type) {
  CollisionKernelOptions options;
  options.type = type;
  options.gas = {1500, 101325, 0.2, 5e-5, 0.029};
  options.shearRate = 30;
  options.efficiency = 0.7;
  options.enhancement = 2.2;
  options.rate = type == additive ? 1e12 : type == multiplicative ? 1e38 : 1e-15;
  return options;
}

// Between 0.5 nm and 5 micrometres.
TEST(PairKernel, HasTheValuesOfTheKernel) {
  const Sphere type(1800);
  for (const auto kernelType : {constant, additive, multiplicative, freeMolecular, continuum, transition, shear}) {
    for (const SlipLaw slip : {SlipLaw::davies, SlipLaw::air}) {
      CollisionKernelOptions options = kernelIn(kernelType);
      options.slip = slip;
      const PairKernel pairs(options);
      const CollisionKernel kernel(options);
      ASSERT_TRUE(pairs.hasForm());
      for (double d = 5e-10; d < 6e-6; d *= 3)
        for (double e = 5e-10; e < 6e-6; e *= 3) {
          const auto i = kernelProperties(kernel, type, type.make(constants::pi / 6 * d * d * d));
          const auto j = kernelProperties(kernel, type, type.make(constants::pi / 6 * e * e * e));
          const double expected = kernel.value(i, j);
          pairs.visit([&](const auto& rate) {
            EXPECT_NEAR(rate(pairs.terms(i), pairs.terms(j)) / expected, 1, 1e-6)
                << nameOf(kernelType) << d << " " << e;
          });
        }
    }
  }
}

TEST(PairKernel, SaysWhatItHasNoFormOf) {
  EXPECT_FALSE(PairKernel(kernelIn(transitionFuchs)).hasForm());
  EXPECT_FALSE(PairKernel(kernelIn(gravitational)).hasForm());
  CollisionKernelOptions sized = kernelIn(freeMolecular);
  sized.efficiencyDiameter = 2e-9;
  EXPECT_FALSE(PairKernel(sized).hasForm());
  sized.efficiency = 2;
  EXPECT_THROW(PairKernel{sized}, InputError);
}

}  // namespace
}  // namespace lampblack::test
