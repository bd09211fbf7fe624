#include "core/mesh_region.hpp"

#include "core/order_free_sums.hpp"

namespace lampblack {

MeshRegion::MeshRegion(const Mesh& mesh, const Vector3& from, const Vector3& to) : mesh_(&mesh) {
  std::vector<PlacedValue> volumes;
  for (int c = 0; c < mesh.owned; ++c) {
    const Vector3& x = mesh.centre[static_cast<std::size_t>(c)];
    bool inside = true;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(mesh.dimension); ++axis)
      inside = inside && from[axis] <= x[axis] && x[axis] <= to[axis];
    if (!inside) continue;
    cells_.push_back(c);
    volumes.push_back({0, mesh.volume[static_cast<std::size_t>(c)]});
  }
  volume_ = orderFreeSums(mesh.comm, 1, volumes)[0];
}

}  // namespace lampblack
