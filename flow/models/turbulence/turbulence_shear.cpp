// Turbulence and the flow that carries it: what velocities and densities tell of the cells.
#include <algorithm>
#include <array>
#include <cmath>

#include "flow/discretisation/face_fluxes.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"

namespace lampblack::flow {

// Strain, vorticity and dilatation of the owned cells, of the gradient that has been computed.
void TurbulenceOperator::findShear(const State& state) {
  if (state.swirls) findTurning(state);
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  for (int c = 0; c < m.owned; ++c) {
    // du_j/dx_i; about an axis the hoop's part stands in the third place.
    std::array<std::array<double, 3>, 3> slope{}, S{}, W{};
    for (std::size_t j = 0; j < static_cast<std::size_t>(d); ++j)
      for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i)
        slope[j][i] = velocityGradient_.of(c, static_cast<int>(j))[i];
    TurbulentCell& cell = cells_[c];
    cell.dilatation = velocityGradient_.dilatation(c, state.velocity);
    if (m.axisymmetric()) slope[2][2] = cell.dilatation - slope[0][0] - slope[1][1];
    if (!turning_.empty()) {
      const double r = m.centre[c][0], turning = turning_[c];
      const double* gradient = &turningGradient_[static_cast<std::size_t>(c) * 2];
      slope[2][0] = turning + r * gradient[0];
      slope[2][1] = r * gradient[1];
      slope[0][2] = -turning;
    }
    double strains = 0.0, turns = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        S[i][j] = 0.5 * (slope[j][i] + slope[i][j]);
        W[i][j] = 0.5 * (slope[i][j] - slope[j][i]);
        strains += S[i][j] * S[i][j];
        turns += W[i][j] * W[i][j];
      }
    const double squared = 2.0 * strains - 2.0 / 3.0 * cell.dilatation * cell.dilatation;
    cell.strain = std::sqrt(std::max(squared, 0.0));
    cell.vorticity = std::sqrt(2.0 * turns);
    for (std::size_t i = 0; i < 3; ++i) S[i][i] -= cell.dilatation / 3.0;
    double cubes = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) cubes += S[i][j] * S[j][k] * S[k][i];
    cell.strainShape = squared > 0.0 ? cubes / (0.5 * squared * std::sqrt(0.5 * squared)) : 0.0;
    for (std::size_t i = 0; i < 3; ++i) S[i][i] -= cell.dilatation / 6.0;
    double stretching = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) stretching += W[i][j] * W[j][k] * S[k][i];
    cell.stretching = std::abs(stretching);
    strain_[c] = cell.strain;
  }
}

// Whether anything of it is another than when the cells were told last, on any rank. A pass of what is carried asks
// several times of one flow.
bool TurbulenceOperator::isOtherFlow(const State& state) {
  const auto follow = [](std::span<const double> now, std::vector<double>& last) {
    if (std::ranges::equal(now, last)) return 0;
    last.assign(now.begin(), now.end());
    return 1;
  };
  int others = follow(state.velocity, seen_.velocity) | follow(velocityGradient_.boundary(), seen_.boundary) |
               follow(state.swirl, seen_.swirl) | follow(state.density, seen_.density) |
               follow(properties_.viscosity, seen_.viscosity);
  MPI_Allreduce(MPI_IN_PLACE, &others, 1, MPI_INT, MPI_MAX, context_.mesh.comm);
  return others != 0;
}

// What velocities and densities tell of the cells.
void TurbulenceOperator::findFlow(const State& state) {
  const Mesh& m = context_.mesh;
  const auto d = static_cast<std::size_t>(m.dimension);
  velocityGradient_.setBoundary(state.velocity);
  if (!isOtherFlow(state)) return;
  areRatesKnown_ = false;
  velocityGradient_.compute(state.velocity);
  gradient_.compute(state.density, boundaryStrain_, 1, densityGradient_, knownDensity_);
  std::copy_n(state.density.begin(), cells_.size(), density_.begin());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    TurbulentCell& cell = cells_[c];
    cell.viscosity = properties_.viscosity[c] / state.density[c];
    if (model_->needsWallDistance()) cell.distance = context_.wallDistance[c];
    for (std::size_t i = 0; i < d; ++i) cell.densityGradient[i] = densityGradient_[c * d + i] / state.density[c];
  }
  if (options_.buoyancy) findBuoyancy(state);
  findShear(state);
  if (model_->needsStrainGradient()) addStrainGradient(state);
}

