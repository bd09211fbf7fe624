#include "flow/equations/momentum_forces.hpp"

#include <algorithm>
#include <cmath>

#include "flow/discretisation/limiter.hpp"

namespace lampblack::flow {

MomentumForces::MomentumForces(const FlowContext& context, bool swirls, VelocityScheme scheme)
    : context_(context),
      dimension_(context.mesh.dimension),
      scheme_(scheme),
      gradient_(context),
      diffusion_(context.mesh, context.halo),
      pressureKnown_(pressureData(context)),
      pressureForce_(context, pressureKnown_) {
  const Mesh& m = context.mesh;
  boundaryPressure_.assign(m.boundaryFaces(), 0.0);
  pressureGradient_.resize(static_cast<std::size_t>(m.cells) * static_cast<std::size_t>(dimension_));
  relaxation_.resize(static_cast<std::size_t>(m.cells));
  for (int i = 0; i < dimension_; ++i) upwind_.emplace_back(context, gradient_.known(i));
  if (swirls) swirl_.emplace(context, pressureKnown_);
}

std::vector<BoundaryData> MomentumForces::pressureData(const FlowContext& context) {
  std::vector<BoundaryData> known;
  for (int face = context.mesh.interiorFaces; face < context.mesh.faces; ++face) {
    const BoundaryKind kind = context.boundaryOf(face).kind;
    known.push_back(kind == BoundaryKind::Outlet     ? BoundaryData::Value
                    : kind == BoundaryKind::Symmetry ? BoundaryData::ZeroSlope
                                                     : BoundaryData::Nothing);
  }
  return known;
}

// Gas that leaves meets the ambient pressure, zero; gas that is drawn in has been accelerated from rest, so that its
// total pressure is zero (Bernoulli), which also keeps entrainment from running away.
void MomentumForces::outletPressures(const State& state) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    if (boundary.kind != BoundaryKind::Outlet) continue;
    double pressure = 0.0;
    if (state.massFlux[face] < 0.0) {
      const double rho = context_.thermo.density(context_.boundaryTemperature(face), state.thermodynamicPressure,
                                                 context_.boundaryY(face));
      const double velocity = state.massFlux[face] / (rho * m.area[face]);
      pressure = -0.5 * rho * velocity * velocity;
    }
    boundaryPressure_[face - m.interiorFaces] = pressure;
  }
}

void MomentumForces::assemble(const State& state, const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  const std::vector<double>& density = sweep.start.density;
  const std::vector<double>& velocity = sweep.mean.velocity;
  const std::span<const double> viscosity = sweep.viscosity;
  gradient_.setBoundary(velocity);
  outletPressures(sweep.mean);
  const int d = dimension_;
  gradient_.compute(velocity);
  gradient_.updateHalo();
  pressureForce_.compute(state.pressure, boundaryPressure_, pressureGradient_);
  if (swirl_) swirl_->completeOuterSlopes(density, pressureGradient_);

  std::fill(relaxation_.begin(), relaxation_.end(), 0.0);
  diagonal_.assign(d * m.owned, 0.0);
  source_.assign(d * m.owned, 0.0);
  conductance_.assign(static_cast<std::size_t>(m.interiorFaces) * d, 0.0);
  for (int c = 0; c < m.owned; ++c) {
    for (int i = 0; i < d; ++i)
      source_[d * c + i] = m.volume[c] * (context_.bodyForce(density[c], i) - pressureGradient_[d * c + i]);
    if (swirl_) source_[d * c] += m.volume[c] * density[c] * swirl_->centrifugal(c);
    // Hoop stress 2 mu v_r / r^2 (its dilatation part is explicit).
    if (m.axisymmetric()) diagonal_[d * c] += 2.0 * viscosity[c] * m.planarArea[c] / m.centre[c][0];
  }
  for (int face = 0; face < m.interiorFaces; ++face) addInside(face, sweep);
  for (int face = m.interiorFaces; face < m.faces; ++face) addBoundary(face, sweep);
  for (int c = 0; c < m.owned; ++c) relaxation_[c] /= density[c] * m.volume[c];
  addLastSweepsViscosity(state, sweep);
  explicitStress(sweep);
  outletStress(sweep);
}

// What a mass flux carries of a component through an interior face.
double MomentumForces::carriedVelocity(int face, double flux, int component, std::span<const double> velocity) const {
  const Mesh& m = context_.mesh;
  const int d = dimension_;
  const Upwind u = upwind_[component].of(face, flux);
  const double* ofUp = gradient_.of(u.up, component);
  const double up = velocity[d * u.up + component], down = velocity[d * u.down + component];
  const double slope = slopeAlong(u.direction, ofUp, d);
  const double slopeBeyond = slopeAlong(u.direction, gradient_.of(u.down, component), d);
  if (scheme_ == VelocityScheme::Central) {
    const double value = centralFaceValue(up, down, slope, slopeBeyond, u);
    const bool isLed = m.isSkewed() && isCentreInReach(m, face);
    return isLed ? value + faceSlope(m, face, m.offset[face], gradient_.values(), d, component) : value;
  }
  // Curvatures are no measure of smoothness on cells without order: along the slope, and where steps between cells with
  // opposite sides miss the faces' centres along the parabola through both values (riseToCentre says why).
  if (m.isSkewed() && m.betweenOpposite[face] != 0) {
    const double share = u.toFace / u.ahead, linear = up + share * (down - up);
    if (!isCentreInReach(m, face)) return linear;
    return linear + (1.0 - share) * (u.toFace * slope - share * (down - up)) + slopeAlong(m.offset[face], ofUp, d);
  }
  const double value =
      m.isOblique() || m.isSkewed() ? up + u.toFace * slope : smoothFaceValue(up, down, slope, slopeBeyond, u);
  return m.isSkewed() ? value + slopeAlong(m.offset[face], ofUp, d) : value;
}

