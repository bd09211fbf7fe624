#include "flow/upwind.hpp"

namespace lampblack::flow {

UpwindGeometry::UpwindGeometry(const FlowContext& context, std::span<const BoundaryData> known) : mesh_(context.mesh) {
  const Mesh& m = mesh_;
  // Of each cell, along each axis, on its low and its high side; zero where nothing is known.
  std::vector<double> distance(static_cast<std::size_t>(m.cells) * 4, 0.0);
  for (int face = 0; face < m.faces; ++face) {
    const auto entry = [&](int cell, bool isHighSide) -> double& {
      return distance[4 * cell + 2 * m.normalAxis[face] + (isHighSide ? 1 : 0)];
    };
    if (m.high[face] >= 0) {
      entry(m.low[face], true) = entry(m.high[face], false) = m.distance[face];
      continue;
    }
    const BoundaryData data = known.empty() ? BoundaryData::Value : known[face - m.interiorFaces];
    entry(m.low[face], m.normalSign[face] > 0.0) = Gradient::reach(m.distance[face], data);
  }
  context.halo.update(distance, 4);
  // Of each owned cell, the same.
  std::vector<int> face(static_cast<std::size_t>(m.owned) * 4, -1);
  for (int f = 0; f < m.faces; ++f) {
    const int axis = m.normalAxis[f];
    if (m.high[f] >= 0) {
      if (m.low[f] < m.owned) face[4 * m.low[f] + 2 * axis + 1] = f;
      if (m.high[f] < m.owned) face[4 * m.high[f] + 2 * axis] = f;
    } else {
      face[4 * m.low[f] + 2 * axis + (m.normalSign[f] > 0.0 ? 1 : 0)] = f;
    }
  }
  behind_.resize(static_cast<std::size_t>(m.interiorFaces) * 2);
  for (int f = 0; f < m.interiorFaces; ++f) {
    for (const bool isHigh : {false, true}) {
      const int cell = isHigh ? m.high[f] : m.low[f];
      const std::size_t place = static_cast<std::size_t>(4 * cell + 2 * m.normalAxis[f] + (isHigh ? 1 : 0));
      int& behind = behind_[2 * f + (isHigh ? 1 : 0)];
      behind = !(distance[place] > 0.0) ? f : cell < m.owned ? face[place] : -1;
      if (behind >= 0 && (behind == f || m.distance[behind] == distance[place])) continue;
      behind = -1 - static_cast<int>(own_.size());
      own_.push_back(distance[place]);
    }
  }
}

}  // namespace lampblack::flow
