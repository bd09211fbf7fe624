#include "flow/paths/streamline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "core/rank_exchange.hpp"
#include "flow/discretisation/velocity_gradient.hpp"
#include "flow/equations/heat_conduction.hpp"

namespace lampblack::flow {
namespace {

// Of the owned cells, m/s, a component and cell.
std::vector<double> thermophoreticDrift(const FlowContext& context, const State& state, const GasProperties& properties,
                                        double thermophoresis) {
  const Mesh& m = context.mesh;
  std::vector<double> temperature(state.temperature), atBoundary(m.boundaryFaces());
  context.halo.update(temperature, 1);
  std::vector<BoundaryData> known;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    known.push_back(knownTemperature(context, face));
    if (known.back() == BoundaryData::Value) atBoundary[face - m.interiorFaces] = context.boundaryTemperature(face);
  }
  std::vector<double> drift(static_cast<std::size_t>(m.cells) * m.dimension);
  Gradient(m).compute(temperature, atBoundary, 1, drift, known);
  for (int c = 0; c < m.owned; ++c)
    for (int i = 0; i < m.dimension; ++i)
      drift[c * m.dimension + i] *= -thermophoresis * properties.viscosity[c] / state.density[c] / temperature[c];
  return drift;
}

// The particles' velocity. At a boundary the gas has that of the boundary, and particles drift in it as in the cell,
// but for through what lets no heat pass.
VertexField::Source particleVelocity(const FlowContext& context, const State& state, const GasProperties& properties,
                                     double thermophoresis) {
  const Mesh& m = context.mesh;
  const int d = m.dimension;
  VelocityGradient gas(context);
  gas.setBoundary(state.velocity);
  VertexField::Source source{
      d, state.velocity, {gas.boundary().begin(), gas.boundary().end()}, {gas.known().begin(), gas.known().end()}};
  const std::vector<double> drift = thermophoreticDrift(context, state, properties, thermophoresis);
  for (int i = 0; i < d * m.owned; ++i) source.values[i] += drift[i];
  context.halo.update(source.values, d);
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    Vector3 there{};
    std::copy_n(&drift[d * m.low[face]], d, there.begin());
    if (knownTemperature(context, face) == BoundaryData::ZeroSlope)
      there = difference(there, scaled(m.normal[face], dot(there, m.normal[face])));
    for (int i = 0; i < d; ++i) source.boundary[d * (face - m.interiorFaces) + i] += there[i];
  }
  return source;
}

// Of that velocity.
VertexField::Source divergenceOf(const FlowContext& context, const VertexField::Source& velocity) {
  const Mesh& m = context.mesh;
  const int d = m.dimension;
  std::vector<double> gradient(velocity.values.size() * d);
  Gradient(m).compute(velocity.values, velocity.boundary, d, gradient, velocity.known);
  VertexField::Source source;
  source.values.resize(m.cells);
  for (int c = 0; c < m.owned; ++c) {
    for (int i = 0; i < d; ++i) source.values[c] += gradient[(c * d + i) * d + i];
    if (m.axisymmetric()) source.values[c] += velocity.values[c * d] / m.centre[c][0];
  }
  context.halo.update(source.values, 1);
  source.boundary.resize(m.boundaryFaces());
  source.known.assign(m.boundaryFaces(), BoundaryData::Nothing);
  source.isBounded = true;
  return source;
}

// A path on its way, as it travels.
struct TracedParticle {
  std::int64_t path, step, cell, crossings;  // `cell`: permanent number
  bool isHalfWay;                            // within the step
  Vector3 begin;                             // m, of the step
  Vector3 from, to;                          // m, the piece it goes along
};

class Tracer {
 public:
  Tracer(const FlowContext& context, const Streamlines& lines, double timeStep, std::int64_t steps, TracedPaths& traced)
      : context_(context), mesh_(context.mesh), lines_(lines), timeStep_(timeStep), steps_(steps), traced_(traced) {}

  // Goes on until the path ends, or leaves this rank's cells: then true, and `rank` has the next.
  bool leaves(TracedParticle& path, int& rank) {
    int cell = mesh_.findOwned(path.cell);
    for (;;) {
      const CellExit exit = exitOf(mesh_, cell, path.from, path.to);
      if (exit.face < 0) {
        path.from = path.to;
        if (!stepOn(path, cell)) return false;
        continue;
      }
      countCrossing(path);
      path.from = sum(path.from, scaled(difference(path.to, path.from), exit.share));
      if (mesh_.high[exit.face] < 0) {
        if (!slides(path, exit.face)) return false;
        continue;
      }
      const Vector3 shift = mesh_.shiftBeyond(cell, exit.face);
      for (Vector3* place : {&path.begin, &path.from, &path.to}) *place = sum(*place, shift);
      cell = mesh_.low[exit.face] == cell ? mesh_.high[exit.face] : mesh_.low[exit.face];
      path.cell = mesh_.naturalCell[cell];
      if (cell < mesh_.owned) continue;
      rank = mesh_.haloRank[cell - mesh_.owned];
      return true;
    }
  }

