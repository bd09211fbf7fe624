#include "flow/steady/newton_krylov.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "flow/cell_errors.hpp"

namespace lampblack::flow {
namespace {

NewtonKrylov* newtonOf(void* context) {
  return static_cast<NewtonKrylov*>(context);
}

}  // namespace

NewtonKrylov::NewtonKrylov(const FlowContext& context, const State& state, FlowResidual& residual, GasUpdate& gas,
                           int vectors, CarriedUpdate* carried, std::vector<Operator*> operators)
    : context_(context),
      residual_(residual),
      gas_(gas),
      carried_(carried),
      operators_(std::move(operators)),
      flow_(context, state, residual),
      vectors_(vectors),
      width_(static_cast<std::size_t>(state.species) + 1),
      velocities_(static_cast<std::size_t>(state.dimension) + (state.swirls ? 1 : 0)),
      scalars_(carried ? state.scalars.size() : 0),
      perCell_(width_ + velocities_ + 1 + scalars_),
      pastFlow_(width_ + velocities_ + 1),
      faces_(static_cast<std::size_t>(context.mesh.faces)),
      size_(static_cast<std::size_t>(context.mesh.owned) * perCell_ + faces_) {
  const Mesh& m = context.mesh;
  for (std::vector<double>* all : {&left_, &leftInTime_, &leftBeside_, &rows_, &units_}) all->resize(size_);
  gasRight_.resize(static_cast<std::size_t>(m.owned) * width_);
  gasChange_.resize(static_cast<std::size_t>(m.cells) * width_);
  densityChange_.resize(static_cast<std::size_t>(m.cells));
  carriedRight_.resize(static_cast<std::size_t>(m.owned) * scalars_);
  carriedChange_.resize(static_cast<std::size_t>(m.cells) * scalars_);
  const auto size = static_cast<PetscInt>(size_);
  checkPetsc(MatCreateShell(m.comm, size, size, PETSC_DETERMINE, PETSC_DETERMINE, this, matrix_.put()));
  const auto product = [](Mat matrix, Vec x, Vec y) -> PetscErrorCode {
    void* self = nullptr;
    if (const PetscErrorCode code = MatShellGetContext(matrix, static_cast<void*>(&self)); code != 0) return code;
    return newtonOf(self)->exceptions_.guard([&] { newtonOf(self)->multiply(x, y); });
  };
  PetscErrorCode (*const multiplies)(Mat, Vec, Vec) = product;
  checkPetsc(MatShellSetOperation(matrix_.get(), MATOP_MULT, reinterpret_cast<void (*)()>(multiplies)));
  checkPetsc(MatCreateVecs(matrix_.get(), solution_.put(), rightSide_.put()));
  checkPetsc(KSPCreate(m.comm, solver_.put()));
  checkPetsc(KSPSetType(solver_.get(), KSPFGMRES));
  checkPetsc(KSPGMRESSetRestart(solver_.get(), vectors_));
  checkPetsc(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()));
  PC preconditioner = nullptr;
  checkPetsc(KSPGetPC(solver_.get(), &preconditioner));
  checkPetsc(PCSetType(preconditioner, PCSHELL));
  checkPetsc(PCShellSetContext(preconditioner, this));
  const auto pass = [](PC pc, Vec x, Vec y) -> PetscErrorCode {
    void* self = nullptr;
    if (const PetscErrorCode code = PCShellGetContext(pc, static_cast<void*>(&self)); code != 0) return code;
    return newtonOf(self)->exceptions_.guard([&] { newtonOf(self)->precondition(x, y); });
  };
  PetscErrorCode (*const passes)(PC, Vec, Vec) = pass;
  checkPetsc(PCShellSetApply(preconditioner, passes));
}

// What is left of all equations of the state that was evaluated.
void NewtonKrylov::find(const State& state, std::span<double> left) {
  const Mesh& m = context_.mesh;
  const FlowResidual::Rates& rates = residual_.rates();
  const auto d = static_cast<std::size_t>(state.dimension);
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.owned); ++c) {
    double* own = &left[c * perCell_];
    gas_.findLeft(state, residual_, c, own);
    for (std::size_t i = 0; i < d; ++i) own[width_ + i] = rates.momentum[c * d + i];
    if (state.swirls) own[width_ + d] = rates.angularMomentum[c] / m.centre[c][0];
    own[pastFlow_ - 1] = rates.mass[c];
    for (std::size_t s = 0; s < scalars_; ++s) {
      const std::size_t i = c * scalars_ + s;
      own[pastFlow_ + s] =
          state.scalars[s].isTransported ? rates.carried[i] - state.carried[i] / state.density[c] * rates.mass[c] : 0.0;
    }
  }
  std::ranges::copy(rates.massFlux, left.begin() + static_cast<std::ptrdiff_t>(size_ - faces_));
}

