// Reactors in lanes for any processor.
#include "chemistry/reactor/reactor_lanes_kernel.hpp"

namespace lampblack::chemistry {

ReactorLanesTarget reactorLanesGeneric() {
  using Kernel = ReactorLanesKernel<Doubled<Doubled<PortableVector<16>>>>;
  return {Kernel::chemicalRates, Kernel::step};
}

}  // namespace lampblack::chemistry
