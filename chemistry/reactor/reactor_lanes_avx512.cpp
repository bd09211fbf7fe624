// Reactors in lanes with the instructions of batch_vector_avx512.hpp, whatever the rest is compiled for.
#include "chemistry/kinetics/batch_vector_avx512.hpp"
#include "chemistry/reactor/reactor_lanes_kernel.hpp"

namespace lampblack::chemistry {

ReactorLanesTarget reactorLanesAvx512() {
  using Kernel = ReactorLanesKernel<Avx512Vector>;
  return {Kernel::chemicalRates, Kernel::step};
}

}  // namespace lampblack::chemistry