void NewtonKrylov::takeInertia(const State& state, const State& start, std::span<double> left) const {
  const std::size_t n = width_ - 1;
  const auto d = static_cast<std::size_t>(state.dimension);
  for (std::size_t c = 0; c < static_cast<std::size_t>(context_.mesh.owned); ++c) {
    double* own = &left[c * perCell_];
    const double inertia = inertia_[c];
    for (std::size_t k = 0; k < n; ++k) own[k] -= inertia * (state.Y[c * n + k] - start.Y[c * n + k]);
    own[n] -= inertia * (state.temperature[c] - start.temperature[c]) / GasUpdate::kelvins;
    for (std::size_t i = 0; i < d; ++i)
      own[width_ + i] -= inertia * (state.velocity[c * d + i] - start.velocity[c * d + i]);
    if (state.swirls) own[width_ + d] -= inertia * (state.swirl[c] - start.swirl[c]);
  }
}

NewtonKrylov::Left NewtonKrylov::leftInTime(const State& state, const State& start) {
  find(state, leftInTime_);
  takeInertia(state, start, leftInTime_);
  return sizeInTime();
}

NewtonKrylov::Left NewtonKrylov::sizeInTime() const {
  std::array<double, 2> sums{};
  const std::size_t inCells = size_ - faces_;
  for (std::size_t i = 0; i < size_; ++i) {
    if (i >= inCells && context_.mesh.low[i - inCells] >= context_.mesh.owned) continue;  // another rank's face
    const double size = std::abs(rows_[i] * leftInTime_[i]);
    sums[0] += size;
    sums[1] += size * size;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  return {.sum = sums[0], .root = std::sqrt(sums[1])};
}

void NewtonKrylov::move(State& state, double step, std::span<const double> along) const {
  const Mesh& m = context_.mesh;
  const std::size_t n = width_ - 1;
  const auto d = static_cast<std::size_t>(state.dimension);
  inEachCell(m, [&](int cell) {
    const auto c = static_cast<std::size_t>(cell);
    const double* own = &along[c * perCell_];
    for (std::size_t k = 0; k < n; ++k) state.Y[c * n + k] += step * own[k];
    state.temperature[c] += step * GasUpdate::kelvins * own[n];
    for (std::size_t i = 0; i < d; ++i) state.velocity[c * d + i] += step * own[width_ + i];
    if (state.swirls) state.swirl[c] += step * own[width_ + d];
    state.pressure[c] += step * own[pastFlow_ - 1];
    followGas(context_, state, cell);
    for (std::size_t s = 0; s < scalars_; ++s)
      state.carried[c * scalars_ + s] += step * state.density[c] * own[pastFlow_ + s];
  });
  const std::span<const double> fluxes = along.last(faces_);
  for (std::size_t f = 0; f < faces_; ++f) state.massFlux[f] += step * fluxes[f];
  state.updateHalo(context_.halo);
  if (carried_) {
    for (Operator* op : operators_) op->setDiffusivities(state);
    state.updateHalo(context_.halo);
  }
}

// Of the equations: over what goes through all of the domain, as the measure of an iteration has them. (Over what there
// is of each species a trace in one cell would be the whole norm, and the system solved for it alone.)
void NewtonKrylov::findScales(const State& state) {
  const Mesh& m = context_.mesh;
  const auto d = static_cast<std::size_t>(state.dimension), owned = static_cast<std::size_t>(m.owned);
  std::array<double, 2> sums{};  // kg/s, and how many faces
  for (int face = 0; face < m.faces; ++face)
    if (m.low[face] < m.owned) {
      sums[0] += std::abs(state.massFlux[face]);
      sums[1] += 1.0;
    }
  std::array<double, 3> most{1e-12, -1e300, -1e300};  // m/s, K, -K
  for (std::size_t c = 0; c < owned; ++c) {
    for (std::size_t i = 0; i < d; ++i) most[0] = std::max(most[0], std::abs(state.velocity[c * d + i]));
    if (state.swirls) most[0] = std::max(most[0], std::abs(state.swirl[c]));
    most[1] = std::max(most[1], state.temperature[c]);
    most[2] = std::max(most[2], -state.temperature[c]);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, most.data(), 3, MPI_DOUBLE, MPI_MAX, m.comm);
  const double through = std::max(sums[0], 1e-300);
  const double speed = most[0], range = std::max(most[1] + most[2], 1e-3 * most[1]);
  std::vector<double> row(perCell_, 1.0 / through), unit(perCell_, 1.0);
  row[width_ - 1] = GasUpdate::kelvins / (through * range);
  std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(width_), velocities_, 1.0 / (through * speed));
  std::fill_n(unit.begin() + static_cast<std::ptrdiff_t>(width_), velocities_, speed);
  for (std::size_t s = 0; s < scalars_; ++s) {
    unit[pastFlow_ + s] = carried_->scales()[s];
    row[pastFlow_ + s] = 1.0 / (through * carried_->scales()[s]);
  }
  for (std::size_t c = 0; c < owned; ++c) {
    unit[pastFlow_ - 1] = state.density[c] * speed * speed;
    std::ranges::copy(row, rows_.begin() + static_cast<std::ptrdiff_t>(c * perCell_));
    std::ranges::copy(unit, units_.begin() + static_cast<std::ptrdiff_t>(c * perCell_));
  }
  std::fill(rows_.end() - static_cast<std::ptrdiff_t>(faces_), rows_.end(), 1.0 / through);
  std::fill(units_.end() - static_cast<std::ptrdiff_t>(faces_), units_.end(), through / sums[1]);
}

