// The linear system of a step of Newton's method: its products and its preconditioner.
#include <algorithm>
#include <cmath>

#include "flow/discretisation/face_fluxes.hpp"
#include "flow/steady/newton_krylov.hpp"

namespace lampblack::flow {
namespace {

constexpr double gasOfPreconditioner = 0.1;
constexpr int mostOfPreconditioner = 1;  // more leave as many iterations around them
constexpr double carriedOfPreconditioner = 0.1;
constexpr double smallStep = 1e-7;  // of the unknowns' units, for differences

}  // namespace

// For differences along a change; zero where there is none.
double NewtonKrylov::stepOf(std::span<const double> along) const {
  double most = 0.0;
  for (std::size_t i = 0; i < size_; ++i) most = std::max(most, std::abs(along[i]) / units_[i]);
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
  return most > 0.0 ? smallStep / most : 0.0;
}

// By the difference of what is left; in the pseudo-time.
void NewtonKrylov::multiply(Vec x, Vec y) {
  const PetscValues values(x);
  const PetscMutableValues product(y);
  const std::span<const double> along = values.get();
  const std::span<double> to = product.get();
  const double step = stepOf(along);
  if (!(step > 0.0)) {
    std::ranges::fill(to, 0.0);
    return;
  }
  State beside = *base_;
  move(beside, step, along);
  residual_.evaluate(beside);
  find(beside, leftBeside_);
  for (std::size_t i = 0; i < size_; ++i) to[i] = (left_[i] - leftBeside_[i]) / step;
  for (std::size_t c = 0; c < static_cast<std::size_t>(context_.mesh.owned); ++c)
    for (std::size_t i = 0; i < perCell_; ++i)
      if (i + 1 != pastFlow_) to[c * perCell_ + i] += inertia_[c] * along[c * perCell_ + i];
  for (std::size_t i = 0; i < size_; ++i) to[i] *= rows_[i];
}

// The gas by its own matrix, then the flow that follows: a lighter gas rises, and flows the faster through faces.
void NewtonKrylov::precondition(Vec x, Vec y) {
  const Mesh& m = context_.mesh;
  const PetscValues values(x);
  const PetscMutableValues found(y);
  const std::span<const double> right = values.get();
  const std::span<double> to = found.get();
  const auto owned = static_cast<std::size_t>(m.owned);
  const std::size_t n = width_ - 1;
  const auto d = static_cast<std::size_t>(base_->dimension);
  for (std::size_t c = 0; c < owned; ++c)
    for (std::size_t k = 0; k < width_; ++k)
      gasRight_[c * width_ + k] = right[c * perCell_ + k] / rows_[c * perCell_ + k];
  gas_.solve(gasRight_, gasChange_, gasOfPreconditioner, mostOfPreconditioner);
  const std::span<const double> weights = context_.thermo.molecularWeights();
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.cells); ++c) {
    const double *Y = &base_->Y[c * n], *change = &gasChange_[c * width_];
    double moles = 0.0, more = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      moles += Y[k] / weights[k];
      more += change[k] / weights[k];
    }
    densityChange_[c] = -base_->density[c] * (more / moles + GasUpdate::kelvins * change[n] / base_->temperature[c]);
  }
  CoupledFlow::Left& left = flow_.left();
  for (std::size_t c = 0; c < owned; ++c) {
    const double* row = &rows_[c * perCell_];
    for (std::size_t i = 0; i < velocities_; ++i) {
      left.momentum[c * velocities_ + i] = right[c * perCell_ + width_ + i] / row[width_ + i];
      if (i < d) left.momentum[c * velocities_ + i] += m.volume[c] * densityChange_[c] * context_.gravity[i];
    }
    left.mass[c] = right[c * perCell_ + width_ + velocities_] / row[width_ + velocities_];
  }
  for (std::size_t f = 0; f < faces_; ++f) {
    const auto low = static_cast<std::size_t>(m.low[f]);
    const bool isInside = m.high[f] >= 0;
    const double w = isInside ? m.lowWeight[f] : 1.0;
    double change = w * densityChange_[low];
    if (isInside) change += (1.0 - w) * densityChange_[static_cast<std::size_t>(m.high[f])];
    const bool follows =
        isInside || (context_.boundaryOf(static_cast<int>(f)).kind == BoundaryKind::Outlet && base_->massFlux[f] > 0.0);
    left.massFlux[f] = right[size_ - faces_ + f] / rows_[size_ - faces_ + f];
    if (follows) left.massFlux[f] += base_->massFlux[f] * change / faceDensity_[f];
  }
  const CoupledFlow::Change& change = flow_.find();
  for (std::size_t c = 0; c < owned; ++c) {
    double* own = &to[c * perCell_];
    std::copy_n(&gasChange_[c * width_], width_, own);
    for (std::size_t i = 0; i < velocities_; ++i) own[width_ + i] = change.velocity[c * velocities_ + i];
    own[pastFlow_ - 1] = change.pressure[c];
  }
  std::ranges::copy(change.massFlux, to.end() - static_cast<std::ptrdiff_t>(faces_));
  if (carried_) {
    for (std::size_t c = 0; c < owned; ++c)
      for (std::size_t s = 0; s < scalars_; ++s) {
        const std::size_t at = c * perCell_ + pastFlow_ + s;
        carriedRight_[c * scalars_ + s] = right[at] / rows_[at];
        to[at] = 0.0;
      }
    addBrought(to);
    carried_->solve(carriedRight_, carriedChange_, carriedOfPreconditioner);
    for (std::size_t c = 0; c < owned; ++c)
      std::copy_n(&carriedChange_[c * scalars_], scalars_, &to[c * perCell_ + pastFlow_]);
  }
}

// To the right side of what is carried what a change of all else leaves of its equations, by the difference: shear
// makes turbulence, and the flow carries it.
void NewtonKrylov::addBrought(std::span<const double> along) {
  const Mesh& m = context_.mesh;
  const double step = stepOf(along);
  if (!(step > 0.0)) return;
  State beside = *base_;
  move(beside, step, along);
  const FlowResidual::Rates& rates = residual_.evaluateCarried(beside);
  // Beside the mass that the fluxes bring; what reactions make of it stays what it was.
  std::vector<double> mass(baseMass_);
  for (int face = 0; face < m.faces; ++face)
    addFaceFlux(m, face, beside.massFlux[face] - base_->massFlux[face], 1.0, mass);
  for (std::size_t i = 0; i < carriedRight_.size(); ++i) {
    const std::size_t c = i / scalars_, s = i % scalars_;
    if (!base_->scalars[s].isTransported) continue;
    const double left = rates.carried[i] - beside.carried[i] / beside.density[c] * mass[c];
    carriedRight_[i] += (left - left_[c * perCell_ + pastFlow_ + s]) / step;
  }
}

}  // namespace lampblack::flow
