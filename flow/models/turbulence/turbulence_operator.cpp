#include "flow/models/turbulence/turbulence_operator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace lampblack::flow {
namespace {

constexpr const char* owner = "turbulence";
// Of g beside a wall, which is linear: twice the value on even cells.
constexpr double mostRise = 3.0;

}  // namespace

ScalarBlock TurbulenceOperator::blockOf(const TurbulenceModel& model, const std::vector<BoundaryCondition>& conditions,
                                        const std::vector<FreeStream>& boundaries) {
  ScalarBlock block{.owner = owner, .scalars = {}, .givesEddies = true, .wallLaw = model.wallLaw()};
  for (const TurbulenceModel::Variable& variable : model.variables())
    block.scalars.push_back({.name = variable.name,
                             .unit = variable.unit,
                             .description = variable.description,
                             .isStirred = false,
                             .wallDiffusivity = variable.wallDiffusivity});
  for (std::size_t s = 0; s < block.scalars.size(); ++s)
    for (std::size_t b = 0; b < conditions.size(); ++b) {
      ScalarBoundary boundary;
      const BoundaryKind kind = conditions[b].kind;
      if (kind == BoundaryKind::Inlet || kind == BoundaryKind::Outlet)
        boundary.value = model.freeStream(boundaries[b])[s];
      if (boundaries[b].varies())
        boundary.varies = [&model, stream = boundaries[b], s](const Vector3& place, double) {
          return model.freeStream(stream.at(place))[s];
        };
      const bool isResolved = conditions[b].isNoSlipWall() && !model.usesWallLaw();
      boundary.isHeld = kind == BoundaryKind::Inlet || isResolved;
      block.scalars[s].boundaries.push_back(boundary);
    }
  return block;
}

TurbulenceOperator::TurbulenceOperator(const FlowContext& context, const State& state,
                                       std::shared_ptr<const TurbulenceModel> model, const GasProperties& properties,
                                       const Options& options)
    : context_(context),
      model_(std::move(model)),
      properties_(properties),
      options_(options),
      first_(static_cast<std::size_t>(state.block(owner).first)),
      count_(static_cast<std::size_t>(state.block(owner).count)),
      velocityGradient_(context),
      gradient_(context.mesh) {
  const Mesh& m = context.mesh;
  const auto cells = static_cast<std::size_t>(m.cells), owned = static_cast<std::size_t>(m.owned);
  const auto faces = static_cast<std::size_t>(m.boundaryFaces()), d = static_cast<std::size_t>(m.dimension);
  if (model_->needsWallDistance() && context.wallDistance.size() != owned)
    throw std::logic_error("a model of turbulence without the distances from walls");
  cells_.resize(owned);
  rates_.resize(owned);
  modelled_.resize(owned);
  beside_.resize(owned);
  ratesBeside_.resize(owned);
  slopes_.resize(owned);
  density_.resize(owned);
  values_.resize(cells * count_);
  boundaryValues_.resize(faces * count_);
  valueGradient_.resize(cells * count_ * d);
  densityGradient_.resize(cells * d);
  strain_.resize(cells);
  boundaryStrain_.resize(faces);
  strainLog_.resize(cells);
  boundaryStrainLog_.resize(faces);
  strainGradient_.resize(cells * d);
  strainSum_.resize(owned);
  if (count_ == 2) beyond_.resize(owned);
  if (state.swirls) {
    turning_.resize(cells);
    boundaryTurning_.resize(faces);
    turningGradient_.resize(cells * d);
  }
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const auto b = static_cast<std::size_t>(face - m.interiorFaces);
    const BoundaryKind kind = context.boundaryOf(face).kind;
    const bool isSlip = kind == BoundaryKind::Wall && !isSticky(face);
    const BoundaryData open =
        kind == BoundaryKind::Symmetry || isSlip ? BoundaryData::ZeroSlope : BoundaryData::Nothing;
    knownDensity_.push_back(open);
    knownStrain_.push_back(isSticky(face) ? BoundaryData::Value : open);
    knownTurning_.push_back(isSticky(face) || kind == BoundaryKind::Inlet ? BoundaryData::Value : open);
    const auto patch = static_cast<std::size_t>(m.patch[b]);
    known_.push_back(state.scalars[first_].boundaries[patch].isHeld ? BoundaryData::Value : open);
    for (std::size_t v = 0; v < count_; ++v)
      boundaryValues_[b * count_ + v] =
          state.scalars[first_ + v].boundaries[patch].at(m.faceCentre[static_cast<std::size_t>(face)]);
  }
  findLayers();
}

