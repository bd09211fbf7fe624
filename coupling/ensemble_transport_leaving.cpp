// Which particles leave a cell, and through which of its faces.
#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/ensemble_transport_sides.hpp"
#include "particles/collisions/sphere.hpp"
#include "particles/population/monte_carlo/systematic_sample.hpp"

namespace lampblack::coupling {
namespace {

// Beyond how many mean weights a numerical particle goes in pieces, and in how many at most.
constexpr double meanWeights = 2.0, mostPieces = 1000.0;

// What a numerical particle that goes as a whole may stand for.
double largestWhole(const ParticleRows& layout, std::span<const double> rows) {
  double number = 0.0, count = 0.0;
  layout.forEach(rows, [&](const double* row) {
    number += row[packedNumberAt];
    count += 1.0;
  });
  return meanWeights * number / count;
}

}  // namespace

// Of a particle: the sums of its probabilities to leave through the sides up to each of them. Returns its class of
// size.
int EnsembleTransport::sumChances(const double* row, const std::vector<Side>& sides, std::span<double> upTo) const {
  const double volume = massAt(row) / options_.type.density(), primaries = row[2];
  const int k = classOf(volume);
  double d = sphereDiameter(volume), ofMobility = volume;
  if (primaries > 1.0) {
    d *= SootAggregate::mobilityFactor(primaries) / std::cbrt(primaries);
    ofMobility = constants::pi / 6.0 * d * d * d;
  }
  const Between at = between(ofMobility, smallest, nodes);
  const double perSquare = 1.0 / (d * d);
  double sum = 0.0;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const Side& side = sides[s];
    if (side.isWall) {
      sum += side.toWall(k, at, perSquare);
    } else {
      sum += side.convected[k];
      if (side.diffuses)
        sum += side.diffused[k] * perSquare *
               (side.diffusion[at.node] + at.part * (side.diffusion[at.node + 1] - side.diffusion[at.node]));
    }
    upTo[s] = sum;
  }
  return k;
}

// Of spheres between a node and the next, and of aggregates of that volume, which diffuse less: no sum of chances to
// leave is above this. D falls with the volume, D d^2 rises.
void EnsembleTransport::boundChances(const std::vector<Side>& sides, std::span<double, nodes> bounds) const {
  std::ranges::fill(bounds, 0.0);
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto [diameter, perSquare, k] = nodes_[node];
    for (const Side& side : sides) {
      if (side.isWall) {
        bounds[node] += side.mostToWall(k, node, perSquare);
        continue;
      }
      bounds[node] += side.convected[k];
      if (side.diffuses)
        bounds[node] += side.diffused[k] * perSquare *
                        std::max(side.diffusion[node], side.diffusion[std::min(node + 1, nodes - 1)]);
    }
  }
}

void EnsembleTransport::drawLeaving(int cell, const std::vector<Side>& sides, double& point, std::size_t head,
                                    Rows& rows) {
  const Mesh& m = context_.mesh;
  if (sides.empty() || rows.size() <= head) return;
  std::array<double, Mesh::mostSides> upTo{};
  std::array<bool, classes> isLimited{};
  for (const Side& side : sides)
    for (std::size_t k = 0; k < isLimited.size(); ++k) isLimited[k] = isLimited[k] || side.isLimited[k];
  const double whole = largestWhole(options_.rows, std::span(rows).subspan(head));
  std::array<double, nodes> bounds;
  boundChances(sides, bounds);
  std::size_t kept = head, next = head;
  for (std::size_t i = head; i < rows.size(); i = next) {
    const std::size_t length = options_.rows.lengthOf(&rows[i]);
    next = i + length;
    // Most stay, which their bound tells.
    const double volume = (rows[i] + rows[i + 1]) / options_.type.density();
    if (const int node = exponentOf(volume) - smallest;
        node >= 0 && node < static_cast<int>(nodes) && !(rows[i + packedNumberAt] > whole)) {
      double drawn = point;
      nextEvenPoint(drawn);
      if (drawn >= bounds[static_cast<std::size_t>(node)]) {
        point = drawn;
        if (isLimited[classOf(volume)]) ++limited_;
        if (kept != i) std::copy_n(&rows[i], length, &rows[kept]);
        kept += length;
        continue;
      }
    }
    const int k = sumChances(&rows[i], sides, upTo);
    const double sum = upTo[sides.size() - 1];
    if (sum > 1.0 || isLimited[k]) ++limited_;
    const double number = rows[i + packedNumberAt];
    const double pieces = std::clamp(std::ceil(number / whole), 1.0, mostPieces);
    std::array<double, Mesh::mostSides> leave{};
    double stay = pieces;
    for (int piece = 0; piece < static_cast<int>(pieces); ++piece) {
      nextEvenPoint(point);
      const double drawn = sum > 1.0 ? point * sum : point;
      if (drawn >= sum) continue;
      std::size_t s = 0;
      while (s + 1 < sides.size() && drawn >= upTo[s]) ++s;
      leave[s] += 1.0;
      stay -= 1.0;
    }
    const double inCell = number * m.volume[cell];
    for (std::size_t s = 0; s < sides.size(); ++s) {
      if (!(leave[s] > 0.0)) continue;
      Rows& to = sides[s].beyond < 0 ? gone_ : leavingRows_;
      if (sides[s].beyond >= 0)
        leaving_.push_back({sides[s].face, sides[s].beyond, to.size()});
      else
        goneThrough_.push_back(sides[s].face);
      to.insert(to.end(), &rows[i], &rows[i] + length);
      to[to.size() - length + packedNumberAt] = inCell * leave[s] / pieces;
    }
    if (stay > 0.0) {
      if (kept != i) std::copy_n(&rows[i], length, &rows[kept]);
      if (stay < pieces) rows[kept + packedNumberAt] = number * stay / pieces;
      kept += length;
    }
  }
  rows.resize(kept);
}

}  // namespace lampblack::coupling
