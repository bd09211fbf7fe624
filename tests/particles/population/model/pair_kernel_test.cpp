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

// More than a block of them.
TEST(PairKernel, HasTheTermsOfManyAtOnce) {
  const Sphere type(1800);
  for (const auto kernelType : {constant, additive, multiplicative, freeMolecular, continuum, transition, shear}) {
    const PairKernel pairs(kernelIn(kernelType));
    std::vector<double> volume, mass, diameter;
    std::vector<PairKernel::Terms> one;
    for (double d = 5e-10; d < 6e-6; d *= 1.05) {
      const auto x = kernelProperties(pairs.kernel(), type, type.make(constants::pi / 6 * d * d * d));
      volume.push_back(x.volume);
      mass.push_back(x.mass);
      diameter.push_back(x.diameter);
      one.push_back(pairs.terms(x));
    }
    ASSERT_GT(one.size(), 140u);
    std::vector<PairKernel::Terms> all(one.size());
    pairs.terms(volume.data(), mass.data(), diameter.data(), one.size(), all.data());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_FLOAT_EQ(all[k].size, one[k].size) << k;
      EXPECT_FLOAT_EQ(all[k].mobility, one[k].mobility) << k;
      EXPECT_FLOAT_EQ(all[k].inverseMass, one[k].inverseMass) << k;
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