// What lighter gas below heavier one makes of eddies; of it a jet along gravity makes epsilon, a layer across it none.
void TurbulenceOperator::findBuoyancy(const State& state) {
  const Vector3& gravity = context_.gravity;
  const double g = length(gravity);
  if (!(g > 0.0)) return;
  const auto d = static_cast<std::size_t>(context_.mesh.dimension);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    TurbulentCell& cell = cells_[c];
    Vector3 velocity{};
    std::copy_n(&state.velocity[c * d], d, velocity.begin());
    const double along = std::abs(dot(velocity, gravity)) / g;
    const double across = std::sqrt(std::max(dot(velocity, velocity) - along * along, 0.0));
    cell.buoyancy = -dot(gravity, cell.densityGradient) / context_.eddies.schmidt;
    cell.buoyancyShare = across > 0.0 ? std::tanh(along / across) : along > 0.0 ? 1.0 : 0.0;
  }
}

// By the angular velocity, which has no slope at the axis: a gas that turns as a solid body has no strain.
void TurbulenceOperator::findTurning(const State& state) {
  const Mesh& m = context_.mesh;
  for (std::size_t c = 0; c < turning_.size(); ++c) turning_[c] = state.swirl[c] / m.centre[c][0];
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const auto b = static_cast<std::size_t>(face - m.interiorFaces);
    if (context_.boundaryOf(face).kind == BoundaryKind::Inlet)
      knownTurning_[b] = context_.isSuction(face) ? BoundaryData::Nothing : BoundaryData::Value;
    if (knownTurning_[b] == BoundaryData::Value)
      boundaryTurning_[b] = context_.boundarySwirl(face) / m.faceCentre[face][0];
  }
  gradient_.compute(turning_, boundaryTurning_, 1, turningGradient_, knownTurning_);
}

void TurbulenceOperator::addStrainGradient(const State& state) {
  const Mesh& m = context_.mesh;
  const auto d = static_cast<std::size_t>(m.dimension);
  for (int face = m.interiorFaces; face < m.faces; ++face)
    if (isSticky(face)) boundaryStrain_[face - m.interiorFaces] = strainAtWall(face, state);
  context_.halo.update(strain_, 1);
  for (std::size_t c = 0; c < strain_.size(); ++c) strainLog_[c] = std::log(std::max(strain_[c], leastStrain));
  for (std::size_t b = 0; b < boundaryStrain_.size(); ++b)
    boundaryStrainLog_[b] = std::log(std::max(boundaryStrain_[b], leastStrain));
  gradient_.compute(strainLog_, boundaryStrainLog_, 1, strainGradient_, knownStrain_);
  std::ranges::fill(strainSum_, 0.0);
  for (int face = 0; face < m.faces; ++face) {
    const bool isInside = m.high[face] >= 0;
    if (!isInside && !isSticky(face)) continue;
    const double beyond = isInside ? strainLog_[m.high[face]] : boundaryStrainLog_[face - m.interiorFaces];
    addFaceFlux(m, face, -m.area[face] / m.distance[face] * (beyond - strainLog_[m.low[face]]), 1.0, strainSum_);
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Vector3& slope = cells_[c].strainSlope;
    std::copy_n(&strainGradient_[c * d], d, slope.begin());
    cells_[c].strainBend = strainSum_[c] / m.volume[c] + dot(slope, slope);
  }
}

// 1/s, one-sided: along the wall, of the gas beside it.
double TurbulenceOperator::strainAtWall(int face, const State& state) const {
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  Vector3 rise{};
  for (int i = 0; i < d; ++i)
    rise[i] = state.velocity[d * m.low[face] + i] - velocityGradient_.boundary()[d * (face - m.interiorFaces) + i];
  const double across = dot(rise, m.normal[face]);
  double about = 0.0;
  if (state.swirls) {
    const double radius = m.faceCentre[face][0];
    about = radius * state.swirl[m.low[face]] / m.centre[m.low[face]][0] - context_.boundarySwirl(face);
  }
  return std::sqrt(std::max(dot(rise, rise) - across * across, 0.0) + about * about) / m.distance[face];
}

}  // namespace lampblack::flow
