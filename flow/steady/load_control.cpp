#include "flow/steady/load_control.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

constexpr double mostOfLoadInIteration = 0.1;  // what an iteration changes of it

}  // namespace

LoadControl::LoadControl(FlowContext& context, const State& state, const Load& load)
    : context_(context),
      load_(load),
      pressure_(state.thermodynamicPressure),
      referenceDensity_(context.referenceDensity) {
  if (load.of == Load::Of::Temperature) temperature_ = context.boundaries[load.boundary].temperature;
  if (load.of == Load::Of::MoleFraction) Y_ = context.boundaries[load.boundary].Y;
  context_.loadedBoundary = load.of == Load::Of::Velocity ? static_cast<int>(load.boundary) : -1;
}

void LoadControl::setBoundary() {
  BoundaryCondition& boundary = context_.boundaries[load_.boundary];
  if (load_.of == Load::Of::Temperature) {
    boundary.temperature = value_ * temperature_;
  } else {
    std::vector<double> X(Y_.size());
    context_.thermo.massToMole(Y_, X);
    const double before = X[load_.species], now = value_ * before;
    if (!(now <= 1.0))
      throw NumericsError(
          fmt::format("the load leads to a mole fraction of {:.4g} in the boundary '{}'", now, boundary.name));
    for (double& x : X) x *= before < 1.0 ? (1.0 - now) / (1.0 - before) : 1.0;
    X[load_.species] = now;
    context_.thermo.moleToMass(X, boundary.Y);
  }
  if (!context_.varying) return;
  context_.varying = std::make_shared<BoundaryValues>(context_.mesh, context_.boundaries, context_.thermo);
  context_.varying->set(0.0, 0.0);
}

void LoadControl::setLoad(State& state, double load) {
  value_ = load;
  switch (load_.of) {
    case Load::Of::Velocities:
    case Load::Of::Velocity:
      context_.load = load;
      break;
    case Load::Of::Temperature:
    case Load::Of::MoleFraction:
      setBoundary();
      break;
    case Load::Of::Pressure:
      state.thermodynamicPressure = load * pressure_;
      context_.referenceDensity = load * referenceDensity_;
      break;
  }
}

// Of all that comes in, what the loaded inlet has of it.
double LoadControl::shareOfMomentum(const State& state) const {
  const Mesh& m = context_.mesh;
  std::array<double, 2> sums{};
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (context_.boundaryOf(face).kind != BoundaryKind::Inlet) continue;
    const double momentum = std::abs(state.massFlux[face] * context_.boundarySpeed(face));
    sums[0] += momentum;
    if (m.patch[face - m.interiorFaces] == static_cast<int>(load_.boundary)) sums[1] += momentum;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, m.comm);
  return sums[0] > 0.0 ? sums[1] / sums[0] : 0.0;
}

void LoadControl::scale(State& state, double load) {
  double ratio = load / value_;
  if (load_.of == Load::Of::Pressure)
    for (std::vector<double>* all : {&state.density, &state.carried, &state.massFlux, &state.pressure})
      for (double& value : *all) value *= ratio;
  if (load_.of == Load::Of::Velocity) ratio = 1.0 + shareOfMomentum(state) * (ratio - 1.0);
  if (load_.of == Load::Of::Velocity || load_.of == Load::Of::Velocities) {
    for (std::vector<double>* all : {&state.velocity, &state.swirl, &state.massFlux})
      for (double& value : *all) value *= ratio;
    // With gravity most of the pressure may be that of the weight, which has no load.
    if (context_.gravity == Vector3{0.0, 0.0, 0.0})
      for (double& value : state.pressure) value *= ratio * ratio;
  }
  setLoad(state, load);
}

double LoadControl::lengthOf(const std::vector<double>& difference) const {
  const Mesh& m = context_.mesh;
  std::array<double, 2> sums{};
  for (int c = 0; c < m.owned; ++c) {
    sums[0] += m.volume[c] * difference[c] * difference[c];
    sums[1] += m.volume[c];
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, m.comm);
  return std::sqrt(sums[0] / sums[1]);
}

void LoadControl::require(const std::vector<double>& from, const std::vector<double>& along, double length) {
  const Mesh& m = context_.mesh;
  from_ = from;
  length_ = length;
  double volume = 0.0;
  for (int c = 0; c < m.owned; ++c) volume += m.volume[c];
  MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, m.comm);
  const double size = volume * lengthOf(along);
  weights_.resize(along.size());
  for (std::size_t c = 0; c < along.size(); ++c) weights_[c] = m.volume[c] * along[c] / size;
}

double LoadControl::weighed(const std::function<double(std::size_t)>& value) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < weights_.size(); ++c) sum += weights_[c] * value(c);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  return sum;
}

double LoadControl::left(const State& state) const {
  return length_ - weighed([&](std::size_t c) { return state.temperature[c] - from_[c]; });
}

double LoadControl::change(double wanted, double slope) const {
  const double most = mostOfLoadInIteration * value_;
  // Where the load changes next to nothing, it is left as it is.
  return std::abs(slope) > 0.0 ? std::clamp(wanted / slope, -most, most) : 0.0;
}

}  // namespace lampblack::flow