void TurbulenceOperator::setStart(State& state, const FreeStream& start, std::span<const FieldFunction> fields) {
  const bool isSheared = fields.empty() && model_->knowsEnergy();
  if (isSheared) {
    context_.halo.update(state.velocity, context_.mesh.dimension);
    if (state.swirls) context_.halo.update(state.swirl, 1);
    velocityGradient_.setBoundary(state.velocity);
    velocityGradient_.compute(state.velocity);
    findShear(state);
    context_.halo.update(strain_, 1);
  }
  const std::size_t n = state.scalars.size();
  FreeStream stream = start;
  for (std::size_t c = 0; c < state.density.size(); ++c) {
    if (isSheared && strain_[c] > 0.0)
      stream.eddyViscosity = std::min(start.eddyViscosity, std::sqrt(walllaw::cMu) * start.energy / strain_[c]);
    const auto values = model_->freeStream(stream);
    const auto given = [&](std::size_t f) { return fields[f](context_.mesh.centre[c], 0.0); };
    for (std::size_t v = 0; v < count_; ++v)
      state.carried[c * n + first_ + v] = state.density[c] * (fields.empty() ? values[v] : given(v));
    state.eddyViscosity[c] = fields.empty() ? state.density[c] * stream.eddyViscosity : given(count_);
  }
}

void TurbulenceOperator::advance(State& state, double, double dt) {
  constexpr double longest = 4.0;
  evaluate(state, Tangents::Unused);
  for (std::size_t c = 0; c < rates_.size(); ++c) {
    const double share = 1.0 / (1.0 + std::min(cells_[c].strain * dt, longest));
    double& eddies = state.eddyViscosity[c];
    eddies += share * (state.density[c] * rates_[c].eddyViscosity - eddies);
  }
  context_.halo.update(state.eddyViscosity, 1);
}

// What the model's own variables tell of the cells, and its rates.
void TurbulenceOperator::findRates(const State& state) {
  const auto d = static_cast<std::size_t>(context_.mesh.dimension);
  const std::size_t n = state.scalars.size();
  bool isKnown = areRatesKnown_;
  for (std::size_t c = 0; c < state.density.size(); ++c)
    for (std::size_t v = 0; v < count_; ++v) {
      const double value = state.carried[c * n + first_ + v] / state.density[c];
      isKnown = isKnown && value == values_[c * count_ + v];
      values_[c * count_ + v] = value;
    }
  if (isKnown) {
    std::ranges::copy(modelled_, rates_.begin());
    return;
  }
  gradient_.compute(values_, boundaryValues_, static_cast<int>(count_), valueGradient_, known_);
  if (count_ == 2) gradient_.beyond(values_, boundaryValues_, valueGradient_, known_, mostRise, beyond_);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    TurbulentCell& cell = cells_[c];
    std::copy_n(&values_[c * count_], count_, cell.values.begin());
    if (count_ == 2) {
      cell.productBeyond = beyond_[c].product;
      cell.squareBeyond = beyond_[c].square;
    }
    for (std::size_t v = 0; v < count_; ++v)
      for (std::size_t i = 0; i < d; ++i) cell.gradients[v][i] = valueGradient_[(c * count_ + v) * d + i];
  }
  if (count_ == 1 && model_->needsStrainGradient()) findNeighbours();
  if (model_->usesWallLaw()) findWallLaw(state);
  model_->evaluate(cells_, rates_);
  std::ranges::copy(rates_, modelled_.begin());
  areRatesKnown_ = true;
}

// Towards which the variable rises and falls most steeply, with the values that are held at boundaries.
void TurbulenceOperator::findNeighbours() {
  const Mesh& m = context_.mesh;
  for (TurbulentCell& cell : cells_) {
    cell.knowsNeighbours = true;
    cell.above = cell.below = std::nullopt;
  }
  const auto see = [&](int c, double value, double distance) {
    if (c < 0 || c >= m.owned) return;
    TurbulentCell& cell = cells_[static_cast<std::size_t>(c)];
    const double own = cell.values[0], slope = (value - own) / distance;
    const auto towards = [&](const std::optional<TurbulentCell::Neighbour>& other) {
      return other ? (other->value - own) / other->distance : 0.0;
    };
    if (slope > towards(cell.above)) cell.above = {value, distance};
    if (slope < towards(cell.below)) cell.below = {value, distance};
  };
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face], high = m.high[face];
    const int boundary = face - m.interiorFaces;
    if (high < 0 && known_[boundary] != BoundaryData::Value) continue;
    see(low, high < 0 ? boundaryValues_[boundary] : values_[high], m.spacing(face));
    see(high, values_[low], m.spacing(face));
  }
}

