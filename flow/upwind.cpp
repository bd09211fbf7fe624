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
  behind_.resize(static_cast<std::size_t>(m.interiorFaces) * 2);
  for (int face = 0; face < m.interiorFaces; ++face) {
    const int axis = m.normalAxis[face];
    const double ofLow = distance[4 * m.low[face] + 2 * axis];
    const double ofHigh = distance[4 * m.high[face] + 2 * axis + 1];
    behind_[2 * face] = ofLow > 0.0 ? ofLow : m.distance[face];
    behind_[2 * face + 1] = ofHigh > 0.0 ? ofHigh : m.distance[face];
  }
}

}  // namespace lampblack::flow
