#include "flow/steady/block_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "flow/cell_errors.hpp"

namespace lampblack::flow {
namespace {

constexpr int restart = 40;

BlockSystem* systemOf(void* context) {
  return static_cast<BlockSystem*>(context);
}

}  // namespace

BlockSystem::BlockSystem(const Mesh& mesh, HaloExchange& halo, std::size_t fields)
    : mesh_(mesh), halo_(halo), fields_(fields) {
  const auto owned = static_cast<std::size_t>(mesh.owned);
  blocks_.resize(owned * fields * fields);
  inverse_.resize(blocks_.size());
  toLow_.resize(static_cast<std::size_t>(mesh.interiorFaces) * fields);
  toHigh_.resize(toLow_.size());
  scale_.resize(owned);
  work_.resize(static_cast<std::size_t>(mesh.cells) * fields);
  row_.resize(fields);
  ones_.assign(fields, 1.0);
  pivots_.resize(fields);

  const auto size = static_cast<PetscInt>(owned * fields);
  checkPetsc(MatCreateShell(mesh.comm, size, size, PETSC_DETERMINE, PETSC_DETERMINE, this, matrix_.put()));
  const auto product = [](Mat matrix, Vec x, Vec y) -> PetscErrorCode {
    void* self = nullptr;
    if (const PetscErrorCode code = MatShellGetContext(matrix, static_cast<void*>(&self)); code != 0) return code;
    return systemOf(self)->exceptions_.guard([&] { systemOf(self)->multiply(x, y); });
  };
  PetscErrorCode (*const multiplies)(Mat, Vec, Vec) = product;
  checkPetsc(MatShellSetOperation(matrix_.get(), MATOP_MULT, reinterpret_cast<void (*)()>(multiplies)));
  checkPetsc(MatCreateVecs(matrix_.get(), solution_.put(), rightSide_.put()));

  checkPetsc(KSPCreate(mesh.comm, solver_.put()));
  checkPetsc(KSPSetType(solver_.get(), KSPGMRES));
  checkPetsc(KSPGMRESSetRestart(solver_.get(), restart));
  checkPetsc(KSPSetPCSide(solver_.get(), PC_RIGHT));
  checkPetsc(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()));
  PC preconditioner = nullptr;
  checkPetsc(KSPGetPC(solver_.get(), &preconditioner));
  checkPetsc(PCSetType(preconditioner, PCSHELL));
  checkPetsc(PCShellSetContext(preconditioner, this));
  const auto sweep = [](PC pc, Vec x, Vec y) -> PetscErrorCode {
    void* self = nullptr;
    if (const PetscErrorCode code = PCShellGetContext(pc, static_cast<void*>(&self)); code != 0) return code;
    return systemOf(self)->exceptions_.guard([&] { systemOf(self)->precondition(x, y); });
  };
  PetscErrorCode (*const sweeps)(PC, Vec, Vec) = sweep;
  checkPetsc(PCShellSetApply(preconditioner, sweeps));
}

void BlockSystem::clear() {
  for (std::vector<double>* all : {&blocks_, &toLow_, &toHigh_}) std::ranges::fill(*all, 0.0);
}

void BlockSystem::connect(int face, std::size_t field, double conductance, double flow) {
  const int low = mesh_.low[face], high = mesh_.high[face];
  const double intoLow = conductance + std::max(-flow, 0.0), intoHigh = conductance + std::max(flow, 0.0);
  if (low < mesh_.owned) block(low)[field * (fields_ + 1)] += intoLow;
  if (high < 0) return;
  const std::size_t at = static_cast<std::size_t>(face) * fields_ + field;
  toLow_[at] += intoLow;
  toHigh_[at] += intoHigh;
  if (high < mesh_.owned) block(high)[field * (fields_ + 1)] += intoHigh;
}

void BlockSystem::drift(int face, std::size_t field, double flow) {
  const int low = mesh_.low[face], high = mesh_.high[face];
  if (low < mesh_.owned) block(low)[field * (fields_ + 1)] += std::max(flow, 0.0);
  if (high < 0) return;
  const std::size_t at = static_cast<std::size_t>(face) * fields_ + field;
  toLow_[at] += std::max(-flow, 0.0);
  toHigh_[at] += std::max(flow, 0.0);
  if (high < mesh_.owned) block(high)[field * (fields_ + 1)] += std::max(-flow, 0.0);
}

void BlockSystem::addInertia(int cell, double inertia) {
  for (std::size_t k = 0; k < fields_; ++k) block(cell)[k * (fields_ + 1)] += inertia;
}

