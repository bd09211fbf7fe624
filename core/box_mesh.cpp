#include "core/box_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/errors.hpp"
#include "core/shares.hpp"

namespace lampblack {
namespace {

using Index = std::array<int, 3>;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

void checkInput(const MeshSpec& spec) {
  for (int axis = 0; axis < spec.dimension(); ++axis) {
    const auto& v = spec.vertices[at(axis)];
    if (v.size() < 2) throw InputError(fmt::format("mesh axis {} has no cells; at least 1 is needed", axis));
    for (std::size_t i = 1; i < v.size(); ++i)
      if (!(v[i] > v[i - 1])) throw InputError(fmt::format("the vertices of mesh axis {} do not increase", axis));
    if (!std::isfinite(v.front()) || !std::isfinite(v.back()))
      throw InputError(fmt::format("the vertices of mesh axis {} are not finite", axis));
    if (spec.periodic[at(axis)] && v.size() < 4)
      throw InputError(
          fmt::format("the periodic mesh axis {} has {} cells; at least 3 are needed", axis, v.size() - 1));
  }
  if (spec.geometry == Geometry::Planar) return;
  if (spec.dimension() != 2) throw InputError("an axisymmetric mesh has two axes");
  if (spec.periodic[0]) throw InputError("the radius of an axisymmetric mesh cannot be periodic");
  if (spec.vertices[0].front() < 0.0) throw InputError("an axisymmetric mesh needs radii of zero or more");
}

class Box {
 public:
  Box(MPI_Comm comm, const MeshSpec& spec) : spec_(spec), dimension_(spec.dimension()) {
    MPI_Comm_rank(comm, &rank_);
    MPI_Comm_size(comm, &ranks_);
    for (int axis = 0; axis < dimension_; ++axis)
      cells_[at(axis)] = static_cast<int>(spec.vertices[at(axis)].size()) - 1;
    for (const MeshSpec::LeftOut& part : spec.leftOut) leftOut_.push_back(rangeOf(part));
    rowStart_.push_back(0);
    for (int k = 0; k < cells_[2]; ++k)
      for (int j = 0; j < cells_[1]; ++j) rowStart_.push_back(rowStart_.back() + cellsInRow(j, k));
    if (rowStart_.back() == 0) throw InputError("all cells of the mesh are left out");
  }

  MeshBlock share() const {
    MeshBlock block;
    block.dimension = dimension_;
    block.totalCells = rowStart_.back();
    block.totalVertices = 1;
    for (int axis = 0; axis < dimension_; ++axis) block.totalVertices *= cells_[at(axis)] + 1;
    for (const BoundaryPatch& patch : spec_.patches) block.patches.push_back(patch.name);
    addCells(block);
    addVertices(block);
    return block;
  }

 private:
  struct Range {
    Index first{0, 0, 0}, last{1, 1, 1};  // cells [first, last)
    [[nodiscard]] bool holds(const Index& cell) const {
      for (std::size_t a = 0; a < 3; ++a)
        if (cell[a] < first[a] || cell[a] >= last[a]) return false;
      return true;
    }
  };

  [[nodiscard]] Range rangeOf(const MeshSpec::LeftOut& part) const {
    Range range;
    for (int axis = 0; axis < dimension_; ++axis) {
      const auto& v = spec_.vertices[at(axis)];
      const auto firstBeyond = [&](double place) {
        int i = 0;
        while (i < cells_[at(axis)] && 0.5 * (v[at(i)] + v[at(i + 1)]) < place) ++i;
        return i;
      };
      range.first[at(axis)] = firstBeyond(part.lower[at(axis)]);
      range.last[at(axis)] = firstBeyond(part.upper[at(axis)]);
    }
    return range;
  }

  // Index of the part that leaves this cell out, or -1.
  [[nodiscard]] int leftOutBy(const Index& cell) const {
    for (std::size_t i = 0; i < leftOut_.size(); ++i)
      if (leftOut_[i].holds(cell)) return static_cast<int>(i);
    return -1;
  }

  [[nodiscard]] int cellsInRow(int j, int k) const {
    int count = 0;
    if (leftOut_.empty()) return cells_[0];
    for (int i = 0; i < cells_[0]; ++i) count += leftOutBy({i, j, k}) < 0 ? 1 : 0;
    return count;
  }

  [[nodiscard]] std::int64_t vertexAt(const Index& v) const {
    return v[0] + (cells_[0] + std::int64_t{1}) * (v[1] + (cells_[1] + std::int64_t{1}) * v[2]);
  }

  // Patch of a side of a cell that lies on the surface, -1 without one, and -2 inside.
  [[nodiscard]] int patchOf(const Index& cell, int axis, bool atMax) const {
    Index beyond = cell;
    beyond[at(axis)] += atMax ? 1 : -1;
    const bool isAtEnd = beyond[at(axis)] < 0 || beyond[at(axis)] >= cells_[at(axis)];
    const int part = isAtEnd ? -1 : leftOutBy(beyond);
    if (isAtEnd && spec_.periodic[at(axis)]) return -2;
    if (!isAtEnd && part < 0) return -2;
    const int other = axis == 0 ? 1 : 0;
    const auto& v = spec_.vertices[at(other)];
    const double along = 0.5 * (v[at(cell[at(other)])] + v[at(cell[at(other)] + 1)]);
    for (std::size_t p = 0; p < spec_.patches.size(); ++p) {
      const BoundaryPatch& patch = spec_.patches[p];
      if (part >= 0 ? patch.leftOut == part
                    : patch.leftOut < 0 && patch.axis == axis && patch.atMax == atMax && along >= patch.from &&
                          along <= patch.to)
        return static_cast<int>(p);
    }
    return -1;
  }

