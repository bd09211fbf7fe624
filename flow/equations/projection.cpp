#include "flow/equations/projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "flow/cell_errors.hpp"
#include "flow/discretisation/face_fluxes.hpp"
#include "flow/equations/matrix_rows.hpp"

namespace lampblack::flow {

Projection::Projection(const FlowContext& context, std::span<const BoundaryData> known, PressureAccuracy accuracy)
    : context_(context), accuracy_(accuracy), row_(matrixRows(context)) {
  const Mesh& m = context.mesh;
  const PetscInt owned = m.owned;
  checkPetsc(MatCreateAIJ(m.comm, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, Mesh::mostSides + 1, nullptr,
                          Mesh::mostSides, nullptr, matrix_.put()));
  checkPetsc(MatCreateVecs(matrix_.get(), solution_.put(), rightSide_.put()));
  if (m.isOblique()) oblique_.emplace(context, known, matrix_.get(), conductance_);
  if (context.isClosed()) {
    MatNullSpace constants = nullptr;
    checkPetsc(MatNullSpaceCreate(m.comm, PETSC_TRUE, 0, nullptr, &constants));
    for (Mat matrix : {matrix_.get(), whole()}) checkPetsc(MatSetNullSpace(matrix, constants));
    checkPetsc(MatNullSpaceDestroy(&constants));
  }
  checkPetsc(KSPCreate(m.comm, solver_.put()));
  checkPetsc(KSPCreate(m.comm, careful_.put()));
  if (oblique_) {
    // Not symmetric.
    for (KSP solver : {solver_.get(), careful_.get()}) {
      checkPetsc(KSPSetType(solver, KSPGMRES));
      checkPetsc(KSPSetPCSide(solver, PC_RIGHT));
    }
    checkPetsc(KSPGMRESSetRestart(careful_.get(), 100));
  } else {
    // Pipelined: one reduction an iteration in place of three, beside the work of the next, which is not worth its
    // start where a few iterations are enough.
    const bool isShort = accuracy_.ofLeft > 1e-4;
    checkPetsc(KSPSetType(solver_.get(), isShort ? KSPCG : KSPPIPECG));
    checkPetsc(KSPSetType(careful_.get(), KSPCG));
  }
  PC preconditioner = nullptr;
  checkPetsc(KSPGetPC(solver_.get(), &preconditioner));
  checkPetsc(PCSetType(preconditioner, PCHYPRE));
  checkPetsc(PCHYPRESetType(preconditioner, "boomeramg"));
  checkPetsc(KSPSetPC(careful_.get(), preconditioner));
  for (KSP solver : {solver_.get(), careful_.get()}) {
    checkPetsc(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
    checkPetsc(KSPSetInitialGuessNonzero(solver, PETSC_TRUE));
  }
  checkPetsc(KSPSetOptionsPrefix(solver_.get(), "pressure_"));
  // The coarsest matrix of a closed vessel is singular: no elimination there.
  constexpr const char* coarsest = "-pressure_pc_hypre_boomeramg_relax_type_coarse";
  if (context.isClosed()) checkPetsc(PetscOptionsSetValue(nullptr, coarsest, "Jacobi"));
  checkPetsc(KSPSetFromOptions(solver_.get()));
  checkPetsc(PetscOptionsClearValue(nullptr, coarsest));
}

void Projection::conductances(double dt, std::span<const double> inverseDensity) {
  const Mesh& m = context_.mesh;
  conductance_.resize(m.faces);
  for (int face = 0; face < m.faces; ++face) {
    const bool open = m.high[face] >= 0 || context_.boundaryOf(face).kind == BoundaryKind::Outlet;
    conductance_[face] = open ? dt * inverseDensity[face] * m.area[face] / m.distance[face] : 0.0;
  }
}

void Projection::assemble() {
  const Mesh& m = context_.mesh;
  checkPetsc(MatZeroEntries(matrix_.get()));
  for (int face = 0; face < m.faces; ++face) {
    const double g = conductance_[face];
    const PetscInt low = row_[m.low[face]];
    if (m.high[face] < 0) {
      checkPetsc(MatSetValue(matrix_.get(), low, low, g, ADD_VALUES));
      continue;
    }
    const PetscInt high = row_[m.high[face]];
    if (m.low[face] < m.owned) {
      checkPetsc(MatSetValue(matrix_.get(), low, low, g, ADD_VALUES));
      checkPetsc(MatSetValue(matrix_.get(), low, high, -g, ADD_VALUES));
    }
    if (m.high[face] < m.owned) {
      checkPetsc(MatSetValue(matrix_.get(), high, high, g, ADD_VALUES));
      checkPetsc(MatSetValue(matrix_.get(), high, low, -g, ADD_VALUES));
    }
  }
  checkPetsc(MatAssemblyBegin(matrix_.get(), MAT_FINAL_ASSEMBLY));
  checkPetsc(MatAssemblyEnd(matrix_.get(), MAT_FINAL_ASSEMBLY));
}

void Projection::saveOrLoad(StateArchive& archive, const std::string& name) {
  double iterations = iterationsAfterSetup_;
  archive.shared(name + "_iterations_after_setup", iterations);
  setupConductance_.resize(static_cast<std::size_t>(context_.mesh.faces));
  archive.faces(name + "_preconditioner", setupConductance_, 1);
  if (!archive.loading()) return;
  iterationsAfterSetup_ = static_cast<int>(iterations);
  if (iterationsAfterSetup_ < 0) return;  // the next solve makes a new one
  conductance_ = setupConductance_;
  assemble();
  checkPetsc(KSPSetOperators(solver_.get(), whole(), matrix_.get()));
  checkPetsc(KSPSetReusePreconditioner(solver_.get(), PETSC_FALSE));
  checkPetsc(KSPSetUp(solver_.get()));
}

Projection::Iterations Projection::iterate(std::span<const double> guess, double tolerance) {
  // Many times what a solve takes; the pipelined iteration goes on for ever where it has come to its round-off, and
  // GMRES forgets at each of its restarts.
  constexpr int mostQuick = 50, most = 500;
  const PetscBool keepsPreconditioner = iterationsAfterSetup_ >= 0 ? PETSC_TRUE : PETSC_FALSE;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscInt iterations = 0;
  Iterations result;
  for (KSP solver : {solver_.get(), careful_.get()}) {
    const bool isQuick = solver == solver_.get();
    double* x = nullptr;
    checkPetsc(VecGetArray(solution_.get(), &x));
    std::copy_n(guess.begin(), context_.mesh.owned, x);
    checkPetsc(VecRestoreArray(solution_.get(), &x));
    checkPetsc(KSPSetTolerances(solver, accuracy_.ofLeft, tolerance, PETSC_DEFAULT, isQuick ? mostQuick : most));
    checkPetsc(KSPSetOperators(solver, whole(), matrix_.get()));
    checkPetsc(KSPSetReusePreconditioner(solver, isQuick ? keepsPreconditioner : PETSC_TRUE));
    const auto solve = [&] { return KSPSolve(solver, rightSide_.get(), solution_.get()); };
    if (oblique_)
      oblique_->run(solve);
    else
      checkPetsc(solve());
    checkPetsc(KSPGetConvergedReason(solver, &reason));
    checkPetsc(KSPGetIterationNumber(solver, &iterations));
    result.ofSolver = static_cast<int>(iterations);
    result.all += result.ofSolver;
    if (reason > 0) return result;
  }
  raiseTogether(context_.mesh.comm,
                NumericsError(fmt::format("the pressure solve failed (PETSc reason {}) after {} iterations",
                                          static_cast<int>(reason), static_cast<int>(iterations))));
}

// What flows out of the owned cells, m^3/s, beyond `divergence`.
std::vector<double> Projection::excess(std::span<const double> divergence, std::span<const double> faceVelocity) const {
  const Mesh& m = context_.mesh;
  std::vector<double> excess(m.owned);
  for (int c = 0; c < m.owned; ++c) excess[c] = -divergence[c] * m.volume[c];
  addFaceFluxes(m, flow(faceVelocity), 1, -1.0, excess);
  return excess;
}

std::vector<double> Projection::flow(std::span<const double> faceVelocity) const {
  std::vector<double> flow(faceVelocity.begin(), faceVelocity.end());
  for (std::size_t face = 0; face < flow.size(); ++face) flow[face] *= context_.mesh.area[face];
  return flow;
}

// One solve for the change that takes the excess away, from the guess.
int Projection::correct(std::span<const double> excess, double tolerance, std::span<double> change) {
  double* right = nullptr;
  checkPetsc(VecGetArray(rightSide_.get(), &right));
  for (std::size_t c = 0; c < excess.size(); ++c) right[c] = -excess[c];
  checkPetsc(VecRestoreArray(rightSide_.get(), &right));
  if (MatNullSpace constants = nullptr; context_.isClosed()) {
    checkPetsc(MatGetNullSpace(matrix_.get(), &constants));
    checkPetsc(MatNullSpaceRemove(constants, rightSide_.get()));  // round-off
  }
  if (iterationsAfterSetup_ < 0) setupConductance_ = conductance_;
  const Iterations iterations = iterate(change, tolerance);
  if (iterationsAfterSetup_ < 0)
    iterationsAfterSetup_ = iterations.ofSolver;
  else if (iterations.ofSolver > 2 * iterationsAfterSetup_ + 3)
    iterationsAfterSetup_ = -1;  // the preconditioner has aged: set it up anew next time

  const double* solved = nullptr;
  checkPetsc(VecGetArrayRead(solution_.get(), &solved));
  std::copy_n(solved, context_.mesh.owned, change.begin());
  checkPetsc(VecRestoreArrayRead(solution_.get(), &solved));
  context_.halo.update(change, 1);
  return iterations.all;
}

Projection::Result Projection::solve(double dt, std::span<const double> inverseDensity,
                                     std::span<const double> divergence, std::span<double> faceVelocity,
                                     std::span<double> change, double slowFlow) {
  const Mesh& m = context_.mesh;
  conductances(dt, inverseDensity);
  assemble();
  double flowScale = std::max(slowFlow, 1e-300);
  for (const double flow : flow(faceVelocity)) flowScale = std::max(flowScale, std::abs(flow));
  // What is no number would break the solver: no scale is infinite otherwise.
  const std::vector<double> first = excess(divergence, faceVelocity);
  if (!std::ranges::all_of(first, [](double e) { return std::isfinite(e); }))
    flowScale = std::numeric_limits<double>::infinity();
  MPI_Allreduce(MPI_IN_PLACE, &flowScale, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  if (flowScale > std::numeric_limits<double>::max())
    inEachCell(m, [&](int c) {
      if (!std::isfinite(first[c])) throw NumericsError("the velocities have grown beyond all numbers");
    });

  // The tolerance is absolute: a fraction of the largest face flow, so that continuity holds alike in every step.
  Result result;
  result.iterations = correct(first, accuracy_.ofFlow * flowScale, change);
  for (int face = 0; face < m.faces; ++face) {
    if (m.area[face] <= 0.0) continue;
    const double beyond = m.high[face] >= 0 ? change[m.high[face]] : 0.0;
    faceVelocity[face] -= conductance_[face] / m.area[face] * (beyond - change[m.low[face]]);
  }
  if (oblique_) oblique_->addVelocity(change, faceVelocity);
  const std::vector<double> left = excess(divergence, faceVelocity);
  for (int c = 0; c < m.owned; ++c)
    result.continuityError = std::max(result.continuityError, std::abs(left[c] / m.volume[c]));
  MPI_Allreduce(MPI_IN_PLACE, &result.continuityError, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  return result;
}

}  // namespace lampblack::flow
