#include "flow/steady/coupled_flow.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/petsc_callbacks.hpp"
#include "flow/equations/matrix_rows.hpp"

namespace lampblack::flow {
namespace {

constexpr double reduction = 0.05;  // of a system that is not eliminated as a whole
constexpr int mostIterations = 20;  // the same
constexpr int overlap = 2;          // cells

}  // namespace

CoupledFlow::CoupledFlow(const FlowContext& context, const State& state, FlowResidual& residual)
    : context_(context),
      residual_(residual),
      d_(static_cast<std::size_t>(state.dimension)),
      velocities_(d_ + (state.swirls ? 1 : 0)),
      width_(velocities_ + 1),
      row_(matrixRows(context)),
      slopes_(static_cast<std::size_t>(context.mesh.faceStart[context.mesh.owned])),
      flux_(static_cast<std::size_t>(context.mesh.faces)),
      steps_(2 * flux_.size() * velocities_),
      drawn_(flux_.size()),
      own_(width_ * width_),
      other_(own_.size()),
      known_(static_cast<std::size_t>(context.mesh.cells) * width_) {
  const Mesh& m = context.mesh;
  left_.momentum.resize(static_cast<std::size_t>(m.owned) * velocities_);
  left_.mass.resize(static_cast<std::size_t>(m.owned));
  left_.massFlux.resize(flux_.size());
  change_.velocity.resize(static_cast<std::size_t>(m.cells) * velocities_);
  change_.pressure.resize(static_cast<std::size_t>(m.cells));
  change_.massFlux.resize(flux_.size());
  findSlopes();
  const PetscInt owned = m.owned;
  const auto width = static_cast<PetscInt>(width_);
  checkPetsc(MatCreateBAIJ(m.comm, width, owned * width, owned * width, PETSC_DETERMINE, PETSC_DETERMINE,
                           Mesh::mostSides + 1, nullptr, Mesh::mostSides, nullptr, matrix_.put()));
  checkPetsc(MatCreateVecs(matrix_.get(), solution_.put(), rightSide_.put()));
  checkPetsc(KSPCreate(m.comm, solver_.put()));
  checkPetsc(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()));
  PC preconditioner = nullptr;
  checkPetsc(KSPGetPC(solver_.get(), &preconditioner));
  int ranks = 1;
  MPI_Comm_size(m.comm, &ranks);
  isJoined_ = ranks > 1 || d_ == 3;
  if (!isJoined_) {
    checkPetsc(KSPSetType(solver_.get(), KSPPREONLY));
    checkPetsc(PCSetType(preconditioner, PCLU));
    return;
  }
  checkPetsc(KSPSetType(solver_.get(), KSPGMRES));
  checkPetsc(KSPSetPCSide(solver_.get(), PC_RIGHT));
  checkPetsc(KSPSetTolerances(solver_.get(), reduction, 1e-300, 1e10, mostIterations));
  checkPetsc(PCSetType(preconditioner, PCASM));
  checkPetsc(PCASMSetOverlap(preconditioner, overlap));
}

// The pressure's gradient in a cell is a sum over what lies beyond its faces: that of a pressure of one beyond each.
void CoupledFlow::findSlopes() {
  const Mesh& m = context_.mesh;
  const std::vector<BoundaryData>& known = residual_.forces().pressureKnown();
  const Gradient gradient(m);
  std::vector<double> values(static_cast<std::size_t>(m.cells), 0.0), beyond(known.size(), 0.0);
  for (int cell = 0; cell < m.owned; ++cell)
    for (int at = m.faceStart[cell]; at < m.faceStart[cell + 1]; ++at) {
      const int face = m.faceOfCell[at], other = m.low[face] == cell ? m.high[face] : m.low[face];
      double& one = m.high[face] < 0 ? beyond[static_cast<std::size_t>(face - m.interiorFaces)]
                                     : values[static_cast<std::size_t>(other)];
      one = 1.0;
      for (std::size_t i = 0; i < d_; ++i) {
        Vector3 axis{};
        axis[i] = 1.0;
        gradient.along(axis, cell, values, beyond, 1, {&slopes_[static_cast<std::size_t>(at)][i], 1}, known);
      }
      one = 0.0;
    }
}