  // The axis that a side of a cell is normal to, and at which end.
  [[nodiscard]] std::pair<int, bool> normalOf(int side) const {
    static constexpr std::array<std::pair<int, bool>, 4> plane{{{1, false}, {0, true}, {1, true}, {0, false}}};
    static constexpr std::array<std::pair<int, bool>, 6> space{
        {{2, false}, {2, true}, {1, false}, {0, true}, {1, true}, {0, false}}};
    return dimension_ == 2 ? plane[at(side)] : space[at(side)];
  }

  void addCells(MeshBlock& block) const {
    static constexpr std::array<Index, 8> corner{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    const Shares shares(block.totalCells, ranks_);
    const CellShape shape = dimension_ == 2 ? CellShape::Quadrilateral : CellShape::Hexahedron;
    block.firstCell = shares.first(rank_);
    const std::int64_t end = block.firstCell + shares.count(rank_);
    block.shapes.reserve(static_cast<std::size_t>(shares.count(rank_)));
    block.corners.reserve(block.shapes.capacity() * at(cornersOf(shape)));
    auto row = static_cast<std::size_t>(std::upper_bound(rowStart_.begin(), rowStart_.end(), block.firstCell) -
                                        rowStart_.begin() - 1);
    for (; row + 1 < rowStart_.size() && rowStart_[row] < end; ++row) {
      std::int64_t number = rowStart_[row];
      Index cell{0, static_cast<int>(row % at(cells_[1])), static_cast<int>(row / at(cells_[1]))};
      for (; cell[0] < cells_[0] && number < end; ++cell[0]) {
        if (leftOutBy(cell) >= 0) continue;
        if (number++ < block.firstCell) continue;
        block.shapes.push_back(shape);
        std::array<std::int64_t, 8> vertex{};
        for (int c = 0; c < cornersOf(shape); ++c) {
          const Index& step = corner[at(c)];
          vertex[at(c)] = vertexAt({cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]});
          block.corners.push_back(vertex[at(c)]);
        }
        const auto sides = sidesOf(shape);
        for (int s = 0; s < static_cast<int>(sides.size()); ++s) {
          const auto [axis, atMax] = normalOf(s);
          const int patch = patchOf(cell, axis, atMax);
          if (patch < 0) continue;
          MeshBlock::NamedFace face;
          face.patch = patch;
          for (int c = 0; c < sides[at(s)].corners; ++c) face.vertices[at(c)] = vertex[at(sides[at(s)].corner[at(c)])];
          block.named.push_back(face);
        }
      }
    }
  }

  void addVertices(MeshBlock& block) const {
    const Shares shares(block.totalVertices, ranks_);
    block.firstVertex = shares.first(rank_);
    block.vertices.reserve(static_cast<std::size_t>(shares.count(rank_)));
    for (std::int64_t number = block.firstVertex; number < block.firstVertex + shares.count(rank_); ++number) {
      Index v{0, 0, 0};
      std::int64_t rest = number;
      for (int axis = 0; axis < dimension_; ++axis) {
        v[at(axis)] = static_cast<int>(rest % (cells_[at(axis)] + 1));
        rest /= cells_[at(axis)] + 1;
      }
      std::array<double, 3> place{0.0, 0.0, 0.0};
      for (int axis = 0; axis < dimension_; ++axis) place[at(axis)] = spec_.vertices[at(axis)][at(v[at(axis)])];
      block.vertices.push_back(spec_.map ? spec_.map(place) : place);
      Index image = v;
      for (int axis = 0; axis < dimension_; ++axis)
        if (spec_.periodic[at(axis)] && v[at(axis)] == cells_[at(axis)]) image[at(axis)] = 0;
      if (image != v) block.periodic.emplace_back(number, vertexAt(image));
    }
  }

  const MeshSpec& spec_;
  int dimension_, rank_ = 0, ranks_ = 1;
  Index cells_{1, 1, 1};
  std::vector<Range> leftOut_;
  std::vector<std::int64_t> rowStart_;  // number of the first cell of each row along the first axis, and the end
};

}  // namespace

bool MeshSpec::isLeftOut(const std::array<double, 3>& centre) const {
  return std::ranges::any_of(leftOut, [&](const LeftOut& part) {
    for (int axis = 0; axis < dimension(); ++axis)
      if (centre[at(axis)] < part.lower[at(axis)] || centre[at(axis)] >= part.upper[at(axis)]) return false;
    return true;
  });
}

MeshBlock boxBlock(MPI_Comm comm, const MeshSpec& spec) {
  MeshBlock block;
  collectively(comm, [&] {
    checkInput(spec);
    block = Box(comm, spec).share();
  });
  return block;
}

}  // namespace lampblack
