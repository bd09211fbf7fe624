// Pressure projection on face fluxes: finds the change q of the hydrodynamic pressure for which the face velocities
//   u_f = uhat_f - (dt / rho_f) dq/dn
// have the given divergence in every cell, with a compact stencil so that pressure cannot decouple (Rhie and Chow
// 1983). Pipelined conjugate gradients (Ghysels and Vanroose 2014) with BoomerAMG, plain ones where their round-off is
// in the way, as for a gas that is as good as at rest; the preconditioner is kept until the iterations grow. Where
// steps are oblique to faces the gradient along Mesh::oblique is that of the last solve: they are repeated until it
// stands.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/petsc.hpp"
#include "core/state_archive.hpp"
#include "flow/discretisation/oblique_pressure.hpp"
#include "flow/flow_context.hpp"

namespace lampblack::flow {

// What a solve may leave of continuity, by the root of the sum of squares: of the largest flow through a face, or of
// what was left before it, whichever is more.
struct PressureAccuracy {
  double ofFlow = 1e-9, ofLeft = 1e-14;
};

class Projection {
 public:
  // Collective. Without an outlet the changes of pressure have the mean zero. `known`: what is known of a change of the
  // pressure at boundary faces, whose value is zero.
  Projection(const FlowContext& context, std::span<const BoundaryData> known, PressureAccuracy accuracy = {});

  struct Result {
    int iterations = 0;            // those of a quick attempt that was in vain included
    double continuityError = 0.0;  // 1/s, largest |divergence of u_f - target| of any cell
  };

  // Collective. `faceVelocity` (m/s, normal, every face; prescribed on all boundary faces but outlets) is corrected in
  // place; `change` (Pa, cells, zero at outlets) is the initial guess and the solution, halo filled. `inverseDensity`:
  // 1/rho at each face; `divergence`: target in each owned cell (1/s). `slowFlow` (m3/s, of this rank): what flows
  // through a face of a gas that is as good as at rest, where the flows are no scale of their own.
  Result solve(double dt, std::span<const double> inverseDensity, std::span<const double> divergence,
               std::span<double> faceVelocity, std::span<double> change, double slowFlow = 0.0);

  // The preconditioner is kept as the conductances of the matrix it was made from, and made from them again. `name`: in
  // front of those of the pieces.
  void saveOrLoad(StateArchive& archive, const std::string& name = "pressure");

 private:
  // From `guess` to solution_.
  struct Iterations {
    int all = 0, ofSolver = 0;  // of both solvers; of the one that converged
  };
  Iterations iterate(std::span<const double> guess, double tolerance);
  [[nodiscard]] std::vector<double> excess(std::span<const double> divergence,
                                           std::span<const double> faceVelocity) const;
  [[nodiscard]] std::vector<double> flow(std::span<const double> faceVelocity) const;  // m^3/s
  int correct(std::span<const double> excess, double tolerance, std::span<double> change);
  [[nodiscard]] Mat whole() const { return oblique_ ? oblique_->matrix() : matrix_.get(); }
  void conductances(double dt, std::span<const double> inverseDensity);
  void assemble();

  const FlowContext& context_;
  PressureAccuracy accuracy_;
  std::vector<PetscInt> row_;  // global matrix row of every local cell
  std::vector<double> conductance_;
  std::vector<double> setupConductance_;  // when the preconditioner was set up
  PetscMatrix matrix_;                    // of the differences along the steps, from which the preconditioner is made
  std::optional<ObliquePressure> oblique_;
  PetscVector rightSide_, solution_;
  PetscSolver solver_, careful_;
  int iterationsAfterSetup_ = -1;
};

}  // namespace lampblack::flow
