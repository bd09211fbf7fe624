// Turbulence at walls: friction and y+, and where the law of the wall stands for the layers beside them its rates.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"

namespace lampblack::flow {
namespace {

constexpr double littleMore = 1e-6;  // of k, for the tangent of its dissipation

// y+ of the cells beside walls for which models of epsilon are no good by the law of both layers: within such a cell k
// rises from nothing to that of the logarithmic layer (docs/verification.md, channel).
constexpr std::array<double, 2> betweenLayers{3.0, 30.0};

bool isBetweenLayers(const TurbulenceModel& model, double yPlus) {
  return model.wallLaw() == WallLaw::Blended && model.secondVariable() == SecondVariable::Dissipation &&
         yPlus > betweenLayers[0] && yPlus < betweenLayers[1];
}

}  // namespace

bool TurbulenceOperator::isSticky(int face) const {
  return context_.boundaryOf(face).isNoSlipWall();
}

// Cells beside walls for which the law of the wall stands.
void TurbulenceOperator::findLayers() {
  const Mesh& m = context_.mesh;
  if (!model_->usesWallLaw()) return;
  for (int face = m.interiorFaces; face < m.faces; ++face)
    if (isSticky(face) && m.area[face] > 0.0) layerFaces_.push_back(face);
  layers_.resize(cells_.size());
  layerArea_.resize(cells_.size());
  dissipationBeside_.resize(cells_.size());
  for (const int face : layerFaces_) layerArea_[static_cast<std::size_t>(m.low[face])] += m.area[face];
}

// What the law makes of the cells beside walls; of several walls each has its share by area. By the blended law the
// shear there is the law's, too: differences know nothing of it.
void TurbulenceOperator::findWallLaw(const State& state) {
  const Mesh& m = context_.mesh;
  const bool isBlended = model_->wallLaw() == WallLaw::Blended;
  std::ranges::fill(layers_, walllaw::Layer{});
  std::ranges::fill(dissipationBeside_, 0.0);
  for (const int face : layerFaces_) {
    const auto c = static_cast<std::size_t>(m.low[face]);
    const double share = m.area[face] / layerArea_[c], distance = m.distance[face];
    const double energy = cells_[c].values[0], velocity = strainAtWall(face, state) * distance;
    const double viscosity = cells_[c].viscosity;
    const auto layerOf = [&](double k) {
      return isBlended ? walllaw::blendedLayer(k, velocity, viscosity, distance, model_->wallBeta())
                       : walllaw::layer(k, velocity, viscosity, distance);
    };
    const walllaw::Layer of = layerOf(energy);
    dissipationBeside_[c] += share * layerOf((1.0 + littleMore) * energy).dissipation;
    layers_[c].production += share * of.production;
    layers_[c].dissipation += share * of.dissipation;
    layers_[c].frequency += share * of.frequency;
    layers_[c].strain += share * of.strain;
  }
  if (!isBlended) return;
  for (std::size_t c = 0; c < cells_.size(); ++c)
    if (layerArea_[c] > 0.0) cells_[c].strain = cells_[c].vorticity = layers_[c].strain;
}

// In place of the model's rates in the cells beside walls. The dissipation, or omega, is held at the law's by a rate
// much faster than what else changes it, which leaves it that share wrong. What k loses goes with a power of k, and is
// taken by its tangent. Of models with epsilon the power is that of the law: one in the viscous layer, 3/2 in the
// logarithmic one, more where one passes into the other. Of models with omega it is 3/2 everywhere.
void TurbulenceOperator::applyWallLaw() {
  constexpr std::size_t energy = 0, second = 1;
  const bool isBlended = model_->wallLaw() == WallLaw::Blended;
  const bool holdsDissipation = model_->secondVariable() == SecondVariable::Dissipation;
  const double faster = isBlended && holdsDissipation ? walllaw::holdsFaster : 1e4;
  for (std::size_t c = 0; c < rates_.size(); ++c) {
    const double k = cells_[c].values[energy];
    if (!(layerArea_[c] > 0.0) || (holdsDissipation && !(k > 0.0))) continue;
    const double lost = layers_[c].dissipation;
    const double rate = isBlended ? walllaw::cMu * layers_[c].frequency : lost / k;
    const double held = holdsDissipation ? lost : 1.0 / std::sqrt(layers_[c].frequency);
    TurbulentRates& rates = rates_[c];
    const double power = holdsDissipation ? std::max((dissipationBeside_[c] / lost - 1.0) / littleMore, 1.0) : 1.5;
    rates.source[energy] = layers_[c].production + (power - 1.0) * lost;
    rates.sink[energy] = power * rate;
    rates.add(energy, -2.0 / 3.0 * k * cells_[c].dilatation, k);
    rates.source[second] = faster * rate * held;
    rates.sink[second] = faster * rate;
    slopes_[c] = {};
    for (const std::size_t v : {energy, second}) slopes_[c][v][v] = -rates.sink[v];
    if (holdsDissipation) slopes_[c][second][energy] = power * faster * rate * rate;
  }
}

TurbulenceOperator::WallState TurbulenceOperator::atWall(int face, const State& state) const {
  const Mesh& m = context_.mesh;
  const auto b = static_cast<std::size_t>(face - m.interiorFaces);
  const auto cell = static_cast<std::size_t>(m.low[face]);
  const bool isKnown = b < properties_.boundaryViscosity.size();
  const double viscosity = isKnown ? properties_.boundaryViscosity[b] : properties_.viscosity[cell];
  const double effective = isKnown ? properties_.effectiveBoundaryViscosity()[b] : viscosity;
  const double shear = effective * strainAtWall(face, state);
  return {shear, std::sqrt(shear * state.density[cell]) * m.distance[face] / viscosity};
}

// The largest speed is that of the state, of what comes in or of a wall that moves.
TurbulenceOperator::ThinCells TurbulenceOperator::thinCells(const State& state) const {
  constexpr double mostFriction = 0.1;
  const Mesh& m = context_.mesh;
  const auto d = static_cast<std::size_t>(m.dimension);
  ThinCells thin;
  for (const BoundaryCondition& boundary : context_.boundaries)
    thin.speed = std::max(thin.speed, std::hypot(boundary.speed, boundary.tangential, boundary.swirl));
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    double square = 0.0;
    for (std::size_t i = 0; i < d; ++i) square += state.velocity[c * d + i] * state.velocity[c * d + i];
    thin.speed = std::max(thin.speed, std::sqrt(square));
  }
  MPI_Allreduce(MPI_IN_PLACE, &thin.speed, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  std::array<double, 2> areas{};  // of all such walls, and of those with thin cells
  for (const int face : layerFaces_) {
    const auto c = static_cast<std::size_t>(m.low[face]);
    const double viscosity = properties_.viscosity[c] / state.density[c];
    const double yPlus = mostFriction * thin.speed * m.distance[face] / viscosity;
    areas[0] += m.area[face];
    if (yPlus >= walllaw::meeting) continue;
    areas[1] += m.area[face];
    thin.mostYPlus = std::max(thin.mostYPlus, yPlus);
  }
  MPI_Allreduce(MPI_IN_PLACE, areas.data(), 2, MPI_DOUBLE, MPI_SUM, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, &thin.mostYPlus, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  if (model_->wallLaw() == WallLaw::TwoLayers && thin.speed > 0.0 && areas[0] > 0.0) thin.share = areas[1] / areas[0];
  return thin;
}

std::vector<Quantity> TurbulenceOperator::historyColumns() const {
  return {{"y_plus_min", "1", "smallest y+ of the centres of cells beside walls; 0 without walls"},
          {"y_plus_mean", "1", "mean of y+ over the walls"},
          {"y_plus_max", "1", "largest y+"},
          {"y_plus_outside", "1", "share of the walls' area with y+ out of what the model is for"},
          {"wall_shear", "Pa", "friction of the gas along the walls, mean over them"},
          {"eddy_viscosity_ratio", "1", "largest eddy viscosity over that of the molecules"},
          {"negative_turbulence", "1", "cells in which a variable of the turbulence model is below zero"}};
}

std::vector<double> TurbulenceOperator::historyValues(const State& state) {
  const Mesh& m = context_.mesh;
  velocityGradient_.setBoundary(state.velocity);
  std::array<double, 2> extremes{-std::numeric_limits<double>::max(), 0.0};  // -least y+, largest y+
  std::array<double, 5> sums{};  // area, y+, shear, cells, area out of the range
  const auto [least, most] = range();
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (!isSticky(face) || m.area[face] <= 0.0) continue;
    const WallState wall = atWall(face, state);
    extremes[0] = std::max(extremes[0], -wall.yPlus);
    extremes[1] = std::max(extremes[1], wall.yPlus);
    sums[0] += m.area[face];
    sums[1] += m.area[face] * wall.yPlus;
    sums[2] += m.area[face] * wall.shear;
    if (wall.yPlus < least || wall.yPlus > most || isBetweenLayers(*model_, wall.yPlus)) sums[4] += m.area[face];
  }
  const std::size_t n = state.scalars.size();
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    for (std::size_t v = 0; v < count_; ++v)
      if (state.carried[c * n + first_ + v] < 0.0) {
        sums[3] += 1.0;
        break;
      }
  }
  MPI_Allreduce(MPI_IN_PLACE, extremes.data(), 2, MPI_DOUBLE, MPI_MAX, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 5, MPI_DOUBLE, MPI_SUM, m.comm);
  const bool hasWalls = sums[0] > 0.0;
  const Peak ratio = largestRatio(state);
  told_ = {hasWalls ? -extremes[0] : 0.0, extremes[1], hasWalls ? sums[4] / sums[0] : 0.0, ratio};
  return {told_.leastYPlus, hasWalls ? sums[1] / sums[0] : 0.0, told_.mostYPlus,
          told_.outside,    hasWalls ? sums[2] / sums[0] : 0.0, ratio.value,
          sums[3]};
}

