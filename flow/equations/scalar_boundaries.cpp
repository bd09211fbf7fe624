#include "flow/equations/scalar_boundaries.hpp"

#include <algorithm>
#include <stdexcept>

namespace lampblack::flow {

ScalarBoundaries::ScalarBoundaries(const FlowContext& context, const State& state)
    : mesh_(context.mesh),
      scalars_(state.scalars.size()),
      rows_(context.boundaries.size() * scalars_),
      holdsAny_(context.boundaries.size(), 0) {
  for (std::size_t s = 0; s < scalars_; ++s) {
    const CarriedScalar& scalar = state.scalars[s];
    if (scalar.boundaries.empty()) continue;
    if (scalar.boundaries.size() != context.boundaries.size())
      throw std::logic_error(scalar.name + ": boundaries of another flow");
    for (std::size_t b = 0; b < context.boundaries.size(); ++b) {
      const BoundaryKind kind = context.boundaries[b].kind;
      if (scalar.boundaries[b].isHeld && kind != BoundaryKind::Inlet && kind != BoundaryKind::Wall)
        throw std::logic_error(scalar.name + " is held where gas leaves, or at a symmetry");
      rows_[b * scalars_ + s] = scalar.boundaries[b];
    }
  }
  for (std::size_t b = 0; b < holdsAny_.size() && scalars_ > 0; ++b) {
    const std::span<const ScalarBoundary> row{&rows_[b * scalars_], scalars_};
    holdsAny_[b] = std::ranges::any_of(row, &ScalarBoundary::isHeld) ? 1 : 0;
    areAlike_ = areAlike_ && (holdsAny_[b] == 0 || std::ranges::all_of(row, &ScalarBoundary::isHeld));
  }
}

}  // namespace lampblack::flow
