// Meshes of other cells than boxes for tests: those of a box are split, and its inner vertices moved.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/box_mesh.hpp"
#include "core/shares.hpp"

namespace lampblack::test {

enum class Cells {
  Quadrilaterals,
  Triangles,
  MixedPlane,  // both
  Hexahedra,
  Tetrahedra,  // six a hexahedron
  Prisms,
  MixedSpace,  // hexahedra, prisms, and pyramids
};

// A number in [-1, 1) that looks random, always the same for the same words.
inline double noise(std::int64_t a, std::int64_t b) {
  auto x =
      static_cast<std::uint64_t>(a) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(b) * 0x632BE59BD9B4E019ULL;
  x = (x ^ (x >> 31)) * 0xBF58476D1CE4E5B9ULL;
  x ^= x >> 29;
  return static_cast<double>(x % 20011) / 10005.5 - 1.0;
}

// `jitter`: by how much of a cell's size inner vertices are moved at most. The box's own patches, nothing left out,
// nothing periodic.
class SkewedMesh {
 public:
  SkewedMesh(MPI_Comm comm, const MeshSpec& spec, Cells cells, double jitter)
      : spec_(spec), kind_(cells), jitter_(jitter) {
    int ranks = 1, rank = 0;
    MPI_Comm_size(comm, &ranks);
    MPI_Comm_rank(comm, &rank);
    const MeshBlock box = boxBlock(comm, spec);
    for (std::size_t a = 0; a < 3; ++a)
      n_[a] = spec.vertices[a].empty() ? 1 : static_cast<std::int64_t>(spec.vertices[a].size()) - 1;
    block_.dimension = box.dimension;
    block_.patches = box.patches;
    const std::size_t corners = box.dimension == 2 ? 4 : 8;
    for (std::size_t c = 0; c < box.shapes.size(); ++c)
      split(box.firstCell + static_cast<std::int64_t>(c),
            {box.corners.begin() + static_cast<std::ptrdiff_t>(c * corners),
             box.corners.begin() + static_cast<std::ptrdiff_t>((c + 1) * corners)});
    for (const MeshBlock::NamedFace& face : box.named) splitFace(face);
    const auto own = static_cast<std::int64_t>(block_.shapes.size());
    MPI_Exscan(&own, &block_.firstCell, 1, MPI_INT64_T, MPI_SUM, comm);
    MPI_Allreduce(&own, &block_.totalCells, 1, MPI_INT64_T, MPI_SUM, comm);
    // The box's vertices, then a middle of each of its cells; unused ones drop out.
    block_.totalVertices = box.totalVertices + box.totalCells;
    const Shares shares(block_.totalVertices, ranks);
    block_.firstVertex = shares.first(rank);
    for (std::int64_t v = block_.firstVertex; v < block_.firstVertex + shares.count(rank); ++v)
      block_.vertices.push_back(placeOf(v, box.totalVertices));
  }

  [[nodiscard]] const MeshBlock& block() const { return block_; }

 private:
  [[nodiscard]] std::array<std::int64_t, 3> indexOf(std::int64_t number, std::int64_t more) const {
    std::array<std::int64_t, 3> index{};
    for (std::size_t a = 0; a < (block_.dimension == 2 ? 2U : 3U); ++a) {
      index[a] = number % (n_[a] + more);
      number /= n_[a] + more;
    }
    return index;
  }

  [[nodiscard]] std::array<double, 3> placeOf(std::int64_t vertex, std::int64_t boxVertices) const {
    std::array<double, 3> place{};
    const auto axes = static_cast<std::size_t>(block_.dimension);
    if (vertex >= boxVertices) {
      const auto cell = indexOf(vertex - boxVertices, 0);
      for (std::size_t a = 0; a < axes; ++a) {
        const auto& x = spec_.vertices[a];
        const auto i = static_cast<std::size_t>(cell[a]);
        place[a] = 0.5 * (x[i] + x[i + 1]);
      }
      return place;
    }
    const auto index = indexOf(vertex, 1);
    bool isInner = true;
    for (std::size_t a = 0; a < axes; ++a) isInner = isInner && index[a] > 0 && index[a] < n_[a];
    for (std::size_t a = 0; a < axes; ++a) {
      const auto& x = spec_.vertices[a];
      const auto i = static_cast<std::size_t>(index[a]);
      place[a] = x[i];
      if (isInner)
        place[a] += jitter_ * noise(vertex, static_cast<std::int64_t>(a)) * std::min(x[i + 1] - x[i], x[i] - x[i - 1]);
    }
    return place;
  }

