#include "core/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include "core/cell_geometry.hpp"
#include "core/errors.hpp"
#include "core/least_squares.hpp"
#include "core/mesh_connect.hpp"
#include "core/mesh_distribution.hpp"

namespace lampblack {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

std::string placeText(const Vector3& place, int dimension) {
  return dimension == 2 ? fmt::format("({:.6g}, {:.6g}) m", place[0], place[1])
                        : fmt::format("({:.6g}, {:.6g}, {:.6g}) m", place[0], place[1], place[2]);
}

class MeshBuilder {
 public:
  MeshBuilder(Mesh& mesh, DistributedCells cells) : mesh_(mesh), cells_(std::move(cells)) {}

  void run() {
    orderCells();
    collectively(mesh_.comm, [&] { measureCells(); });
    orderFaces();
    measureFaces();
    keepDeviations();
    linkCellsToFaces();
    weighGradients();
    keepCorners();
  }

 private:
  // A local cell in the set it came in.
  struct Place {
    const CellSet& set;
    std::size_t index;
    [[nodiscard]] CellShape shape() const { return set.shapes[index]; }
    [[nodiscard]] std::span<const Vector3> corners() const { return set.placesOf(index); }
  };
  [[nodiscard]] Place of(int cell) const {
    return cell < mesh_.owned ? Place{cells_.owned, at(cell)} : Place{cells_.halo, at(cell - mesh_.owned)};
  }

  void orderCells() {
    Mesh& m = mesh_;
    m.owned = static_cast<int>(cells_.owned.size());
    m.cells = m.owned + static_cast<int>(cells_.halo.size());
    m.naturalCell = cells_.owned.numbers;
    m.naturalCell.insert(m.naturalCell.end(), cells_.halo.numbers.begin(), cells_.halo.numbers.end());
    m.haloRank = cells_.haloOwner;
  }

  void measureCells() {
    Mesh& m = mesh_;
    for (int c = 0; c < m.cells; ++c) {
      const Place cell = of(c);
      const CellMeasures measures = measureCell(cell.shape(), cell.corners());
      if (!(measures.size > 0.0) || !(measures.shape > 0.0))
        throw InputError(
            fmt::format("cell {} of the mesh (counted from zero), a {} at {}, is folded: a corner lies inside out, or "
                        "two corners are "
                        "one; repair the mesh there",
                        m.naturalCell[at(c)], nameOf(cell.shape()), placeText(measures.centre, m.dimension)));
      m.centre.push_back(measures.centre);
      m.volume.push_back(measures.size);
      if (m.dimension == 2) m.planarArea.push_back(measures.size);
      if (!m.axisymmetric()) continue;
      for (const Vector3& corner : cell.corners())
        if (corner[0] < 0.0)
          throw InputError(fmt::format("an axisymmetric mesh needs radii of zero or more, and has a vertex at {}",
                                       placeText(corner, 2)));
      m.volume.back() = m.planarArea.back() * m.centre.back()[0];
    }
  }

  // A face by its cells, before it has metrics.
  struct Link {
    int low, high;  // high is -1 on the boundary
    signed char lowSide, highSide;
    int patch;
    std::int64_t number;
  };

  // The faces of owned cells by number, interior ones first, so that a cell meets its faces in the same order on any
  // number of ranks.
  void orderFaces() {
    Mesh& m = mesh_;
    std::vector<Link> links;
    for (int c = 0; c < m.owned; ++c) {
      const auto sides = cells_.owned.sidesOf(at(c));
      for (std::size_t s = 0; s < sides.size(); ++s) {
        const CellSet::Side& side = sides[s];
        const auto own = static_cast<signed char>(s);
        if (side.neighbour < 0) {
          links.push_back({c, -1, own, -1, side.patch, side.face});
          continue;
        }
        const int beyond = localOf(side);
        if (side.isLow != 0)
          links.push_back({c, beyond, own, side.neighbourSide, -1, side.face});
        else if (beyond >= m.owned)
          links.push_back({beyond, c, side.neighbourSide, own, -1, side.face});
      }
    }
    std::ranges::sort(links, [](const Link& a, const Link& b) {
      const bool isInside = a.high >= 0, isOtherInside = b.high >= 0;
      return isInside != isOtherInside ? isInside : a.number < b.number;
    });
    m.faces = static_cast<int>(links.size());
    m.interiorFaces = static_cast<int>(std::ranges::count_if(links, [](const Link& link) { return link.high >= 0; }));
    for (const Link& link : links) {
      m.low.push_back(link.low);
      m.high.push_back(link.high);
      m.lowSide.push_back(link.lowSide);
      m.highSide.push_back(link.highSide);
      m.faceNumber.push_back(link.number);
      if (link.high < 0) m.patch.push_back(link.patch);
    }
  }

