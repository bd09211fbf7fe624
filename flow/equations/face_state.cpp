#include "flow/equations/face_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "flow/discretisation/limiter.hpp"

namespace lampblack::flow {
namespace {

// Gas that is drawn in through an outlet is known, gas that leaves is not. `fed`: of what is fed with a given flux
// alone.
std::vector<BoundaryData> knownData(const FlowContext& context, bool isOfTemperature, BoundaryData fed) {
  std::vector<BoundaryData> known;
  for (int face = context.mesh.interiorFaces; face < context.mesh.faces; ++face) {
    const BoundaryCondition& boundary = context.boundaryOf(face);
    const bool isWall = boundary.kind == BoundaryKind::Wall || boundary.kind == BoundaryKind::Symmetry;
    const bool isGiven = !isWall || (isOfTemperature && boundary.kind == BoundaryKind::Wall && boundary.isothermal);
    const bool hasFlux = isOfTemperature && (boundary.heatFlux != 0.0 || boundary.varies.heatFlux);
    const bool isHeld = isOfTemperature ? boundary.kind != BoundaryKind::Outlet : context.isCompositionGiven(face);
    known.push_back(!isGiven && hasFlux ? BoundaryData::Nothing
                    : !isGiven          ? BoundaryData::ZeroSlope
                    : isHeld            ? BoundaryData::Value
                                        : fed);
  }
  return known;
}

// What lies at a face through which gas comes in with a given flux, where diffusion may have changed it: between the
// cell and what is fed, and no further than the slope on the cell's other side leads.
double behindFeed(double cell, double fed, double extrapolated) {
  const double byFeed = fed - cell, bySlope = extrapolated - cell;
  if (!(byFeed * bySlope > 0.0)) return cell;
  return cell + (std::abs(byFeed) < std::abs(bySlope) ? byFeed : bySlope);
}

}  // namespace

FaceState::FaceState(const FlowContext& context, const State& state)
    : context_(context),
      species_(state.species),
      carried_(state.carriedCount()),
      carriedBoundaries_(context, state),
      gradient_(context.mesh),
      temperatureKnown_(knownData(context, true, BoundaryData::Value)),
      YKnown_(knownData(context, false, BoundaryData::Value)),
      temperatureHeld_(knownData(context, true, BoundaryData::Nothing)),
      YHeld_(knownData(context, false, BoundaryData::Nothing)),
      temperatureUpwind_(context, temperatureKnown_),
      YUpwind_(context, YKnown_),
      YGradient_(context, species_),
      temperatureBounds_(context, 1),
      YBounds_(context, species_),
      carriedBounds_(context, carried_) {
  const Mesh& m = context.mesh;
  const auto faces = static_cast<std::size_t>(m.faces);
  const auto boundary = static_cast<std::size_t>(m.boundaryFaces());
  const auto cells = static_cast<std::size_t>(m.cells);
  temperature.resize(faces);
  density.resize(faces);
  enthalpy.resize(faces);
  for (std::vector<double>* row : {&slope_, &offsetSlope_}) row->resize(static_cast<std::size_t>(species_));
  boundaryTemperature_.resize(boundary);
  boundaryY_.resize(boundary * species_);
  boundaryCarried_.resize(boundary * carried_);
  perMass_.resize(cells * carried_);
  temperatureGradient_.resize(cells * m.dimension);
  carriedGradient_.resize(cells * carried_ * m.dimension);
}

void FaceState::setBoundaries(const State& state) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    const int b = face - m.interiorFaces;
    const int c = m.low[face];
    if (boundary.kind == BoundaryKind::Outlet)
      temperatureKnown_[b] = YKnown_[b] = state.massFlux[face] < 0.0 ? BoundaryData::Value : BoundaryData::Nothing;
    if (boundary.kind == BoundaryKind::Inlet)
      temperatureKnown_[b] = YKnown_[b] = context_.isSuction(face) ? BoundaryData::Nothing : BoundaryData::Value;
    const bool isTemperatureGiven = temperatureKnown_[b] == BoundaryData::Value;
    const bool isYGiven = YKnown_[b] == BoundaryData::Value;
    boundaryTemperature_[b] = isTemperatureGiven ? context_.boundaryTemperature(face) : state.temperature[c];
    std::copy_n(isYGiven ? context_.boundaryY(face).data() : &Y_[c * species_], species_, &boundaryY_[b * species_]);
    const std::span<const ScalarBoundary> given = carriedBoundaries_.at(face);
    for (int s = 0; s < carried_; ++s)
      boundaryCarried_[b * carried_ + s] = isYGiven ? given[s].value : perMass_[c * carried_ + s];
  }
  for (int face = m.interiorFaces; face < m.faces; ++face) limitFed(state, face);
  if (carried_ > 0) setCarriedBoundaries();
}

