// Turbulence and gradients: the strain's, and rates that a variable's own gradient makes.
#include <algorithm>
#include <array>
#include <cmath>

#include "flow/discretisation/face_fluxes.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"

namespace lampblack::flow {

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
  gradient_.compute(strain_, boundaryStrain_, 1, strainGradient_, knownStrain_);
  std::ranges::fill(strainSum_, 0.0);
  for (int face = 0; face < m.faces; ++face) {
    const bool isInside = m.high[face] >= 0;
    if (!isInside && !isSticky(face)) continue;
    const double beyond = isInside ? strain_[m.high[face]] : boundaryStrain_[face - m.interiorFaces];
    addFaceFlux(m, face, -m.area[face] / m.distance[face] * (beyond - strain_[m.low[face]]), 1.0, strainSum_);
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    cells_[c].strainLaplacian = strainSum_[c] / m.volume[c];
    std::copy_n(&strainGradient_[c * d], d, cells_[c].strainGradient.begin());
  }
}

// Of the state that was evaluated last. A rate that changes with the gradient of its variable moves the variable with
// the velocity -d rate/d gradient: -3 D |grad g|^2/g of omega's equation and the cross diffusion do so faster than the
// gas flows, and faster than they spread. Explicit in a long step that would swing.
void TurbulenceOperator::addCarriedFlow(std::span<double> flow) {
  constexpr double small = 1e-4;
  const Mesh& m = context_.mesh;
  const auto d = static_cast<std::size_t>(m.dimension);
  const std::size_t width = count_ * d, n = flow.size() / static_cast<std::size_t>(m.faces);
  drift_.assign(static_cast<std::size_t>(m.cells) * width, 0.0);
  std::ranges::copy(cells_, beside_.begin());
  for (std::size_t v = 0; v < count_; ++v)
    for (std::size_t i = 0; i < d; ++i) {
      const auto riseOf = [&](std::size_t c) { return small * length(cells_[c].gradients[v]); };
      for (std::size_t c = 0; c < cells_.size(); ++c) beside_[c].gradients[v][i] += riseOf(c);
      model_->evaluate(beside_, ratesBeside_);
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        beside_[c].gradients[v][i] = cells_[c].gradients[v][i];
        const bool isOfWallLaw = !layerArea_.empty() && layerArea_[c] > 0.0;
        if (!(riseOf(c) > 0.0) || isOfWallLaw) continue;
        const auto net = [&](const TurbulentRates& of) { return of.source[v] - of.sink[v] * cells_[c].values[v]; };
        drift_[c * width + v * d + i] = -density_[c] * (net(ratesBeside_[c]) - net(rates_[c])) / riseOf(c);
      }
    }
  context_.halo.update(drift_, static_cast<int>(width));
  for (int face = 0; face < m.faces; ++face) {
    const bool isInside = m.high[face] >= 0;
    if (!isInside && known_[static_cast<std::size_t>(face - m.interiorFaces)] != BoundaryData::Value) continue;
    const auto low = static_cast<std::size_t>(m.low[face]);
    const std::size_t high = isInside ? static_cast<std::size_t>(m.high[face]) : low;
    const double w = isInside ? m.lowWeight[face] : 1.0;
    for (std::size_t v = 0; v < count_; ++v) {
      double across = 0.0;
      for (std::size_t i = 0; i < d; ++i)
        across +=
            m.normal[face][i] * (w * drift_[low * width + v * d + i] + (1.0 - w) * drift_[high * width + v * d + i]);
      flow[static_cast<std::size_t>(face) * n + first_ + v] += across * m.area[face];
    }
  }
}

}  // namespace lampblack::flow