  // Local index of what lies beyond a side.
  [[nodiscard]] int localOf(const CellSet::Side& side) const {
    const Mesh& m = mesh_;
    if (side.owner == m.rank) return m.findOwned(side.neighbour);
    const auto [first, last] = std::ranges::equal_range(m.haloRank, side.owner);
    const auto begin = m.naturalCell.begin() + m.owned;
    const auto found =
        std::lower_bound(begin + (first - m.haloRank.begin()), begin + (last - m.haloRank.begin()), side.neighbour);
    return static_cast<int>(found - m.naturalCell.begin());
  }

  [[nodiscard]] SideMeasures measure(int cell, int side) const {
    const Place place = of(cell);
    return measureSide(place.shape(), sidesOf(place.shape())[at(side)], place.corners());
  }

  void measureFaces() {
    Mesh& m = mesh_;
    for (int face = 0; face < m.faces; ++face) {
      const SideMeasures side = measure(m.low[at(face)], m.lowSide[at(face)]);
      m.faceCentre.push_back(side.centre);
      m.normal.push_back(side.normal);
      if (m.axisymmetric()) m.planarLength.push_back(side.size);
      m.area.push_back(m.axisymmetric() ? side.size * side.centre[0] : side.size);
      const Vector3 fromLow = difference(side.centre, m.centre[at(m.low[at(face)])]);
      const double toLow = dot(fromLow, side.normal);
      double toHigh = 0.0;
      Vector3 step = fromLow;
      if (const int high = m.high[at(face)]; high >= 0) {
        // Of a periodic pair the other side is elsewhere.
        const Vector3 there = measure(high, m.highSide[at(face)]).centre;
        const Vector3 toCentre = difference(m.centre[at(high)], there);
        toHigh = dot(toCentre, side.normal);
        step = sum(step, toCentre);
      }
      m.step.push_back(step);
      m.distance.push_back(toLow + toHigh);
      m.lowWeight.push_back(toHigh / (toLow + toHigh));
    }
  }

  // What the steps deviate by from the normals and from the faces' centres; nothing where that is round-off.
  void keepDeviations() {
    constexpr double roundOff = 1e-11;
    Mesh& m = mesh_;
    std::array<double, 2> largest{0.0, 0.0};
    for (std::size_t face = 0; face < at(m.faces); ++face) {
      const Vector3 across = scaled(m.step[face], 1.0 / m.distance[face]);
      Vector3 oblique = difference(m.normal[face], across);
      if (length(oblique) < roundOff) {
        oblique = {};
        m.step[face] = scaled(m.normal[face], m.distance[face]);
      }
      if (const double size = length(oblique); size > Mesh::mostOblique)
        oblique = scaled(oblique, Mesh::mostOblique / size);
      Vector3 offset{};
      if (m.high[face] >= 0) {
        const Vector3 meets = sum(m.centre[at(m.low[face])], scaled(m.step[face], 1.0 - m.lowWeight[face]));
        offset = difference(m.faceCentre[face], meets);
        if (length(offset) < roundOff * m.distance[face]) offset = {};
      }
      m.oblique.push_back(oblique);
      m.offset.push_back(offset);
      largest[0] = std::max(largest[0], length(oblique));
      largest[1] = std::max(largest[1], length(offset));
    }
    MPI_Allreduce(MPI_IN_PLACE, largest.data(), 2, MPI_DOUBLE, MPI_MAX, m.comm);
    if (largest[0] == 0.0) m.oblique = {};
    if (largest[1] == 0.0) m.offset = {};
  }

