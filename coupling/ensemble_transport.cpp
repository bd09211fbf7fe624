#include "coupling/ensemble_transport.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/rank_exchange.hpp"
#include "coupling/ensemble_transport_sides.hpp"
#include "flow/properties/wall_transfer.hpp"
#include "particles/collisions/sphere.hpp"

namespace lampblack::coupling {
EnsembleTransport::EnsembleTransport(const FlowContext& context, Options options)
    : context_(context),
      options_(std::move(options)),
      perDensity_(1.0 / options_.type.density()),
      gradient_(context.mesh),
      known_(static_cast<std::size_t>(context.mesh.boundaryFaces()), BoundaryData::ZeroSlope),
      density_(static_cast<std::size_t>(context.mesh.cells) * classes),
      gradients_(density_.size() * static_cast<std::size_t>(context.mesh.dimension)),
      nothing_(known_.size() * classes),
      diffusivity_(options_.diffusion ? static_cast<std::size_t>(context.mesh.cells) * nodes : 0),
      isFound_(static_cast<std::size_t>(context.mesh.cells)),
      contents_(static_cast<std::size_t>(context.mesh.owned)),
      lanes_(std::make_unique<SideLanes>()),
      facesInOrder_(context.mesh.faceOfCell),
      comingThrough_(2 * static_cast<std::size_t>(context.mesh.interiorFaces), Chain{-1, -1}) {
  for (std::size_t node = 0; node < nodes; ++node) {
    const double volume = std::ldexp(1.0, smallest + static_cast<int>(node)), d = sphereDiameter(volume);
    nodes_[node] = {d, 1.0 / (d * d), classOf(volume)};
  }
  const Mesh& m = context.mesh;
  const auto numberOf = [&](int face) { return m.faceNumber[static_cast<std::size_t>(face)]; };
  for (int cell = 0; cell < m.owned; ++cell)
    std::ranges::sort(facesInOrder_.begin() + m.faceStart[cell], facesInOrder_.begin() + m.faceStart[cell + 1], {},
                      numberOf);
}

EnsembleTransport::~EnsembleTransport() = default;

double EnsembleTransport::massOf(const Gas& gas, int cell, double part) const {
  const double start = gas.state.start.density[cell], end = gas.state.density[cell];
  return context_.mesh.volume[cell] * (start + part * (end - start));
}

// kg/s, of the gas that particles of the cell see flow out through one of its faces.
double EnsembleTransport::outflow(const Gas& gas, int face, int cell) const {
  const Mesh& m = context_.mesh;
  const double flux =
      gas.state.massFlux[face] +
      (m.high[face] >= 0 || context_.takesParticles(face) ? options_.thermophoresis * gas.driftFlux[face] : 0.0);
  return m.low[face] == cell ? flux : -flux;
}

bool EnsembleTransport::diffuses(int face) const {
  return options_.diffusion && (context_.mesh.high[face] >= 0 || context_.takesParticles(face));
}

// Walls have their own way (flow/properties/wall_transfer.hpp).
double EnsembleTransport::stirredThrough(const Gas& gas, int face) const {
  const Mesh& m = context_.mesh;
  if (gas.state.eddyViscosity.empty() || m.high[face] < 0) return 0.0;
  const auto of = [&](int cell) { return eddyMixing(context_, gas.state, static_cast<std::size_t>(cell)); };
  const double D = m.lowWeight[face] * of(m.low[face]) + (1.0 - m.lowWeight[face]) * of(m.high[face]);
  return gas.faceDensity[face] * m.area[face] / m.distance[face] * D;
}

// Of a local cell: D d^2 at the nodes.
const double* EnsembleTransport::diffusivityOf(const Gas& gas, int cell) {
  double* row = &diffusivity_[static_cast<std::size_t>(cell) * nodes];
  if (isFound_[cell] != 0) return row;
  isFound_[cell] = 1;
  const CarrierGas carrier{gas.state.temperature[cell], gas.state.thermodynamicPressure, gas.state.density[cell],
                           gas.properties.viscosity[cell], gas.properties.molecularWeight[cell]};
  for (std::size_t node = 0; node < nodes; ++node) {
    const double d = nodes_[node].diameter;
    row[node] = brownianDiffusivity(carrier, d) * d * d;
  }
  return row;
}

void EnsembleTransport::findBoundaries(const Gas& gas) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryKind kind = context_.boundaryOf(face).kind;
    const bool isOpen = kind == BoundaryKind::Inlet || kind == BoundaryKind::Outlet;
    // Nothing comes in; what goes out is as what comes after it.
    known_[face - m.interiorFaces] = context_.takesParticles(face)    ? BoundaryData::Nothing
                                     : !isOpen                        ? BoundaryData::ZeroSlope
                                     : gas.state.massFlux[face] < 0.0 ? BoundaryData::Value
                                                                      : BoundaryData::Nothing;
  }
}

