// Velocities normal to the faces, between the cells' velocities and the projection.
//
// A face's velocity is that of the cells around it, interpolated, plus a deviation d that couples pressures of
// neighbouring cells (Rhie and Chow 1983). The deviation has an equation of its own,
//   dd/dt = r - d/tau,    r = (grad p)/rho of the cells, interpolated, - (1/rho) dp/dn across the face,
// gravity's force taken off both gradients,
// with tau the time in which convection and viscosity renew a cell's momentum: a steady flow has d = tau r whatever the
// time step (Choi 1999 on why the plain interpolation does depend on it).
//
// What r has in common at the faces of a quadrilateral or hexahedron is taken off: in a smooth flow that is nearly all
// of it, which would take energy from vortices a few cells wide; of pressures that go up and down from cell to cell it
// is nothing. What is left falls as the fourth power of the mesh's width, against the pressure's own slope.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

class FaceVelocity {
 public:
  explicit FaceVelocity(const FlowContext& context);

  // What the cells know at the end of the momentum's prediction; halo filled.
  struct Cells {
    std::span<const double> velocity;          // m/s, a component and cell
    std::span<const double> acceleration;      // m/s2, (grad p - f)/rho with gravity's force f, a component and cell
    std::span<const double> relaxation;        // 1/s, 1/tau
    std::span<const double> pressure;          // Pa
    std::span<const double> velocityGradient;  // 1/s, of `velocity`; where no face has an Mesh::offset only owned cells
  };
  // Normal velocity (m/s) of every face after dt under the old pressure. `inverseDensity`: 1/rho at each face.
  void predict(const Cells& cells, std::span<const double> inverseDensity, double dt, std::span<double> faceVelocity);

  // The same after deviations have come to rest: what the faces have in a steady flow.
  void settled(const Cells& cells, std::span<const double> inverseDensity, std::span<double> faceVelocity);

  // After the projection: takes what faces deviate by from the cells' new velocities (halo filled). With
  // the end of the step it is what the next one begins with.
  void take(std::span<const double> velocity, std::span<const double> faceVelocity);

  void endStep() { deviation_ = found_; }

  void saveOrLoad(StateArchive& archive) { archive.faces("face_velocity_deviation", deviation_, 1); }

 private:
  void computeExcess(const Cells& cells, std::span<const double> inverseDensity);
  void removeSmoothExcess();
  [[nodiscard]] double ofCells(int face, const Cells& cells);
  [[nodiscard]] double ofBoundary(int face, const Cells& cells) const;
  [[nodiscard]] double mean(int face, std::span<const double> values) const;
  // Part along a direction of vectors in the cells, interpolated to a face.
  [[nodiscard]] double meanAlong(const Vector3& direction, int face, std::span<const double> vectors) const;

  const FlowContext& context_;
  std::vector<double> deviation_;      // m/s, before the step; zero on the boundary
  std::vector<double> found_;          // m/s, by the last sweep
  std::vector<double> excess_;         // m/s2, r at each interior face
  std::vector<double> common_;         // m/s2, a component and cell: what r of its faces has in common
  std::vector<Vector3> normalWeight_;  // of r at each face of an owned cell, as Mesh::faceOfCell has them
  // m/s, from where a step meets the face to its centre, along the slope of the predicted velocities.
  std::vector<double> offset_;
};

}  // namespace lampblack::flow