  void add(CellShape shape, std::initializer_list<std::int64_t> corners) {
    block_.shapes.push_back(shape);
    block_.corners.insert(block_.corners.end(), corners);
  }

  // What a cell becomes; of a column along the third axis all become the same.
  [[nodiscard]] Cells kindOf(std::int64_t cell) const {
    const auto index = indexOf(cell, 0);
    const double draw = noise(index[0] + 100 * index[1], 7);
    if (kind_ == Cells::MixedPlane) return draw < 0.0 ? Cells::Quadrilaterals : Cells::Triangles;
    if (kind_ == Cells::MixedSpace)
      return draw < -0.3 ? Cells::Hexahedra : draw < 0.3 ? Cells::Prisms : Cells::MixedSpace;
    return kind_;
  }

  void split(std::int64_t cell, const std::vector<std::int64_t>& v) {
    switch (kindOf(cell)) {
      case Cells::Quadrilaterals:
      case Cells::MixedPlane:
        add(CellShape::Quadrilateral, {v[0], v[1], v[2], v[3]});
        break;
      case Cells::Triangles:
        if (noise(cell, 3) < 0.0) {
          add(CellShape::Triangle, {v[0], v[1], v[2]});
          add(CellShape::Triangle, {v[0], v[2], v[3]});
        } else {
          add(CellShape::Triangle, {v[0], v[1], v[3]});
          add(CellShape::Triangle, {v[1], v[2], v[3]});
        }
        break;
      case Cells::Hexahedra:
        add(CellShape::Hexahedron, {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]});
        break;
      case Cells::Tetrahedra:
        // Along the diagonal from the first to the last corner, so that neighbours agree (Kuhn).
        for (const auto& [a, b] : {std::pair{1U, 2U}, {2U, 3U}, {3U, 7U}, {7U, 4U}, {4U, 5U}, {5U, 1U}})
          add(CellShape::Tetrahedron, {v[0], v[a], v[b], v[6]});
        break;
      case Cells::Prisms:
        add(CellShape::Prism, {v[0], v[1], v[2], v[4], v[5], v[6]});
        add(CellShape::Prism, {v[0], v[2], v[3], v[4], v[6], v[7]});
        break;
      case Cells::MixedSpace:
        for (const CellSide& side : sidesOf(CellShape::Hexahedron)) {
          const auto at = [&](std::size_t i) { return v[static_cast<std::size_t>(side.corner[i])]; };
          const std::int64_t middle = (n_[0] + 1) * (n_[1] + 1) * (n_[2] + 1) + cell;
          add(CellShape::Pyramid, {at(3), at(2), at(1), at(0), middle});
        }
        break;
    }
  }

  void splitFace(const MeshBlock::NamedFace& face) {
    const auto& v = face.vertices;
    std::array<std::int64_t, 4> order = v;
    std::ranges::sort(order);
    const bool isAcrossThirdAxis = block_.dimension == 3 && order[3] - order[0] < (n_[0] + 1) * (n_[1] + 1);
    const auto cellIndex = indexOf(order[0], 1);
    const std::int64_t column = cellIndex[0] + n_[0] * cellIndex[1];
    const bool isSplit = kind_ == Cells::Tetrahedra ||
                         (isAcrossThirdAxis &&
                          (kind_ == Cells::Prisms || (kind_ == Cells::MixedSpace && kindOf(column) == Cells::Prisms)));
    if (!isSplit) {
      block_.named.push_back(face);
      return;
    }
    for (const std::size_t middle : {1U, 2U})
      block_.named.push_back({{order[0], order[middle], order[3], -1}, face.patch});
  }

  const MeshSpec& spec_;
  Cells kind_;
  double jitter_;
  std::array<std::int64_t, 3> n_{};
  MeshBlock block_;
};

}  // namespace lampblack::test
