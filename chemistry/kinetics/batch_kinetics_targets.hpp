// The kernels of BatchKinetics, one an instruction set, each in a file compiled for it. To be called only where the
// processor has these instructions.
#pragma once

#include "chemistry/kinetics/batch_kinetics_view.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

void batchRatesGeneric(const BatchView& view, const BatchWork& work, const BatchStates& states);
void batchRatesAvx2(const BatchView& view, const BatchWork& work, const BatchStates& states);
void batchRatesAvx512(const BatchView& view, const BatchWork& work, const BatchStates& states);

}  // namespace lampblack::chemistry
