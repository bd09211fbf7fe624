#include "particles/population/model/collision_kernel.hpp"

#include "core/errors.hpp"

namespace lampblack {

CollisionKernel::CollisionKernel(const CollisionKernelOptions& options) : options_(options) {
  if (options.type != CollisionKernelType::constant) throw InputError("this collision kernel is not available yet");
}

CollisionKernel::Terms CollisionKernel::terms(const Properties&) const {
  return {{0.5 * options_.rate}, {1.0}};
}

double CollisionKernel::value(const Properties&, const Properties&) const {
  return options_.rate;
}

}  // namespace lampblack