// Where scalars are held: at inlets as they are, at walls by a layer next to them, of which the cells see nothing.
void FaceState::setCarriedBoundaries() {
  const Mesh& m = context_.mesh;
  const int each = carriedBoundaries_.areAlike() ? 1 : carried_;
  carriedKnown_.resize(YKnown_.size() * static_cast<std::size_t>(each));
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int b = face - m.interiorFaces;
    std::fill_n(&carriedKnown_[static_cast<std::size_t>(b * each)], each, YKnown_[b]);
    if (!carriedBoundaries_.holdsAny(face)) continue;
    const bool isWall = context_.boundaryOf(face).kind == BoundaryKind::Wall;
    const std::span<const ScalarBoundary> given = carriedBoundaries_.at(face);
    for (int s = 0; s < carried_; ++s) {
      if (!given[s].isHeld) continue;
      if (isWall)
        carriedKnown_[b * each + s % each] = BoundaryData::Nothing;
      else if (YKnown_[b] == BoundaryData::Value)
        boundaryCarried_[b * carried_ + s] = given[s].value;
    }
  }
}

void FaceState::limitFed(const State& state, int face) {
  const Mesh& m = context_.mesh;
  const int b = face - m.interiorFaces, c = m.low[face];
  const auto limit = [&](std::span<const double> values, std::span<double> atFaces, int components,
                         const std::vector<BoundaryData>& known, const std::vector<BoundaryData>& held) {
    if (known[b] != BoundaryData::Value || held[b] == BoundaryData::Value || components == 0) return;
    feedSlope_.resize(static_cast<std::size_t>(components));
    gradient_.along(m.step[face], c, values, atFaces, components, feedSlope_, held);
    for (int k = 0; k < components; ++k) {
      const double cell = values[c * components + k];
      double& atFace = atFaces[b * components + k];
      atFace = behindFeed(cell, atFace, cell + feedSlope_[k]);
    }
  };
  limit(state.temperature, boundaryTemperature_, 1, temperatureKnown_, temperatureHeld_);
  limit(Y_, boundaryY_, species_, YKnown_, YHeld_);
  limit(perMass_, boundaryCarried_, carried_, YKnown_, YHeld_);
}

void FaceState::findPerMass(const State& state) {
  for (int c = 0; c < context_.mesh.cells; ++c)
    for (int s = 0; s < carried_; ++s) perMass_[c * carried_ + s] = state.carried[c * carried_ + s] / state.density[c];
}

void FaceState::prepareCarried(const State& state) {
  const Mesh& m = context_.mesh;
  findPerMass(state);
  setBoundaries(state);
  gradient_.compute(perMass_, boundaryCarried_, carried_, carriedGradient_, carriedKnown_);
  keepAmountsAtWalls();
  context_.halo.update(carriedGradient_, m.dimension * carried_);
  if (m.isSkewed()) carriedBounds_.prepare(perMass_, boundaryCarried_, YKnown_);
}

void FaceState::prepare(const State& state, std::span<const double> Y) {
  const Mesh& m = context_.mesh;
  Y_ = Y;
  findPerMass(state);
  setBoundaries(state);
  gradient_.compute(state.temperature, boundaryTemperature_, 1, temperatureGradient_, temperatureKnown_);
  std::vector<FieldView> gradients{{temperatureGradient_, m.dimension}};
  if (carried_ > 0) {
    gradient_.compute(perMass_, boundaryCarried_, carried_, carriedGradient_, carriedKnown_);
    keepAmountsAtWalls();
    gradients.push_back({carriedGradient_, m.dimension * carried_});
  }
  context_.halo.update(gradients);
  YGradient_.prepare(Y_, boundaryY_, YKnown_);
  if (!m.isSkewed()) return;
  temperatureBounds_.prepare(state.temperature, boundaryTemperature_, temperatureKnown_);
  YBounds_.prepare(Y_, boundaryY_, YKnown_);
  if (carried_ > 0) carriedBounds_.prepare(perMass_, boundaryCarried_, YKnown_);  // what walls hold does not count
}

bool FaceState::enters(int face, double direction) const {
  const BoundaryCondition& boundary = context_.boundaryOf(face);
  return boundary.kind == BoundaryKind::Inlet ? !context_.isSuction(face)
                                              : boundary.kind == BoundaryKind::Outlet && direction < 0.0;
}

