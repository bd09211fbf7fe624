// The vertices of a MeshBlock, asked of the ranks in whose shares they are.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/mesh_block.hpp"
#include "core/shares.hpp"

namespace lampblack {

class VertexOwner {
 public:
  // A vertex as its owner knows it.
  struct Vertex {
    std::array<double, 3> place{};  // m
    std::int64_t original = -1;     // the one it is an image of, or itself
    std::int64_t number = -1;       // without the vertices that no cell uses
  };

  // Collective. The block has to live as long.
  VertexOwner(MPI_Comm comm, const MeshBlock& block);

  [[nodiscard]] const Shares& shares() const { return shares_; }
  // Whether any vertex of the mesh is an image.
  [[nodiscard]] bool hasImages() const { return hasImages_ != 0; }

  // Collective. The vertices of these numbers, which are then known to be used.
  std::vector<Vertex> vertices(const std::vector<std::int64_t>& wanted);
  // Of all ranks, those that are used.
  [[nodiscard]] std::int64_t total() const { return total_; }

 private:
  [[nodiscard]] std::int64_t originalOf(std::int64_t number) const;
  // Collective. An image's original may be an image itself, at the corner of two periodic sides.
  void followImages();

  MPI_Comm comm_;
  const MeshBlock& block_;
  Shares shares_;
  std::unordered_map<std::int64_t, std::int64_t> originals_;
  std::int64_t total_ = 0;
  int hasImages_ = 0;
};

}  // namespace lampblack
