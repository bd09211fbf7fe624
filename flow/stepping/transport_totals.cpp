// What the transport tells of the flow as a whole: integrals over the domain and over its boundaries.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/gather.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::flow {
namespace {

// The angular velocity w/r of a gas that turns about the axis, and its slopes.
struct Turning {
  std::vector<double> rate, slopes;  // 1/s; 1/(m s), two a cell
};

Turning turningOf(const FlowContext& context, const State& state) {
  const Mesh& m = context.mesh;
  Turning turning{std::vector<double>(static_cast<std::size_t>(m.cells)),
                  std::vector<double>(static_cast<std::size_t>(m.owned) * 2)};
  for (int c = 0; c < m.cells; ++c) turning.rate[c] = state.swirl[c] / m.centre[c][0];
  const std::vector<double> boundary(static_cast<std::size_t>(m.boundaryFaces()), 0.0);
  std::vector<BoundaryData> known;
  for (int face = m.interiorFaces; face < m.faces; ++face)
    known.push_back(context.boundaryOf(face).kind == BoundaryKind::Symmetry ? BoundaryData::ZeroSlope
                                                                            : BoundaryData::Nothing);
  Gradient(m).compute(turning.rate, boundary, 1, turning.slopes, known);
  return turning;
}

// The square of the vorticity in a cell, 1/s^2. `turning`: empty where nothing turns.
double squaredVorticity(const Mesh& m, const VelocityGradient& gradient, int cell, const Turning& turning) {
  const auto slope = [&](int component, int axis) { return gradient.of(cell, component)[axis]; };
  const double inPlane = slope(1, 0) - slope(0, 1);
  double sum = inPlane * inPlane;
  if (m.dimension == 3) {
    const double x = slope(2, 1) - slope(1, 2), y = slope(0, 2) - slope(2, 0);
    sum += x * x + y * y;
  }
  if (!turning.rate.empty()) {
    const double r = m.centre[cell][0];
    const double along = 2.0 * turning.rate[cell] + r * turning.slopes[2 * cell],
                 outwards = r * turning.slopes[2 * cell + 1];
    sum += along * along + outwards * outwards;
  }
  return sum;
}

}  // namespace

TransportOperator::Integrals TransportOperator::integrals(const State& state) {
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  const VelocityGradient& gradient = momentum_.forces().velocityGradient(state);
  const Turning turning = state.swirls ? turningOf(context_, state) : Turning{};
  std::array<double, 2> sums{0.0, 0.0};
  for (int c = 0; c < m.owned; ++c) {
    double square = state.swirls ? state.swirl[c] * state.swirl[c] : 0.0;
    for (int i = 0; i < d; ++i) square += state.velocity[d * c + i] * state.velocity[d * c + i];
    const double half = 0.5 * state.density[c] * m.volume[c];
    sums[0] += half * square;
    sums[1] += half * squaredVorticity(m, gradient, c, turning);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  return {sums[0], sums[1]};
}

// Pa, of the gas on a wall that it sticks to; the angular velocity is what friction evens out.
double TransportOperator::frictionAboutAxis(int face, const State& state) const {
  const Mesh& m = context_.mesh;
  if (!state.swirls || !context_.boundaryOf(face).isNoSlipWall()) return 0.0;
  const int cell = m.low[face];
  const double carried = m.faceCentre[face][0] * state.swirl[cell] / m.centre[cell][0];
  return properties_.effectiveBoundaryViscosity()[face - m.interiorFaces] * (carried - context_.boundarySwirl(face)) /
         m.distance[face];
}

std::vector<BoundaryTotals> TransportOperator::boundaryTotals(const State& state) {
  constexpr std::size_t width = 11;
  const Mesh& m = context_.mesh;
  momentum_.forces().velocityGradient(state);
  const std::vector<double> pressure = momentum_.forces().boundaryPressures(state);
  std::vector<double> sums(width * context_.boundaries.size(), 0.0);
  for (std::size_t b = 0; b < context_.boundaries.size(); ++b)
    for (std::size_t i = 0; i < 3; ++i) sums[width * b + 1 + i] = boundaryFlows_[3 * b + i];
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int b = face - m.interiorFaces;
    double* sum = &sums[width * static_cast<std::size_t>(m.patch[b])];
    sum[0] += m.area[face];
    const Vector3 friction =
        momentum_.forces().boundaryTraction(face, state, properties_.effectiveBoundaryViscosity()[b]);
    for (std::size_t i = 0; i < 3; ++i) {
      sum[4 + i] += pressure[b] * m.area[face] * m.normal[face][i];
      sum[7 + i] += friction[i];
    }
    sum[10] += m.faceCentre[face][0] * m.area[face] * frictionAboutAxis(face, state);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  std::vector<BoundaryTotals> totals;
  for (std::size_t b = 0; b < context_.boundaries.size(); ++b) {
    const double* s = &sums[width * b];
    totals.push_back({s[0], s[1], s[2], s[3], {s[4], s[5], s[6]}, {s[7], s[8], s[9]}, s[10]});
  }
  return totals;
}

std::vector<WallFace> TransportOperator::wallFaces(const State& state, int boundary) {
  const Mesh& m = context_.mesh;
  momentum_.forces().velocityGradient(state);
  std::vector<WallFace> own;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int b = face - m.interiorFaces;
    if (m.patch[b] != boundary || m.area[face] <= 0.0) continue;
    const Vector3 traction =
        momentum_.forces().boundaryTraction(face, state, properties_.effectiveBoundaryViscosity()[b]);
    const Vector3 along = difference(traction, scaled(m.normal[face], dot(traction, m.normal[face])));
    const double density = state.density[m.low[face]];
    WallFace wall{m.faceNumber[face], m.faceCentre[face], m.area[face], scaled(along, 1.0 / m.area[face])};
    if (state.swirls) wall.friction[2] = frictionAboutAxis(face, state);
    wall.yPlus = std::sqrt(length(wall.friction) * density) * m.distance[face] / properties_.boundaryViscosity[b];
    wall.heatFlux = -heat_.heat[face] / m.area[face];
    own.push_back(wall);
  }
  std::vector<WallFace> faces = gatheredOnFirst(m.comm, std::move(own)).values;
  std::ranges::sort(faces, {}, &WallFace::number);
  return faces;
}

}  // namespace lampblack::flow