  // The rows of faceOfCell, each in face order.
  void linkCellsToFaces() {
    Mesh& m = mesh_;
    const auto eachSide = [&](auto&& visit) {
      for (int face = 0; face < m.faces; ++face) {
        visit(face, m.low[at(face)]);
        if (m.high[at(face)] >= 0) visit(face, m.high[at(face)]);
      }
    };
    std::vector<int> next(at(m.cells) + 1, 0);
    eachSide([&](int, int cell) { ++next[at(cell) + 1]; });
    std::partial_sum(next.begin(), next.end(), next.begin());
    m.faceStart = next;
    m.faceOfCell.resize(at(next.back()));
    eachSide([&](int face, int cell) { m.faceOfCell[at(next[at(cell)]++)] = face; });
  }

  void weighGradients() {
    Mesh& m = mesh_;
    const auto stepFrom = [&](int cell, int face) {
      return scaled(m.step[at(face)], m.low[at(face)] == cell ? 1.0 : -1.0);
    };
    for (int c = 0; c < m.owned; ++c) {
      const std::span<const int> faces{&m.faceOfCell[at(m.faceStart[at(c)])],
                                       at(m.faceStart[at(c) + 1] - m.faceStart[at(c)])};
      const bool isInside = std::ranges::all_of(faces, [&](int face) { return m.high[at(face)] >= 0; });
      m.gradientRow.push_back(isInside ? static_cast<int>(m.gradientWeight.size()) : -1);
      if (!isInside) continue;
      LeastSquares squares;
      for (const int face : faces) squares.add(stepFrom(c, face));
      squares.finish(m.dimension);
      for (const int face : faces) m.gradientWeight.push_back(squares.weight(stepFrom(c, face)));
    }
  }

  void keepCorners() {
    Mesh& m = mesh_;
    const CellSet& owned = cells_.owned;
    m.shape = owned.shapes;
    m.cornerStart.assign(owned.cornerStart.begin(), owned.cornerStart.end());
    m.vertexNumber = owned.vertices;
    std::ranges::sort(m.vertexNumber);
    m.vertexNumber.erase(std::unique(m.vertexNumber.begin(), m.vertexNumber.end()), m.vertexNumber.end());
    m.vertexNumber.shrink_to_fit();
    m.vertex.resize(m.vertexNumber.size());
    for (std::size_t i = 0; i < owned.vertices.size(); ++i) {
      const auto found = std::ranges::lower_bound(m.vertexNumber, owned.vertices[i]);
      m.corner.push_back(static_cast<int>(found - m.vertexNumber.begin()));
      m.vertex[at(m.corner.back())] = owned.places[i];
    }
  }

  Mesh& mesh_;
  DistributedCells cells_;
};

}  // namespace

Mesh::Mesh(MPI_Comm communicator, const MeshBlock& block, Geometry meshGeometry, std::span<const double> cellWeight)
    : comm(communicator), geometry(meshGeometry) {
  build(block, cellWeight);
}

Mesh::Mesh(MPI_Comm communicator, const MeshSpec& spec, std::span<const double> cellWeight)
    : comm(communicator), geometry(spec.geometry), box(spec) {
  build(boxBlock(comm, spec), cellWeight);
}

void Mesh::build(const MeshBlock& block, std::span<const double> cellWeight) {
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  dimension = block.dimension;
  patches = block.patches;
  totalCells = block.totalCells;
  collectively(comm, [&] {
    if (!cellWeight.empty() && cellWeight.size() != block.shapes.size())
      throw std::invalid_argument(
          fmt::format("Mesh: {} cell weights for {} cells", cellWeight.size(), block.shapes.size()));
    if (axisymmetric() && dimension != 2) throw InputError("an axisymmetric mesh lies in a plane");
  });
  ConnectedCells connected = connect(comm, block);
  totalFaces = connected.totalFaces;
  totalVertices = connected.totalVertices;
  const std::vector<int> owner = partitionAlongCurve(comm, connected.cells, dimension, cellWeight);
  MeshBuilder(*this, distribute(comm, std::move(connected.cells), totalCells, owner)).run();
}

int Mesh::findOwned(std::int64_t natural) const {
  // Owned cells are ordered by number.
  const auto end = naturalCell.begin() + owned;
  const auto it = std::lower_bound(naturalCell.begin(), end, natural);
  return it == end || *it != natural ? -1 : static_cast<int>(it - naturalCell.begin());
}

}  // namespace lampblack