// Convection in advective form, of the difference to the cell's own velocity, and implicit viscosity.
void MomentumForces::addInside(int face, const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  const int d = dimension_, low = m.low[face], high = m.high[face];
  const std::vector<double>& velocity = sweep.mean.velocity;
  const double flux = sweep.mean.massFlux[face];
  const double mu = m.lowWeight[face] * sweep.viscosity[low] + (1.0 - m.lowWeight[face]) * sweep.viscosity[high];
  const bool isWithoutOrder = m.isOblique() || m.isSkewed();
  for (int i = 0; i < d; ++i) {
    const double value = carriedVelocity(face, flux, i, velocity);
    double force = 0.0;
    if (m.isOblique()) force = mu * m.area[face] * faceSlope(m, face, m.oblique[face], gradient_.values(), d, i);
    if (low < m.owned) source_[d * low + i] += force - flux * (value - velocity[d * low + i]);
    if (high < m.owned) source_[d * high + i] -= force - flux * (value - velocity[d * high + i]);
    conductance_[d * face + i] = mu * m.area[face] / m.distance[face];
  }
  // On cells without order the pressure makes up for what interpolated velocities lack: the less, the longer a face's
  // deviation lasts. A tenth: errors of the pressure a fourth of what they are with the whole, those of the velocities
  // the same (docs/theory/flow.md).
  const double viscousShare = isWithoutOrder ? 0.1 : 1.0;
  for (const int cell : {low, high})
    if (cell < m.owned) relaxation_[cell] += viscousShare * conductance_[d * face] + 0.5 * std::abs(flux);
}

void MomentumForces::addBoundary(int face, const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  const int d = dimension_, cell = m.low[face];
  const double* own = &sweep.mean.velocity[d * cell];
  const double* beyond = &gradient_.boundary()[d * (face - m.interiorFaces)];
  const double flux = sweep.mean.massFlux[face];
  relaxation_[cell] += 0.5 * std::abs(flux);
  const GivenVelocity given = givenVelocity(context_.boundaryOf(face));
  if (given == GivenVelocity::Nothing) return;
  const double mu = sweep.boundaryViscosity[face - m.interiorFaces];
  const double conductance = mu * m.area[face] / m.distance[face];
  for (int i = 0; i < d; ++i) {
    // Where only the normal velocity is given it is what pulls, each component by its share.
    const double share = given == GivenVelocity::All ? 1.0 : m.normal[face][i] * m.normal[face][i];
    if (share == 0.0) continue;
    diagonal_[d * cell + i] += conductance * share;
    relaxation_[cell] += 0.5 * conductance * share;
    source_[d * cell + i] += conductance * (beyond[i] - (1.0 - share) * own[i]) - flux * (beyond[i] - own[i]);
    if (m.isOblique() && given == GivenVelocity::All)
      source_[d * cell + i] += mu * m.area[face] * faceSlope(m, face, m.oblique[face], gradient_.values(), d, i);
  }
}

// What the implicit viscosity is corrected by, that the step's is the mean of its start and its end: half of the
// difference between the start and what the last sweep found as the end, none in the first sweep.
void MomentumForces::addLastSweepsViscosity(const State& state, const MomentumSweep& sweep) {
  excess_.resize(state.velocity.size());
  for (std::size_t i = 0; i < excess_.size(); ++i) excess_[i] = 0.5 * (sweep.start.velocity[i] - state.velocity[i]);
  diffusion_.subtract(dimension_, diagonal_, conductance_, excess_, source_);
}

void MomentumForces::acceleration(std::span<const double> density, std::span<double> to) const {
  const int d = dimension_;
  for (int c = 0; c < context_.mesh.owned; ++c)
    for (int i = 0; i < d; ++i)
      to[d * c + i] = (pressureGradient_[d * c + i] - context_.bodyForce(density[c], i)) / density[c];
}

std::span<const double> MomentumForces::gradientOfChange(std::span<const double> change) {
  const std::vector<double> unchanged(boundaryPressure_.size(), 0.0);
  pressureForce_.compute(change, unchanged, pressureGradient_);
  return pressureGradient_;
}

// What is left of the source where it moves gas of these velocities: the force on each cell.
void MomentumForces::rates(const State& state, const MomentumSweep& sweep, std::span<double> momentum,
                           std::span<double> angularMomentum) {
  if (swirl_) swirl_->rates(state, sweep, angularMomentum);
  assemble(state, sweep);
  diffusion_.subtract(dimension_, diagonal_, conductance_, state.velocity, source_);
  std::ranges::copy(source_, momentum.begin());
}

}  // namespace lampblack::flow