NewtonKrylov::Result NewtonKrylov::advance(State& state, std::span<const double> inertia, double reduction,
                                           const State* start) {
  const State base = state;
  base_ = &base;
  inertia_ = inertia;
  gas_.prepare(state, residual_, inertia);
  flow_.prepare(state, inertia);
  if (carried_) carried_->prepare(state, residual_, inertia);
  faceDensity_ = residual_.faces().density;
  findScales(start ? *start : state);  // the same in all passes of a step
  find(state, left_);
  baseMass_ = residual_.rates().mass;
  leftInTime_ = left_;
  if (start) takeInertia(state, *start, leftInTime_);
  const Left before = sizeInTime();
  {
    const PetscMutableValues values(rightSide_.get());
    for (std::size_t i = 0; i < size_; ++i) values.get()[i] = rows_[i] * leftInTime_[i];
  }
  checkPetsc(KSPSetTolerances(solver_.get(), reduction, 1e-300, 1e10, vectors_));
  exceptions_.run([&] { return KSPSolve(solver_.get(), rightSide_.get(), solution_.get()); });
  Result result;
  result.before = before;
  PetscInt iterations = 0;
  checkPetsc(KSPGetIterationNumber(solver_.get(), &iterations));
  result.iterations = static_cast<int>(iterations);
  double norm = 0.0, of = 0.0;
  checkPetsc(KSPGetResidualNorm(solver_.get(), &norm));
  checkPetsc(VecNorm(rightSide_.get(), NORM_2, &of));
  result.reached = of > 0.0 ? norm / of : 0.0;
  base_ = nullptr;

  const PetscValues values(solution_.get());
  const std::span<const double> change = values.get();
  const auto d = static_cast<std::size_t>(state.dimension);
  for (std::size_t c = 0; c < static_cast<std::size_t>(context_.mesh.owned); ++c) {
    const double* own = &change[c * perCell_];
    std::copy_n(own, width_, &gasChange_[c * width_]);
    for (std::size_t i = 0; i < d; ++i) state.velocity[c * d + i] += own[width_ + i];
    if (state.swirls) state.swirl[c] += own[width_ + d];
    state.pressure[c] += own[pastFlow_ - 1];
  }
  for (std::size_t f = 0; f < faces_; ++f) state.massFlux[f] += change[size_ - faces_ + f];
  const GasUpdate::Result taken = gas_.take(state, gasChange_);
  result.largestRise = taken.largestRise;
  result.limited = taken.limited;
  for (std::size_t c = 0; c < static_cast<std::size_t>(context_.mesh.owned); ++c) {
    bool isHeld = false;
    for (std::size_t s = 0; s < scalars_; ++s) {
      double& amount = state.carried[c * scalars_ + s];
      const double perMass = amount / state.density[c], by = change[c * perCell_ + pastFlow_ + s];
      isHeld = isHeld || carried_->isHeld(s, perMass, by);
      amount = state.density[c] * carried_->limited(s, perMass, by);
    }
    result.held += isHeld ? 1 : 0;
  }
  MPI_Allreduce(MPI_IN_PLACE, &result.held, 1, MPI_INT64_T, MPI_SUM, context_.mesh.comm);
  return result;
}

}  // namespace lampblack::flow
