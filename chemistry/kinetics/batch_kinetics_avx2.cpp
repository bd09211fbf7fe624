// BatchKinetics for processors with AVX2 and FMA: four states at a time. Compiled for these instructions whatever the
// rest is compiled for; see batch_kinetics_simd.hpp.
#include "chemistry/kinetics/batch_kinetics_kernel.hpp"
#include "chemistry/kinetics/batch_kinetics_targets.hpp"
#include "chemistry/kinetics/batch_vector_avx2.hpp"

namespace lampblack::chemistry {

void batchRatesAvx2(const BatchView& view, const BatchWork& work, const BatchStates& states) {
  BatchKernel<Doubled<Avx2Vector>>::run(view, work, states);
}

}  // namespace lampblack::chemistry
