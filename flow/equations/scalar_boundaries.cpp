#include "flow/equations/scalar_boundaries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/errors.hpp"

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
      rows_[b * scalars_ + s] = {.value = scalar.boundaries[b].value, .isHeld = scalar.boundaries[b].isHeld};
    }
  }
  for (std::size_t b = 0; b < holdsAny_.size() && scalars_ > 0; ++b) {
    const std::span<const ScalarBoundary> row{&rows_[b * scalars_], scalars_};
    holdsAny_[b] = std::ranges::any_of(row, &ScalarBoundary::isHeld) ? 1 : 0;
    areAlike_ = areAlike_ && (holdsAny_[b] == 0 || std::ranges::all_of(row, &ScalarBoundary::isHeld));
  }
  for (int face = mesh_.interiorFaces; face < mesh_.faces; ++face) rowOf_.push_back(static_cast<int>(patchOf(face)));
  collectively(mesh_.comm, [&] { addVaryingRows(context, state); });
}

void ScalarBoundaries::addVaryingRows(const FlowContext& context, const State& state) {
  for (int face = mesh_.interiorFaces; face < mesh_.faces; ++face) {
    const std::size_t patch = patchOf(face);
    const bool varies = std::ranges::any_of(state.scalars, [&](const CarriedScalar& scalar) {
      return !scalar.boundaries.empty() && scalar.boundaries[patch].varies;
    });
    if (!varies) continue;
    const Vector3& place = mesh_.faceCentre[static_cast<std::size_t>(face)];
    rowOf_[face - mesh_.interiorFaces] = static_cast<int>(rows_.size() / scalars_);
    for (std::size_t s = 0; s < scalars_; ++s) {
      ScalarBoundary value = rows_[patch * scalars_ + s];
      if (const CarriedScalar& scalar = state.scalars[s]; !scalar.boundaries.empty()) try {
          value.value = scalar.boundaries[patch].at(place);
        } catch (const InputError& error) {
          throw InputError(fmt::format("boundaries.{}: at {}: {}", context.boundaries[patch].name,
                                       placeText(place, mesh_.dimension), error.what()));
        }
      rows_.push_back(value);
    }
  }
}

}  // namespace lampblack::flow