// Collective. Of the classes that move, with their gradients.
void EnsembleTransport::findDensities(const Gas& gas, double part) {
  const Mesh& m = context_.mesh;
  const std::size_t width = moving_.size();
  const std::span<double> density(density_.data(), width * static_cast<std::size_t>(m.cells));
  const std::span<double> gradients(gradients_.data(), density.size() * static_cast<std::size_t>(m.dimension));
  for (int cell = 0; cell < m.owned; ++cell) {
    double* of = &density[static_cast<std::size_t>(cell) * width];
    const double perMass = m.volume[cell] / massOf(gas, cell, part);
    for (std::size_t k = 0; k < width; ++k) of[k] = contents_[cell].numbers[moving_[k]] * perMass;
  }
  const auto components = static_cast<int>(width);
  context_.halo.update(density, components);
  gradient_.compute(density, nothing_, components, gradients, known_);
  if (m.isOblique() && (options_.diffusion || !gas.state.eddyViscosity.empty()))
    context_.halo.update(gradients, components * m.dimension);
}

// Through the layer beside a wall; `share`: s/kg, of the cell's mass in a part of a step.
void EnsembleTransport::findWallDiffusion(const Gas& gas, int cell, double share, int face, std::size_t side) {
  const double* here = diffusivityOf(gas, cell);
  for (std::size_t node = firstNode_; node < endNode_; ++node) {
    const double perSquare = nodes_[node].perSquare;
    lanes_->diffusion[node][side] =
        share / perSquare *
        conductanceToWall(context_, gas.state, gas.properties, face, gas.faceDensity[face], here[node] * perSquare);
  }
}

void EnsembleTransport::findSides(const Gas& gas, int cell, double dt, double mass, std::vector<Side>& sides) {
  const Mesh& m = context_.mesh;
  const std::size_t width = moving_.size();
  const double* present = &density_[static_cast<std::size_t>(cell) * width];
  const double* slopes = &gradients_[static_cast<std::size_t>(cell) * width * static_cast<std::size_t>(m.dimension)];
  const double* velocity = &gas.state.velocity[static_cast<std::size_t>(cell) * m.dimension];
  sides.clear();
  lanes_->hasWall = false;
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const int face = m.faceOfCell[i];
    if (m.area[face] <= 0.0) continue;
    const bool isLow = m.low[face] == cell;
    const double out = outflow(gas, face, cell) * dt / mass, convected = std::max(out, 0.0);
    const double stirred = stirredThrough(gas, face) * dt / mass;
    if (!(convected > 0.0) && !diffuses(face) && !(stirred > 0.0)) continue;
    const std::size_t place = sides.size();
    Side& side = sides.emplace_back();
    side.face = face;
    side.beyond = isLow ? m.high[face] : m.low[face];
    side.diffuses = diffuses(face);
    side.isWall = side.beyond < 0 && context_.takesParticles(face);
    lanes_->stirred[place] = stirred;
    lanes_->hasWall = lanes_->hasWall || side.isWall;
    side.drift = out;
    if (side.isWall) side.eddies = eddiesToWall(context_, gas.state, gas.properties, face).resistance * mass / dt;
    const Vector3 toFace = difference(m.faceCentreOf(cell, face), m.centre[cell]);
    for (std::size_t j = 0; j < width; ++j) {
      const int k = moving_[j];
      double ratio = 1.0;
      if (options_.secondOrder && (side.beyond >= 0 || side.isWall) && present[j] > 0.0) {
        const double behind = 0.5 * dt * lengths_[k];
        for (int axis = 0; axis < m.dimension; ++axis)
          ratio += slopes[j * m.dimension + axis] * (toFace[axis] - behind * velocity[axis]) / present[j];
        side.isLimited[k] = ratio < 0.0 || ratio > 2.0;
        ratio = std::clamp(ratio, 0.0, 2.0);
      }
      lanes_->convected[k][place] = convected * (side.isWall ? ratio - 1.0 : ratio);
    }
    const bool mixes = !side.isWall && (side.diffuses || stirred > 0.0);
    for (const int k : moving_) lanes_->diffused[k][place] = mixes ? 1.0 : 0.0;
    if (!side.diffuses)
      for (std::size_t node = firstNode_; node < endNode_; ++node) lanes_->diffusion[node][place] = 0.0;
    if (side.isWall) {
      if (side.diffuses) findWallDiffusion(gas, cell, dt / mass, face, place);
    } else if (mixes) {
      if (side.diffuses) {
        const double through = dt / mass * gas.faceDensity[face] * m.area[face] / m.distance[face];
        const double own = isLow ? m.lowWeight[face] : 1.0 - m.lowWeight[face];
        const double *here = diffusivityOf(gas, cell), *there = diffusivityOf(gas, side.beyond);
        for (std::size_t node = firstNode_; node < endNode_; ++node)
          lanes_->diffusion[node][place] = through * (own * here[node] + (1.0 - own) * there[node]);
      }
      if (m.isOblique())
        for (std::size_t j = 0; j < width; ++j) {
          const int k = moving_[j];
          if (!(present[j] > 0.0)) continue;
          // Half of it is taken from what goes each way.
          const double skew =
              0.5 * m.distance[face] *
              faceSlope(m, face, m.oblique[face], gradients_, static_cast<int>(width), static_cast<int>(j)) /
              present[j];
          side.isLimited[k] = side.isLimited[k] || std::abs(skew) > 1.0;
          lanes_->diffused[k][place] = std::clamp(1.0 - (isLow ? skew : -skew), 0.0, 2.0);
        }
    }
  }
}

