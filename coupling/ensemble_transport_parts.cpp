// In how many parts a half of a step is taken, by which class of particles, and what happens in each.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "core/random.hpp"
#include "coupling/ensemble_transport_sides.hpp"
#include "coupling/load_ahead.hpp"
#include "flow/properties/wall_transfer.hpp"
#include "particles/collisions/sphere.hpp"

namespace lampblack::coupling {
namespace {

constexpr std::uint32_t movesStream = 0x4d4f5645;  // and the parts of both halves of a step behind it
constexpr int mostParts = 600;                     // of a half

// Of a cell in a part: with r at its limit of two no probability is above one. Diffusion is explicit in time, of first
// order in this: along one axis a part p that leaves errs by (p/4 - 1/12) D h^2 k^4 of a wave k, in space and time.
constexpr double mostLeaving = 0.5;

}  // namespace

// Collective. So many that what would leave a cell in one by the values in it is no more than mostLeaving of it, for
// each class; and how many of them each takes together.
int EnsembleTransport::findParts(const Gas& gas, double dt) {
  const Mesh& m = context_.mesh;
  std::array<double, classes> most{}, ofVolume{}, out{};
  for (int cell = 0; cell < m.owned; ++cell) {
    const Content& content = contents_[cell];
    if (content.count == 0) continue;
    if (options_.diffusion)
      for (int k = 0; k < classes; ++k) {
        if (content.counts[k] == 0) continue;
        const double volume = content.lightest[k] * perDensity_;
        const Between at = between(volume, smallest, nodes);
        const double* D = diffusivityOf(gas, cell) + at.node;
        ofVolume[k] = (D[0] + at.part * (D[1] - D[0])) / std::pow(sphereDiameter(volume), 2);
      }
    out.fill(0.0);
    for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
      const int face = m.faceOfCell[i];
      if (m.area[face] <= 0.0) continue;
      const double carried = std::max(outflow(gas, face, cell), 0.0) + stirredThrough(gas, face);
      const double through = m.high[face] >= 0 ? gas.faceDensity[face] * m.area[face] / m.distance[face] : 0.0;
      for (int k = 0; k < classes; ++k) {
        if (content.counts[k] == 0) continue;
        out[k] += carried;
        if (!diffuses(face)) continue;
        out[k] += m.high[face] >= 0 ? through * ofVolume[k]
                                    : conductanceToWall(context_, gas.state, gas.properties, face,
                                                        gas.faceDensity[face], ofVolume[k]);
      }
    }
    const double least = std::min(massOf(gas, cell, 0.0), massOf(gas, cell, 1.0));
    for (int k = 0; k < classes; ++k)
      if (content.counts[k] > 0) most[k] = std::max(most[k], dt * out[k] / least);
  }
  MPI_Allreduce(MPI_IN_PLACE, most.data(), classes, MPI_DOUBLE, MPI_MAX, m.comm);
  const double highest = std::ranges::max(most);
  if (!(highest <= mostParts * mostLeaving))
    raiseTogether(m.comm, NumericsError(fmt::format("in a step of {:.3g} s particles move through {:.3g} cells; a "
                                                    "smaller 'time.maximum_step' helps",
                                                    dt, highest)));
  const int parts = std::max(1, static_cast<int>(std::ceil(highest / mostLeaving)));
  for (int k = 0; k < classes; ++k)
    together_[k] = most[k] > 0.0 ? static_cast<int>(std::clamp(mostLeaving * parts / most[k], 1.0, 1.0 * parts)) : 0;
  return parts;
}

// Which classes move in it, and over how many parts.
void EnsembleTransport::beginPart(int part, int parts) {
  moving_.clear();
  for (int k = 0; k < classes; ++k) {
    const bool moves = together_[k] > 0 && part % together_[k] == 0;
    lengths_[k] = moves ? std::min(together_[k], parts - part) : 0;
    if (moves) moving_.push_back(k);
  }
  if (moving_.empty()) return;
  firstNode_ = static_cast<std::size_t>(3 * moving_.front());
  // Aggregates have nodes of mobility above their own.
  endNode_ = options_.type.coalescing() && moving_.back() + 1 < classes
                 ? static_cast<std::size_t>(3 * moving_.back() + 4)
                 : nodes;
}

bool EnsembleTransport::hasMoving(int cell) const {
  return std::ranges::any_of(moving_, [&](int k) { return contents_[cell].counts[k] > 0; });
}

void EnsembleTransport::advance(const Gas& gas, double dt, std::uint64_t step, Half half,
                                std::vector<Rows>& populations, std::vector<Rows>& arrived) {
  const Mesh& m = context_.mesh;
  const bool isFirst = half == Half::First;
  if (isFirst) {
    gone_.clear();
    goneThrough_.clear();
    limited_ = 0;
    parts_ = 0;
  }
  std::ranges::fill(isFound_, 0);  // the ensembles between the halves have changed the gas
  order_.clear();
  for (int cell = 0; cell < m.owned; ++cell) {
    loadAhead(populations, cell + 1);
    takeStock(cell, options_.rows.of(populations[cell]), arrived[cell]);
  }
  const int parts = findParts(gas, 0.5 * dt);
  parts_ += parts;
  findBoundaries(gas);
  std::vector<Side> sides;
  for (int part = 0; part < parts; ++part) {
    beginPart(part, parts);
    if (moving_.empty()) continue;
    const double begun = 0.5 * ((isFirst ? 0.0 : 1.0) + static_cast<double>(part) / parts);
    findDensities(gas, begun);
    for (int cell = 0; cell < m.owned; ++cell) {
      if (!hasMoving(cell)) continue;
      findSides(gas, cell, 0.5 * dt / parts, massOf(gas, cell, begun), sides);
      RandomStream random(options_.seed, static_cast<std::uint64_t>(m.naturalCell[cell]),
                          movesStream + static_cast<std::uint32_t>((isFirst ? 0 : mostParts) + part));
      random.seek(2 * step);
      drawLeaving(cell, sides, random, populations[cell], arrived[cell]);
    }
    send(arrived);
  }
  for (int cell = 0; cell < m.owned; ++cell) {
    loadAhead(populations, cell + 1);
    if (!contents_[cell].hasLost) continue;
    removeGone(populations[cell], options_.rows.head);
    removeGone(arrived[cell], 0);
  }
}

}  // namespace lampblack::coupling
