// The cells of a box in a mesh, by their centres.
#pragma once

#include <vector>

#include "core/mesh.hpp"
#include "core/vector3.hpp"

namespace lampblack {

class MeshRegion {
 public:
  // Collective. `from` is below `to` along each axis of the mesh, m.
  MeshRegion(const Mesh& mesh, const Vector3& from, const Vector3& to);

  [[nodiscard]] bool isEmpty() const { return !(volume_ > 0.0); }
  // Owned cells of this rank.
  [[nodiscard]] const std::vector<int>& cells() const { return cells_; }
  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  // m3, per metre depth or radian, of the cells of all ranks; the same to the last bit on any number of them.
  [[nodiscard]] double volume() const { return volume_; }

 private:
  const Mesh* mesh_;
  std::vector<int> cells_;
  double volume_ = 0.0;
};

}  // namespace lampblack
