// What the boundaries have of the carried scalars (ScalarBoundary), as a table: a row a boundary, and a row a face of
// those along which a scalar varies.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"

namespace lampblack::flow {

class ScalarBoundaries {
 public:
  // std::logic_error for a scalar whose boundaries are others than the context's, or that is held where nothing can be;
  // InputError for a value that cannot be at its place. Collective.
  ScalarBoundaries(const FlowContext& context, const State& state);

  // Of every scalar at a boundary face.
  [[nodiscard]] std::span<const ScalarBoundary> at(int face) const {
    return {rows_.data() + static_cast<std::size_t>(rowOf_[face - mesh_.interiorFaces]) * scalars_, scalars_};
  }
  // Whether the boundary of this face holds any of them.
  [[nodiscard]] bool holdsAny(int face) const { return holdsAny_[patchOf(face)] != 0; }
  // Whether no boundary holds some scalars and lets others be.
  [[nodiscard]] bool areAlike() const { return areAlike_; }

 private:
  void addVaryingRows(const FlowContext& context, const State& state);
  [[nodiscard]] std::size_t patchOf(int face) const {
    return static_cast<std::size_t>(mesh_.patch[face - mesh_.interiorFaces]);
  }

  const Mesh& mesh_;
  std::size_t scalars_;
  std::vector<ScalarBoundary> rows_;  // without their functions
  std::vector<int> rowOf_;            // of each boundary face
  std::vector<char> holdsAny_;
  bool areAlike_ = true;
};

}  // namespace lampblack::flow
