// BatchKinetics for processors with AVX-512 (F, DQ, VL): eight states at a time. Compiled for these instructions
// whatever the rest is compiled for; see batch_kinetics_simd.hpp.
#include "chemistry/kinetics/batch_kinetics_kernel.hpp"
#include "chemistry/kinetics/batch_kinetics_targets.hpp"
#include "chemistry/kinetics/batch_vector_avx512.hpp"

namespace lampblack::chemistry {

void batchRatesAvx512(const BatchView& view, const BatchWork& work, const BatchStates& states) {
  BatchKernel<Avx512Vector>::run(view, work, states);
}

}  // namespace lampblack::chemistry