Peak TurbulenceOperator::largestRatio(const State& state) const {
  return peakOf(context_.mesh, [&](int c) { return state.eddyViscosity[c] / properties_.viscosity[c]; });
}

void TurbulenceOperator::checkResult() const {
  refuseTooViscous(told_.ratio);
}

void TurbulenceOperator::checkEddies(const State& state) const {
  refuseTooViscous(largestRatio(state));
}

void TurbulenceOperator::refuseTooViscous(const Peak& ratio) const {
  if (ratio.value <= options_.mostRatio) return;
  const Mesh& m = context_.mesh;
  std::array<double, TurbulentCell::most> values{};
  values.fill(-std::numeric_limits<double>::max());
  for (std::size_t c = 0; c < cells_.size(); ++c)
    if (m.centre[c] == ratio.place) std::copy_n(&values_[c * count_], count_, values.begin());
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, m.comm);
  std::string with;
  const auto variables = model_->variables();
  for (std::size_t v = 0; v < count_; ++v)
    with += fmt::format(", {} {:.4g} {}", variables[v].name, values[v], variables[v].unit);
  raiseTogether(m.comm, NumericsError(fmt::format(
                            "in the cell at {}: the eddy viscosity is {:.3g} times that of the molecules, more than "
                            "{:.3g} (turbulence.largest_eddy_viscosity_ratio){}",
                            placeText(ratio.place, m.dimension), ratio.value, options_.mostRatio, with)));
}

