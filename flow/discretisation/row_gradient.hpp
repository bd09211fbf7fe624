// Gradients of many fields at once, such as mass fractions, made where they are asked for, which costs no more than to
// keep them and takes no memory; those of halo cells come from their owners.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

class RowGradient {
 public:
  RowGradient(const FlowContext& context, int fields) : context_(context), gradient_(context.mesh), fields_(fields) {}

  // Collective. Values of all local cells and of boundary faces, and what is known there (a flag a face); all have to
  // stay.
  void prepare(std::span<const double> values, std::span<const double> boundary, std::span<const BoundaryData> known);

  // The part along a direction, of any length, in any local cell.
  void along(const Vector3& direction, int cell, std::span<double> slope) const;

 private:
  const FlowContext& context_;
  Gradient gradient_;
  int fields_;
  std::span<const double> values_, boundary_;
  std::span<const BoundaryData> known_;
  std::vector<double> halo_;  // of each halo cell, `fields` along one axis after the other
};

}  // namespace lampblack::flow