double CoupledFlow::weightOf(int cell, int face) const {
  const Mesh& m = context_.mesh;
  if (m.high[face] < 0) return 1.0;
  return m.low[face] == cell ? m.lowWeight[face] : 1.0 - m.lowWeight[face];
}

void CoupledFlow::add(int row, int column, const std::vector<double>& block) {
  checkPetsc(MatSetValuesBlocked(matrix_.get(), 1, &row_[row], 1, &row_[column], block.data(), ADD_VALUES));
}

void CoupledFlow::assembleCell(int cell, const State& state, double inertia) {
  const Mesh& m = context_.mesh;
  MomentumForces& forces = residual_.forces();
  const auto c = static_cast<std::size_t>(cell);
  std::ranges::fill(own_, 0.0);
  for (std::size_t i = 0; i < velocities_; ++i)
    own_[i * width_ + i] = inertia + forces.diagonal()[c * d_ + std::min(i, d_ - 1)];
  for (int at = m.faceStart[cell]; at < m.faceStart[cell + 1]; ++at) {
    const int face = m.faceOfCell[at];
    const auto f = static_cast<std::size_t>(face);
    const bool isLow = m.low[face] == cell, isInside = m.high[face] >= 0;
    const int beyond = isInside ? (isLow ? m.high[face] : m.low[face]) : -1;
    const double sign = isLow ? 1.0 : -1.0, comes = std::max(-sign * state.massFlux[face], 0.0);
    std::ranges::fill(other_, 0.0);
    double* step = &steps_[(2 * f + (isLow ? 0 : 1)) * velocities_];
    std::fill_n(step, velocities_, 0.0);
    const bool isGiven = isInside || givenVelocity(context_.boundaryOf(face)) != GivenVelocity::Nothing;
    for (std::size_t i = 0; i < velocities_; ++i) {
      const double g = isInside ? forces.conductance()[f * d_ + std::min(i, d_ - 1)] : 0.0;
      if (isGiven) own_[i * width_ + i] += g + comes;
      if (!isInside) continue;
      other_[i * width_ + i] -= g + comes;
      const auto n = static_cast<std::size_t>(beyond);
      if (comes > 0.0)
        step[i] = i < d_ ? state.velocity[n * d_ + i] - state.velocity[c * d_ + i] : state.swirl[n] - state.swirl[c];
    }
    // The pressure's force, also of what the pressure at an outlet is where gas is drawn in.
    for (std::size_t i = 0; i < d_; ++i) {
      const double force = m.volume[c] * slopes_[static_cast<std::size_t>(at)][i];
      if (force == 0.0) continue;
      own_[i * width_ + velocities_] -= force;
      if (isInside) other_[i * width_ + velocities_] += force;
      for (std::size_t j = 0; j < d_; ++j)
        own_[i * width_ + j] += force * drawn_[f] * flux_[f].ofVelocity * m.normal[face][j];
    }
    // What goes through the face: of the mass, and of what it brings.
    for (std::size_t i = 0; i < width_; ++i) {
      const double brings = i < velocities_ ? step[i] : 1.0;
      if (brings == 0.0) continue;
      for (std::size_t j = 0; j < d_; ++j) {
        const double flows = sign * brings * flux_[f].ofVelocity * m.normal[face][j], own = weightOf(cell, face);
        own_[i * width_ + j] += flows * own;
        other_[i * width_ + j] += flows * (1.0 - own);
      }
      own_[i * width_ + velocities_] += brings * flux_[f].ofPressure;
      other_[i * width_ + velocities_] -= brings * flux_[f].ofPressure;
    }
    if (isInside) add(cell, beyond, other_);
  }
  add(cell, cell, own_);
}