void BlockSystem::invert() {
  const std::size_t n = fields_;
  std::vector<double> factors(n * n);
  inEachCell(mesh_, [&](int c) {
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) sum += std::abs(block(c)[k * (n + 1)]);
    scale_[c] = static_cast<double>(n) / sum;
    std::copy_n(block(c), n * n, factors.begin());
    if (!dense_.factorise(n, factors.data(), pivots_.data()))
      throw NumericsError("the linear system of an iteration towards the steady state is singular");
    dense_.invert(n, factors.data(), pivots_.data(), ones_.data(), &inverse_[static_cast<std::size_t>(c) * n * n]);
  });
}

void BlockSystem::multiply(Vec x, Vec y) {
  const std::size_t n = fields_;
  {
    const PetscValues values(x);
    std::ranges::copy(values.get(), work_.begin());
  }
  halo_.update(work_, static_cast<int>(n));
  const PetscMutableValues product(y);
  const std::span<double> to = product.get();
  for (int c = 0; c < mesh_.owned; ++c) {
    double* own = &to[static_cast<std::size_t>(c) * n];
    std::fill_n(own, n, 0.0);
    addProduct(n, n, 1.0, block(c), &work_[static_cast<std::size_t>(c) * n], own);
  }
  for (int face = 0; face < mesh_.interiorFaces; ++face) {
    const auto low = static_cast<std::size_t>(mesh_.low[face]), high = static_cast<std::size_t>(mesh_.high[face]);
    const double *toLow = &toLow_[static_cast<std::size_t>(face) * n],
                 *toHigh = &toHigh_[static_cast<std::size_t>(face) * n];
    if (mesh_.low[face] < mesh_.owned)
      for (std::size_t k = 0; k < n; ++k) to[low * n + k] -= toLow[k] * work_[high * n + k];
    if (mesh_.high[face] < mesh_.owned)
      for (std::size_t k = 0; k < n; ++k) to[high * n + k] -= toHigh[k] * work_[low * n + k];
  }
  for (int c = 0; c < mesh_.owned; ++c)
    for (std::size_t k = 0; k < n; ++k) to[static_cast<std::size_t>(c) * n + k] *= scale_[c];
}

// What the cell has by its own equations, its neighbours as they are now.
void BlockSystem::relax(int cell, std::span<const double> right) {
  const std::size_t n = fields_, own = static_cast<std::size_t>(cell) * n;
  for (std::size_t k = 0; k < n; ++k) row_[k] = right[own + k] / scale_[cell];
  for (int i = mesh_.faceStart[cell]; i < mesh_.faceStart[cell + 1]; ++i) {
    const int face = mesh_.faceOfCell[i];
    if (mesh_.high[face] < 0) continue;
    const bool isLow = mesh_.low[face] == cell;
    const int other = isLow ? mesh_.high[face] : mesh_.low[face];
    const double* coefficient = &(isLow ? toLow_ : toHigh_)[static_cast<std::size_t>(face) * n];
    const double* beyond = &work_[static_cast<std::size_t>(other) * n];
    for (std::size_t k = 0; k < n; ++k) row_[k] += coefficient[k] * beyond[k];
  }
  std::fill_n(&work_[own], n, 0.0);
  addProduct(n, n, 1.0, &inverse_[own * n], row_.data(), &work_[own]);
}

void BlockSystem::precondition(Vec x, Vec y) {
  const PetscValues values(x);
  std::ranges::fill(work_, 0.0);
  for (int c = 0; c < mesh_.owned; ++c) relax(c, values.get());
  for (int c = mesh_.owned - 1; c >= 0; --c) relax(c, values.get());
  const PetscMutableValues found(y);
  std::copy_n(work_.begin(), found.get().size(), found.get().begin());
}

BlockSystem::Result BlockSystem::solve(std::span<const double> right, std::span<double> x, double reduction,
                                       int mostIterations) {
  invert();
  {
    const PetscMutableValues values(rightSide_.get());
    for (int c = 0; c < mesh_.owned; ++c)
      for (std::size_t k = 0; k < fields_; ++k) {
        const std::size_t at = static_cast<std::size_t>(c) * fields_ + k;
        values.get()[at] = scale_[c] * right[at];
      }
  }
  checkPetsc(KSPSetTolerances(solver_.get(), reduction, 1e-300, 1e10, mostIterations));
  exceptions_.run([&] { return KSPSolve(solver_.get(), rightSide_.get(), solution_.get()); });
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscInt iterations = 0;
  checkPetsc(KSPGetConvergedReason(solver_.get(), &reason));
  checkPetsc(KSPGetIterationNumber(solver_.get(), &iterations));
  {
    const PetscValues values(solution_.get());
    std::ranges::copy(values.get(), x.begin());
  }
  halo_.update(x.first(work_.size()), static_cast<int>(fields_));
  return {static_cast<int>(iterations), reason > 0};
}

}  // namespace lampblack::flow