void TurbulenceOperator::evaluate(const State& state, Tangents tangents) {
  findFlow(state);
  findRates(state);
  if (tangents == Tangents::Wanted) linearise();
  if (model_->usesWallLaw()) applyWallLaw();
}

void TurbulenceOperator::add(const State& state, State::Balance& rates) const {
  const std::size_t n = state.scalars.size();
  for (std::size_t c = 0; c < rates_.size(); ++c)
    for (std::size_t v = 0; v < count_; ++v) {
      rates.carried[c * n + first_ + v] += state.density[c] * rates_[c].source[v];
      rates.carriedSink[c * n + first_ + v] += rates_[c].sink[v];
    }
}

void TurbulenceOperator::addRates(const State& state, State::Balance& rates) {
  evaluate(state, Tangents::Wanted);
  add(state, rates);
}

void TurbulenceOperator::addRatesOfCarried(const State& state, State::Balance& rates) {
  findRates(state);
  if (model_->usesWallLaw()) applyWallLaw();
  add(state, rates);
}

// Of the owned cells, as evaluated.
void TurbulenceOperator::storeDiffusivities(State& state) const {
  const std::size_t n = state.scalars.size();
  for (std::size_t c = 0; c < rates_.size(); ++c)
    for (std::size_t v = 0; v < count_; ++v) state.carriedDiffusivity[c * n + first_ + v] = rates_[c].diffusivity[v];
}

void TurbulenceOperator::endSweep(State& state) {
  evaluate(state, Tangents::Wanted);
  add(state, state.balance);
  storeDiffusivities(state);
  context_.halo.update(state.carriedDiffusivity, static_cast<int>(state.scalars.size()));
}

void TurbulenceOperator::setDiffusivities(State& state) {
  state.updateHalo(context_.halo);
  evaluate(state, Tangents::Unused);
  storeDiffusivities(state);
  for (std::size_t c = 0; c < rates_.size(); ++c) state.eddyViscosity[c] = state.density[c] * rates_[c].eddyViscosity;
}

Eddies TurbulenceOperator::eddies(const State& state, int cell, bool ofShear) const {
  const auto c = static_cast<std::size_t>(cell);
  const double perMass = 1.0 / state.density[c];
  Eddies eddies;
  eddies.viscosity = properties_.viscosity[c] * perMass;
  eddies.eddyViscosity = state.eddyViscosity[c] * perMass;
  if (ofShear) {
    eddies.energy = eddies.eddyViscosity * cells_[c].strain / std::sqrt(walllaw::cMu);
    eddies.dissipation = eddies.eddyViscosity * cells_[c].strain * cells_[c].strain;
    return eddies;
  }
  std::array<double, TurbulentCell::most> variables{};
  for (std::size_t v = 0; v < count_; ++v)
    variables[v] = state.carried[c * state.scalars.size() + first_ + v] * perMass;
  eddies.energy = variables[0];
  eddies.dissipation = model_->dissipation(variables).value_or(0.0);
  return eddies;
}

void TurbulenceOperator::fields(const State& state, const FieldSink& sink) const {
  const std::size_t n = state.scalars.size();
  std::vector<double> column(cells_.size());
  for (std::size_t v = 0; v < count_; ++v) {
    const CarriedScalar& scalar = state.scalars[first_ + v];
    for (std::size_t c = 0; c < column.size(); ++c) column[c] = state.carried[c * n + first_ + v] / state.density[c];
    sink({scalar.name, scalar.unit, scalar.description}, column);
  }
  if (!model_->knowsEnergy()) return;
  for (std::size_t c = 0; c < column.size(); ++c)
    column[c] = state.pressure[c] - 2.0 / 3.0 * state.carried[c * n + first_];
  sink({"static_pressure", "Pa", "hydrodynamic pressure less 2/3 rho k, which the pressure of the flow holds"}, column);
}

}  // namespace lampblack::flow