void CoupledFlow::prepare(const State& state, std::span<const double> inertia) {
  const Mesh& m = context_.mesh;
  const std::span<const double> relaxation = residual_.forces().relaxation();
  for (int face = 0; face < m.faces; ++face) {
    const auto f = static_cast<std::size_t>(face);
    const bool isInside = m.high[face] >= 0;
    const bool isOpen = isInside || context_.boundaryOf(face).kind == BoundaryKind::Outlet;
    flux_[f] = {};
    drawn_[f] = 0.0;
    if (!isOpen || !(m.area[face] > 0.0)) continue;
    flux_[f].ofVelocity = residual_.faces().density[face] * m.area[face];
    if (!isInside) {
      if (state.massFlux[face] < 0.0) drawn_[f] = -state.massFlux[face] / (flux_[f].ofVelocity * m.area[face]);
      continue;
    }
    const double w = m.lowWeight[face], renews = w * relaxation[m.low[face]] + (1.0 - w) * relaxation[m.high[face]];
    if (renews > 0.0) flux_[f].ofPressure = m.area[face] / (renews * m.distance[face]);
  }
  checkPetsc(MatZeroEntries(matrix_.get()));
  for (int c = 0; c < m.owned; ++c) assembleCell(c, state, inertia[static_cast<std::size_t>(c)]);
  checkPetsc(MatAssemblyBegin(matrix_.get(), MAT_FINAL_ASSEMBLY));
  checkPetsc(MatAssemblyEnd(matrix_.get(), MAT_FINAL_ASSEMBLY));
  checkPetsc(KSPSetUp(solver_.get()));
  if (!isJoined_ || isSetUp_) return;
  PC preconditioner = nullptr;
  KSP* ofRank = nullptr;
  checkPetsc(KSPGetPC(solver_.get(), &preconditioner));
  checkPetsc(PCASMGetSubKSP(preconditioner, nullptr, nullptr, &ofRank));
  checkPetsc(KSPGetPC(*ofRank, &preconditioner));
  checkPetsc(PCSetType(preconditioner, d_ == 3 ? PCILU : PCLU));
  isSetUp_ = true;
}

const CoupledFlow::Change& CoupledFlow::find() {
  const Mesh& m = context_.mesh;
  {
    const PetscMutableValues values(rightSide_.get());
    const std::span<double> right = values.get();
    for (int cell = 0; cell < m.owned; ++cell) {
      const auto c = static_cast<std::size_t>(cell);
      double* own = &right[c * width_];
      std::copy_n(&left_.momentum[c * velocities_], velocities_, own);
      own[velocities_] = left_.mass[c];
      for (int at = m.faceStart[cell]; at < m.faceStart[cell + 1]; ++at) {
        const auto f = static_cast<std::size_t>(m.faceOfCell[at]);
        const bool isLow = m.low[m.faceOfCell[at]] == cell;
        const double flux = isLow ? left_.massFlux[f] : -left_.massFlux[f];
        const double* step = &steps_[(2 * f + (isLow ? 0 : 1)) * velocities_];
        for (std::size_t i = 0; i < velocities_; ++i) own[i] -= step[i] * flux;
        for (std::size_t i = 0; i < d_; ++i)
          own[i] -= m.volume[c] * slopes_[static_cast<std::size_t>(at)][i] * drawn_[f] * flux;
        own[velocities_] -= flux;
      }
    }
  }
  checkPetsc(KSPSolve(solver_.get(), rightSide_.get(), solution_.get()));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  checkPetsc(KSPGetConvergedReason(solver_.get(), &reason));
  if (reason == KSP_DIVERGED_PC_FAILED || reason == KSP_DIVERGED_NANORINF)
    throw NumericsError("the linear system of velocities and pressure is singular");
  {
    const PetscValues values(solution_.get());
    std::ranges::copy(values.get(), known_.begin());
  }
  context_.halo.update(known_, static_cast<int>(width_));
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.cells); ++c) {
    std::copy_n(&known_[c * width_], velocities_, &change_.velocity[c * velocities_]);
    change_.pressure[c] = known_[c * width_ + velocities_];
  }
  for (int face = 0; face < m.faces; ++face) {
    const auto f = static_cast<std::size_t>(face), low = static_cast<std::size_t>(m.low[face]);
    const std::size_t high = m.high[face] >= 0 ? static_cast<std::size_t>(m.high[face]) : low;
    const double w = weightOf(m.low[face], face);
    double rises = 0.0;
    for (std::size_t i = 0; i < d_; ++i)
      rises += m.normal[face][i] *
               (w * change_.velocity[low * velocities_ + i] + (1.0 - w) * change_.velocity[high * velocities_ + i]);
    change_.massFlux[f] = left_.massFlux[f] + flux_[f].ofVelocity * rises +
                          flux_[f].ofPressure * (change_.pressure[low] - change_.pressure[high]);
  }
  return change_;
}

}  // namespace lampblack::flow
