// The gradient of the pressure that moves the gas of a cell. On a box it is that of Gradient, of second order on graded
// cells too. On other cells it is the sum of the pressures on the faces, so that what pushes one cell pushes back
// another: the pressures there have noise of first order, where velocities between cells are corrected by it, and
// gradients that are not conservative would turn that into a force that does not vanish on fine meshes.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

class PressureForce {
 public:
  // `known`: what is known of the pressure at boundary faces; has to stay.
  PressureForce(const FlowContext& context, const std::vector<BoundaryData>& known);

  // Collective. `pressure`: Pa, cells, halo filled, and at boundary faces where known; `gradient`: Pa/m, a component
  // and owned cell.
  void compute(std::span<const double> pressure, std::span<const double> boundary, std::span<double> gradient);

  // `values`: Pa at each boundary face, as far as the cells beside it and what is known there tell; `pressure` and
  // `boundary` as above.
  void atBoundary(std::span<const double> pressure, std::span<const double> boundary, std::span<double> values) const;

 private:
  // m, from a boundary face's cell: where its pressure lies on the slope in the cell.
  [[nodiscard]] Vector3 reachOf(int face) const;

  const FlowContext& context_;
  const std::vector<BoundaryData>& known_;
  Gradient gradient_;
  std::vector<double> slope_;  // Pa/m, in the cells
};

}  // namespace lampblack::flow