 private:
  // At the end of a piece: the point it is, and the next piece. False where the path's time is over.
  bool stepOn(TracedParticle& path, int cell) {
    path.crossings = 0;
    const PlaceInCell place = placeInCell(mesh_, cell, path.from);
    const Vector3 velocity = lines_.velocityAt(place);
    if (!std::isfinite(length(velocity)))
      throw NumericsError(
          fmt::format("the velocity of particles at {} is not finite", placeText(path.from, mesh_.dimension)));
    if (!path.isHalfWay) {
      path.begin = path.from;
      traced_.points.push_back({static_cast<int>(path.path), path.step, path.from, place, lines_.divergenceAt(place)});
      if (path.step == steps_) return false;
    }
    path.to = sum(path.begin, scaled(velocity, path.isHalfWay ? timeStep_ : 0.5 * timeStep_));
    if (path.isHalfWay) ++path.step;
    path.isHalfWay = !path.isHalfWay;
    return true;
  }

  // Along a symmetry it goes on; elsewhere on the boundary it ends.
  bool slides(TracedParticle& path, int face) {
    if (context_.boundaryOf(face).kind == BoundaryKind::Symmetry) {
      const Vector3& normal = mesh_.normal[face];
      path.to = difference(path.to, scaled(normal, dot(difference(path.to, path.from), normal)));
      return true;
    }
    PathEnd& end = traced_.ends[static_cast<std::size_t>(path.path)];
    end.patch = mesh_.patch[face - mesh_.interiorFaces];
    end.place = path.from;
    return false;
  }

  void countCrossing(TracedParticle& path) const {
    if (++path.crossings <= 4 * mesh_.totalCells + 100) return;
    throw NumericsError(fmt::format("a path of particles at {} finds no way through the cells there",
                                    placeText(path.from, mesh_.dimension)));
  }

  const FlowContext& context_;
  const Mesh& mesh_;
  const Streamlines& lines_;
  double timeStep_;
  std::int64_t steps_;
  TracedPaths& traced_;
};

std::vector<TracedParticle> particlesFrom(const Mesh& mesh, std::span<const Vector3> starts) {
  const FoundCells found = findCells(mesh, starts);
  std::vector<TracedParticle> particles;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (found.naturalCell[i] < 0)
      raiseTogether(mesh.comm,
                    InputError(fmt::format("a path cannot start at {}: {}", placeText(starts[i], mesh.dimension),
                                           meshExtentText(mesh, starts[i]))));
    if (found.cell[i] >= 0)
      particles.push_back(
          {static_cast<std::int64_t>(i), 0, found.naturalCell[i], 0, false, starts[i], starts[i], starts[i]});
  }
  return particles;
}

// Of each path from the rank that knows it, to all.
void shareEnds(const Mesh& mesh, TracedPaths& traced) {
  const std::size_t paths = traced.ends.size();
  std::vector<std::int64_t> points(paths, 0), patches(paths);
  std::vector<double> places(3 * paths);
  for (const PathPoint& point : traced.points) ++points[static_cast<std::size_t>(point.path)];
  for (std::size_t i = 0; i < paths; ++i) {
    patches[i] = traced.ends[i].patch;
    std::ranges::copy(traced.ends[i].place, &places[3 * i]);
  }
  const int count = static_cast<int>(paths);
  MPI_Allreduce(MPI_IN_PLACE, points.data(), count, MPI_INT64_T, MPI_SUM, mesh.comm);
  MPI_Allreduce(MPI_IN_PLACE, patches.data(), count, MPI_INT64_T, MPI_MAX, mesh.comm);
  MPI_Allreduce(MPI_IN_PLACE, places.data(), 3 * count, MPI_DOUBLE, MPI_SUM, mesh.comm);
  for (std::size_t i = 0; i < paths; ++i)
    traced.ends[i] = {points[i], static_cast<int>(patches[i]), {places[3 * i], places[3 * i + 1], places[3 * i + 2]}};
}

}  // namespace

Streamlines::Streamlines(const FlowContext& context, const State& state, const GasProperties& properties,
                         double thermophoresis)
    : context_(context) {
  VertexField::Source velocity = particleVelocity(context, state, properties, thermophoresis);
  divergence_.emplace(context, divergenceOf(context, velocity));
  velocity_.emplace(context, std::move(velocity));
}

Vector3 Streamlines::velocityAt(const PlaceInCell& place) const {
  Vector3 velocity{};
  for (int i = 0; i < context_.mesh.dimension; ++i) velocity[i] = velocity_->at(place, i);
  return velocity;
}

TracedPaths Streamlines::trace(std::span<const Vector3> starts, double timeStep, double duration) const {
  const Mesh& m = context_.mesh;
  const auto steps = static_cast<std::int64_t>(std::ceil(duration / timeStep - 1e-9));
  TracedPaths traced{{}, std::vector<PathEnd>(starts.size())};
  Tracer tracer(context_, *this, timeStep, steps, traced);
  std::vector<TracedParticle> here = particlesFrom(m, starts);
  for (std::int64_t alive = 1; alive > 0;) {
    std::vector<TracedParticle> leaving;
    std::vector<int> ranks;
    collectively(m.comm, [&] {
      for (TracedParticle& path : here)
        if (int rank = 0; tracer.leaves(path, rank)) {
          leaving.push_back(path);
          ranks.push_back(rank);
        }
    });
    alive = static_cast<std::int64_t>(leaving.size());
    MPI_Allreduce(MPI_IN_PLACE, &alive, 1, MPI_INT64_T, MPI_SUM, m.comm);
    if (alive > 0) here = RankExchange(m.comm, ranks).send(leaving, 1);
  }
  shareEnds(m, traced);
  return traced;
}

}  // namespace lampblack::flow