void FaceState::massFractions(int face, double direction, std::span<double> row) const {
  const Mesh& m = context_.mesh;
  const int n = species_;
  if (m.high[face] < 0) {
    std::copy_n(
        enters(face, direction) ? context_.boundaryY(face).data() : &Y_[static_cast<std::size_t>(m.low[face]) * n], n,
        row.begin());
    return;
  }
  const Upwind u = YUpwind_.of(face, direction);
  YGradient_.along(u.direction, u.up, slope_);
  const double* up = &Y_[static_cast<std::size_t>(u.up) * n];
  const double* down = &Y_[static_cast<std::size_t>(u.down) * n];
  for (int k = 0; k < n; ++k) row[k] = limitedFaceValue(up[k], down[k], slope_[k], u);
  if (m.isSkewed()) {
    YGradient_.along(m.offset[face], u.up, offsetSlope_);
    const double* smallest = YBounds_.smallest(u.up);
    const double* largest = YBounds_.largest(u.up);
    for (int k = 0; k < n; ++k)
      row[k] = boundedFaceValue(row[k] + limitedOffset(row[k], up[k], slope_[k], offsetSlope_[k], u), up[k],
                                smallest[k], largest[k]);
  }
  double sum = 0.0;
  for (int k = 0; k < n; ++k) sum += row[k];
  const double scale = 1.0 / sum;
  for (int k = 0; k < n; ++k) row[k] *= scale;
}

void FaceState::interpolate(const State& state, int face, double direction, std::span<double> row) {
  const Mesh& m = context_.mesh;
  massFractions(face, direction, row);
  if (m.high[face] >= 0) {
    temperature[face] = limited(temperatureUpwind_.of(face, direction), face, state.temperature, temperatureGradient_,
                                temperatureBounds_);
  } else {
    temperature[face] = enters(face, direction) ? context_.boundaryTemperature(face) : state.temperature[m.low[face]];
  }
  density[face] = context_.thermo.density(temperature[face], state.thermodynamicPressure, row);
  enthalpy[face] = context_.thermo.enthalpyMass(temperature[face], row);
}

double FaceState::carriedPerMass(int face, int scalar, double direction) const {
  return limited(YUpwind_.of(face, direction), face, perMass_, carriedGradient_, carriedBounds_, carried_, scalar);
}

// What a wall holds has in the cells beside it the slope of the cell's other side, which may lead to less than nothing
// at the wall. With that slope the face on the other side would take from a cell that has nothing.
void FaceState::keepAmountsAtWalls() {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (!carriedBoundaries_.holdsAny(face) || context_.boundaryOf(face).kind != BoundaryKind::Wall) continue;
    const std::span<const ScalarBoundary> given = carriedBoundaries_.at(face);
    const Vector3& step = m.step[face];
    for (int s = 0; s < carried_; ++s) {
      const int i = m.low[face] * carried_ + s;
      double* gradient = &carriedGradient_[static_cast<std::size_t>(i) * m.dimension];
      const double lacks = -std::max(perMass_[i], 0.0) - slopeAlong(step, gradient, m.dimension);
      if (!given[s].isHeld || lacks <= 0.0) continue;
      for (int axis = 0; axis < m.dimension; ++axis) gradient[axis] += lacks / dot(step, step) * step[axis];
    }
  }
}

double FaceState::carriedRiseToWall(int face, int scalar) const {
  const Mesh& m = context_.mesh;
  const int i = m.low[face] * carried_ + scalar;
  const double present = std::max(perMass_[i], 0.0);
  return std::clamp(slopeAlong(m.step[face], &carriedGradient_[static_cast<std::size_t>(i) * m.dimension], m.dimension),
                    -present, present);
}

double FaceState::limited(const Upwind& u, int face, std::span<const double> values, std::span<const double> gradient,
                          const NeighbourBounds& bounds, int components, int component) const {
  const Mesh& m = context_.mesh;
  const double* ofUp = &gradient[static_cast<std::size_t>(u.up * components + component) * m.dimension];
  const double up = values[u.up * components + component];
  const double slope = slopeAlong(u.direction, ofUp, m.dimension);
  const double value = limitedFaceValue(up, values[u.down * components + component], slope, u);
  if (!m.isSkewed()) return value;
  const double wanted = value + limitedOffset(value, up, slope, slopeAlong(m.offset[face], ofUp, m.dimension), u);
  return boundedFaceValue(wanted, up, bounds.smallest(u.up)[component], bounds.largest(u.up)[component]);
}

}  // namespace lampblack::flow
