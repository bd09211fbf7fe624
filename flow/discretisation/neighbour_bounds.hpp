// The smallest and the largest of the values in a cell, in the cells around it, and at its boundary faces where they
// are known: what a face value on cells without order has to stay within.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

class NeighbourBounds {
 public:
  NeighbourBounds(const FlowContext& context, int fields) : context_(context), fields_(fields) {}

  // Collective, a halo message. Values of all local cells and of boundary faces, `fields` each, and what is known there
  // (a flag a face).
  void prepare(std::span<const double> values, std::span<const double> boundary, std::span<const BoundaryData> known);

  // Of any local cell, `fields` each.
  [[nodiscard]] const double* smallest(int cell) const { return &bounds_[at(cell)]; }
  [[nodiscard]] const double* largest(int cell) const { return &bounds_[at(cell)] + fields_; }

 private:
  [[nodiscard]] std::size_t at(int cell) const { return static_cast<std::size_t>(cell) * 2 * fields_; }

  const FlowContext& context_;
  int fields_;
  std::vector<double> bounds_;  // of each local cell the smallest, then the largest
};

}  // namespace lampblack::flow
