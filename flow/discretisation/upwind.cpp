#include "flow/discretisation/upwind.hpp"

namespace lampblack::flow {
namespace {

constexpr int noFace = -1;

// The face on the other side of an owned cell: whose step goes on straight, within some degrees. None on triangles.
int faceBehind(const Mesh& m, int cell, int face) {
  constexpr double straight = 0.985;
  const auto outwards = [&](int f) { return scaled(m.step[f], (m.low[f] == cell ? 1.0 : -1.0) / m.spacing(f)); };
  const Vector3 ahead = outwards(face);
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i)
    if (m.faceOfCell[i] != face && dot(ahead, outwards(m.faceOfCell[i])) < -straight) return m.faceOfCell[i];
  return noFace;
}

}  // namespace

UpwindGeometry::UpwindGeometry(const FlowContext& context, std::span<const BoundaryData> known) : mesh_(context.mesh) {
  const Mesh& m = mesh_;
  const auto reach = [&](int face) {
    if (m.high[face] >= 0) return m.spacing(face);
    const BoundaryData data = known.empty() ? BoundaryData::Value : known[face - m.interiorFaces];
    return data == BoundaryData::Value ? m.spacing(face) : Gradient::reach(m.distance[face], data);
  };
  // Behind each side of a cell; zero where nothing is known. Halo cells' are told by their owners.
  constexpr int sides = Mesh::mostSides;
  std::vector<double> distance(static_cast<std::size_t>(m.cells) * sides, 0.0);
  std::vector<int> face(static_cast<std::size_t>(m.owned) * sides, noFace);
  for (int f = 0; f < m.interiorFaces; ++f)
    for (const bool isHigh : {false, true}) {
      const int cell = isHigh ? m.high[f] : m.low[f];
      if (cell >= m.owned) continue;
      const int behind = faceBehind(m, cell, f), place = cell * sides + (isHigh ? m.highSide[f] : m.lowSide[f]);
      if (behind == noFace) continue;
      face[place] = behind;
      distance[place] = reach(behind);
    }
  context.halo.update(distance, sides);
  behind_.resize(static_cast<std::size_t>(m.interiorFaces) * 2);
  for (int f = 0; f < m.interiorFaces; ++f) {
    for (const bool isHigh : {false, true}) {
      const int cell = isHigh ? m.high[f] : m.low[f];
      const int place = cell * sides + (isHigh ? m.highSide[f] : m.lowSide[f]);
      int& behind = behind_[2 * f + (isHigh ? 1 : 0)];
      behind = !(distance[place] > 0.0) ? f : cell < m.owned ? face[place] : noFace;
      if (behind != noFace && (behind == f || m.spacing(behind) == distance[place])) continue;
      behind = -1 - static_cast<int>(own_.size());
      own_.push_back(distance[place]);
    }
  }
}

}  // namespace lampblack::flow
