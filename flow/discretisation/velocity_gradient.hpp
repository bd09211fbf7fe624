// The velocity at the boundary faces and its gradient in the cells, as viscous stresses and all that looks at them know
// them.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

// What a boundary gives of the velocity.
enum class GivenVelocity { Nothing, Normal, All };
GivenVelocity givenVelocity(const BoundaryCondition& boundary);

class VelocityGradient {
 public:
  explicit VelocityGradient(const FlowContext& context);  // collective

  // Velocities (m/s, a component and cell) beside which the boundary faces get theirs.
  void setBoundary(std::span<const double> velocity);
  // Of these velocities (halo filled) with the boundary's as they are set: in the owned cells.
  void compute(std::span<const double> velocity);
  void updateHalo() { context_.halo.update(gradient_, dimension_ * dimension_); }

  // 1/s: [(cell * dimension + j) * dimension + i] is du_j/dx_i.
  [[nodiscard]] std::span<double> values() { return gradient_; }
  [[nodiscard]] std::span<const double> values() const { return gradient_; }
  [[nodiscard]] const double* of(int cell, int component) const {
    return &gradient_[static_cast<std::size_t>(cell * dimension_ + component) * dimension_];
  }
  // m/s, a component and boundary face, and what is known of each.
  [[nodiscard]] std::span<const double> boundary() const { return boundary_; }
  [[nodiscard]] std::span<const BoundaryData> known() const { return known_; }
  // Whether one component of the velocity is known at each boundary face.
  [[nodiscard]] std::vector<BoundaryData> known(int component) const;

  // div u in a cell (1/s), the hoop's part included.
  [[nodiscard]] double dilatation(int cell, std::span<const double> velocity) const;
  // The part ((grad u)^T - 2/3 (div u) I) n of the stress on a face over the viscosity, 1/s; halo filled. At walls and
  // symmetries only what is normal to them: along them the normal velocity stays zero.
  [[nodiscard]] Vector3 transposedTraction(int face, std::span<const double> velocity) const;

 private:
  void findOpposites();
  void setOutletGradients();
  [[nodiscard]] bool isOpenCorner(int face) const;
  [[nodiscard]] Vector3 slopesAlong(int cell, const Vector3& normal) const;
  [[nodiscard]] Vector3 slopesBetween(int face, const Vector3& normal) const;
  [[nodiscard]] Vector3 transposedAt(int face) const;

  const FlowContext& context_;
  int dimension_;
  Gradient byLeastSquares_;
  std::vector<double> boundary_, gradient_;
  std::vector<BoundaryData> known_;
  std::vector<int> opposite_;    // of each boundary face the face on its cell's other side, or -1
  bool hasOpenCorners_ = false;  // an outlet's cell without such a face, on any rank
};

}  // namespace lampblack::flow
