// BatchKinetics for any processor: two states at a time.
#include "chemistry/kinetics/batch_kinetics_kernel.hpp"
#include "chemistry/kinetics/batch_kinetics_targets.hpp"

namespace lampblack::chemistry {

void batchRatesGeneric(const BatchView& view, const BatchWork& work, const BatchStates& states) {
  BatchKernel<Doubled<Doubled<PortableVector<16>>>>::run(view, work, states);
}

}  // namespace lampblack::chemistry
