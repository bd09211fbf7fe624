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

void BlockSystem::addBrought(int cell, std::span<const double> values, std::span<double> sum) const {
  for (int i = mesh_.faceStart[cell]; i < mesh_.faceStart[cell + 1]; ++i) {
    const int face = mesh_.faceOfCell[i];
    if (mesh_.high[face] < 0) continue;
    const bool isLow = mesh_.low[face] == cell;
    const double* comes = &(isLow ? toLow_ : toHigh_)[static_cast<std::size_t>(face) * fields_];
    const double* value = &values[static_cast<std::size_t>(isLow ? mesh_.high[face] : mesh_.low[face]) * fields_];
    for (std::size_t k = 0; k < fields_; ++k) sum[k] += comes[k] * value[k];
  }
}

// What the other cell of a face, one of this rank's own, brings to a cell, and is brought by it.
BlockSystem::Neighbour BlockSystem::neighbour(int cell, int face) const {
  if (mesh_.high[face] < 0) return {};
  const bool isLow = mesh_.low[face] == cell;
  const int other = isLow ? mesh_.high[face] : mesh_.low[face];
  if (other >= mesh_.owned) return {};
  const std::size_t at = static_cast<std::size_t>(face) * fields_;
  return {other, &(isLow ? toLow_ : toHigh_)[at], &(isLow ? toHigh_ : toLow_)[at]};
}

// Of a cell's block, less what the cells before it answer to a change of the cell, and of the neighbours that those
// have behind it as if they changed by as much.
void BlockSystem::factorise() {
  const std::size_t n = fields_;
  std::vector<double> factors(n * n), inverse(n * n), behind(static_cast<std::size_t>(mesh_.owned) * n, 0.0);
  inEachCell(mesh_, [&](int c) {
    double* own = &behind[static_cast<std::size_t>(c) * n];
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) sum += std::abs(block(c)[k * (n + 1)]);
    scale_[c] = static_cast<double>(n) / sum;
    std::copy_n(block(c), n * n, factors.begin());
    for (int i = mesh_.faceStart[c]; i < mesh_.faceStart[c + 1]; ++i) {
      const Neighbour other = neighbour(c, mesh_.faceOfCell[i]);
      if (other.cell > c)
        for (std::size_t k = 0; k < n; ++k) own[k] += other.comes[k];
      if (other.cell < 0 || other.cell >= c) continue;
      const float* answer = &inverse_[static_cast<std::size_t>(other.cell) * n * n];
      const double* all = &behind[static_cast<std::size_t>(other.cell) * n];
      for (std::size_t k = 0; k < n; ++k) {
        const double goes = (1.0 - keptFill_) * other.goes[k] + keptFill_ * all[k];
        for (std::size_t r = 0; r < n; ++r)
          factors[k * n + r] -= other.comes[r] * static_cast<double>(answer[k * n + r]) * goes;
      }
    }
    if (!dense_.factorise(n, factors.data(), pivots_.data()))
      throw NumericsError("the linear system of an iteration towards the steady state is singular");
    dense_.invert(n, factors.data(), pivots_.data(), ones_.data(), inverse.data());
    std::ranges::transform(inverse, &inverse_[static_cast<std::size_t>(c) * n * n],
                           [](double value) { return static_cast<float>(value); });
  });
}

double BlockSystem::inverseDiagonal(int cell, std::size_t field) {
  std::vector<double> factors(block(cell), block(cell) + fields_ * fields_), column(fields_, 0.0);
  if (!dense_.factorise(fields_, factors.data(), pivots_.data())) return 0.0;
  column[field] = 1.0;
  dense_.solve(fields_, factors.data(), pivots_.data(), 1, column.data());
  return column[field];
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

void BlockSystem::addNeighbours(int cell, std::span<const double> values, bool before) {
  for (int i = mesh_.faceStart[cell]; i < mesh_.faceStart[cell + 1]; ++i) {
    const Neighbour other = neighbour(cell, mesh_.faceOfCell[i]);
    if (other.cell < 0 || other.cell == cell || (other.cell < cell) != before) continue;
    const double* value = &values[static_cast<std::size_t>(other.cell) * fields_];
    for (std::size_t k = 0; k < fields_; ++k) row_[k] += other.comes[k] * value[k];
  }
}

void BlockSystem::precondition(Vec x, Vec y) {
  const PetscValues values(x);
  const PetscMutableValues found(y);
  const std::span<const double> right = values.get();
  const std::span<double> to = found.get();
  const std::size_t n = fields_;
  for (int c = 0; c < mesh_.owned; ++c) {
    const std::size_t own = static_cast<std::size_t>(c) * n;
    for (std::size_t k = 0; k < n; ++k) row_[k] = right[own + k] / scale_[c];
    addNeighbours(c, to, true);
    std::fill_n(&to[own], n, 0.0);
    addProduct(n, n, &inverse_[own * n], row_.data(), &to[own]);
  }
  for (int c = mesh_.owned - 1; c >= 0; --c) {
    const std::size_t own = static_cast<std::size_t>(c) * n;
    std::ranges::fill(row_, 0.0);
    addNeighbours(c, to, false);
    addProduct(n, n, &inverse_[own * n], row_.data(), &to[own]);
  }
}

BlockSystem::Result BlockSystem::solve(std::span<const double> right, std::span<double> x, double reduction,
                                       int mostIterations) {
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
  double left = 0.0, all = 0.0;
  checkPetsc(KSPGetResidualNorm(solver_.get(), &left));
  checkPetsc(VecNorm(rightSide_.get(), NORM_2, &all));
  {
    const PetscValues values(solution_.get());
    std::ranges::copy(values.get(), x.begin());
  }
  halo_.update(x.first(work_.size()), static_cast<int>(fields_));
  return {static_cast<int>(iterations), reason > 0, all > 0.0 ? left / all : 0.0};
}

}  // namespace lampblack::flow
