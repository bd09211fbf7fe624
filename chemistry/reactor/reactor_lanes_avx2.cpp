// Reactors in lanes with the instructions of batch_vector_avx2.hpp, whatever the rest is compiled for.
#include "chemistry/kinetics/batch_vector_avx2.hpp"
#include "chemistry/reactor/reactor_lanes_kernel.hpp"

namespace lampblack::chemistry {

ReactorLanesTarget reactorLanesAvx2() {
  using Kernel = ReactorLanesKernel<Doubled<Avx2Vector>>;
  return {Kernel::chemicalRates, Kernel::step};
}

}  // namespace lampblack::chemistry