std::array<double, 2> TurbulenceOperator::range() const {
  switch (model_->wallLaw()) {
    case WallLaw::TwoLayers:
      return {30.0, 300.0};
    case WallLaw::Blended:
      return {0.0, 300.0};
    default:
      return {0.0, 5.0};
  }
}

std::string TurbulenceOperator::warning() const {
  constexpr double smallest = 0.01;
  if (!(told_.outside > smallest)) return {};
  const auto [least, most] = range();
  const std::string expected =
      model_->wallLaw() == WallLaw::Blended
          ? fmt::format("the law of the wall, by which '{}' meets walls, holds up to {:g}{}", model_->name(), most,
                        model_->secondVariable() == SecondVariable::Dissipation
                            ? fmt::format("; between {:g} and {:g} its friction is several per cent wrong: thinner or "
                                          "thicker cells there",
                                          betweenLayers[0], betweenLayers[1])
                            : "")
      : model_->usesWallLaw() ? fmt::format(
                                    "the law of the wall, by which '{}' meets walls, holds from {:g} to {:g} and "
                                    "below {:.1f} makes less turbulence beside the wall, or none; "
                                    "'turbulence.walls: automatic' is for cells of any thickness",
                                    model_->name(), least, most, walllaw::meeting * std::numbers::sqrt2)
                              : fmt::format(
                                    "'{}', which resolves the layer beside walls, needs less than {:g} and better "
                                    "1",
                                    model_->name(), most);
  return fmt::format(
      "y+ of the cells beside walls is {:.3g} to {:.3g}, and on {:.0f} % of the walls' area out of what "
      "the turbulence model is for: {}",
      told_.leastYPlus, told_.mostYPlus, 100.0 * told_.outside, expected);
}

}  // namespace lampblack::flow