// Collective. Those that came through a face come behind one another in the order in which they left, faces in that of
// their numbers.
void EnsembleTransport::send(std::vector<Rows>& arrived) {
  const Mesh& m = context_.mesh;
  std::vector<int> ranks;
  PackedRows letters;  // face, cell, row
  const auto isOwn = [&](const Leaving& one) { return one.cell < m.owned; };
  for (const Leaving& one : leaving_) {
    if (isOwn(one)) continue;
    const double* row = &leavingRows_[one.row];
    ranks.push_back(m.haloRank[one.cell - m.owned]);
    Rows letter{static_cast<double>(m.faceNumber[one.face]), static_cast<double>(m.naturalCell[one.cell])};
    letter.insert(letter.end(), row, row + options_.rows.lengthOf(row));
    letters.add(letter);
  }
  std::erase_if(leaving_, [&](const Leaving& one) { return !isOwn(one); });
  const RankExchange exchange(m.comm, ranks);
  const PackedRows came = exchange.send(letters);
  const double* letter = came.values.data();
  for (const std::int64_t length : came.lengths) {
    const int cell = m.findOwned(static_cast<std::int64_t>(letter[1]));
    const auto face =
        std::find_if(m.faceOfCell.begin() + m.faceStart[cell], m.faceOfCell.begin() + m.faceStart[cell + 1],
                     [&](int f) { return m.faceNumber[f] == static_cast<std::int64_t>(letter[0]); });
    leaving_.push_back({*face, cell, classOf(volumeOf(letter + 2)), leavingRows_.size()});
    leavingRows_.insert(leavingRows_.end(), letter + 2, letter + length);
    letter += length;
  }
  for (int k = 0; k < static_cast<int>(leaving_.size()); ++k) {
    Chain& chain = comingThrough_[2 * static_cast<std::size_t>(leaving_[k].face) +
                                  (leaving_[k].cell == m.high[leaving_[k].face] ? 1 : 0)];
    (chain.last < 0 ? chain.first : leaving_[chain.last].next) = k;
    chain.last = k;
  }
  for (int cell = 0; cell < m.owned; ++cell)
    for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
      const int face = facesInOrder_[i];
      if (face >= m.interiorFaces) continue;
      for (const bool isHigh : {false, true}) {
        if ((isHigh ? m.high[face] : m.low[face]) != cell) continue;
        Chain& chain = comingThrough_[2 * static_cast<std::size_t>(face) + (isHigh ? 1 : 0)];
        for (int k = chain.first; k >= 0; k = leaving_[k].next) {
          const double* row = &leavingRows_[leaving_[k].row];
          const std::size_t length = options_.rows.lengthOf(row);
          Rows& to = arrived[cell];
          to.insert(to.end(), row, row + length);
          const double number = row[packedNumberAt] / m.volume[cell];
          to[to.size() - length + packedNumberAt] = number;
          contents_[cell].add(leaving_[k].ofClass, number, 1);
        }
        chain = {-1, -1};
      }
    }
  leaving_.clear();
  leavingRows_.clear();
}

}  // namespace lampblack::coupling
